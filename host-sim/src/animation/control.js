// Play, pause and time of the pictures that move. Without this script they play by themselves.
for (const figure of document.querySelectorAll("figure.moving")) {
  const pictures = [...figure.querySelectorAll("svg")];
  const [button, slider, shown] = ["button", "input", "output"].map((name) => figure.querySelector(name));
  const length = Number(figure.dataset.seconds);
  const slow = Number(figure.dataset.slow);
  let playing = false;

  const show = () => {
    const time = pictures[0].getCurrentTime() % length;
    slider.value = time;
    shown.value = `${(time / slow).toFixed(3)} s`;
    slider.setAttribute("aria-valuetext", shown.value);
  };
  const tick = () => {
    if (!playing) return;
    show();
    requestAnimationFrame(tick);
  };
  const play = (wanted) => {
    playing = wanted;
    for (const picture of pictures) playing ? picture.unpauseAnimations() : picture.pauseAnimations();
    button.textContent = playing ? "Pause" : "Play";
    tick();
  };
  const seek = (time) => {
    for (const picture of pictures) picture.setCurrentTime(time);
    show();
  };
  button.addEventListener("click", () => play(!playing));
  slider.addEventListener("input", () => {
    const time = Number(slider.value);
    play(false);
    seek(time);
  });
  // Now that it can be stopped, it is shown to those who prefer reduced motion too, at rest.
  figure.classList.add("steered");
  figure.querySelector(".steer").hidden = false;
  seek(0);
  play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
}
