// Which colours tell the fighters apart in the page.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Color, SRGBColorSpace } from 'three';
import { coloursOf } from '../src/fighters.js';

const palette = ['#first', '#second', '#third'];
const hslOf = (colour) => new Color(colour).getHSL({}, SRGBColorSpace);

function coloursOfGloves(...gloves) {
  const materials = gloves.map((colour, i) => ({
    name: `fighter${i}_gloves`,
    pbrMetallicRoughness: { baseColorFactor: [...new Color(colour).toArray(), 1] },
  }));
  return coloursOf({ parser: { json: { materials } } }, gloves.length, palette);
}

test('two of a team keep their hue, the darker gloves the darker one', () => {
  const [red, blue, navy] = coloursOfGloves('#c4161c', '#1d4fb8', '#16357f').map(hslOf);
  assert.ok(red.h < 0.03 || red.h > 0.97);
  assert.ok(Math.abs(blue.h - navy.h) < 0.03);
  assert.ok(blue.l > navy.l + 0.1);
  assert.ok(navy.l > 0.5, 'is read on dark');
});

test('a whole team of one colour keeps its hue, each in a shade of its own', () => {
  const shown = coloursOfGloves('#c4161c', '#c4161c', '#c4161c', '#c4161c', '#1d4fb8', '#1d4fb8').map(hslOf);
  for (const { h, l } of shown.slice(0, 4)) assert.ok((h < 0.03 || h > 0.97) && l > 0.5);
  assert.ok(Math.abs(shown[4].h - shown[5].h) < 0.03);
  assert.equal(new Set(shown.map(({ h, l }) => `${h.toFixed(2)} ${l.toFixed(2)}`)).size, 6);
});

test('where all are of one hue, or one is grey, the palette tells them apart', () => {
  assert.equal(coloursOfGloves('#1d4fb8', '#16357f', '#2a6ae0'), palette);
  assert.equal(coloursOfGloves('#1d4fb8', '#1d4fb8'), palette);
  assert.equal(coloursOfGloves('#808080', '#1d4fb8'), palette);
});
