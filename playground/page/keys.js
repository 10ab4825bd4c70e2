// Keys that work wherever the focus has no use of its own for them.

export function listenToKeys(player, tick) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tagName, type } = event.target;
    const own = { Space: ["BUTTON", "SELECT", "A"], Arrow: ["SELECT", "INPUT", "PRE"] };
    const isText = tagName === "INPUT" && type === "number";
    if (event.key === " ") {
      if (own.Space.includes(tagName) || isText || type === "radio") return;
      player.toggle();
    } else if (own.Arrow.includes(tagName)) {
      return;
    } else if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
      const ticks = Math.round(player.shown() / tick) + (event.key === "ArrowLeft" ? -1 : 1);
      player.go(ticks * tick);
    } else if (event.key === "Home") {
      player.go(0);
    } else {
      return;
    }
    event.preventDefault();
  });
}
