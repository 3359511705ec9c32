// What can be drawn over the fight: capsules, contacts, support polygons, skeletons, trails of the hands.
import {
  BufferAttribute, BufferGeometry, CapsuleGeometry, Color, DoubleSide, DynamicDrawUsage, Group, LineBasicMaterial,
  LineLoop, LineSegments, Mesh, MeshBasicMaterial, Quaternion, ShaderMaterial, Vector3,
} from 'three';
import { Contacts } from './contacts.js';
import { convexHull, soleOutline } from './geometry2d.js';

export const OVERLAYS = {
  contacts: 'Contacts',
  capsules: 'Capsules',
  support: 'Support polygon',
  skeleton: 'Skeleton',
  trails: 'Hand trails',
  ropes: 'Ropes',
};
const UP = new Vector3(0, 1, 0);

// Clear in the middle, bright at the rim: volumes can be read through the body.
function rimMaterial(colour) {
  return new ShaderMaterial({
    uniforms: { colour: { value: new Color(colour) } },
    vertexShader: `varying vec3 n; varying vec3 v;
      void main() { vec4 p = modelViewMatrix * vec4(position, 1.0); n = normalMatrix * normal; v = -p.xyz;
        gl_Position = projectionMatrix * p; }`,
    fragmentShader: `uniform vec3 colour; varying vec3 n; varying vec3 v;
      void main() { float rim = 1.0 - abs(dot(normalize(n), normalize(v)));
        gl_FragColor = vec4(colour, 0.10 + 0.75 * rim * rim * rim); }`,
    transparent: true, depthWrite: false, depthTest: false,
  });
}

class Capsules {
  constructor(cast) {
    this.group = new Group();
    this.parts = [];
    for (const fighter of cast.fighters) {
      const material = rimMaterial(fighter.colour);
      for (const { joint, a, b, radius } of fighter.capsules) {
        const along = b.clone().sub(a);
        const mesh = new Mesh(new CapsuleGeometry(radius, along.length(), 6, 16), material);
        mesh.matrixAutoUpdate = false;
        mesh.renderOrder = 4;
        mesh.frustumCulled = false;
        mesh.userData.local = mesh.matrix.clone().compose(a.clone().add(b).multiplyScalar(0.5),
          along.lengthSq() > 0 ? new Quaternion().setFromUnitVectors(UP, along.normalize()) : new Quaternion(),
          new Vector3(1, 1, 1));
        this.parts.push({ mesh, joint });
        this.group.add(mesh);
      }
    }
  }

  update() {
    for (const { mesh, joint } of this.parts) mesh.matrix.multiplyMatrices(joint.matrixWorld, mesh.userData.local);
  }
}

class Skeletons {
  constructor(cast) {
    this.cast = cast;
    this.group = new Group();
    this.lines = cast.fighters.map((fighter) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position',
        new BufferAttribute(new Float32Array(fighter.bones.length * 6), 3).setUsage(DynamicDrawUsage));
      const lines = new LineSegments(geometry,
        new LineBasicMaterial({ color: '#ffffff', depthTest: false, transparent: true, opacity: 0.95 }));
      lines.renderOrder = 6;
      lines.frustumCulled = false;
      this.group.add(lines);
      return lines;
    });
    this.knobs = cast.fighters.map((fighter) => {
      const material = new MeshBasicMaterial({ color: fighter.colour, depthTest: false, transparent: true });
      return [...fighter.joints.keys()].map((joint) => {
        const knob = new Mesh(new CapsuleGeometry(0.016, 0.0001, 4, 8), material);
        knob.renderOrder = 7;
        knob.userData.joint = joint;
        this.group.add(knob);
        return knob;
      });
    });
    this.at = new Vector3();
  }

  update() {
    this.cast.fighters.forEach((fighter, i) => {
      const position = this.lines[i].geometry.getAttribute('position');
      fighter.bones.forEach(([from, to], k) => {
        fighter.position(from, this.at).toArray(position.array, k * 6);
        fighter.position(to, this.at).toArray(position.array, k * 6 + 3);
      });
      position.needsUpdate = true;
      for (const knob of this.knobs[i]) fighter.position(knob.userData.joint, knob.position);
    });
  }
}

const SOLE = 0.14;        // m: a foot is on the ground while ankle and ball are lower than rest plus this
const STILL = 0.35;       // m/s: and while its ball moves slower than this
const MOST_POINTS = 24;

class Support {
  constructor(cast) {
    this.cast = cast;
    this.group = new Group();
    this.shapes = cast.fighters.map((fighter) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(new Float32Array(MOST_POINTS * 3), 3).setUsage(DynamicDrawUsage));
      const index = [];
      for (let i = 2; i < MOST_POINTS; ++i) index.push(0, i - 1, i);
      const filled = geometry.clone();
      filled.setAttribute('position', geometry.getAttribute('position'));
      filled.setIndex(index);
      const fill = new Mesh(filled, new MeshBasicMaterial({
        color: fighter.colour, transparent: true, opacity: 0.34, side: DoubleSide, depthWrite: false,
        polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2,
      }));
      const outline = new LineLoop(geometry, new LineBasicMaterial({ color: fighter.colour }));
      for (const shape of [fill, outline]) {
        shape.frustumCulled = false;
        shape.renderOrder = 2;
        this.group.add(shape);
      }
      return { fill, outline, geometry };
    });
  }

  // Ankle and ball where the foot is planted at frame f, null where it is in the air.
  planted(fighter, side, f) {
    const now = this.cast.at(f)[fighter];
    const before = this.cast.at(f - 1)[fighter];
    const after = this.cast.at(f + 1)[fighter];
    const ball = now[`${side}Toes`];
    const ankle = now[`${side}Foot`];
    const speed = after[`${side}Toes`].distanceTo(before[`${side}Toes`]) * this.cast.rate * 0.5;
    return ball.y < SOLE && speed < STILL ? { ankle, ball } : null;
  }

  update(t) {
    const f = Math.round(t * this.cast.rate);
    this.shapes.forEach(({ fill, outline, geometry }, i) => {
      const points = ['left', 'right'].flatMap((side) => {
        const foot = this.planted(i, side, f);
        return foot ? soleOutline(foot.ankle, foot.ball) : [];
      });
      const hull = convexHull(points).slice(0, MOST_POINTS);
      const shown = hull.length > 2;
      fill.visible = outline.visible = shown;
      if (!shown) return;
      const position = geometry.getAttribute('position');
      hull.forEach(([x, z], k) => position.setXYZ(k, x, 0.008, z));
      position.needsUpdate = true;
      geometry.setDrawRange(0, hull.length);
      fill.geometry.setDrawRange(0, (hull.length - 2) * 3);
    });
  }
}

const TRAIL = 0.4;  // s

// A ribbon that faces the camera and fades with age.
class Trails {
  constructor(cast) {
    this.cast = cast;
    this.group = new Group();
    this.count = Math.max(2, Math.round(TRAIL * cast.rate));
    this.ribbons = cast.fighters.flatMap((fighter) => ['leftHand', 'rightHand'].map((joint) => {
      const geometry = new BufferGeometry();
      const vertices = (this.count + 1) * 2;
      geometry.setAttribute('position', new BufferAttribute(new Float32Array(vertices * 3), 3).setUsage(DynamicDrawUsage));
      const colours = new Float32Array(vertices * 4);
      const colour = new Color(fighter.colour);
      for (let i = 0; i < vertices; ++i) {
        colour.toArray(colours, i * 4);
        colours[i * 4 + 3] = 0.85 * (1 - Math.floor(i / 2) / this.count) ** 1.5;
      }
      geometry.setAttribute('color', new BufferAttribute(colours, 4));
      const index = [];
      for (let i = 0; i < this.count; ++i) index.push(2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 1, 2 * i + 3, 2 * i + 2);
      geometry.setIndex(index);
      const mesh = new Mesh(geometry, new MeshBasicMaterial({
        vertexColors: true, transparent: true, depthWrite: false, side: DoubleSide,
      }));
      mesh.frustumCulled = false;
      mesh.renderOrder = 3;
      this.group.add(mesh);
      return { fighter, joint, mesh };
    }));
  }

  update(t, camera) {
    const f = t * this.cast.rate;
    this.cast.warm(Array.from({ length: this.count }, (_, k) => Math.max(0, Math.ceil(f) - 1 - k)));
    for (const { fighter, joint, mesh } of this.ribbons) {
      const path = [fighter.position(joint) ?? new Vector3()];
      for (let k = 0; k < this.count; ++k) path.push(this.cast.at(Math.max(0, Math.ceil(f) - 1 - k))[fighter.index][joint]);
      const position = mesh.geometry.getAttribute('position');
      const across = new Vector3();
      const to = new Vector3();
      path.forEach((p, i) => {
        across.subVectors(path[Math.max(0, i - 1)], path[Math.min(path.length - 1, i + 1)]);
        across.cross(to.subVectors(camera.position, p));
        if (across.lengthSq() > 1e-10) across.normalize();
        across.multiplyScalar(0.028 * (1 - i / path.length));
        position.setXYZ(2 * i, p.x + across.x, p.y + across.y, p.z + across.z);
        position.setXYZ(2 * i + 1, p.x - across.x, p.y - across.y, p.z - across.z);
      });
      position.needsUpdate = true;
    }
  }
}

export class Overlays {
  constructor(stage, cast, events, ropes) {
    this.layers = {
      contacts: new Contacts(events),
      capsules: new Capsules(cast),
      support: new Support(cast),
      skeleton: new Skeletons(cast),
      trails: new Trails(cast),
    };
    if (ropes) this.layers.ropes = { group: ropes, update() {} };
    for (const layer of Object.values(this.layers)) {
      if (layer.group !== ropes) stage.scene.add(layer.group);
      layer.group.visible = layer.group === ropes;
    }
    this.stage = stage;
    this.set('contacts', true);
  }

  names() {
    return Object.keys(this.layers);
  }

  on(name) {
    return Boolean(this.layers[name]?.group.visible);
  }

  set(name, on) {
    if (!Object.hasOwn(this.layers, name)) return false;
    this.layers[name].group.visible = Boolean(on);
    return true;
  }

  update(t) {
    for (const layer of Object.values(this.layers)) if (layer.group.visible) layer.update(t, this.stage.camera);
  }
}
