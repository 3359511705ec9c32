// The side panel: the list of events, a decision with its tree, the report.
import { escapeHtml, plain, TYPES } from './data.js';
import { linesHtml, treeSvg } from './tree.js';

const PRUNED = {
  unanswered_hit: ['unanswered hit', 'the line lets itself be struck without defending'],
  back_turned: ['back turned', 'the fighter would show its back'],
  penetration: ['penetration', 'the bodies would pass through each other'],
  candidates: ['candidates', 'beyond the best of the list that every node keeps'],
};
const FILTERS = ['hit', 'block', 'miss', 'knockdown', 'response', 'getup', 'strike', 'decision'];

// "mean_impulse_Ns" -> "mean impulse [N·s]"
const UNITS = { s: 's', ms: 'ms', us: 'µs', m: 'm', Ns: 'N·s', kg: 'kg', mps: 'm/s', rad: 'rad' };
function label(key) {
  const [, name, unit] = /^(.+)_([A-Za-z]+)$/.exec(key) ?? [];
  return unit in UNITS ? `${plain(name)} [${UNITS[unit]}]` : plain(key);
}
const count = (value) => (Number.isFinite(value) ? value.toLocaleString('en-US') : '–');
const points = (value) => (Number.isFinite(value) ? `${value >= 0 ? '+' : '−'}${Math.abs(value).toFixed(2)}` : '–');

export class Panels {
  constructor(story, fighters, report, jump) {
    this.story = story;
    this.fighters = fighters;
    this.report = report;
    this.jump = jump;
    this.colours = fighters.map((f) => f.colour);
    this.shown = new Set(FILTERS.filter((type) => type !== 'decision' && type !== 'strike'));
    this.form = 'tree';
    this.current = -1;
    this.decision = null;
    this.tabs = { events: 'Events', decision: 'Decision', report: 'Report' };
    document.getElementById('tabs').innerHTML = Object.entries(this.tabs)
      .map(([id, label]) => `<button role="tab" data-tab="${id}" aria-controls="panel-${id}">${label}</button>`).join('');
    document.getElementById('tabs').addEventListener('click', (event) => {
      const tab = event.target.closest('[data-tab]');
      if (tab) this.open(tab.dataset.tab);
    });
    this.makeEvents();
    this.makeDecision();
    this.makeReport();
    this.open('events');
  }

  open(tab) {
    this.tab = tab;
    for (const id of Object.keys(this.tabs)) {
      document.getElementById(`panel-${id}`).hidden = id !== tab;
      document.querySelector(`[data-tab="${id}"]`).setAttribute('aria-selected', id === tab);
    }
    if (tab === 'decision') this.drawDecision();
    if (tab === 'events') this.reveal();
  }

  makeEvents() {
    const root = document.getElementById('panel-events');
    const number = {};
    for (const event of this.story.events) number[event.type] = (number[event.type] ?? 0) + 1;
    const filters = FILTERS.filter((type) => number[type]).map((type) =>
      `<button class="filter" data-type="${type}" style="--c:${TYPES[type].colour}" aria-pressed="${this.shown.has(type)}"><i></i>${TYPES[type].label}<b>${number[type]}</b></button>`);
    root.innerHTML = `<div class="filters">${filters.join('')}</div><ol class="events"></ol>`;
    this.list = root.querySelector('.events');
    root.querySelector('.filters').addEventListener('click', (click) => {
      const button = click.target.closest('[data-type]');
      if (!button) return;
      const { type } = button.dataset;
      this.shown.has(type) ? this.shown.delete(type) : this.shown.add(type);
      button.setAttribute('aria-pressed', this.shown.has(type));
      this.fillEvents();
    });
    this.list.addEventListener('click', (click) => {
      const row = click.target.closest('[data-event]');
      if (row) this.jump(this.story.events[row.dataset.event]);
    });
    this.fillEvents();
  }

  fillEvents() {
    this.listed = this.story.events.filter((event) => this.shown.has(event.type) || !FILTERS.includes(event.type));
    this.list.innerHTML = this.listed.map((event) =>
      `<li><button data-event="${event.index}" style="--c:${TYPES[event.type]?.colour ?? '#8b95a5'};--f:${this.colours[event.who] ?? '#8b95a5'}">` +
      `<time>${event.t.toFixed(2)}</time><i></i><span>${escapeHtml(this.story.tell(event))}</span>${event.damage > 0 ? `<em>−${event.damage.toFixed(1)}</em>` : ''}</button>${this.figures(event)}</li>`).join('') ||
      '<li class="none">No events of these types.</li>';
    this.rows = [...this.list.querySelectorAll('[data-event]')];
    this.current = -1;
  }

  figures(event) {
    const rows = ['hit', 'block', 'knockdown'].includes(event.type) ? this.story.figures(event) : [];
    return rows.length ? `<dl>${rows.map(([k, v]) => `<div><dt>${escapeHtml(k)}</dt><dd>${escapeHtml(v)}</dd></div>`).join('')}</dl>` : '';
  }

  makeDecision() {
    const root = document.getElementById('panel-decision');
    root.addEventListener('click', (click) => {
      const go = click.target.closest('[data-go]');
      const form = click.target.closest('[data-form]');
      if (go) {
        const { decisions } = this.story;
        const at = decisions.indexOf(this.decision);
        const next = decisions[Math.min(Math.max(at + Number(go.dataset.go), 0), decisions.length - 1)];
        if (next) this.jump(next);
      }
      if (form) {
        this.form = form.dataset.form;
        this.drawDecision();
      }
    });
  }

  drawDecision() {
    const root = document.getElementById('panel-decision');
    const event = this.decision;
    if (!event) {
      root.innerHTML = '<p class="none">No decision yet at this time.</p>';
      return;
    }
    const at = this.story.decisions.indexOf(event);
    const rules = Object.keys({ ...PRUNED, ...event.pruned }).filter((key) => event.pruned && key in event.pruned);
    const pruned = rules.map((key) => {
      const value = event.pruned[key];
      const [name, why] = PRUNED[key] ?? [plain(key), ''];
      return `<tr><th>${escapeHtml(name)}</th><td>${count(value)}</td><td class="why">${escapeHtml(why)}</td></tr>`;
    });
    const struck = (event.struck_off ?? []).map((one) =>
      `<tr><th>${escapeHtml(plain(one.action))}</th><td class="why">${escapeHtml(one.rules.map((rule) => (PRUNED[rule] ?? [plain(rule)])[0]).join(', '))}</td></tr>`);
    const lines = event.lines ?? [];
    const picture = this.form === 'tree' ? `<div class="tree-box">${treeSvg(event, this.colours, points)}</div>`
      : linesHtml(event, this.colours, points);
    root.innerHTML = `
      <div class="decision-head" style="--c:${this.colours[event.who] ?? '#8b95a5'}">
        <button data-go="-1" title="Decision before" aria-label="Decision before"${at <= 0 ? ' disabled' : ''}>‹</button>
        <div><b>${escapeHtml(this.story.name(event.who))}</b> chooses <b>${escapeHtml(plain(event.action) || '–')}</b>
          <small>${event.t.toFixed(2)} s · decision ${at + 1} of ${this.story.decisions.length}</small></div>
        <button data-go="1" title="Next decision" aria-label="Next decision"${at + 1 >= this.story.decisions.length ? ' disabled' : ''}>›</button>
      </div>
      <dl class="figures"><div><dt>nodes</dt><dd>${count(event.nodes)}</dd></div><div><dt>leaves</dt><dd>${count(event.leaves)}</dd></div>
        <div><dt>forced</dt><dd>${count(event.forced_nodes)}</dd></div></dl>
      <div class="forms"><h3>${lines.length} line${lines.length === 1 ? '' : 's'}, best first</h3>
        <button data-form="tree" aria-pressed="${this.form === 'tree'}">Tree</button><button data-form="lines" aria-pressed="${this.form === 'lines'}">Lines</button></div>
      ${lines.length ? picture : '<p class="none">No line was kept.</p>'}
      <p class="key"><span class="step forced">forced</span> an answer that physics chose: one edge out, not a choice. Scores in points.</p>
      ${struck.length ? `<h3>First moves struck off</h3><table class="pruned struck">${struck.join('')}</table>` : ''}
      ${pruned.length ? `<h3>Pruned</h3><table class="pruned">${pruned.join('')}</table>` : ''}
      <p class="key">Counted over the whole tree.${this.treeCommand(event)}</p>`;
  }

  // What writes this decision's tree out. Its time is cut, not rounded: the first decision from there on is this one,
  // or the other fighter's of the same tick, and then there is no such command.
  treeCommand(event) {
    const { header, decisions } = this.story;
    const before = decisions[decisions.indexOf(event) - 1];
    if (before && event.t - before.t < 1e-6) return '';
    const seed = header.seed === undefined ? '' : ` --seed ${header.seed}`;
    const command = `ringcraft tree ${header.scene ?? 'SCENE'}${seed} --at ${Math.floor(event.t * 1000) / 1000}`;
    return ` Each pruned branch of it by name, and the terms of each edge: <code>${escapeHtml(command)}</code>`;
  }

  makeReport() {
    const rows = [];
    const walk = (value, name, depth) => {
      if (value && typeof value === 'object') {
        rows.push(`<tr class="group"><th colspan="2" style="padding-left:${depth * 12}px">${escapeHtml(name)}</th></tr>`);
        for (const [key, inner] of Object.entries(value)) {
          walk(inner, Array.isArray(value) ? inner?.name ?? `${Number(key) + 1}` : label(key), depth + 1);
        }
      } else {
        const shown = typeof value === 'number' ? String(Math.abs(value) < 1e9 ? Number(value.toPrecision(6)) : value) : String(value);
        rows.push(`<tr><th style="padding-left:${depth * 12}px">${escapeHtml(name)}</th><td>${escapeHtml(shown)}</td></tr>`);
      }
    };
    for (const [key, value] of Object.entries(this.report ?? {})) walk(value, label(key), 0);
    document.getElementById('panel-report').innerHTML = rows.length ? `<table class="report">${rows.join('')}</table>` : '<p class="none">The page holds no report.</p>';
  }

  reveal() {
    const row = this.rows[this.current];
    if (!row || this.list.matches(':hover')) return;
    const box = this.list.getBoundingClientRect();
    const at = row.getBoundingClientRect();
    if (at.top < box.top + 40 || at.bottom > box.bottom - 40) {
      this.list.scrollTop += at.top - box.top - box.height * 0.4;
    }
  }

  show(t) {
    const current = this.story.lastAt(this.listed, t);
    if (current !== this.current) {
      for (const row of this.list.querySelectorAll('.current')) row.classList.remove('current');
      this.current = current;
      // What happened at the same instant belongs together.
      for (let i = current; i >= 0 && this.listed[current].t - this.listed[i].t < 1e-6; --i) {
        this.rows[i].parentNode.classList.add('current');
      }
      if (this.tab === 'events') this.reveal();
    }
    const { decisions } = this.story;
    const decision = decisions[this.story.lastAt(decisions, t)] ?? null;
    if (decision !== this.decision && !this.pinned(t, decision)) {
      this.decision = decision;
      if (this.tab === 'decision') this.drawDecision();
    }
  }

  // A decision that was asked for stays while others fall on the same instant.
  pinned(t, decision) {
    return this.asked && decision && Math.abs(this.asked.t - decision.t) < 1e-6 && this.decision === this.asked;
  }

  ask(event) {
    if (event.type !== 'decision') return;
    this.asked = event;
    this.decision = event;
    this.open('decision');
  }
}
