// Bundles src/ into dist/page.html: one file with script and style inside, and three empty places
// (fight.glb, events.jsonl, report.json) that src/io/page.cpp fills.
import { mkdir, readFile, rename, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import path from 'node:path';
import * as esbuild from 'esbuild';

const here = path.dirname(fileURLToPath(import.meta.url));

async function bundle(entry) {
  const result = await esbuild.build({
    entryPoints: [path.join(here, 'src', entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['chrome100', 'firefox100', 'safari15'],
    legalComments: 'none',
    loader: { '.css': 'css' },
    logLevel: 'warning',
  });
  return result.outputFiles[0].text.trim();
}

// Puts `text` where `mark` stands; the mark must stand exactly once.
function fill(page, mark, text) {
  const parts = page.split(mark);
  if (parts.length !== 2) throw new Error(`src/page.html must hold ${mark} exactly once`);
  return parts[0] + text + parts[1];
}

const license = await readFile(path.join(here, 'node_modules/three/LICENSE'), 'utf8');
const [script, style] = await Promise.all([bundle('main.js'), bundle('style.css')]);
let page = await readFile(path.join(here, 'src/page.html'), 'utf8');
page = fill(page, '/*style*/', style.replaceAll('</style', '<\\/style'));
page = fill(page, '/*license*/', `three.js: ${license.replaceAll('*/', '* /').trim()}`);
page = fill(page, '/*script*/', script.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--'));

await mkdir(path.join(here, 'dist'), { recursive: true });
const target = path.join(here, 'dist/page.html');
await writeFile(`${target}.part`, page);
await rename(`${target}.part`, target);
console.error(`viewer/dist/page.html: ${(page.length / 1024).toFixed(0)} KiB`);
