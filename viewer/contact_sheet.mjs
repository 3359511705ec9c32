// Many frames of a fight in one picture, drawn in one go by the page itself:
//   node contact_sheet.mjs FIGHT_HTML OUT.png [--times 0.5,1,1.5 | --every S | --events hit,knockdown]
//        [--from S] [--to S] [--camera side|follow|front|top|ring] [--size 320x240] [--columns N]
//        [--zoom 1.5] [--overlays capsules,skeleton] [--shadows]
import { existsSync } from 'node:fs';
import { mkdir, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { launch } from './browser.mjs';

const MOST_FRAMES = 400;
const USAGE = 'usage: node contact_sheet.mjs FIGHT_HTML OUT.png [--times a,b,c | --every S | --events hit,block] [--from S] [--to S] ' +
  '[--camera side|follow|front|top|ring] [--zoom F] [--size 320x240] [--columns N] [--overlays a,b] [--shadows]';

function fail(message) {
  console.error(message);
  process.exit(2);
}

function options() {
  let read;
  try {
    read = parseArgs({
      allowPositionals: true,
      options: {
        times: { type: 'string' }, every: { type: 'string' }, events: { type: 'string' }, from: { type: 'string' },
        to: { type: 'string' }, camera: { type: 'string', default: 'side' }, size: { type: 'string', default: '320x240' },
        columns: { type: 'string' }, zoom: { type: 'string', default: '1' }, overlays: { type: 'string' }, shadows: { type: 'boolean', default: false },
      },
    });
  } catch (error) {
    fail(`${error.message}\n${USAGE}`);
  }
  const { values, positionals } = read;
  if (positionals.length !== 2) fail(USAGE);
  if (!existsSync(positionals[0])) fail(`${positionals[0]}: no such file; make it with \`ringcraft fight SCENE\``);
  const size = /^(\d{2,4})x(\d{2,4})$/.exec(values.size);
  if (!size) fail(`--size ${values.size}: give it as 320x240`);
  for (const name of ['every', 'from', 'to', 'columns', 'zoom']) {
    if (values[name] !== undefined && !(Number(values[name]) >= (name === 'from' ? 0 : 1e-3))) fail(`--${name} ${values[name]}: not a positive number`);
  }
  const times = values.times?.split(',').map(Number);
  if (times?.some((t) => !Number.isFinite(t))) fail(`--times ${values.times}: not a list of numbers`);
  return { ...values, times, html: positionals[0], out: positionals[1], width: Number(size[1]), height: Number(size[2]) };
}

function timesOf(told, duration, events) {
  const from = Number(told.from ?? 0);
  const to = Math.min(Number(told.to ?? duration), duration);
  let times = told.times;
  if (!times && told.events) {
    const types = new Set(told.events.split(','));
    times = events.filter((e) => types.has(e.type) && e.t >= from && e.t <= to).flatMap((e) => [e.t - 0.1, e.t, e.t + 0.15, e.t + 0.5]);
  }
  if (!times) {
    const every = Number(told.every ?? Math.max((to - from) / 47, 1 / 60));
    times = [];
    for (let k = 0; from + k * every <= to + 1e-6 && k <= MOST_FRAMES; ++k) times.push(from + k * every);
  }
  if (times.length > MOST_FRAMES) {
    console.error(`only the first ${MOST_FRAMES} of ${times.length} frames`);
    times = times.slice(0, MOST_FRAMES);
  }
  return times.map((t) => Math.min(Math.max(t, 0), duration));
}

const told = options();
const browser = await launch();
try {
  const page = await browser.newPage({ viewport: { width: 640, height: 480 } });
  const faults = [];
  page.on('pageerror', (error) => faults.push(error.message));
  await page.goto(pathToFileURL(path.resolve(told.html)).href + '#panel=0');
  await page.evaluate(() => window.ringcraft.ready).catch((error) => {
    throw new Error(faults[0] ?? error.message);
  });
  const { duration, events } = await page.evaluate(() => ({
    duration: window.ringcraft.duration, events: window.ringcraft.events.map(({ t, type }) => ({ t, type })),
  }));
  const times = timesOf(told, duration, events);
  if (!times.length) throw new Error('no frame to draw: the fight has no such event or time');
  const url = await page.evaluate((o) => window.ringcraft.contactSheet(o), {
    times, camera: told.camera, width: told.width, height: told.height, shadows: told.shadows,
    columns: told.columns ? Number(told.columns) : told.events ? 4 : undefined, zoom: Number(told.zoom), overlays: told.overlays?.split(',') ?? [],
  });
  await mkdir(path.dirname(path.resolve(told.out)), { recursive: true });
  await writeFile(told.out, Buffer.from(url.slice(url.indexOf(',') + 1), 'base64'));
  console.log(`${told.out}: ${times.length} frames of ${told.width}x${told.height}, ${times[0].toFixed(2)} to ${times[times.length - 1].toFixed(2)} s`);
} catch (error) {
  console.error(`${told.html}: ${error.message}`);
  process.exitCode = 1;
} finally {
  await browser.close();
}
