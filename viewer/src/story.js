// What the events say of the fight at a time: health, score, the action in hand, a sentence for each event.
import { plain, sizeOf } from './data.js';

const CAPTION = 1.4;  // s for which a caption stays
const FULL_HEALTH = 100;  // points, where the header does not say

export class Story {
  constructor(header, events, names) {
    this.header = header;
    this.events = events;
    this.names = names;
    this.full = names.map((_, i) => header.fighters?.[i]?.health ?? FULL_HEALTH);
    this.decisions = events.filter((event) => event.type === 'decision');
    this.spans = this.actionSpans();
  }

  name(i) {
    return this.names[i] ?? (i >= 0 ? `fighter ${i}` : '');
  }

  // Index of the last of `list` that is not after t; -1 before the first.
  lastAt(list, t) {
    let low = 0;
    let high = list.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (list[middle].t <= t + 1e-4) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  // Stretches of each fighter's lane: {who, from, to, name, forced}.
  actionSpans() {
    const spans = this.names.map(() => []);
    for (const event of this.events) {
      const launches = event.type === 'decision' || event.type === 'response' || event.type === 'getup' ||
        (event.type === 'knockdown' && event.action);
      const lane = spans[event.who];
      if (!lane || !launches || !event.action) continue;
      const last = lane[lane.length - 1];
      if (last) last.to = Math.min(last.to, event.t);
      if (last && last.from === event.t) lane.pop();
      lane.push({ who: event.who, from: event.t, to: Infinity, name: event.action, forced: event.type !== 'decision' });
    }
    return spans;
  }

  actionOf(who, t) {
    const lane = this.spans[who] ?? [];
    for (let i = lane.length - 1; i >= 0; --i) if (lane[i].from <= t + 1e-4) return lane[i];
    return null;
  }

  // Board of every fighter at t.
  board(t) {
    const rows = this.names.map((name, i) => ({
      name, health: this.full[i], full: this.full[i], landed: 0, thrown: 0, blocked: 0, downs: 0, out: false,
      action: this.actionOf(i, t),
    }));
    for (const event of this.events) {
      if (event.t > t + 1e-4) break;
      const who = rows[event.who];
      const whom = rows[event.whom];
      if (event.type === 'hit' || event.type === 'block') {
        if (whom) whom.health = Math.max(0, whom.health - event.damage);
        if (who && event.type === 'hit') who.landed += 1;
        if (whom && event.type === 'block') whom.blocked += 1;
        if (whom && event.knockout) whom.out = true;
      }
      if (who && ['hit', 'block', 'miss'].includes(event.type)) who.thrown += 1;
      if (who && event.type === 'knockdown') who.downs += 1;
    }
    return rows;
  }

  // The last thing worth a word, and what it led to at the same instant.
  caption(t) {
    const quiet = (event) => event.type === 'decision' || event.type === 'strike';
    const last = this.events.findLast((event) => event.t <= t + 1e-4 && !quiet(event));
    if (!last || t - last.t > CAPTION) return [];
    return this.events.filter((event) => Math.abs(event.t - last.t) < 1e-6 && !quiet(event)).slice(0, 3);
  }

  // A short sentence.
  tell(event) {
    const who = this.name(event.who);
    const whom = this.name(event.whom);
    const action = plain(event.action) || 'strike';
    const size = sizeOf(event.impulse);
    const power = size > 0 ? ` · ${size.toFixed(1)} N·s` : '';
    switch (event.type) {
      case 'hit': return `${who}: ${action} lands on ${whom}${event.part ? `, ${plain(event.part)}` : ''}${power}`;
      case 'block': return `${whom} blocks ${who}'s ${action}${power}`;
      case 'miss': return `${who}: ${action} misses`;
      case 'strike': return `${who} throws ${action}`;
      case 'response': return `${who} answers: ${plain(event.response) || action}${event.steps ? ` (${event.steps} step${event.steps > 1 ? 's' : ''})` : ''}`;
      case 'knockdown': return `${who} is ${event.knockout ? 'knocked out' : 'knocked down'}`;
      case 'getup': return `${who} gets up`;
      case 'decision': return `${who} chooses ${action}`;
      default: return `${who} ${plain(event.type)}`;
    }
  }

  // Figures of an event, for those who ask: [name, value].
  figures(event) {
    const rows = [];
    const add = (name, value, unit, digits) => {
      if (Number.isFinite(value) && value !== 0) rows.push([name, `${value.toFixed(digits)} ${unit}`]);
    };
    add('closing speed', event.speed_mps, 'm/s', 1);
    add('effective mass', event.effective_mass_kg, 'kg', 2);
    add('impulse', sizeOf(event.impulse), 'N·s', 1);
    add('head spin', event.head_spin_radps, 'rad/s', 1);
    add('damage', event.damage, 'points', 1);
    if (event.response && event.type !== 'response') rows.push(['answer', plain(event.response) + (event.steps ? ` (${event.steps})` : '')]);
    if (event.type === 'hit') rows.push(['foreseen', event.foreseen ? 'yes' : 'no']);
    return rows;
  }
}
