// Khronos' validator over GLB files: node tools/validate_glb.mjs FILE...
// Prints one line per file and the messages; ends with 1 where there is an error or a warning.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

// The validator comes with the page's packages (viewer/package.json).
const require = createRequire(new URL('../viewer/', import.meta.url));
const validator = require('gltf-validator');

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node tools/validate_glb.mjs FILE...');
  process.exit(2);
}
let faulty = false;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { uri: file, maxIssues: 100 });
  const { numErrors, numWarnings, numInfos, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos`);
  for (const message of messages) {
    if (message.severity <= 1) console.log(`  ${message.code} ${message.pointer ?? ''}: ${message.message}`);
  }
  if (process.env.VERBOSE) {
    for (const message of messages) {
      if (message.severity > 1) console.log(`  (${message.code} ${message.pointer ?? ''}: ${message.message})`);
    }
  }
  faulty ||= numErrors + numWarnings > 0;
}
process.exit(faulty ? 1 : 0);
