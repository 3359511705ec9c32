// A marker where a blow lands, with an arrow along its impulse and its size, around the event's time.
import {
  CanvasTexture, ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, RingGeometry,
  SphereGeometry, Sprite, SpriteMaterial, SRGBColorSpace, Vector3,
} from 'three';
import { sizeOf, TYPES } from './data.js';

const BEFORE = 0.004;       // s before the contact
const AFTER = 0.55;         // s after it
const METRES_PER_NS = 0.016;
const UP = new Vector3(0, 1, 0);

function label(text, colour) {
  const canvas = document.createElement('canvas');
  canvas.width = 256;
  canvas.height = 64;
  const g = canvas.getContext('2d');
  g.font = '600 34px system-ui, sans-serif';
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  g.lineWidth = 7;
  g.strokeStyle = 'rgba(6,8,12,.85)';
  g.strokeText(text, 128, 32);
  g.fillStyle = colour;
  g.fillText(text, 128, 32);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  const sprite = new Sprite(new SpriteMaterial({ map: texture, depthTest: false, transparent: true, toneMapped: false }));
  sprite.scale.set(0.44, 0.11, 1);
  sprite.renderOrder = 10;
  return sprite;
}

class Marker {
  constructor(event) {
    this.event = event;
    const { colour } = TYPES[event.type];
    this.materials = [];
    const material = (opacity) => {
      const made = new MeshBasicMaterial({ color: colour, transparent: true, opacity, depthTest: false, toneMapped: false });
      made.userData.opacity = opacity;
      this.materials.push(made);
      return made;
    };
    this.group = new Group();
    this.group.position.set(...event.point);
    this.ball = new Mesh(new SphereGeometry(0.022, 16, 12), material(1));
    this.ring = new Mesh(new RingGeometry(0.055, 0.066, 40), material(0.9));
    this.group.add(this.ball, this.ring);
    const size = sizeOf(event.impulse);
    if (size > 1e-3) {
      const length = Math.min(Math.max(size * METRES_PER_NS, 0.1), 0.85);
      const arrow = new Group();
      const shaft = new Mesh(new CylinderGeometry(0.009, 0.009, length, 10), material(0.95));
      shaft.position.y = length / 2;
      const head = new Mesh(new ConeGeometry(0.032, 0.085, 16), material(0.95));
      head.position.y = length + 0.04;
      arrow.add(shaft, head);
      arrow.quaternion.copy(new Quaternion().setFromUnitVectors(UP, new Vector3(...event.impulse).normalize()));
      this.text = label(`${size.toFixed(1)} N·s`, colour);
      this.text.position.set(0, 0.14, 0);
      this.materials.push(this.text.material);
      this.text.material.userData.opacity = 1;
      this.group.add(arrow, this.text);
    }
    this.group.traverse((child) => (child.renderOrder = Math.max(child.renderOrder, 9)));
  }

  show(age, camera) {
    const faded = age < 0 ? 1 : Math.max(0, 1 - (age / AFTER) ** 2);
    for (const material of this.materials) material.opacity = material.userData.opacity * faded;
    this.ring.quaternion.copy(camera.quaternion);
    this.ring.scale.setScalar(1 + 1.3 * Math.sqrt(Math.max(0, age) / AFTER));
  }
}

export class Contacts {
  constructor(events) {
    this.group = new Group();
    this.events = events.filter((event) => event.point && ['hit', 'block'].includes(event.type));
    this.markers = new Map();
  }

  update(t, camera) {
    for (const event of this.events) {
      const age = t - event.t;
      const shown = age >= -BEFORE && age <= AFTER;
      let marker = this.markers.get(event);
      if (!marker && shown) {
        marker = new Marker(event);
        this.markers.set(event, marker);
        this.group.add(marker.group);
      }
      if (!marker) continue;
      marker.group.visible = shown;
      if (shown) marker.show(age, camera);
    }
  }
}
