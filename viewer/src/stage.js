// The picture: renderer, lights, background and the camera it is seen with.
import {
  ACESFilmicToneMapping, BackSide, BufferAttribute, Color, DirectionalLight, Fog, HemisphereLight,
  Mesh, MeshBasicMaterial, PCFShadowMap, PerspectiveCamera, Scene, SphereGeometry, WebGLRenderer,
} from 'three';

const HORIZON = new Color('#1b2230');
const ZENITH = new Color('#05070b');
const GROUND = new Color('#080a0f');

// A sphere around everything, shaded from the ground over a faint glow at the horizon to the top.
function backdrop() {
  const geometry = new SphereGeometry(60, 32, 24);
  const position = geometry.getAttribute('position');
  const colours = new Float32Array(position.count * 3);
  const colour = new Color();
  for (let i = 0; i < position.count; ++i) {
    const h = position.getY(i) / 60;
    if (h >= 0) colour.copy(HORIZON).lerp(ZENITH, Math.min(1, Math.sqrt(h) * 1.25));
    else colour.copy(HORIZON).lerp(GROUND, Math.min(1, -h * 6));
    colour.toArray(colours, i * 3);
  }
  geometry.setAttribute('color', new BufferAttribute(colours, 3));
  const mesh = new Mesh(geometry, new MeshBasicMaterial({
    vertexColors: true, side: BackSide, fog: false, toneMapped: false, depthWrite: false,
  }));
  mesh.renderOrder = -10;
  mesh.frustumCulled = false;
  return mesh;
}

function lights(scene) {
  scene.add(new HemisphereLight('#dfe6f5', '#6e5f54', 1.0));

  // Key: the lamps over the ring, warm, a little to one side so that bodies are modelled.
  const key = new DirectionalLight('#fff0dc', 2.7);
  key.position.set(3.2, 8.5, 4.2);
  key.castShadow = true;
  key.shadow.mapSize.set(2048, 2048);
  Object.assign(key.shadow.camera, { left: -4.6, right: 4.6, top: 4.6, bottom: -4.6, near: 2, far: 18 });
  key.shadow.bias = -0.0004;
  key.shadow.normalBias = 0.02;
  key.shadow.radius = 4;
  scene.add(key, key.target);

  // Nearly white: it is the key of who looks from over there, and a blue one makes skin ashen.
  const rim = new DirectionalLight('#e3e9ff', 1.9);
  rim.position.set(-4.5, 5.5, -5.5);
  const fill = new DirectionalLight('#ffd9c2', 0.7);
  fill.position.set(-5, 2.5, 4);
  const back = new DirectionalLight('#ffd9c2', 0.4);
  back.position.set(5, 2.5, -4);
  scene.add(rim, fill, back);
  return key;
}

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
    this.renderer.toneMapping = ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 1.05;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;

    this.scene = new Scene();
    this.scene.fog = new Fog('#0d1119', 14, 40);
    this.scene.add(backdrop());
    this.key = lights(this.scene);
    this.camera = new PerspectiveCamera(36, 1, 0.05, 120);
  }

  // Size of the picture in CSS pixels; `ratio` device pixels each.
  resize(width, height, ratio = Math.min(window.devicePixelRatio || 1, 2)) {
    const w = Math.max(1, Math.floor(width));
    const h = Math.max(1, Math.floor(height));
    const size = `${w} ${h} ${ratio}`;
    if (size === this.size) return;  // a resize clears the picture, and waits for the graphics card
    this.size = size;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / h;
    // A narrow window sees as much across as a square one.
    this.camera.fov = w >= h ? 36 : 2 * Math.atan(Math.tan((18 * Math.PI) / 180) * Math.min(2, h / w)) * (180 / Math.PI);
    this.camera.updateProjectionMatrix();
  }

  zoom(factor) {
    this.camera.zoom = factor;
    this.camera.updateProjectionMatrix();
  }

  setShadows(on) {
    this.key.castShadow = on;
  }

  // Shadows stay sharp wherever the fight goes: the lamp's frustum follows `point` in whole texels.
  light(point) {
    const texel = 9.2 / this.key.shadow.mapSize.x;
    const x = Math.round(point.x / texel) * texel;
    const z = Math.round(point.z / texel) * texel;
    this.key.target.position.set(x, 0, z);
    this.key.position.set(x + 3.2, 8.5, z + 4.2);
  }

  render() {
    this.renderer.render(this.scene, this.camera);
  }
}
