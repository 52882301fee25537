// The target in space. Needs three.js; without it, or without WebGL, the section says so.
const bounceColours = [[0.6, 0.65, 0.7], [0.95, 0.65, 0.1], [0.9, 0.3, 0.2], [0.75, 0.2, 0.65], [0.35, 0.3, 0.9], [0.15, 0.6, 0.8]];

function hasWebGL() {
  try {
    const canvas = document.createElement("canvas");
    return Boolean(canvas.getContext("webgl2") || canvas.getContext("webgl"));
  } catch {
    return false;
  }
}

const directionOf = (thetaDeg, phiDeg) => {
  const theta = thetaDeg * Math.PI / 180, phi = phiDeg * Math.PI / 180;
  return new THREE.Vector3(Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta));
};

const perVertex = () => THREE.VertexColors || true;  // a number in three.js up to r124

// Of flat lists of numbers, three to a vertex.
function geometryOf(positions, colours) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  if (colours) geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  return geometry;
}

// colours: one for all, or one for each end.
function lineSegments(ends, colours, opacity = 1) {
  const plain = colours.length === 3, look = plain ? { color: new THREE.Color(...colours) } : { vertexColors: perVertex() };
  return new THREE.LineSegments(geometryOf(ends, plain ? null : colours), new THREE.LineBasicMaterial({ ...look, transparent: opacity < 1, opacity }));
}

// A plane spanned by two unit vectors, with levels on it from their peak down. grid as of HeatPlot, but x, y are the outer ends.
function levelPlane(grid, origin, u, v, range) {
  const canvas = colourDots(grid, peakOf(grid.levels), range, true), texture = new THREE.CanvasTexture(canvas);
  texture.magFilter = texture.minFilter = THREE.NearestFilter;
  texture.generateMipmaps = false;
  const corner = (a, b) => origin.clone().addScaledVector(u, grid.x[a]).addScaledVector(v, grid.y[b]).toArray();
  const geometry = geometryOf(new Float32Array([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)].flat()));
  geometry.setAttribute("uv", new THREE.BufferAttribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const plane = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ map: texture, transparent: true, opacity: 0.85, side: THREE.DoubleSide, depthTest: false, depthWrite: false }));
  plane.renderOrder = 2;
  return plane;
}

function letter(text, at, size) {
  const canvas = make("canvas", { width: 64, height: 64 }), pen = canvas.getContext("2d");
  pen.font = "bold 44px system-ui, sans-serif";
  pen.fillStyle = "#8a939c";
  write(pen, text, 32, 32, "center", "middle");
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas), transparent: true }));
  sprite.position.copy(at);
  sprite.scale.set(size, size, 1);
  return sprite;
}

class SpaceView {
  constructor(holder, barHolder, data, sweep, isar, centres) {
    Object.assign(this, { holder, barHolder, data, sweep, isar, centres, channel: 0, look: 0, range: 40 });
    this.on = { target: true, colours: data.looks.length > 0, lines: true, lit: true, tubes: false, image: false, isar: false, centres: true, arrow: true };
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    holder.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1);  // an image laid over the target, which knows no perspective, fits it
    this.camera.up.set(0, 0, 1);
    this.scene.add(this.camera, new THREE.AmbientLight(0xffffff, 0.55));
    const lamp = new THREE.DirectionalLight(0xffffff, 0.6);
    lamp.position.set(0.4, 0.8, 1);
    this.camera.add(lamp);
    this.unpack();
    const canvas = this.renderer.domElement;
    this.orbit = Object.assign(new THREE.OrbitControls(this.camera, canvas), { enableKeys: false, screenSpacePanning: true });
    this.orbit.addEventListener("change", () => this.render());
    this.lookFrom(this.fromTheSide());
    canvas.addEventListener("pointermove", (event) => this.hover(event));
    canvas.addEventListener("pointerleave", () => showTip(""));
    canvas.addEventListener("dblclick", () => this.lookFrom(this.fromTheSide()));
    new ResizeObserver(() => this.resize()).observe(holder);
    this.addSurface();
    this.addAxes();
  }

  // Beside the radar and above it: what it lights is in sight, and so is its arrow.
  fromTheSide() {
    const i = this.looks[0] ? this.looks[0].look : 0, { theta, phi } = this.sweep.looks;
    return directionOf(Math.min(Math.max(theta[i] - 18, 30), 100), phi[i] + 32);
  }

  unpack() {
    const vertices = floatsOf(this.data.vertices), corners = indicesOf(this.data.triangles);
    this.positions = new Float32Array(3 * corners.length);
    corners.forEach((corner, i) => this.positions.set(vertices.subarray(3 * corner, 3 * corner + 3), 3 * i));
    const box = new THREE.Box3().setFromArray(vertices);
    this.centre = box.getCenter(new THREE.Vector3());
    this.radius = box.getSize(new THREE.Vector3()).length() / 2;
    this.looks = this.data.looks.map((look) => ({
      ...look, sigma: fourLevels(look.sigma), cells: look.cells && { ...look.cells, sigma: fourLevels(look.cells.sigma) },
      edgeEnds: floatsOf(look.edges.ends), edgeSigma: fourLevels(look.edges.sigma), tubeEnds: floatsOf(look.tubes.ends), bounces: indicesOf(look.tubes.bounces),
    }));
  }

  addSurface() {
    this.colours = new Float32Array(this.positions.length);
    const geometry = geometryOf(this.positions, this.colours);
    geometry.computeVertexNormals();
    this.surface = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ vertexColors: perVertex(), side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    this.scene.add(this.surface);
    this.outline = lineSegments(floatsOf(this.data.lines), [0.25, 0.28, 0.32], 0.6);
    this.scene.add(this.outline);
  }

  addAxes() {
    const size = 0.35 * this.radius, origin = this.centre.clone().addScalar(-0.62 * this.radius);
    origin.z = this.centre.z - 0.8 * this.radius;
    this.axes = new THREE.Group();
    const axes = new THREE.AxesHelper(size);
    axes.position.copy(origin);
    this.axes.add(axes);
    [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]].forEach(([name, to]) =>
      this.axes.add(letter(name, origin.clone().addScaledVector(new THREE.Vector3(...to), 1.2 * size), 0.16 * this.radius)));
    this.scene.add(this.axes);
  }

  // What depends on look, channel and levels.
  show() {
    if (this.changing) this.scene.remove(this.changing);
    this.changing = new THREE.Group();
    this.scene.add(this.changing);
    const look = this.looks[this.look];
    this.top = look ? topOf(Math.max(peakOf(look.sigma[this.channel]), peakOf(look.edgeSigma[this.channel]))) : 0;
    this.paintSurface(look);
    this.surface.visible = this.on.target;
    this.outline.visible = this.on.lines;
    if (look && this.on.lit) this.addLit(look);
    if (look && this.on.tubes) this.addTubes(look);
    if (look && this.on.image && look.cells) this.addImage(look.cells);
    if (this.isar && this.on.isar) this.addIsar();
    this.sprites = this.centres && this.on.centres ? centreSprites(this.centres, this.channel, this.range, this.radius) : null;
    if (this.sprites) this.changing.add(this.sprites);
    if (this.on.arrow) this.addArrows(look);
    this.paintBar(look);
    this.render();
  }

  paintSurface(look) {
    const levels = look && this.on.colours ? look.sigma[this.channel] : null;
    for (let i = 0; i < this.colours.length / 9; ++i) {
      const share = levels ? shareOf(levels[i], this.top, this.range) : 0;
      const rgb = share > 0 ? rgbOf(share) : [0.66, 0.7, 0.74];
      for (let j = 0; j < 3; ++j) this.colours.set(rgb, 9 * i + 3 * j);
    }
    this.surface.geometry.attributes.color.needsUpdate = true;
  }

  addLit(look) {
    const ends = [], colours = [], levels = look.edgeSigma[this.channel];
    for (let i = 0; i < levels.length; ++i) {
      const share = shareOf(levels[i], this.top, this.range);
      if (!(share > 0)) continue;
      const rgb = [1, 0.25 + 0.6 * share, 0.2 + 0.3 * share];
      ends.push(...look.edgeEnds.subarray(6 * i, 6 * i + 6));
      colours.push(...rgb, ...rgb);
    }
    this.changing.add(lineSegments(new Float32Array(ends), new Float32Array(colours)));
  }

  addTubes(look) {
    const colours = [];
    for (const bounce of look.bounces) {
      const rgb = bounceColours[Math.min(bounce, bounceColours.length - 1)];
      colours.push(...rgb, ...rgb);
    }
    this.changing.add(lineSegments(look.tubeEnds, new Float32Array(colours), 0.55));
  }

  addImage(cells) {
    const u = new THREE.Vector3(...cells.u), v = new THREE.Vector3(...cells.v), out = u.clone().cross(v);
    const grid = { levels: cells.sigma[this.channel], columns: cells.columns, rows: cells.rows,
      x: [cells.corner[0], cells.corner[0] + cells.cell[0] * cells.columns], y: [cells.corner[1], cells.corner[1] + cells.cell[1] * cells.rows] };
    this.changing.add(levelPlane(grid, out.multiplyScalar(this.centre.dot(out)), u, v, this.range));
  }

  addIsar() {
    const grid = isarGrid(this.isar, this.channel), range = new THREE.Vector3(...this.isar.range_axis), cross = new THREE.Vector3(...this.isar.cross_axis);
    const half = (ends, cells) => (ends[1] - ends[0]) / Math.max(cells - 1, 1) / 2;
    const widened = (ends, cells) => [ends[0] - half(ends, cells), ends[1] + half(ends, cells)];
    const outer = { ...grid, x: widened(grid.x, grid.columns), y: widened(grid.y, grid.rows) };
    this.changing.add(levelPlane(outer, new THREE.Vector3(), cross, range, this.range));
  }

  addArrows(look) {
    const i = look ? look.look : 0, angles = this.sweep.looks;
    const from = directionOf(angles.theta[i], angles.phi[i]), length = 0.5 * this.radius;
    const start = this.centre.clone().addScaledVector(from, 1.5 * this.radius);
    this.changing.add(new THREE.ArrowHelper(from.clone().negate(), start, length, 0xe0362c, 0.3 * length, 0.14 * length));
    if (!this.sweep.bistatic) return;
    const to = directionOf(angles.rx_theta[i], angles.rx_phi[i]);
    this.changing.add(new THREE.ArrowHelper(to, this.centre.clone().addScaledVector(to, this.radius), length, 0x2a8a3a, 0.3 * length, 0.14 * length));
  }

  // With the colour bar, for a file.
  picture() {
    this.renderer.render(this.scene, this.camera);
    const canvas = onPaper(this.renderer.domElement), dots = canvas.width / this.holder.clientWidth;
    canvas.getContext("2d").drawImage(this.barHolder, canvas.width - 100 * dots, 8 * dots, 92 * dots, 240 * dots);
    return canvas;
  }

  paintBar(look) {
    const canvas = this.barHolder, pen = canvas.getContext("2d"), dots = window.devicePixelRatio || 1;
    canvas.width = 92 * dots;
    canvas.height = 240 * dots;
    pen.setTransform(dots, 0, 0, dots, 0, 0);
    if (!look || !this.on.colours) return;
    pen.font = "13px system-ui, sans-serif";
    paintColourBar(pen, { left: 26, top: 30, height: 200, width: 14 }, this.top, this.range);
  }

  resize() {
    const box = this.holder.getBoundingClientRect();
    if (box.width < 10) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(box.width, box.height, false);
    const half = 0.95 * this.radius / Math.min(1, box.width / box.height), across = half * box.width / box.height;
    Object.assign(this.camera, { left: -across, right: across, top: half, bottom: -half, near: 0, far: 12 * this.radius });
    this.camera.updateProjectionMatrix();
    this.render();
  }

  render() {
    this.asked = this.asked || requestAnimationFrame(() => {
      this.asked = 0;
      this.renderer.render(this.scene, this.camera);
    });
  }

  lookFrom(direction) {
    this.orbit.target.copy(this.centre);
    this.camera.position.copy(this.centre).addScaledVector(direction, 6 * this.radius);
    this.camera.zoom = 1;
    this.camera.updateProjectionMatrix();
    this.orbit.update();
    this.render();
  }

  lookFromRadar() {
    const look = this.looks[this.look], i = look ? look.look : 0;
    this.lookFrom(directionOf(this.sweep.looks.theta[i], this.sweep.looks.phi[i]));
  }

  hover(event) {
    if (event.buttons) {
      this.render();
      return showTip("");
    }
    const box = this.holder.getBoundingClientRect();
    const at = new THREE.Vector2(2 * (event.clientX - box.left) / box.width - 1, 1 - 2 * (event.clientY - box.top) / box.height);
    const centre = this.sprites ? centreUnder(this.sprites, this.camera, at) : null;
    return showTip(centre !== null ? centreWords(this.centres, centre) : this.on.target ? this.facetWords(at) : "", event);
  }

  facetWords(at) {
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, this.camera);
    const hit = ray.intersectObject(this.surface)[0], look = this.looks[this.look];
    if (!hit) return "";
    return placeText(hit.point.toArray()) + (look ? "\n" + channelNames[this.channel] + " of this facet  " + levelText(look.sigma[this.channel][Math.floor(hit.faceIndex)]) : "");
  }
}

function lookWords(sweep, i) {
  const { theta, phi, rx_theta, rx_phi } = sweep.looks, angles = (t, p) => "\u03b8 " + numberText(t, 7) + "\u00b0, \u03c6 " + numberText(p, 7) + "\u00b0";
  return "look " + i + ": " + angles(theta[i], phi[i]) + (sweep.bistatic ? " to " + angles(rx_theta[i], rx_phi[i]) : "");
}

function addSpace(data, sweep, isar, centres) {
  if (!data) return;
  const missing = typeof THREE === "undefined" ? "three.js was not installed where this report was made (Debian: libjs-three)."
    : hasWebGL() ? "" : "this browser has no WebGL.";
  if (missing) {
    addSection("space", "Target", make("p", {}, "No view in space: " + missing));
    return;
  }
  const { controls, holder } = addPlotSection("space", "Target", spaceWords(data, sweep, centres), "plot tall space"), bar = make("canvas");
  const view = new SpaceView(holder, bar, data, sweep, isar, centres);
  holder.append(make("div", { class: "scale" }, bar));
  const part = (name, text) => toggle(text, view.on[name], (on) => { view.on[name] = on; view.show(); });
  const first = data.looks[0];
  if (first || centres) {
    if (data.looks.length > 1) controls.append(choice("look", data.looks.map((look) => lookWords(sweep, look.look)), 0, (i) => { view.look = i; view.show(); }));
    view.channel = strongestChannel((first ? view.looks[0] : centres).sigma);
    controls.append(choice("channel", channelNames, view.channel, (i) => { view.channel = i; view.show(); }),
      rangeChoice(40, (range) => { view.range = range; view.show(); }));
  }
  const parts = group("show", part("target", "target"), part("lines", "edges"));
  if (first) parts.append(part("colours", "return of facets"), part("lit", "return of edges"));
  if (first && first.tubes.paths) parts.append(part("tubes", "tubes"));
  if (first && first.cells) parts.append(part("image", "image of the look"));
  if (isar) parts.append(part("isar", "ISAR image"));
  if (centres) parts.append(part("centres", "scattering centres"));
  parts.append(part("arrow", sweep.bistatic ? "arrows of transmitter and receiver" : "arrow of the radar"));
  controls.append(parts, make("button", { onclick: () => view.lookFromRadar() }, "from the radar"),
    make("button", { onclick: () => view.lookFrom(view.fromTheSide()) }, "from the side"));
  controls.append(...saveButtons("target", () => view.picture()));
  view.show();
  redrawers.push(() => view.show());
}

function spaceWords(data, sweep, centres) {
  const coarse = data.shown < data.traced ? ` The ${data.traced} facets of the target are shown as ${data.shown}, each with the strongest that it stands for.` : "";
  const look = data.looks.length
    ? ` Colours: σ of what each facet alone sends back, of all bounces together, at ${numberText(data.looks[0].ghz, 6)} GHz; facets and edges add up with their phases.` + (data.looks.length === 1 ? " This is " + lookWords(sweep, data.looks[0].look) + "." : "")
    : "";
  const points = centres ? " Scattering centres, of look " + centres.look + `, are dots, larger and brighter the stronger, coloured from their own peak down and seen through the target at ${numberText(centres.ghz, 6)} GHz. ${centres.doubt}` : "";
  return "Drag to turn, wheel to enlarge, drag with shift to move, double click for the first view." + look +
    " Grey facets are below the levels shown; images laid over the target are coloured from their own peak down. The red arrow points from the radar to the target; tubes are grey before their first reflection, then orange, red, violet, blue." + points + coarse;
}
