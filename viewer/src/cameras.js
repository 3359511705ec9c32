// Cameras: two that the mouse moves (orbit, follow), and views that keep the fight in frame.
import { Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

export const CAMERAS = {
  follow: 'Follow',
  side: 'Side',
  front: 'Front',
  top: 'Top',
  ring: 'Ring',
  orbit: 'Orbit',
};
const UP = new Vector3(0, 1, 0);
const LOOK = 0.95;  // m: height of the point looked at when all stand

export class Cameras {
  constructor(stage, cast, changed) {
    this.stage = stage;
    this.cast = cast;
    this.changed = changed;
    this.name = 'follow';
    this.controls = new OrbitControls(stage.camera, stage.canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.minDistance = 0.6;
    this.controls.maxDistance = 60;  // m: two at the far ends of a large ring are in the picture
    this.controls.maxPolarAngle = Math.PI * 0.53;
    this.controls.addEventListener('change', () => this.changed());
    // A hand on a view that moves by itself takes it over from where it is.
    this.controls.addEventListener('start', () => {
      if (this.name !== 'orbit' && this.name !== 'follow') this.set('orbit', true);
    });
    this.target = new Vector3(0, LOOK, 0);
    this.turned = 0;
    this.away = 1;
  }

  // Metres from `centre` along `from` (unit) at which everybody is in the picture about time t, with
  // room for arms, and a standing body.
  distance(t, centre, from) {
    const half = Math.tan((this.stage.camera.fov * Math.PI) / 360);
    const right = new Vector3().crossVectors(UP, from).normalize();
    const up = new Vector3().crossVectors(from, right);
    const f = Math.round(t * this.cast.rate);
    let away = 0;
    for (let k = -24; k <= 24; k += 8) {
      for (const { hips } of this.cast.at(f + k)) {
        const off = hips.clone().sub(centre).setY(0);
        const tall = (Math.abs(off.dot(up)) + 1.125) / half;
        const wide = (Math.abs(off.dot(right)) + 0.75) / (half * this.stage.camera.aspect);
        away = Math.max(away, off.dot(from) + Math.max(tall, wide));
      }
    }
    return away;
  }

  // The middle of the fight at the height to look at: lower when somebody is down.
  aim(t) {
    const centre = this.cast.centre(t);
    return centre.setY(Math.min(LOOK, 0.42 + 0.58 * centre.y));
  }

  set(name, keep = false) {
    if (!Object.hasOwn(CAMERAS, name)) return false;
    this.name = name;
    if (!keep && (name === 'follow' || name === 'orbit')) this.place(this.cast.time < 0 ? 0 : this.cast.time);
    this.changed('name');
    return true;
  }

  // Three quarters from a side, the first fighter at the left; from above where it is far away, so
  // that who is behind is seen.
  place(t) {
    const centre = this.aim(t);
    const axis = this.cast.axis(t, 1);
    const from = new Vector3(-axis.z, 0, axis.x).applyAxisAngle(UP, -0.38);
    this.away = this.distance(t, centre, from);
    this.stage.camera.position.copy(centre).addScaledVector(from, this.away * 1.12);
    this.stage.camera.position.y = centre.y + Math.max(0.75, 0.22 * this.away);
    this.target.copy(centre);
    this.turned = this.bearing(t);
    this.controls.target.copy(centre);
    this.controls.update();
  }

  // Angle of the fighters' axis about the vertical, rad, calm.
  bearing(t) {
    const axis = this.cast.axis(t, 1);
    return Math.atan2(axis.x, axis.z);
  }

  // Puts the camera where the chosen view has it at time t.
  update(t) {
    const { camera } = this.stage;
    const centre = this.aim(t);
    const axis = this.cast.axis(t);
    const side = new Vector3(-axis.z, 0, axis.x);  // seen from here the first fighter stands at the left
    if (this.name === 'follow') {
      // Goes along and turns along: the fighters' axis stays as it lay in the picture. Nearer or
      // farther as they are.
      const bearing = this.bearing(t);
      const offset = camera.position.clone().sub(this.controls.target).applyAxisAngle(UP, bearing - this.turned);
      const away = this.distance(t, centre, offset.clone().setY(0).normalize());
      offset.multiplyScalar(away / this.away);
      this.away = away;
      this.controls.target.add(centre.clone().sub(this.target));
      camera.position.copy(this.controls.target).add(offset);
      this.target.copy(centre);
      this.turned = bearing;
    } else if (this.name === 'side') {
      const away = this.distance(t, centre, side);
      this.look(centre, side.multiplyScalar(away), 0.12 + 0.22 * Math.max(0, away - 4.5));
    } else if (this.name === 'front') {
      const from = axis.clone().addScaledVector(side, 0.36).normalize();
      this.look(centre, from.clone().multiplyScalar(this.distance(t, centre, from) * 1.12), 0.55);
    } else if (this.name === 'top') {
      const from = UP.clone().addScaledVector(side, 0.1).normalize();
      this.look(centre, side.multiplyScalar(0.6), this.distance(t, centre, from) * 1.25);
    } else if (this.name === 'ring') {
      this.look(new Vector3(0, 0.45, 0), new Vector3(5.4, 0, 7.2), 3.6);
    }
    this.clip();
    this.controls.update();
  }

  // Ropes and posts close before a view that moves by itself would hide the fight: it begins
  // behind them. Bodies stay within the other half of the way.
  clip() {
    const { camera } = this.stage;
    const moves = this.name === 'side' || this.name === 'front';
    const near = moves ? 0.45 * camera.position.distanceTo(this.target) : 0.05;
    if (camera.near === near) return;
    camera.near = near;
    camera.updateProjectionMatrix();
  }

  look(at, offset, height) {
    this.stage.camera.position.copy(at).add(offset).setY(at.y + height);
    this.controls.target.copy(at);
    this.target.copy(at);
  }
}
