// The clock of the pictures.

/** Time for which the last picture stays before the motion begins again, s. */
const PAUSE = 0.5;

export class Player {
  constructor(onTime, onState) {
    Object.assign(this, { onTime, onState, time: 0, end: 1, speed: 1, playing: false });
  }

  /** Takes the length of the motion, s. */
  lasts(end) {
    this.end = end;
    if (this.time > end) this.time = 0;
    this.onTime(this.shown());
  }

  shown() {
    return Math.min(this.time, this.end);
  }

  play() {
    if (this.playing) return;
    this.playing = true;
    this.onState(true);
    let before = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      // A page that was hidden goes on from where it was; the first frame may have begun before the click.
      this.time += (Math.min(Math.max(now - before, 0), 100) / 1000) * this.speed;
      before = now;
      if (this.time > this.end + PAUSE * this.speed) this.time = 0;
      this.onTime(this.shown());
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  pause() {
    this.playing = false;
    this.onState(false);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  /** Goes to a time, s, and stays there. */
  go(time) {
    if (this.playing) this.pause();
    this.time = Math.min(this.end, Math.max(0, time));
    this.onTime(this.time);
  }
}
