// Checks what a default duel must show: node tools/check_report.mjs FOLDER
// FOLDER holds report.json and events.jsonl of `ringcraft fight`. Exit 1 where something is missing.
import { readFileSync } from 'node:fs';
import path from 'node:path';

const folder = process.argv[2];
const report = JSON.parse(readFileSync(path.join(folder, 'report.json'), 'utf8'));
const [, ...events] = readFileSync(path.join(folder, 'events.jsonl'), 'utf8')
  .trim().split('\n').map((line) => JSON.parse(line));

const sum = (key) => report.fighters.reduce((total, fighter) => total + fighter[key], 0);
const { planner, physics, quality } = report;
const answered = events.filter(
  (e) => e.type === 'knockdown' || (e.type === 'response' && e.response !== 'absorb'),
).length;

const checks = [
  ['strikes', sum('strikes'), (n) => n >= 8, 'at least 8'],
  ['landed', sum('landed'), (n) => n >= 2, 'at least 2'],
  ['impacts through Bullet', physics.impacts, (n) => n >= 2, 'at least 2'],
  ['forced nodes in the tree', planner.forced_nodes, (n) => n >= 1, 'at least 1'],
  ['responses other than absorb', answered, (n) => n >= 1, 'at least 1'],
  ['penetration, 99th percentile (m)', quality.penetration_p99_m, (x) => x < 0.03, 'below 0.03'],
  ['foot skate ratio', quality.foot_skate_ratio, (x) => x < 0.02, 'below 0.02'],
  ['joint limit violations', quality.joint_limit_violations, (n) => n === 0, 'none'],
];

let faults = 0;
for (const [name, value, holds, wanted] of checks) {
  const good = typeof value === 'number' && holds(value);
  if (!good) faults += 1;
  console.log(`${good ? 'ok    ' : 'FAULT '} ${name}: ${value} (${wanted})`);
}
process.exit(faults > 0 ? 1 : 0);
