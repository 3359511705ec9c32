// A boxing ring, drawn where the fight brings none of its own (no node `ring`).
import {
  BoxGeometry, BufferGeometry, CanvasTexture, CatmullRomCurve3, CylinderGeometry, Float32BufferAttribute,
  Group, Mesh, MeshStandardMaterial, PlaneGeometry, RepeatWrapping, SRGBColorSpace, TubeGeometry, Vector3,
} from 'three';

const APRON = 0.6;            // m of canvas outside the ropes
const PLATFORM = 1.0;         // m over the hall's floor
const ROPES = [0.45, 0.75, 1.05, 1.35];  // m
const CORNERS = ['#b3261e', '#e8e6e1', '#1d55b5', '#e8e6e1'];

// The same grain on every load: no Math.random.
function grain() {
  let state = 12345;
  return () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 4294967296);
}

function canvasTexture(size) {
  const n = 1024;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = n;
  const g = canvas.getContext('2d');
  g.fillStyle = '#737d8b';
  g.fillRect(0, 0, n, n);
  const random = grain();
  for (let i = 0; i < 26000; ++i) {
    g.fillStyle = random() < 0.5 ? 'rgba(255,255,255,.028)' : 'rgba(0,0,0,.035)';
    g.fillRect(random() * n, random() * n, 1 + random() * 3, 1 + random() * 3);
  }
  for (let i = 0; i < 90; ++i) {  // scuffs
    g.strokeStyle = `rgba(20,24,32,${0.03 + random() * 0.05})`;
    g.lineWidth = 1 + random() * 3;
    g.beginPath();
    const x = n * (0.15 + 0.7 * random());
    const y = n * (0.15 + 0.7 * random());
    g.moveTo(x, y);
    g.quadraticCurveTo(x + 40 * (random() - 0.5), y + 40 * (random() - 0.5), x + 90 * (random() - 0.5), y + 90 * (random() - 0.5));
    g.stroke();
  }
  const metre = n / size;
  g.strokeStyle = 'rgba(30,38,52,.5)';
  g.lineWidth = 0.035 * metre;
  g.beginPath();
  g.arc(n / 2, n / 2, 1.05 * metre, 0, 2 * Math.PI);
  g.stroke();
  g.lineWidth = 0.012 * metre;
  g.beginPath();
  g.arc(n / 2, n / 2, 0.96 * metre, 0, 2 * Math.PI);
  g.stroke();
  g.fillStyle = 'rgba(30,38,52,.42)';
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  g.font = `800 ${0.27 * metre}px system-ui, sans-serif`;
  g.fillText('RINGCRAFT', n / 2, n / 2);
  g.strokeStyle = 'rgba(30,38,52,.35)';
  g.lineWidth = 0.05 * metre;
  g.strokeRect(APRON * metre, APRON * metre, n - 2 * APRON * metre, n - 2 * APRON * metre);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 8;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  return texture;
}

// One rope along a side: it hangs a little.
function rope(from, to, material) {
  const middle = from.clone().add(to).multiplyScalar(0.5);
  middle.y -= 0.02;
  const mesh = new Mesh(new TubeGeometry(new CatmullRomCurve3([from, middle, to]), 12, 0.014, 8), material);
  mesh.castShadow = true;
  return mesh;
}

function hallFloor() {
  const geometry = new BufferGeometry();
  const positions = [0, 0, 0];
  const colours = [0.02, 0.023, 0.032];
  const index = [];
  const n = 48;
  for (let i = 0; i <= n; ++i) {
    const a = (i / n) * 2 * Math.PI;
    positions.push(45 * Math.cos(a), 0, 45 * Math.sin(a));
    colours.push(0.004, 0.005, 0.008);
    if (i > 0) index.push(0, i + 1, i);
  }
  geometry.setAttribute('position', new Float32BufferAttribute(positions, 3));
  geometry.setAttribute('color', new Float32BufferAttribute(colours, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, new MeshStandardMaterial({ vertexColors: true, roughness: 0.9 }));
  mesh.position.y = -PLATFORM;
  return mesh;
}

// `inside`: metres between opposite ropes.
export function makeRing(inside) {
  const ring = new Group();
  ring.name = 'ring';
  const size = inside + 2 * APRON;
  const half = inside / 2;

  // In tiles: a software renderer that clips a large triangle at the near plane may lose its depth.
  const tiles = Math.ceil(size / 0.5);
  const canvas = new Mesh(new PlaneGeometry(size, size, tiles, tiles).rotateX(-Math.PI / 2),
    new MeshStandardMaterial({ map: canvasTexture(size), roughness: 0.95 }));
  canvas.receiveShadow = true;
  const skirt = new Mesh(new BoxGeometry(size, PLATFORM, size, tiles, 1, tiles),
    new MeshStandardMaterial({ color: '#141a26', roughness: 0.85 }));
  skirt.position.y = -PLATFORM / 2 - 0.004;
  ring.add(canvas, skirt, hallFloor());

  const above = new Group();  // what can stand between camera and fighters
  above.name = 'ropes';
  const at = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, z]) => new Vector3(x * half, 0, z * half));
  const posts = at.map((corner, i) => {
    const steel = new MeshStandardMaterial({ color: '#2a303c', roughness: 0.45, metalness: 0.6, transparent: true });
    const cover = new MeshStandardMaterial({ color: CORNERS[i], roughness: 0.6, transparent: true });
    const out = new Vector3(Math.sign(corner.x), 0, Math.sign(corner.z)).multiplyScalar(0.16);
    const post = new Mesh(new CylinderGeometry(0.055, 0.055, 1.55, 16), steel);
    post.position.copy(corner).add(out).setY(0.775);
    post.castShadow = true;
    const pad = new Mesh(new BoxGeometry(0.2, 1.1, 0.12), cover);
    pad.position.copy(corner).addScaledVector(out, 0.35).setY(0.92);
    pad.rotation.y = Math.atan2(corner.x, corner.z);
    pad.castShadow = true;
    above.add(post, pad);
    return { corner, materials: [steel, cover] };
  });
  const colours = ['#d9d4c8', '#b3261e', '#d9d4c8', '#1d55b5'];
  const sides = at.map((corner, i) => {
    const next = at[(i + 1) % 4];
    const materials = ROPES.map((height, k) => {
      const material = new MeshStandardMaterial({ color: colours[k], roughness: 0.7, transparent: true });
      above.add(rope(corner.clone().setY(height), next.clone().setY(height), material));
      return material;
    });
    return { outward: corner.clone().add(next).normalize(), materials };
  });
  const fade = (materials, opacity) => {
    for (const material of materials) {
      material.opacity = Math.min(1, Math.max(0, opacity));
      material.visible = opacity > 0.02;
    }
  };
  // m over the ground
  const apart = (a, b) => Math.hypot(a.x - b.x, a.z - b.z);
  // Ropes and posts between a camera and the fight at `target` fade away.
  above.userData.clear = (camera, target, keep) => {
    for (const { outward, materials } of sides) {
      const inside = half - outward.dot(camera.position);  // m from the ropes, negative outside
      fade(materials, keep ? 1 : (inside - 0.7) / 0.6);
    }
    for (const { corner, materials } of posts) {
      const behind = apart(camera.position, corner) - apart(camera.position, target);
      fade(materials, keep ? 1 : 1 + behind / 0.8);
    }
  };
  ring.add(above);
  return ring;
}
