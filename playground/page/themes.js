// Light and dark: the system's choice until the reader makes one, which is kept where the browser allows it.

const KEY = "stillbeam-theme";

function kept() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

export function listenToTheme(onChange) {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const apply = (theme) => {
    document.documentElement.dataset.theme = theme;
    onChange();
  };
  const bySystem = () => apply(kept() ?? (system.matches ? "dark" : "light"));
  system.addEventListener("change", bySystem);
  document.querySelector("#theme").addEventListener("click", () => {
    const theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    try {
      localStorage.setItem(KEY, theme);
    } catch {
      // A page from a file may have no storage. The choice holds until it is closed.
    }
    apply(theme);
  });
  bySystem();
}
