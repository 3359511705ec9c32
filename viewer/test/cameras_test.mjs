// The cameras by themselves, without a page: where they go as the fighters come together.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PerspectiveCamera, Vector3 } from 'three';
import { Cameras } from '../src/cameras.js';

// Two fighters, `apart(t)` metres from each other along x, whose middle stays where it is.
function following(apart) {
  const rate = 30;
  const at = (f) => [-1, 1].map((side) => ({ hips: new Vector3((side * apart(f / rate)) / 2, 0.9, 0) }));
  const cast = { rate, time: 0, at, centre: () => new Vector3(0, 0.9, 0), axis: () => new Vector3(1, 0, 0) };
  const cameras = new Cameras({ camera: new PerspectiveCamera(36, 16 / 9, 0.05, 120), canvas: null }, cast, () => {});
  cameras.set('follow');
  return cameras;
}

const distance = ({ stage, controls }) => stage.camera.position.distanceTo(controls.target);

// One that was with them from the start, for comparison.
const near = distance(following(() => 1.2));

for (const far of [4, 8, 24]) {
  test(`the following camera comes as near as the fighters do, from ${far} m`, () => {
    const cameras = following((t) => Math.max(1.2, far - t));
    const from = distance(cameras);
    assert.ok(from > near + 0.5 * (far - 4), `${from} m away where they are ${far} m apart, ${near} m where they box`);
    for (let t = 0; t < far + 2; t += 1 / 30) cameras.update(t);
    assert.ok(Math.abs(distance(cameras) - near) < 0.02 * near, `${distance(cameras)} m, not ${near}`);
  });
}

test('who has gone nearer with the mouse stays nearer by as much', () => {
  const cameras = following((t) => Math.min(9.2, 1.2 + t));
  const { camera } = cameras.stage;
  camera.position.lerp(cameras.controls.target, 0.5);
  cameras.update(0);
  assert.ok(Math.abs(distance(cameras) - near / 2) < 0.02 * near);
  for (let t = 0; t < 9; t += 1 / 30) cameras.update(t);
  const whole = distance(following(() => 9.2));
  assert.ok(Math.abs(distance(cameras) - whole / 2) < 0.02 * whole, `${distance(cameras)} m of ${whole}`);
});
