// Scattering centres of a look: points in space, and a table.
const mostCentresInTable = 50;

function unpackedCentres(centres) {
  return centres && { ...centres, places: floatsOf(centres.places), persistence: floatsOf(centres.persistence), sigma: fourLevels(centres.sigma) };
}

const centrePlace = (centres, i) => [...centres.places.subarray(3 * i, 3 * i + 3)];
const placeText = (place) => "(" + place.map((x) => numberText(x, 4)).join(", ") + ") m";

function centreWords(centres, i) {
  const part = centres.part[i] ? "\npart  " + centres.part[i] : "";
  return "centre " + (i + 1) + "  " + centres.mechanism[i] + "\n" + placeText(centrePlace(centres, i)) +
    "\n" + channelNames.map((name, channel) => name + "  " + levelText(centres.sigma[channel][i])).join("\n") + part;
}

// Seen through the target: of several bounces a centre lies where no surface is.
function centreSprites(centres, channel, range, radius) {
  const disc = make("canvas", { width: 64, height: 64 }), pen = disc.getContext("2d"), group = new THREE.Group();
  pen.beginPath();
  pen.arc(32, 32, 26, 0, 2 * Math.PI);
  pen.fillStyle = "#ffffff";
  pen.fill();
  pen.lineWidth = 6;
  pen.strokeStyle = "#000000";
  pen.stroke();
  const map = new THREE.CanvasTexture(disc), levels = centres.sigma[channel], top = peakOf(levels);
  for (let i = levels.length - 1; i >= 0; --i) {
    const share = shareOf(levels[i], top, range);
    if (!(share > 0)) continue;
    const colour = new THREE.Color(...rgbOf(share)), size = (0.025 + 0.065 * share) * radius;
    const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map, color: colour, transparent: true, depthTest: false, depthWrite: false }));
    sprite.position.set(...centrePlace(centres, i));
    sprite.scale.set(size, size, 1);
    sprite.renderOrder = 3;
    sprite.userData = { centre: i, reach: size / 2 };
    group.add(sprite);
  }
  return group;
}

// The one under the mouse, the nearest of several; null if there is none. at: as THREE.Raycaster takes it.
function centreUnder(sprites, camera, at) {
  const perMetre = camera.zoom / camera.top, aspect = camera.right / camera.top;
  let found = null, least = 1;
  for (const sprite of sprites.children) {
    const seen = sprite.position.clone().project(camera);
    const reach = Math.max(sprite.userData.reach * perMetre, 0.012), away = Math.hypot((seen.x - at.x) * aspect, seen.y - at.y) / reach;
    if (away < least) {
      least = away;
      found = sprite.userData.centre;
    }
  }
  return found;
}

function addCentres(centres, sweep) {
  if (!centres) return;
  const count = centres.mechanism.length, shown = Math.min(count, mostCentresInTable), heads = ["", "VV (dBsm)", "HH (dBsm)", "place x, y, z (m)", "mechanism", "part", "persists over"];
  const level = (channel, i) => (centres.sigma[channel][i] === -Infinity ? "\u2212\u221e" : centres.sigma[channel][i].toFixed(2).replace("-", "\u2212"));
  const persistence = (i) => { const [ghz, azimuth, elevation] = centres.persistence.subarray(3 * i, 3 * i + 3); return `${numberText(ghz, 3)} GHz, ${numberText(azimuth, 3)}\u00b0, ${numberText(elevation, 3)}\u00b0`; };
  const rows = Array.from({ length: shown }, (_, i) => [String(i + 1), level(0, i), level(3, i), placeText(centrePlace(centres, i)).replace(/[()]| m$/g, ""),
    centres.mechanism[i], centres.part[i], persistence(i)]);
  addSection("centres", "Scattering centres", make("p", { class: "note" }, `The strongest places of ${lookWords(sweep, centres.look)}, at ${numberText(centres.ghz, 6)} GHz, resolved to cubes of ` +
    `${numberText(centres.side, 3)} m; they add up with their phases. A centre persists over the band, azimuths and elevations within which its pieces stay together.` +
    (shown < centres.total ? ` Of ${centres.total} these are the first ${shown}; centres.csv has all.` : "")), make("p", {}, centres.doubt), tableOf(rows, heads));
}
