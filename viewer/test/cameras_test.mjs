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
  const from = distance(cameras);
  camera.position.lerp(cameras.controls.target, 0.5);
  cameras.update(0);
  assert.ok(Math.abs(distance(cameras) - from / 2) < 0.02 * from);
  for (let t = 0; t < 9; t += 1 / 30) cameras.update(t);
  const whole = distance(following(() => 9.2));
  assert.ok(Math.abs(distance(cameras) - whole / 2) < 0.02 * whole, `${distance(cameras)} m of ${whole}`);
});

// Eight who fight in pairs, one pair far from the others, and go about.
function brawl() {
  const rate = 30;
  const at = (f) => Array.from({ length: 8 }, (_, i) => {
    const pair = Math.floor(i / 2), t = f / rate;
    const along = [-4, -1, 0.5, 6][pair] + 0.5 * Math.sin(t + pair), beside = [0, 2, -2.5, 1][pair];
    return { hips: new Vector3(along + (i % 2 ? 0.5 : -0.5), 0.9, beside) };
  });
  const centre = () => new Vector3(0.4, 0.9, 0.1);
  const cast = { rate, time: 0, at, centre, axis: () => new Vector3(1, 0, 0) };
  return { at, cameras: new Cameras({ camera: new PerspectiveCamera(36, 16 / 9, 0.05, 120), canvas: null }, cast, () => {}) };
}

for (const name of ['follow', 'side', 'front', 'top']) {
  test(`everybody in a brawl is in the picture: ${name}`, () => {
    const { at, cameras } = brawl();
    const { camera } = cameras.stage;
    cameras.set(name);
    for (let t = 0; t < 6; t += 1 / 10) {
      cameras.update(t);
      camera.updateMatrixWorld();
      for (const { hips } of at(Math.round(t * 30))) {
        for (const height of [0.1, 1.75]) {
          const seen = hips.clone().setY(height).project(camera);
          assert.ok(Math.abs(seen.x) < 0.97 && Math.abs(seen.y) < 1, `${t} s: ${seen.x}, ${seen.y}`);
          assert.ok(seen.z < 1, `${t} s: behind the camera`);
        }
      }
    }
  });
}
