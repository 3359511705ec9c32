// The timeline: a lane per fighter with its actions, marks that jump, and a playhead to drag.
import { escapeHtml, plain, TYPES } from './data.js';

const LABEL = 92;  // px for the names at the left

// A round step for the ruler, s.
function rulerStep(seconds, pixels) {
  const wanted = (seconds * 80) / Math.max(pixels, 1);
  return [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300].find((s) => s >= wanted) ?? 600;
}

// As much of a text as has room, or nothing where that would tell nothing.
function fitted(g, text, room) {
  if (g.measureText(text).width <= room) return text;
  let length = text.length - 1;
  while (length > 0 && g.measureText(`${text.slice(0, length)}…`).width > room) --length;
  return length < 5 ? '' : `${text.slice(0, length).trimEnd()}…`;
}

export class Timeline {
  constructor(root, story, fighters, player) {
    this.root = root;
    this.story = story;
    this.fighters = fighters;
    this.player = player;
    this.from = 0;
    this.to = Math.max(player.duration, 0.01);
    this.tall = fighters.length <= 2;  // labels below the marks, not between them
    this.laneHeight = this.tall ? 30 : 17;
    root.innerHTML = `
      <div class="lanes-names">${fighters.map((f) => `<div style="height:${this.laneHeight}px;--c:${f.colour}"><i></i><span title="${escapeHtml(f.name)}">${escapeHtml(f.name)}</span></div>`).join('')}</div>
      <div class="lanes" style="--lane:${this.laneHeight}px;--mark:${this.tall ? 9 : 6.5}px" role="slider" tabindex="0" aria-label="Time" aria-valuemin="0" aria-valuemax="${player.duration.toFixed(2)}">
        <canvas></canvas><div class="marks"></div><div class="playhead"><b></b></div><div class="hover" hidden></div>
      </div>`;
    this.lanes = root.querySelector('.lanes');
    this.canvas = root.querySelector('canvas');
    this.marks = root.querySelector('.marks');
    this.head = root.querySelector('.playhead');
    this.hover = root.querySelector('.hover');
    this.makeMarks();
    this.listen();
    new ResizeObserver(() => this.layout()).observe(this.lanes);
  }

  makeMarks() {
    this.buttons = this.story.events.map((event) => {
      const button = document.createElement('button');
      const colour = TYPES[event.type]?.colour ?? '#8b95a5';
      button.className = `event-mark ${event.type}`;
      button.dataset.event = event.index;
      button.style.setProperty('--c', colour);
      const lane = Math.min(Math.max(event.who, 0), this.fighters.length - 1);
      button.style.top = `${lane * this.laneHeight}px`;
      button.tabIndex = -1;
      button.setAttribute('aria-label', `${event.t.toFixed(2)} s: ${this.story.tell(event)}`);
      return button;
    });
    // Decisions and throws under the marks that matter more.
    const weight = { decision: 0, strike: 1 };
    const order = [...this.buttons].sort((a, b) => this.rank(a, weight) - this.rank(b, weight));
    this.marks.replaceChildren(...order);
  }

  rank(button, weight) {
    return weight[this.story.events[button.dataset.event].type] ?? 2;
  }

  x(t) {
    return ((t - this.from) / (this.to - this.from)) * this.width;
  }

  time(x) {
    return this.from + (x / this.width) * (this.to - this.from);
  }

  zoom(factor, about) {
    const whole = Math.max(this.player.duration, 0.01);
    const span = Math.min(whole, Math.max(0.5, (this.to - this.from) * factor));
    const share = (about - this.from) / (this.to - this.from);
    this.from = Math.min(Math.max(0, about - share * span), whole - span);
    this.to = this.from + span;
    this.layout();
  }

  layout() {
    this.width = Math.max(1, this.lanes.clientWidth);
    this.story.events.forEach((event, i) => {
      const inside = this.inView(event.t);
      this.buttons[i].hidden = !inside;
      if (inside) this.buttons[i].style.left = `${this.x(event.t).toFixed(1)}px`;
    });
    this.draw();
    this.show();
  }

  draw() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const height = this.lanes.clientHeight;
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const g = this.canvas.getContext('2d');
    g.scale(ratio, ratio);
    g.clearRect(0, 0, this.width, height);
    g.textBaseline = 'middle';
    this.story.spans.forEach((spans, lane) => this.drawLane(g, spans, lane));
    const step = rulerStep(this.to - this.from, this.width);
    const bottom = this.fighters.length * this.laneHeight;
    g.font = '10px system-ui, sans-serif';
    g.textAlign = 'center';
    for (let k = Math.ceil(this.from / step); k * step <= this.to + 1e-9; ++k) {
      const x = Math.round(this.x(k * step)) + 0.5;
      g.strokeStyle = 'rgba(255,255,255,.07)';
      g.beginPath();
      g.moveTo(x, 0);
      g.lineTo(x, bottom + 4);
      g.stroke();
      g.fillStyle = '#77839a';
      const text = step < 1 ? (k * step).toFixed(step < 0.1 ? 2 : 1) : `${k * step}`;
      if (x > 6 && x < this.width - 8) g.fillText(text, x, bottom + 11);
    }
  }

  drawLane(g, spans, lane) {
    const top = lane * this.laneHeight + 1;
    const height = this.laneHeight - 2;
    g.fillStyle = 'rgba(255,255,255,.025)';
    g.fillRect(0, top, this.width, height);
    g.font = '10px system-ui, sans-serif';
    g.textAlign = 'left';
    const marks = this.tall ? [] : this.marksIn(lane);
    for (const span of spans) {
      const from = Math.max(span.from, this.from);
      const to = Math.min(span.to, this.to, this.player.duration);
      if (to <= from) continue;
      const x = this.x(from);
      const width = Math.max(1, this.x(to) - x - 1);
      g.globalAlpha = span.forced ? 0.42 : 0.2;
      g.fillStyle = span.forced ? TYPES.response.colour : this.fighters[lane].colour;
      g.fillRect(x, top, width, height);
      g.globalAlpha = 1;
      const [begin, end] = this.gap(x + 5, x + width - 3, marks);
      if (end - begin < 20) continue;
      g.fillStyle = 'rgba(230,236,246,.62)';
      g.fillText(fitted(g, plain(span.name), end - begin), begin, top + height - 5.5);
    }
  }

  // Where the lane's marks stand, from left to right; decisions and throws are small and do not count.
  marksIn(lane) {
    return this.story.events
      .filter((event) => event.who === lane && event.type !== 'decision' && event.type !== 'strike')
      .map((event) => this.x(event.t));
  }

  // The widest stretch between two places that no mark stands in.
  gap(from, to, marks) {
    const aside = 8;  // px
    const inside = marks.filter((x) => x > from - aside && x < to + aside);
    const edges = [from - aside, ...inside, to + aside];
    let best = [from, from];
    for (let i = 0; i + 1 < edges.length; ++i) {
      const [begin, end] = [edges[i] + aside, edges[i + 1] - aside];
      if (end - begin > best[1] - best[0]) best = [begin, end];
    }
    return best;
  }

  listen() {
    const at = (event) => event.clientX - this.lanes.getBoundingClientRect().left;
    this.marks.addEventListener('click', (event) => {
      const button = event.target.closest('.event-mark');
      if (!button) return;
      this.player.pause();
      this.onJump?.(this.story.events[button.dataset.event]);
    });
    this.lanes.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || event.target.closest('.event-mark')) return;
      this.lanes.setPointerCapture(event.pointerId);
      this.dragging = true;
      this.player.seek(this.time(at(event)));
    });
    this.lanes.addEventListener('pointermove', (event) => {
      if (this.dragging) this.player.seek(this.time(at(event)));
      this.tooltip(event, at(event));
    });
    for (const end of ['pointerup', 'pointercancel']) this.lanes.addEventListener(end, () => (this.dragging = false));
    this.lanes.addEventListener('pointerleave', () => (this.hover.hidden = true));
    this.lanes.addEventListener('dblclick', () => {
      this.from = 0;
      this.to = Math.max(this.player.duration, 0.01);
      this.layout();
    });
    this.lanes.addEventListener('wheel', (event) => {
      event.preventDefault();
      if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
        const shift = (event.deltaX / this.width) * (this.to - this.from);
        const span = this.to - this.from;
        this.from = Math.min(Math.max(0, this.from + shift), this.player.duration - span);
        this.to = this.from + span;
        this.layout();
      } else this.zoom(Math.exp(event.deltaY * 0.0016), this.time(at(event)));
    }, { passive: false });
  }

  tooltip(event, x) {
    const button = event.target.closest?.('.event-mark');
    const told = button ? this.story.events[button.dataset.event] : null;
    this.hover.hidden = false;
    this.hover.innerHTML = told
      ? `<b>${told.t.toFixed(2)} s</b> ${escapeHtml(this.story.tell(told))}`
      : `<b>${this.time(x).toFixed(2)} s</b> ${escapeHtml(this.doing(event, this.time(x)))}`;
    const half = this.hover.offsetWidth / 2;
    this.hover.style.left = `${Math.min(Math.max(x, half - LABEL), this.width - half)}px`;
  }

  // What the fighter whose lane is under the pointer does then.
  doing(event, t) {
    const lane = Math.floor((event.clientY - this.lanes.getBoundingClientRect().top) / this.laneHeight);
    const span = this.story.spans[lane]?.find(({ from, to }) => from <= t && t < to);
    return span ? `${this.fighters[lane].name}: ${plain(span.name)}` : '';
  }

  inView(t) {
    return t >= this.from - 1e-6 && t <= this.to + 1e-6;
  }

  // The player's time was set or goes on: a zoomed view pages along.
  follow() {
    const t = this.player.time;
    if (this.dragging || this.inView(t)) return;
    const span = this.to - this.from;
    this.from = Math.min(Math.max(0, t - 0.1 * span), Math.max(0, this.player.duration - span));
    this.to = this.from + span;
    this.layout();
  }

  // The playhead at the player's time, where the view holds it.
  show() {
    const t = this.player.time;
    this.head.hidden = !this.inView(t);
    this.head.style.transform = `translateX(${this.x(t).toFixed(1)}px)`;
    this.lanes.setAttribute('aria-valuenow', t.toFixed(2));
  }
}
