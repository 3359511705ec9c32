// A decision as pictures: its lines joined to a tree, and the lines one by one.
import { escapeHtml, plain } from './data.js';

const COLUMN = 132;
const ROW = 27;
const MARGIN = 66;  // left of the first moves: what each is worth
const MOST_LINES = 40;

// {name, forced, actor}, one per move of a line.
const stepsOf = (line) =>
  (line.moves ?? []).map((move) => ({ name: String(move.action ?? ''), forced: Boolean(move.forced), actor: Math.max(0, move.who ?? 0) }));

// Lines that begin alike share their beginning.
function joined(lines, chosen) {
  const root = { children: [], depth: -1, chosen: true };
  lines.forEach((line, i) => {
    let node = root;
    for (const step of stepsOf(line)) {
      const key = `${step.actor}|${step.forced}|${step.name}`;
      let child = node.children.find((c) => c.key === key);
      if (!child) {
        child = { ...step, key, children: [], depth: node.depth + 1, chosen: false };
        node.children.push(child);
      }
      if (i === chosen) child.chosen = true;
      node = child;
    }
    node.scores = [...(node.scores ?? []), { score: line.score, atMost: Boolean(line.at_most) }];
  });
  return root;
}

// Rows from the leaves up; an inner node stands beside its first child.
function place(node, state) {
  state.depth = Math.max(state.depth, node.depth);
  if (!node.children.length) node.row = state.row++;
  else {
    node.children.forEach((child) => place(child, state));
    node.row = node.children[0].row;
  }
}

// The best line through a node: {score, atMost}.
function worth(node) {
  const all = [...(node.scores ?? []), ...node.children.map(worth)];
  return all.reduce((best, one) => (one.score > best.score ? one : best));
}

const scoreText = (line, score) => (line.atMost ? '≤ ' : '') + score(line.score);

export function treeSvg(event, colours, score) {
  const lines = (event.lines ?? []).slice(0, MOST_LINES);
  const root = joined(lines, event.chosen ?? 0);
  const state = { row: 0, depth: 0 };
  place(root, state);
  const width = MARGIN + (state.depth + 1) * COLUMN - 10;
  const height = state.row * ROW + 6;
  const edges = [];
  const boxes = [];
  const draw = (node) => {
    const x = MARGIN + node.depth * COLUMN;
    const y = 4 + node.row * ROW;
    if (node.depth >= 0) {
      const colour = colours[node.actor % colours.length];
      const text = plain(node.name);
      const shown = text.length > 17 ? `${text.slice(0, 16)}…` : text;
      boxes.push(`<g class="node${node.forced ? ' forced' : ''}${node.chosen ? ' chosen' : ''}"><title>${escapeHtml(text)}${node.forced ? ' (forced)' : ''}</title>` +
        `<rect x="${x}" y="${y}" width="${COLUMN - 20}" height="20" rx="4"/><rect class="actor" x="${x}" y="${y}" width="3.5" height="20" rx="1.5" fill="${colour}"/>` +
        `<text x="${x + 9}" y="${y + 14}">${escapeHtml(shown)}</text></g>`);
      if (node.depth === 0) {
        boxes.push(`<text class="score${node.chosen ? ' chosen' : ''}" x="${x - 8}" y="${y + 14}">${escapeHtml(scoreText(worth(node), score))}</text>`);
      }
    }
    for (const child of node.children) {
      if (node.depth >= 0) {
        const [x0, y0, x1, y1] = [x + COLUMN - 20, y + 10, x + COLUMN, 14 + child.row * ROW];
        edges.push(`<path class="${child.chosen && node.chosen ? 'chosen' : ''}" d="M${x0} ${y0} C${x0 + 10} ${y0} ${x1 - 10} ${y1} ${x1} ${y1}"/>`);
      }
      draw(child);
    }
  };
  draw(root);
  return `<svg class="tree" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" role="img" aria-label="Game tree">${edges.join('')}${boxes.join('')}</svg>`;
}

// What a line is worth by each term, for both fighters: a row each, empty terms left out.
function termsHtml(line, event, colours, score) {
  if (!Array.isArray(line.terms)) return '';
  const rows = line.terms.map((terms, i) => {
    const who = i === 0 ? event.who : event.whom;
    const parts = Object.entries(terms).filter(([, value]) => value !== 0)
      .map(([name, value]) => `${escapeHtml(name)} <b>${escapeHtml(score(value))}</b>`);
    return parts.length ? `<div class="terms" style="--c:${colours[who % colours.length] ?? '#8b95a5'}"><i></i>${parts.join(' ')}</div>` : '';
  });
  return rows.join('');
}

export function linesHtml(event, colours, score) {
  const rows = (event.lines ?? []).map((line, i) => {
    const steps = stepsOf(line).map((step) =>
      `<span class="step${step.forced ? ' forced' : ''}" style="--c:${colours[step.actor % colours.length]}"${step.forced ? ' title="forced: the answer that physics chose"' : ''}>${escapeHtml(plain(step.name))}</span>`);
    return `<li class="${i === (event.chosen ?? 0) ? 'chosen' : ''}"><span class="points">${escapeHtml(scoreText({ score: line.score, atMost: line.at_most }, score))}</span><div>${steps.join('<i>›</i>')}${termsHtml(line, event, colours, score)}</div></li>`;
  });
  return `<ol class="lines">${rows.join('')}</ol>`;
}
