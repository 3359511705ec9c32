// What the page holds: the bytes of fight.glb, the events, the report.

// Event types in the order of the legend, with their colours.
export const TYPES = {
  hit: { label: 'hit', colour: '#ff5d55' },
  block: { label: 'block', colour: '#f0b429' },
  miss: { label: 'miss', colour: '#8b95a5' },
  response: { label: 'response', colour: '#c77dff' },
  knockdown: { label: 'knockdown', colour: '#ff2e88' },
  getup: { label: 'get-up', colour: '#3ecf8e' },
  strike: { label: 'strike', colour: '#5f6b7c' },
  decision: { label: 'decision', colour: '#4c9aff' },
};
export const FIGHTER_COLOURS = ['#ff6b57', '#4d9dff', '#58c98b', '#d7a63f', '#b887f5', '#5fc7cf'];

function text(id) {
  const node = document.getElementById(id);
  const value = node ? node.textContent.trim() : '';
  return value.startsWith('@@') ? '' : value;
}

function bytesFromBase64(base64) {
  const binary = atob(base64);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

const number = (value, fallback = 0) => (Number.isFinite(value) ? value : fallback);
const vector = (value) =>
  Array.isArray(value) && value.length === 3 && value.every(Number.isFinite) ? value : null;

// One line of events.jsonl, with every field that the page reads in its place.
function tidy(line, i) {
  return {
    ...line,
    index: i,
    t: number(line.t),
    type: String(line.type ?? 'decision'),
    who: Number.isInteger(line.who) ? line.who : -1,
    whom: Number.isInteger(line.whom) ? line.whom : -1,
    point: vector(line.point),
    impulse: vector(line.impulse),
    damage: number(line.damage),
  };
}

function json(id) {
  const value = text(id);
  return value ? JSON.parse(value) : {};
}

export function readFight() {
  const glb = text('fight-glb');
  if (!glb) throw new Error('This page holds no fight: it is the empty template. Make one with `ringcraft fight SCENE`.');
  let header = {};
  const events = [];
  for (const line of text('fight-events').split('\n')) {
    if (!line.trim()) continue;
    const value = JSON.parse(line);
    if (value.type === 'header') header = value;
    else events.push(tidy(value, events.length));
  }
  events.sort((a, b) => a.t - b.t || a.index - b.index);
  events.forEach((event, i) => (event.index = i));
  return { glb: bytesFromBase64(glb).buffer, header, events, report: json('fight-report') };
}

// Length of a vector; 0 where there is none.
export const sizeOf = (v) => (v ? Math.hypot(v[0], v[1], v[2]) : 0);

// "leftLowerArm" -> "left lower arm"
export const plain = (name) =>
  String(name ?? '').replace(/[_-]+/g, ' ').replace(/([a-z])([A-Z])/g, (_, a, b) => `${a} ${b.toLowerCase()}`);

export const escapeHtml = (text) =>
  String(text).replace(/[&<>"']/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;', "'": '&#39;' })[c]);
