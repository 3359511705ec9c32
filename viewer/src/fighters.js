// The fighters of a GLB: their joints by canonical name, their capsules, and where joints are at any time.
import { AnimationMixer, Color, SRGBColorSpace, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

export const load = (buffer) =>
  new Promise((done, failed) => new GLTFLoader().parse(buffer, '', done, failed));

// The name in the file: the loader renames equal names apart, and extras may hide them.
function namer(gltf) {
  const nodes = gltf.parser.json.nodes ?? [];
  return (object) => nodes[gltf.parser.associations.get(object)?.nodes]?.name ?? object.name;
}

const PARENT = {
  spine: 'hips', chest: 'spine', upperChest: 'chest', neck: 'upperChest', head: 'neck',
  leftShoulder: 'upperChest', leftUpperArm: 'leftShoulder', leftLowerArm: 'leftUpperArm', leftHand: 'leftLowerArm',
  rightShoulder: 'upperChest', rightUpperArm: 'rightShoulder', rightLowerArm: 'rightUpperArm', rightHand: 'rightLowerArm',
  leftUpperLeg: 'hips', leftLowerLeg: 'leftUpperLeg', leftFoot: 'leftLowerLeg', leftToes: 'leftFoot',
  rightUpperLeg: 'hips', rightLowerLeg: 'rightUpperLeg', rightFoot: 'rightLowerLeg', rightToes: 'rightFoot',
};
const JOINTS = new Set(['hips', ...Object.keys(PARENT)]);

const point = (v) => (Array.isArray(v) && v.length === 3 && v.every(Number.isFinite) ? new Vector3(...v) : null);

// Contract with the writer: node `fighterN`.extras.capsules = [{joint, a, b, radius}], joint's rest frame.
function capsulesOf(extras, joints) {
  if (!Array.isArray(extras.capsules)) return [];
  return extras.capsules
    .map((c) => ({ joint: joints.get(c.joint), a: point(c.a), b: point(c.b), radius: c.radius }))
    .filter((c) => c.joint && c.a && c.b && c.radius > 0);
}

const LIGHTEST = 0.8;  // shades of one hue
const DARKEST = 0.54;

// Colours that tell the fighters apart in the page: their gloves', light enough to read on dark. Those of
// one hue, as of a team, get shades of it, the darkest gloves the darkest; where all are of one hue, or
// some are grey, the palette tells more.
export function coloursOf(gltf, count, palette) {
  const gloves = [];
  for (let i = 0; i < count; ++i) {
    const made = gltf.parser.json.materials?.find((m) => m.name === `fighter${i}_gloves`);
    const base = made?.pbrMetallicRoughness?.baseColorFactor;
    if (!base) return palette;
    gloves.push(new Color(base[0], base[1], base[2]).getHSL({}, SRGBColorSpace));
  }
  const colours = gloves.map((own) => {
    const alike = gloves.filter(({ h }) => Math.min(Math.abs(h - own.h), 1 - Math.abs(h - own.h)) < 0.06);
    if (own.s < 0.25 || (alike.length === count && count > 1)) return null;
    const rank = alike.sort((a, b) => b.l - a.l).indexOf(own);
    const light = alike.length === 1 ? 0.66 : LIGHTEST - (rank * (LIGHTEST - DARKEST)) / (alike.length - 1);
    return `#${new Color().setHSL(own.h, 1, light, SRGBColorSpace).getHexString()}`;
  });
  return colours.includes(null) ? palette : colours;
}

class Fighter {
  constructor(index, node, name, colour, nameOf) {
    this.index = index;
    this.node = node;
    this.colour = colour;
    this.joints = new Map();
    const know = (child) => {
      const joint = nameOf(child);
      if (JOINTS.has(joint) && !this.joints.has(joint)) this.joints.set(joint, child);
    };
    node.traverse((child) => {
      know(child);
      child.skeleton?.bones.forEach(know);  // joints that hang elsewhere in the scene
    });
    this.name = name ?? node.userData.name ?? `fighter ${index}`;
    this.capsules = capsulesOf(node.userData, this.joints);
    this.bones = [...this.joints.keys()].filter((j) => this.joints.has(PARENT[j])).map((j) => [PARENT[j], j]);
  }

  position(joint, out = new Vector3()) {
    const node = this.joints.get(joint);
    return node ? out.setFromMatrixPosition(node.matrixWorld) : null;
  }
}

export class Cast {
  constructor(gltf, header, colours) {
    this.root = gltf.scene;
    this.fighters = [];
    const nodes = [];
    const nameOf = namer(gltf);
    this.nameOf = nameOf;
    this.root.traverse((node) => {
      const match = /^fighter(\d+)$/.exec(nameOf(node));
      if (match) nodes[Number(match[1])] ??= node;
    });
    const shown = coloursOf(gltf, nodes.length, colours);
    nodes.forEach((node, i) => {
      const told = header.fighters?.[i] ?? {};
      this.fighters.push(new Fighter(i, node, told.name, shown[i % shown.length], nameOf));
    });
    if (!this.fighters.length) throw new Error('fight.glb has no node named fighter0');
    this.root.traverse((mesh) => {
      if (!mesh.isMesh) return;
      mesh.castShadow = mesh.receiveShadow = true;
      if (mesh.isSkinnedMesh) mesh.frustumCulled = false;  // bounds are those of the rest pose
    });

    this.mixer = new AnimationMixer(this.root);
    this.actions = gltf.animations.map((clip) => this.mixer.clipAction(clip).play());
    this.duration = Math.max(0, ...gltf.animations.map((clip) => clip.duration));
    const longest = Math.max(0, ...gltf.animations.flatMap((c) => c.tracks.map((t) => t.times.length)));
    this.rate = longest > 1 && this.duration > 0 ? Math.round((longest - 1) / this.duration) : 60;
    this.frames = Math.max(1, Math.round(this.duration * this.rate) + 1);
    this.time = -1;
    this.cache = new Map();  // frame -> positions of the tracked joints
  }

  pose(t) {
    if (t === this.time) return;
    this.time = t;
    for (const action of this.actions) action.time = Math.min(Math.max(t, 0), action.getClip().duration);
    this.mixer.update(0);
    this.root.updateMatrixWorld(true);
  }

  // Positions at one frame of the animation, [fighter][joint] -> Vector3. Leaves the shown pose alone.
  at(frame) {
    const f = Math.min(Math.max(Math.round(frame), 0), this.frames - 1);
    const known = this.cache.get(f);
    if (known) return known;
    const shown = this.time;
    this.pose(f / this.rate);
    const value = this.fighters.map((fighter) =>
      Object.fromEntries(['hips', 'head', 'leftHand', 'rightHand', 'leftFoot', 'rightFoot', 'leftToes', 'rightToes']
        .map((joint) => [joint, fighter.position(joint) ?? new Vector3()])));
    this.cache.set(f, value);
    if (shown >= 0) this.pose(shown);
    return value;
  }

  // Several frames at once: the shown pose is put back only once.
  warm(frames) {
    const shown = this.time;
    this.time = -1;
    for (const f of frames) this.at(f);
    if (shown >= 0) this.pose(shown);
  }

  // Where the fight is: mean of the hips over almost a second around t.
  centre(t) {
    const f = Math.round(t * this.rate);
    const reach = Math.round(0.4 * this.rate);
    const frames = Array.from({ length: 2 * reach + 1 }, (_, k) => f - reach + k);
    this.warm(frames);
    const sum = new Vector3();
    for (const g of frames) for (const fighter of this.at(g)) sum.add(fighter.hips);
    return sum.multiplyScalar(1 / (frames.length * this.fighters.length));
  }

  // From the first fighter to the second on the ground, unit length; mean over `reach` seconds to both sides.
  axis(t, reach = 0.4) {
    const f = Math.round(t * this.rate);
    const span = Math.round(reach * this.rate);
    const step = Math.max(1, Math.round(span / 8));
    const sum = new Vector3();
    if (this.fighters.length > 1) {
      const missing = [];
      for (let k = -8 * step; k <= 8 * step; k += step) missing.push(f + k);
      this.warm(missing);
      for (const g of missing) {
        const [a, b] = this.at(g);
        sum.add(b.hips).sub(a.hips);
      }
    }
    sum.y = 0;
    return sum.lengthSq() > 1e-6 ? sum.normalize() : sum.set(0, 0, 1);
  }
}
