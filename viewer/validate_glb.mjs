// Khronos' glTF validator: `node validate_glb.mjs FILE...`; exit 1 on any error or warning, 2 on wrong use.
import { readFile } from 'node:fs/promises';
import path from 'node:path';
import validator from 'gltf-validator';

const MOST_SHOWN = 40;

async function validate(file) {
  const bytes = new Uint8Array(await readFile(file));
  const report = await validator.validateBytes(bytes, { uri: path.basename(file), maxIssues: 0, writeTimestamp: false });
  const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
  const { drawCallCount = 0, totalVertexCount = 0, totalTriangleCount = 0, animationCount = 0 } = report.info ?? {};
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints ` +
    `(${drawCallCount} draw calls, ${totalVertexCount} vertices, ${totalTriangleCount} triangles, ${animationCount} animations, ${bytes.length} bytes)`);
  const level = ['error', 'warning', 'info', 'hint'];
  const sorted = [...messages].sort((a, b) => a.severity - b.severity);
  for (const m of sorted.slice(0, MOST_SHOWN)) console.log(`  ${level[m.severity]} ${m.code} ${m.pointer ?? ''}: ${m.message}`);
  if (sorted.length > MOST_SHOWN) console.log(`  ... ${sorted.length - MOST_SHOWN} more`);
  return numErrors + numWarnings === 0;
}

const files = process.argv.slice(2);
if (!files.length) {
  console.error('usage: node validate_glb.mjs FILE...');
  process.exit(2);
}
let good = true;
for (const file of files) {
  try {
    good = (await validate(file)) && good;
  } catch (error) {
    console.error(`${file}: ${error.message ?? error}`);
    good = false;
  }
}
process.exit(good ? 0 : 1);
