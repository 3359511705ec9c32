// The clock of the page: time, play, speed, loop. It owns no picture; it calls `changed`.

export const SPEEDS = [0.1, 0.25, 0.5, 1, 1.5, 2];

export class Player {
  constructor(duration, rate, changed) {
    this.duration = duration;  // s
    this.rate = rate;          // frames per second of the baked animation
    this.changed = changed;
    this.time = 0;
    this.speed = 1;
    this.playing = false;
    this.loop = false;
  }

  seek(t) {
    const time = Number.isFinite(t) ? t : 0;
    this.time = Math.min(Math.max(time, 0), this.duration);
    this.changed('time');
  }

  // Whole frames: lands on the grid even from between two frames.
  step(frames) {
    this.pause();
    const frame = this.time * this.rate;
    const from = frames > 0 ? Math.floor(frame + 1e-4) : Math.ceil(frame - 1e-4);
    this.seek((from + frames) / this.rate);
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.duration - 1e-6) this.time = 0;
    this.playing = true;
    this.changed('playing');
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.changed('playing');
  }

  toggle() {
    this.playing ? this.pause() : this.play();
  }

  setSpeed(speed) {
    this.speed = Math.min(Math.max(speed, SPEEDS[0]), SPEEDS[SPEEDS.length - 1]);
    this.changed('speed');
  }

  // The next speed up (+1) or down (-1) of the list.
  nudgeSpeed(direction) {
    const at = SPEEDS.reduce((best, s, i) =>
      Math.abs(s - this.speed) < Math.abs(SPEEDS[best] - this.speed) ? i : best, 0);
    this.setSpeed(SPEEDS[Math.min(Math.max(at + direction, 0), SPEEDS.length - 1)]);
  }

  setLoop(on) {
    this.loop = on;
    this.changed('loop');
  }

  // `seconds` of the wall clock have passed. A hidden tab or a stall does not skip ahead.
  advance(seconds) {
    if (!this.playing) return;
    let t = this.time + Math.min(seconds, 0.1) * this.speed;
    if (t >= this.duration) {
      if (this.loop && this.duration > 0) t %= this.duration;
      else {
        t = this.duration;
        this.playing = false;
        this.changed('playing');
      }
    }
    this.time = t;
    this.changed('time');
  }
}
