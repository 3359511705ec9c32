// Opens a fight's page as a visitor does, from a file:// address, and compares what it shows.
//   FIGHT_HTML=out/duel/fight.html node --test test/page_test.mjs
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { launch } from '../browser.mjs';

const file = process.env.FIGHT_HTML;
const TIMEOUT = { timeout: 180_000 };

let browser;
let page;   // the fight
let paper;  // an empty page on which pictures are decoded
let address;
const faults = [];
const requests = [];

before(async () => {
  assert.ok(file, 'FIGHT_HTML must name a fight.html, for instance out/duel/fight.html from ./run.sh');
  assert.ok(existsSync(file), `${file}: no such file; make it with ./run.sh`);
  address = pathToFileURL(path.resolve(file)).href;
  browser = await launch();
  paper = await browser.newPage();
  page = await browser.newPage({ viewport: { width: 1000, height: 600 } });
  page.setDefaultTimeout(TIMEOUT.timeout);  // software WebGL on a busy machine
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(error.message));
  page.on('request', (request) => requests.push(request.url()));
  await page.goto(address);
  await page.evaluate(() => window.ringcraft.ready);
}, TIMEOUT);

after(() => browser?.close());

const call = (what, ...args) => page.evaluate(([w, a]) => window.ringcraft[w](...a), [what, args]);
const duration = () => page.evaluate(() => window.ringcraft.duration);

async function picture() {
  return (await page.locator('#stage').screenshot()).toString('base64');
}

// Share of pixels that differ between two PNG pictures, and how many colours the first one has.
function compare(a, b) {
  return paper.evaluate(async (both) => {
    const pixels = await Promise.all(both.map(async (base64) => {
      const image = new Image();
      image.src = `data:image/png;base64,${base64}`;
      await image.decode();
      const canvas = new OffscreenCanvas(image.width, image.height);
      const g = canvas.getContext('2d');
      g.drawImage(image, 0, 0);
      return g.getImageData(0, 0, image.width, image.height).data;
    }));
    const colours = new Set();
    let differing = 0;
    for (let i = 0; i < pixels[0].length; i += 4) {
      const [p, q] = pixels;
      colours.add(((p[i] >> 3) << 10) | ((p[i + 1] >> 3) << 5) | (p[i + 2] >> 3));
      const off = Math.abs(p[i] - q[i]) + Math.abs(p[i + 1] - q[i + 1]) + Math.abs(p[i + 2] - q[i + 2]);
      if (off > 24) ++differing;
    }
    return { differing: (4 * differing) / pixels[0].length, colours: colours.size };
  }, [a, b]);
}

test('the page knows its fight', async () => {
  const fighters = await page.evaluate(() => window.ringcraft.fighters);
  assert.ok(fighters.length >= 2, `${fighters.length} fighters`);
  for (const fighter of fighters) assert.equal(fighter.joints.length, 22, `${fighter.name}: ${fighter.joints.join(' ')}`);
  assert.ok((await duration()) > 1);
  assert.ok(await page.evaluate(() => window.ringcraft.events.some((e) => e.type === 'decision')));
});

test('two times look different, and neither is blank', TIMEOUT, async () => {
  const end = await duration();
  await call('seek', 0.15 * end);
  const first = await picture();
  await call('seek', 0.6 * end);
  const second = await picture();
  const { differing, colours } = await compare(first, second);
  assert.ok(colours > 150, `${colours} colours`);
  assert.ok((await compare(second, first)).colours > 150);
  assert.ok(differing > 0.01, `${differing} of the pixels differ`);
});

test('the same time looks the same again', TIMEOUT, async () => {
  const end = await duration();
  await call('setCamera', 'side');
  await call('seek', 0.3 * end);
  const first = await picture();
  await call('seek', 0.8 * end);
  await call('seek', 0.3 * end);
  assert.equal((await compare(first, await picture())).differing, 0);
});

test('every fighter moves', async () => {
  const end = await duration();
  const fighters = await page.evaluate(() => window.ringcraft.fighters.length);
  const hips = async (t) => {
    await call('seek', t);
    return Promise.all(Array.from({ length: fighters }, (_, i) => call('jointPosition', i, 'hips')));
  };
  const times = Array.from({ length: 12 }, (_, i) => ((i + 0.5) / 12) * end);
  const tracks = [];
  for (const t of times) tracks.push(await hips(t));
  for (let i = 0; i < fighters; ++i) {
    const moved = Math.max(...tracks.map((at) => Math.hypot(...at[i].map((v, k) => v - tracks[0][i][k]))));
    assert.ok(moved > 0.02, `the hips of fighter ${i} move ${moved} m`);
    assert.ok(tracks.every((at) => at[i][1] > -0.1 && at[i][1] < 1.6), 'hips between floor and a jump');
  }
  assert.equal(await call('jointPosition', 0, 'noSuchJoint'), null);
});

test('a long name is cut on the board, and covers neither action nor neighbour', async () => {
  await call('seek', 0.5 * (await duration()));
  const rows = await page.evaluate(() => [...document.querySelectorAll('#board .fighter')].map((row) => {
    const name = row.querySelector('b');
    const before = name.textContent;
    name.textContent = 'Theophilus '.repeat(12);
    const [within, own, action] = [row, name, row.querySelector('.action')].map((node) => node.getBoundingClientRect());
    name.textContent = before;
    return { inside: own.left >= within.left - 0.5 && own.right <= within.right + 0.5, action: action.width, title: name.title === before };
  }));
  for (const row of rows) assert.ok(row.inside && row.action > 20 && row.title, JSON.stringify(rows));
});

test('a click on a mark jumps to its event', async () => {
  await call('seek', 0);
  const found = await page.evaluate(() => {
    const rank = { hit: 0, block: 1, miss: 2, response: 3 };
    const marks = [...document.querySelectorAll('.event-mark')].map((mark) => {
      const box = mark.getBoundingClientRect();
      const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
      return { x, y, event: window.ringcraft.events[mark.dataset.event], top: document.elementFromPoint(x, y) === mark };
    }).filter((m) => m.top && m.event.t > 0.05);
    marks.sort((a, b) => (rank[a.event.type] ?? 9) - (rank[b.event.type] ?? 9));
    return marks[0];
  });
  assert.ok(found, 'no mark can be reached');
  await page.mouse.click(found.x, found.y);
  assert.ok(Math.abs((await call('time')) - found.event.t) < 1e-6);
});

test('every overlay changes the picture and goes away again', TIMEOUT, async () => {
  const contact = await page.evaluate(() => window.ringcraft.events.find((e) => ['hit', 'block'].includes(e.type) && e.point));
  await call('setCamera', 'side');
  await call('seek', contact ? contact.t + 0.05 : 1);
  const capsules = await page.evaluate(() => window.ringcraft.fighters.every((f) => f.capsules > 0));
  assert.ok(capsules, 'the GLB brings no capsules (extras of the fighter nodes)');
  await call('setOverlay', 'contacts', false);
  const changesThePicture = async (names) => {
    const bare = await picture();
    for (const name of names) {
      assert.equal(await call('setOverlay', name, true), true, name);
      const { differing } = await compare(bare, await picture());
      assert.ok(differing > 0.00005, `${name}: ${differing} of the pixels differ`);
      await call('setOverlay', name, false);
    }
    assert.equal((await compare(bare, await picture())).differing, 0);
  };
  await changesThePicture(['capsules', 'skeleton', 'trails', ...(contact ? ['contacts'] : [])]);
  await call('seek', 0.1); // in the opening guard both feet of everybody stand; after a hit none may
  await changesThePicture(['support']);
  assert.equal(await call('setOverlay', 'noSuchOverlay', true), false);
});

test('every camera sees something of its own', TIMEOUT, async () => {
  const seen = [];
  for (const name of ['follow', 'side', 'front', 'top', 'ring']) {
    assert.equal(await call('setCamera', name), true, name);
    seen.push(await picture());
  }
  for (let i = 1; i < seen.length; ++i) {
    const { differing, colours } = await compare(seen[i], seen[i - 1]);
    assert.ok(differing > 0.05 && colours > 100, `camera ${i}: ${differing}, ${colours} colours`);
  }
  assert.equal(await call('setCamera', 'noSuchCamera'), false);
});

test('a picture that the graphics card has lost is drawn again', TIMEOUT, async () => {
  await call('setCamera', 'side');
  await call('seek', 0.4 * (await duration()));
  const first = await picture();
  await page.evaluate(() => new Promise((done) => {
    const canvas = document.getElementById('stage');
    const card = canvas.getContext('webgl2').getExtension('WEBGL_lose_context');
    canvas.addEventListener('webglcontextlost', () => setTimeout(() => card.restoreContext(), 50), { once: true });
    // Two frames later what was asked for then is drawn.
    canvas.addEventListener('webglcontextrestored', () =>
      requestAnimationFrame(() => requestAnimationFrame(done)), { once: true });
    card.loseContext();
  }));
  const { differing } = await compare(first, await picture());
  assert.ok(differing < 0.001, `${differing} of the pixels differ`);
});

test('play goes on, pause stands still, keys step by a frame', TIMEOUT, async () => {
  await call('seek', 0.5);
  await page.keyboard.press('Space');
  await page.waitForFunction(() => window.ringcraft.time() > 0.7);
  await page.keyboard.press('Space');
  const stopped = await call('time');
  await page.waitForTimeout(300);
  assert.equal(await call('time'), stopped);
  await page.keyboard.press('.');
  const stepped = await call('time');
  assert.ok(stepped > stopped && stepped - stopped < 0.034, `${stopped} to ${stepped}`);
  await page.keyboard.press(',');
  assert.ok((await call('time')) < stepped);
});

test('the space bar presses what Tab has reached, and plays after a click', TIMEOUT, async () => {
  await call('pause');
  const focused = () => page.evaluate(() => document.activeElement.id || document.activeElement.dataset.overlay || document.activeElement.tagName);
  await page.locator('#overlay-button').focus();
  await page.keyboard.press('Space');
  assert.equal(await focused(), 'overlay-button');
  const box = page.locator('[data-overlay=capsules]');
  const before = await box.isChecked();
  await page.keyboard.press('Tab');  // contacts
  await page.keyboard.press('Tab');
  assert.equal(await focused(), 'capsules');
  await page.keyboard.press('Space');
  assert.equal(await box.isChecked(), !before);
  assert.equal(await call('playing'), false);
  await page.locator('label:has([data-overlay=capsules])').click();
  assert.equal(await box.isChecked(), before);
  await page.keyboard.press('Space');
  assert.equal(await box.isChecked(), before);
  assert.equal(await call('playing'), true);
  await call('pause');
  await page.locator('#overlay-button').click();
  assert.equal(await page.locator('#overlays').isHidden(), true);
});

test('the timeline can be dragged', async () => {
  const box = await page.locator('.lanes').boundingBox();
  const y = box.y + box.height - 4;
  await page.mouse.move(box.x + box.width * 0.2, y);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.75, y, { steps: 4 });
  await page.mouse.up();
  const share = (await call('time')) / (await duration());
  assert.ok(Math.abs(share - 0.75) < 0.01, `${share}`);
});

test('the timeline zooms in where the pointer is, and goes back to the time that is set', TIMEOUT, async () => {
  await call('pause');
  await call('seek', 0);
  const box = await page.locator('.lanes').boundingBox();
  const [x, y] = [box.x + 0.8 * box.width, box.y + box.height - 4];
  const pointed = async () => {
    await page.mouse.move(x + 1, y);
    await page.mouse.move(x, y);
    return Number.parseFloat(await page.locator('.lanes .hover b').innerText());
  };
  const before = await pointed();
  const wheel = (dx, dy) => page.locator('.lanes').evaluate((lanes, [deltaX, deltaY, clientX]) =>
    lanes.dispatchEvent(new WheelEvent('wheel', { deltaX, deltaY, clientX, cancelable: true })), [dx, dy, x]);
  await wheel(0, -800);
  assert.ok(Math.abs((await pointed()) - before) < 0.02, `${before} became ${await pointed()}`);
  assert.equal(await page.locator('.playhead').evaluate((head) => head.hidden), true);
  await wheel(-100, 0);
  assert.ok((await pointed()) < before - 0.02);
  await page.keyboard.press('Home');
  assert.equal(await page.locator('.playhead').evaluate((head) => head.hidden), false);
  await page.locator('.lanes').dispatchEvent('dblclick');
  assert.ok(Math.abs((await pointed()) - before) < 0.02);
});

test('the pointer over a lane tells what its fighter does then', async () => {
  const box = await page.locator('.lanes').boundingBox();
  await page.mouse.move(box.x + box.width * 0.5, box.y + 26);  // under the marks
  const text = await page.locator('.lanes .hover').innerText();
  assert.match(text, /^\d+\.\d\d s \S.*: \w+/);
});

test('a decision shows its lines and what was pruned', async () => {
  const mark = await page.evaluate(() => window.ringcraft.events.find((e) => e.type === 'decision' && e.lines?.length)?.t);
  assert.ok(mark !== undefined, 'no decision with lines');
  await call('seek', mark);
  await page.locator('[data-tab=decision]').click();
  const tree = page.locator('#panel-decision svg.tree');
  assert.ok((await tree.locator('.node').count()) > 0);
  assert.equal(await tree.locator('.node.chosen').count() > 0, true);
  const words = await page.locator('#panel-decision').innerText();
  for (const rule of ['unanswered hit', 'back turned', 'penetration', 'candidates']) assert.ok(words.includes(rule), rule);
  // What a line is made of, and which first moves fell by which rule: as the events say it.
  // Taken at a time at which nobody else decided.
  const told = await page.evaluate(() => {
    const all = window.ringcraft.events.filter((e) => e.type === 'decision');
    return all.find((e) => e.struck_off?.length && e.lines.some((l) => l.terms) && all.filter((o) => o.t === e.t).length === 1);
  });
  assert.ok(told, 'no decision with a first move struck off');
  await call('seek', told.t);
  const pages = page.locator('#panel-decision');
  assert.equal(await pages.locator('.struck tr').count(), told.struck_off.length);
  await pages.locator('[data-form=lines]').click();
  assert.ok((await pages.locator('.terms').count()) > 0);
  await pages.locator('[data-form=tree]').click();
  await call('seek', mark);
  // What each first move is worth stands in sight, whatever the length of its line.
  const shown = await tree.evaluate((svg) => {
    const box = svg.parentNode.getBoundingClientRect();
    return [...svg.querySelectorAll('.score')].map((text) => {
      const at = text.getBoundingClientRect();
      return { text: text.textContent, seen: at.left >= box.left && at.right <= box.right, chosen: text.classList.contains('chosen') };
    });
  });
  const decision = await page.evaluate((t) => window.ringcraft.events.filter((e) => e.type === 'decision' && e.t === t).at(-1), mark);
  // The first row is that of the first line: the best whose score is exact, others may only be bounded (≤).
  const begins = (line) => line.moves[0].action;
  const first = decision.lines.filter((line) => begins(line) === begins(decision.lines[0]));
  const best = Math.max(...first.map((line) => line.score));
  assert.ok(!decision.lines[0].at_most);
  assert.ok(shown.length > 0 && shown.every((one) => one.seen), JSON.stringify(shown));
  assert.equal(shown.filter((one) => one.chosen).length, 1);
  assert.equal(Number(shown[0].text.replace('≤', '').replace('−', '-')), Number(best.toFixed(2)));
  assert.equal(shown.some((one) => one.text.startsWith('≤')), decision.lines.some((line) => line.at_most));
  await page.locator('[data-form=lines]').click();
  assert.ok((await page.locator('#panel-decision .lines li').count()) > 0);
  await page.locator('[data-tab=events]').click();
});

test('a decision that no other shares its tick with says how its tree is written out', async () => {
  const times = await page.evaluate(() => window.ringcraft.events.filter((e) => e.type === 'decision').map((e) => e.t));
  const alone = times.find((t) => times.filter((other) => other === t).length === 1);
  const shared = times.find((t) => times.filter((other) => other === t).length > 1);
  await page.locator('[data-tab=decision]').click();
  if (alone !== undefined) {
    await call('seek', alone + 0.001);
    const words = await page.locator('#panel-decision').innerText();
    const at = Number(/ringcraft tree \S+.* --at ([\d.]+)/.exec(words)?.[1]);
    assert.ok(at <= alone && alone - at < 0.0011, `${alone}: ${words}`);
  }
  if (shared !== undefined) {
    await call('seek', shared);
    assert.ok(!(await page.locator('#panel-decision').innerText()).includes('ringcraft tree'), `${shared}`);
  }
  await page.locator('[data-tab=events]').click();
});

test('the address names a time and a camera', async () => {
  const t = Math.round(50 * (await duration())) / 100;
  await page.evaluate((hash) => (location.hash = hash), `#t=${t}&camera=top`);
  await page.waitForFunction((wanted) => Math.abs(window.ringcraft.time() - wanted) < 1e-6, t);
  assert.equal(await page.locator('#cameras [aria-pressed=true]').innerText(), 'Top');
});

test('what the address names and is not there changes nothing', TIMEOUT, async () => {
  const odd = await browser.newPage({ viewport: { width: 400, height: 300 } });
  odd.setDefaultTimeout(TIMEOUT.timeout);
  await odd.goto(`${address}#overlays=constructor,none&camera=toString&t=soon`);
  await odd.evaluate(() => window.ringcraft.ready);
  assert.equal(await odd.locator('#cameras [aria-pressed=true]').innerText(), 'Follow');
  assert.equal(await odd.evaluate(() => window.ringcraft.time()), 0);
  await odd.close();
});

test('a page that is cut off says so', TIMEOUT, async () => {
  const whole = readFileSync(file);
  const folder = mkdtempSync(path.join(tmpdir(), 'ringcraft-page-'));
  const cut = await browser.newPage();
  try {
    const name = path.join(folder, 'fight.html');
    for (const share of [0.5, 0.999]) {
      writeFileSync(name, whole.subarray(0, Math.floor(share * whole.length)));
      await cut.goto(pathToFileURL(name).href);
      assert.match(await cut.locator('#message').innerText(), /cut off/, `${share}`);
    }
  } finally {
    await cut.close();
    rmSync(folder, { recursive: true });
  }
  assert.equal(await page.locator('#message').isHidden(), true);
});

test('nothing went wrong and nothing left the machine', () => {
  assert.deepEqual(faults, []);
  assert.deepEqual(requests.filter((url) => !/^(data|blob):/.test(url) && url.split('#')[0] !== address), []);
});
