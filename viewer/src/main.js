// The page: reads the fight, puts the parts together and answers keys, buttons and `window.ringcraft`.
import { Cameras, CAMERAS } from './cameras.js';
import { escapeHtml, FIGHTER_COLOURS, plain, readFight, TYPES } from './data.js';
import { Cast, load } from './fighters.js';
import { OVERLAYS, Overlays } from './overlays.js';
import { Panels } from './panels.js';
import { Player, SPEEDS } from './player.js';
import { makeRing } from './ring.js';
import { Stage } from './stage.js';
import { Story } from './story.js';
import { Timeline } from './timeline.js';
import { makeApi } from './api.js';

const $ = (id) => document.getElementById(id);
const ICONS = {
  play: '<path d="M7 4.5v15l12-7.5z"/>',
  pause: '<path d="M6 4.5h4v15H6zM14 4.5h4v15h-4z"/>',
  start: '<path d="M5 5h2.5v14H5zM19 5v14l-10-7z"/>',
  back: '<path d="M15 5v14l-9-7zM17 5h2v14h-2z"/>',
  forward: '<path d="M9 5v14l9-7zM5 5h2v14H5z"/>',
  loop: '<path d="M7 7h9V4l5 4.5L16 13v-3H9v3.5H6V8a1 1 0 0 1 1-1zm10 10H8v3l-5-4.5L8 11v3h7v-3.5h3V16a1 1 0 0 1-1 1z"/>',
};
const icon = (name) => `<svg viewBox="0 0 24 24" aria-hidden="true">${ICONS[name]}</svg>`;
const KEYS = [
  ['Space', 'play or pause'], [', and .', 'one frame back, one frame on'], ['← and →', 'half a second back, on'],
  ['N and B', 'next event, event before'], ['Home and End', 'to the start, to the end'], ['[ and ]', 'slower, faster'],
  ['L', 'loop'], ['F S V T R O', 'camera: follow, side, front, top, ring, orbit'], ['1 to 6', 'overlays'], ['P', 'side panel'],
  ['wheel on the timeline', 'zoom; double click shows all'],
];

class Page {
  constructor(fight, gltf) {
    this.header = fight.header;
    this.stage = new Stage($('stage'));
    this.cast = new Cast(gltf, fight.header, FIGHTER_COLOURS);
    this.stage.scene.add(gltf.scene);
    this.ropes = this.addRing();
    const last = fight.events.length ? fight.events[fight.events.length - 1].t : 0;
    this.player = new Player(this.cast.duration || last, this.cast.rate, (what) => this.playerChanged(what));
    this.story = new Story(fight.header, fight.events, this.cast.fighters.map((f) => f.name));
    this.overlays = new Overlays(this.stage, this.cast, fight.events, this.ropes);
    this.cameras = new Cameras(this.stage, this.cast, (what) => {
      if (what === 'name') this.showCamera();
      this.invalidate();
    });
    this.timeline = new Timeline($('timeline'), this.story, this.cast.fighters, this.player);
    this.panels = new Panels(this.story, this.cast.fighters, fight.report, (event) => this.jump(event));
    this.timeline.onJump = (event) => this.jump(event);
    this.makeChrome();
    this.makeBoard();
    this.listen();
    this.fit();
    this.cast.pose(0);
    this.cameras.set('follow');
    this.readHash();
    this.draw();
  }

  // A ring of the size that the file's own has, else large enough for the whole fight. The file's own is
  // plain boxes whose ropes cannot step out of the picture, so the page's stands in for it.
  addRing() {
    let own = null;
    let inside = 0;
    this.cast.root.traverse((node) => {
      if (!own && this.cast.nameOf(node) === 'ring') own = node;
    });
    own?.traverse((node) => {
      if (/ropes/i.test(node.material?.name ?? '')) {
        node.geometry.computeBoundingBox();
        inside = node.geometry.boundingBox.max.x - node.geometry.boundingBox.min.x;
      }
    });
    if (own && inside < 2) return null;  // some other ring: it is shown as it is
    if (own) own.visible = false;
    let farthest = 0;
    for (let f = 0; f < this.cast.frames; f += 30) {
      for (const { hips } of this.cast.at(f)) farthest = Math.max(farthest, Math.abs(hips.x), Math.abs(hips.z));
    }
    const told = Number(this.header.ring_size);
    const ring = makeRing(inside || (told > 2 ? told : Math.max(6.1, 2 * (farthest + 0.4))));
    this.stage.scene.add(ring);
    return ring.getObjectByName('ropes');
  }

  makeChrome() {
    const { header } = this;
    const scene = [plain(header.scene), header.seed !== undefined ? `seed ${header.seed}` : ''].filter(Boolean).join(' · ');
    $('scene').textContent = scene;
    document.title = `${this.cast.fighters.map((f) => f.name).join(' against ')} – Ringcraft`;
    $('to-start').innerHTML = icon('start');
    $('step-back').innerHTML = icon('back');
    $('step-forward').innerHTML = icon('forward');
    $('loop').innerHTML = icon('loop');
    $('speed').innerHTML = SPEEDS.map((s) => `<option value="${s}">${s}×</option>`).join('');
    $('cameras').innerHTML = Object.entries(CAMERAS).map(([id, label]) => `<button data-camera="${id}">${label}</button>`).join('');
    $('overlays').innerHTML = this.overlays.names().map((id, i) =>
      `<label><input type="checkbox" data-overlay="${id}"><span>${OVERLAYS[id]}</span><kbd>${i + 1}</kbd></label>`).join('');
    $('help').innerHTML = `<h2>Keys</h2><table>${KEYS.map(([k, v]) => `<tr><th>${k.split(' ').map((w) => (/^(and|to|on|the|wheel|timeline)$/.test(w) ? w : `<kbd>${escapeHtml(w)}</kbd>`)).join(' ')}</th><td>${v}</td></tr>`).join('')}</table>
      <h2>Marks</h2><p class="legend">${Object.values(TYPES).map((t) => `<span style="--c:${t.colour}"><i></i>${t.label}</span>`).join('')}</p>
      <form method="dialog"><button autofocus>Close</button></form>`;
    this.showOverlays();
    this.playerChanged('playing');
    this.playerChanged('speed');
    this.playerChanged('loop');
  }

  makeBoard() {
    $('board').classList.toggle('crowd', this.cast.fighters.length > 4);
    $('board').innerHTML = this.cast.fighters.map((fighter, i) =>
      `<div class="fighter${i === 1 && this.cast.fighters.length === 2 ? ' right' : ''}" style="--c:${fighter.colour}"><div class="who"><b title="${escapeHtml(fighter.name)}">${escapeHtml(fighter.name)}</b><span class="action"></span></div>
       <div class="health"><i class="late"></i><i class="now"></i></div><div class="score"></div></div>`).join('');
    this.boardRows = [...$('board').children].map((root) => ({
      action: root.querySelector('.action'), now: root.querySelector('.now'), late: root.querySelector('.late'),
      score: root.querySelector('.score'), root, key: '',
    }));
  }

  showBoard(t) {
    this.story.board(t).forEach((row, i) => {
      const key = JSON.stringify(row);
      const parts = this.boardRows[i];
      if (parts.key === key) return;
      parts.key = key;
      const share = `${((100 * row.health) / row.full).toFixed(2)}%`;
      parts.now.style.width = share;
      parts.late.style.width = share;
      parts.root.classList.toggle('low', row.health < 0.3 * row.full);
      parts.action.textContent = row.out ? 'knocked out' : row.action ? plain(row.action.name) : '';
      parts.action.classList.toggle('forced', Boolean(row.action?.forced || row.out));
      parts.score.innerHTML = `<span><b>${row.health.toFixed(0)}</b><em> health</em></span><span><b>${row.landed}</b>/${row.thrown} landed</span>` +
        `<span><b>${row.blocked}</b> blocked</span>${row.downs ? `<span class="down"><b>${row.downs}</b> down</span>` : ''}`;
    });
  }

  listen() {
    $('play').onclick = () => this.player.toggle();
    $('to-start').onclick = () => this.player.seek(0);
    $('step-back').onclick = () => this.player.step(-1);
    $('step-forward').onclick = () => this.player.step(1);
    $('loop').onclick = () => this.player.setLoop(!this.player.loop);
    $('speed').onchange = (event) => this.player.setSpeed(Number(event.target.value));
    $('cameras').onclick = (event) => event.target.dataset.camera && this.cameras.set(event.target.dataset.camera);
    $('overlays').onchange = (event) => this.setOverlay(event.target.dataset.overlay, event.target.checked);
    $('overlay-button').onclick = () => this.openOverlays($('overlays').hidden);
    document.addEventListener('pointerdown', (event) => {
      if (!event.target.closest('#overlay-menu')) this.openOverlays(false);
    });
    $('panel-button').onclick = () => this.togglePanel();
    $('help-button').onclick = () => $('help').showModal();
    window.addEventListener('hashchange', () => this.readHash());
    document.addEventListener('keydown', (event) => this.key(event));
    // What a pointer has pressed does not keep the space bar; what Tab has reached does.
    let pointed = false;
    document.addEventListener('pointerdown', () => (pointed = true), true);
    document.addEventListener('keydown', () => (pointed = false), true);
    document.addEventListener('click', (event) => pointed && event.target.closest('button, input')?.blur());
    new ResizeObserver(() => this.fit()).observe($('view'));
    // After a sleep or a reset of the graphics card the canvas is empty.
    this.stage.canvas.addEventListener('webglcontextrestored', () => this.invalidate());
    if (innerWidth < 760) this.togglePanel();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || $('help').open) return;
    if (event.target.matches?.('select, input:not([type=checkbox])')) return;
    if (event.key === ' ' && event.target.matches?.('button, input')) return;
    const actions = {
      ' ': () => this.player.toggle(),
      ',': () => this.player.step(-1),
      '.': () => this.player.step(1),
      ArrowLeft: () => this.player.seek(this.player.time - 0.5),
      ArrowRight: () => this.player.seek(this.player.time + 0.5),
      Home: () => this.player.seek(0),
      End: () => this.player.seek(this.player.duration),
      '[': () => this.player.nudgeSpeed(-1),
      ']': () => this.player.nudgeSpeed(1),
      l: () => this.player.setLoop(!this.player.loop),
      n: () => this.jumpBy(1),
      b: () => this.jumpBy(-1),
      f: () => this.cameras.set('follow'),
      s: () => this.cameras.set('side'),
      v: () => this.cameras.set('front'),
      r: () => this.cameras.set('ring'),
      t: () => this.cameras.set('top'),
      o: () => this.cameras.set('orbit', true),
      p: () => this.togglePanel(),
      '?': () => $('help').showModal(),
    };
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const overlay = this.overlays.names()[Number(key) - 1];
    const act = overlay ? () => this.setOverlay(overlay, !this.overlays.on(overlay)) : actions[key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  // #t=12.3&camera=side&overlays=capsules,support&panel=0
  readHash() {
    const told = new URLSearchParams(location.hash.slice(1));
    if (told.has('panel')) this.togglePanel(told.get('panel') !== '0');
    if (told.has('overlays')) for (const name of told.get('overlays').split(',')) this.setOverlay(name, true);
    if (told.has('t')) this.player.seek(Number(told.get('t')));
    if (told.has('camera')) {
      this.cast.pose(this.player.time);
      this.cameras.set(told.get('camera'));
    }
  }

  togglePanel(on = document.body.classList.contains('no-panel')) {
    document.body.classList.toggle('no-panel', !on);
    $('panel-button').setAttribute('aria-pressed', on);
  }

  openOverlays(on) {
    $('overlays').hidden = !on;
    $('overlay-button').setAttribute('aria-expanded', on);
  }

  setOverlay(name, on) {
    const known = this.overlays.set(name, on);
    this.showOverlays();
    this.invalidate();
    return known;
  }

  showOverlays() {
    for (const box of $('overlays').querySelectorAll('input')) box.checked = this.overlays.on(box.dataset.overlay);
  }

  showCamera() {
    for (const button of $('cameras').children) button.setAttribute('aria-pressed', button.dataset.camera === this.cameras.name);
  }

  jump(event) {
    this.player.seek(event.t);
    this.panels.ask(event);
  }

  jumpBy(direction) {
    const t = this.player.time;
    const events = this.panels.listed;
    const next = direction > 0 ? events.find((e) => e.t > t + 1e-3) : events.findLast((e) => e.t < t - 1e-3);
    if (next) this.player.seek(next.t);
  }

  playerChanged(what) {
    const { player } = this;
    if (what === 'time') this.timeline?.follow();
    if (what === 'playing') {
      $('play').innerHTML = icon(player?.playing ? 'pause' : 'play');
      $('play').setAttribute('aria-label', player?.playing ? 'Pause' : 'Play');
      this.last = undefined;
    }
    if (what === 'speed') $('speed').value = String(SPEEDS.includes(player.speed) ? player.speed : 1);
    if (what === 'loop') $('loop').setAttribute('aria-pressed', player.loop);
    this.invalidate();
  }

  // `share` of the pixels across: fewer while a slow machine plays.
  fit(share = 1) {
    const box = $('view').getBoundingClientRect();
    if (box.width < 2 || box.height < 2) return;
    this.share = share;
    this.stage.resize(box.width, box.height, share * Math.min(window.devicePixelRatio || 1, 2));
    this.invalidate();
  }

  // Trades sharpness for speed while playing; a paused picture is always sharp.
  pace(seconds) {
    if (!this.player.playing) {
      if (this.share < 1) this.fit();
      this.slow = 0;
    } else if (seconds > 0.045) {
      this.slow = (this.slow ?? 0) + 1;
      if (this.slow > 6 && this.share > 0.4) {
        this.fit(this.share * 0.75);
        this.slow = 0;
      }
    } else this.slow = 0;
  }

  // One picture at the next chance; while playing, one after the other.
  invalidate() {
    if (this.waiting || this.held) return;
    this.waiting = requestAnimationFrame((now) => {
      this.waiting = 0;
      const seconds = this.last === undefined ? 0 : (now - this.last) / 1000;
      this.last = now;
      this.pace(seconds);
      this.player.advance(seconds);
      this.draw();
      if (this.player.playing) this.invalidate();
    });
  }

  drawStage(t) {
    this.cast.pose(t);
    this.cameras.update(t);
    this.stage.light(this.cast.centre(t));
    this.overlays.update(t);
    this.ropes?.userData.clear(this.stage.camera, this.cameras.target, this.cameras.name === 'ring');
    this.stage.render();
  }

  draw() {
    const t = this.player.time;
    this.drawStage(t);
    this.timeline.show();
    this.panels.show(t);
    this.showBoard(t);
    this.showWords(t);
  }

  showWords(t) {
    const frame = Math.round(t * this.cast.rate);
    const clock = `${t.toFixed(2)} / ${this.player.duration.toFixed(2)} s`;
    if ($('clock').textContent !== clock) $('clock').textContent = clock;
    const hud = `${t.toFixed(3)} s  frame ${frame}${this.player.speed === 1 ? '' : `  ${this.player.speed}×`}`;
    if ($('hud').textContent !== hud) $('hud').textContent = hud;
    const told = this.story.caption(t);
    const words = told.map((event) => this.story.tell(event)).join(' → ');
    if ($('caption').textContent !== words) {
      $('caption').textContent = words;
      $('caption').style.setProperty('--c', TYPES[told[0]?.type]?.colour ?? '#fff');
    }
  }
}

function fail(error) {
  const lost = /webgl/i.test(String(error?.message));
  document.body.classList.add('failed');
  $('message').hidden = false;
  $('message').textContent = lost
    ? 'This browser shows no WebGL picture. Turn on hardware acceleration or open the page in another browser.'
    : `The fight cannot be shown: ${error?.message ?? error}`;
  throw error;
}

async function start() {
  const fight = readFight();
  const gltf = await load(fight.glb);
  return new Page(fight, gltf);
}

window.ringcraft = makeApi(start().catch(fail));
