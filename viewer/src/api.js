// `window.ringcraft`: what tests, contact sheets and other pages may ask of this one.

// Draws the fight at many times in one go, small and into one picture, each labelled with its time.
async function contactSheet(page, { times, camera = 'side', width = 320, height = 240, columns, shadows = false, overlays = [], zoom = 1 }) {
  const { stage, cameras } = page;
  page.held = true;
  const before = { camera: cameras.name, time: page.player.time, on: page.overlays.names().filter((n) => page.overlays.on(n)) };
  stage.setShadows(shadows);
  stage.resize(width, height, 1);
  stage.zoom(zoom);
  for (const name of page.overlays.names()) page.overlays.set(name, name === 'ropes' || overlays.includes(name));
  // A canvas may be 16384 pixels high.
  const fewest = Math.ceil((times.length * height) / 16000);
  const across = Math.max(fewest, columns ?? Math.min(times.length, Math.max(1, Math.floor(1920 / width))));
  const sheet = document.createElement('canvas');
  sheet.width = across * width;
  sheet.height = Math.ceil(times.length / across) * height;
  const g = sheet.getContext('2d');
  g.font = '600 15px system-ui, sans-serif';
  g.textBaseline = 'top';
  times.forEach((t, i) => {
    const x = (i % across) * width;
    const y = Math.floor(i / across) * height;
    page.cast.pose(t);
    if (i === 0 || camera !== 'follow') cameras.set(camera);
    page.drawStage(t);
    g.drawImage(stage.canvas, x, y, width, height);
    const told = page.story.events.filter((e) => Math.abs(e.t - t) < 0.03 && !['decision', 'strike'].includes(e.type));
    const words = `${t.toFixed(2)} s  ${[...new Set(told.map((e) => e.type))].join(', ')}`.trim();
    g.fillStyle = 'rgba(0,0,0,.55)';
    g.fillRect(x, y, g.measureText(words).width + 12, 22);
    g.fillStyle = '#fff';
    g.fillText(words, x + 6, y + 4);
    g.strokeStyle = 'rgba(255,255,255,.14)';
    g.strokeRect(x + 0.5, y + 0.5, width - 1, height - 1);
  });
  const url = sheet.toDataURL('image/png');
  page.held = false;
  stage.zoom(1);
  stage.setShadows(true);
  for (const name of page.overlays.names()) page.overlays.set(name, before.on.includes(name));
  page.fit();
  page.player.seek(before.time);
  page.cast.pose(before.time);
  cameras.set(before.camera);
  return url;
}

// `started`: a promise of the page.
export function makeApi(started) {
  let page = null;
  const api = {
    ready: started.then((made) => {
      page = made;
      api.duration = made.player.duration;
      api.fighters = made.cast.fighters.map((fighter) => ({
        name: fighter.name, joints: [...fighter.joints.keys()], capsules: fighter.capsules.length,
      }));
      api.events = made.story.events;
    }),
    duration: 0,
    fighters: [],
    events: [],
    // Draws at once, so that a screenshot taken next shows that time.
    seek(t) {
      page.player.seek(t);
      page.draw();
    },
    time: () => page.player.time,
    playing: () => page.player.playing,
    play: () => page.player.play(),
    pause: () => page.player.pause(),
    setOverlay(name, on) {
      const known = page.setOverlay(name, on);
      page.draw();
      return known;
    },
    setCamera(name) {
      const known = page.cameras.set(name);
      page.draw();
      return known;
    },
    // World position [x, y, z] in metres of a joint at the shown time; null where there is none.
    jointPosition(fighter, joint) {
      return page.cast.fighters[fighter]?.position(joint)?.toArray() ?? null;
    },
    contactSheet: (options) => contactSheet(page, options),
  };
  return api;
}
