// The page: a section for each view that the result has data for.
const redrawers = [redrawAll];
const quantityLabels = { phi: "azimuth φ (degrees)", theta: "polar angle θ (degrees)", rx_phi: "receiver azimuth φ (degrees)", rx_theta: "receiver polar angle θ (degrees)", time: "time (s)", ghz: "frequency (GHz)" };
const shortLabels = { phi: "φ", theta: "θ", rx_phi: "receiver φ", rx_theta: "receiver θ", time: "t", ghz: "f" };
const partColours = ["--c0", "--c3", "--c1", "--c4", "--c5", "--c6", "--c2", "--c7", "--c8"];

// Rows by what tells them apart.
class Rows {
  constructor(sweep) {
    const index = indicesOf(sweep.rows), count = sweep.ghz.length;
    const look = (name) => Float64Array.from(index, (row) => sweep.looks[name][Math.floor(row / count)]);
    this.values = { phi: look("phi"), theta: look("theta"), ghz: Float64Array.from(index, (row) => sweep.ghz[row % count]) };
    if (sweep.bistatic) Object.assign(this.values, { rx_phi: look("rx_phi"), rx_theta: look("rx_theta") });
    if (sweep.looks.time) this.values.time = look("time");
    this.count = index.length;
    this.total = sweep.total;
    this.names = Object.keys(this.values);
    this.swept = this.names.filter((name) => this.values[name].some((value) => value !== this.values[name][0]));
    this.sigma = fourLevels(sweep.sigma);
    this.error = fourLevels(sweep.error);
    this.model = fourLevels(sweep.model);
    this.incoherent = (sweep.incoherent || []).map(levelsOf);
    this.mechanisms = sweep.mechanisms.map((each) => ({ label: each.label, sigma: fourLevels(each.sigma) }));
  }

  // Rows that differ in this quantity only, by it.
  cutsAlong(quantity) {
    const others = this.names.filter((name) => name !== quantity), cuts = new Map();
    for (let row = 0; row < this.count; ++row) {
      const key = others.map((name) => this.values[name][row]).join();
      if (!cuts.has(key)) cuts.set(key, []);
      cuts.get(key).push(row);
    }
    const along = this.values[quantity];
    return [...cuts.values()].map((rows) => ({ rows: rows.sort((a, b) => along[a] - along[b]), words: this.fixedWords(others, rows[0]) }));
  }

  fixedWords(names, row) {
    return names.map((name) => shortLabels[name] + " = " + numberText(this.values[name][row], 7) + ({ ghz: " GHz", time: " s" }[name] || "°")).join(", ");
  }

  peakRow() {
    let best = 0, most = -Infinity;
    for (const levels of this.sigma) levels.forEach((level, row) => { if (level > most) { most = level; best = row; } });
    return best;
  }
}

// An error in decibels as a band: S and what may be wrong with it, 20 log10(1 ± δ/|S|).
function bandOf(ys, errors, opacity) {
  const share = errors.map((level) => 10 ** (level / 20) - 1);
  return { high: ys.map((y, i) => y + errors[i]), low: ys.map((y, i) => y + 20 * Math.log10(Math.max(1 - share[i], 1e-3))), opacity };
}

// Whether a warning of the run says so of the steps of a quantity.
function tooWide(name) {
  const word = { phi: "phi", theta: "theta", rx_phi: "receiver phi", rx_theta: "receiver theta", ghz: "frequency" }[name];
  return (report.record && report.record.warnings || []).some((warning) => warning.startsWith("sampling:") && warning.includes(" in " + word + " are too wide"));
}

class CurveView {
  constructor(rows) {
    this.rows = rows;
    // The longest curves first.
    const swept = rows.swept.length ? rows.swept : ["ghz"];
    this.choices = swept.map((name) => ({ name, cuts: rows.cutsAlong(name) })).sort((a, b) => a.cuts.length - b.cuts.length);
    this.channels = [true, false, false, true];
    this.shown = [true, ...rows.mechanisms.map(() => false)];
    this.incoherent = [false, false];
    this.model = true;
    this.numerical = false;
    const rough = rows.incoherent.length ? " What rough surfaces scatter incoherently, of V or H transmitted and both received together, has no phase: it adds to σ as power." : "";
    const left = rows.count < rows.total ? ` Of ${rows.total} rows ${rows.count} are here: the strongest and the weakest of every few neighbours.` : "";
    const curves = addPlotSection("curves", "Curves", "Drag a rectangle or turn the wheel to zoom (shift: across only), double click or Escape for all." + rough + left);
    this.controls = curves.controls;
    this.hint = note("");
    curves.holder.after(this.hint);
    const caption = () => this.chosen.cuts[this.cut].words;
    this.plot = new CurvePlot(curves.holder, { label: "σ over what is swept", yLabel: "σ (dBsm)", range: 80, caption });
    const polar = addPlotSection("polar", "Polar", "The curve above, for the same channels and mechanisms: radius in decibels, azimuth 0 on the right, 90° on top.", "plot tall");
    this.polarSection = polar.section;
    this.polar = new PolarPlot(polar.holder, { label: "σ over azimuth", range: 50, caption });
    polar.controls.append(rangeChoice(50, (range) => { this.polar.range = range; this.update(true); }), ...saveButtons("polar", () => this.polar.picture()));
    this.chooseQuantity(0);
  }

  chooseQuantity(i) {
    this.chosen = this.choices[i];
    const peak = this.rows.peakRow();
    this.cut = Math.max(this.chosen.cuts.findIndex((cut) => cut.rows.includes(peak)), 0);
    this.plot.xLabel = quantityLabels[this.chosen.name];
    this.coarse = tooWide(this.chosen.name);
    this.hint.textContent = this.coarse ? "Steps are too wide for the lobes (see the warnings): rows are points, without lines between them." : "";
    this.layControls();
    this.update(false);
  }

  layControls() {
    const { choices, chosen, rows } = this, update = () => this.update(true);
    this.controls.replaceChildren();
    if (choices.length > 1) this.controls.append(choice("over", choices.map((each) => quantityLabels[each.name]), choices.indexOf(chosen), (i) => this.chooseQuantity(i)));
    if (chosen.cuts.length > 1) this.controls.append(slider("at", chosen.cuts.map((cut) => cut.words), this.cut, (i) => { this.cut = i; this.update(true); }));
    else this.controls.append(make("span", {}, chosen.cuts[0].words));
    this.controls.append(toggles("channels", channelNames, this.channels, update, (i) => "--c" + i));
    const names = ["all together", ...rows.mechanisms.map((each) => each.label)];
    if (rows.mechanisms.length) this.controls.append(toggles("mechanisms", names, this.shown, update));
    if (rows.incoherent.length) this.controls.append(toggles("incoherent", ["of V", "of H"], this.incoherent, update, (i) => "--c" + (4 + i)));
    this.controls.append(group("bands", toggle("model uncertainty", this.model, (on) => { this.model = on; this.update(true); }),
      toggle("numerical error", this.numerical, (on) => { this.numerical = on; this.update(true); })),
      rangeChoice(this.plot.range, (range) => { this.plot.range = range; this.update(false); }),
      ...saveButtons("curves", () => this.plot.picture(), () => this.plot.table()));
  }

  // One channel: a colour for each mechanism; several: a colour for each channel and dashes for mechanisms.
  seriesOf(channel, part, xs, of) {
    const alone = this.channels.filter(Boolean).length === 1, total = part === 0;
    const source = total ? this.rows.sigma : this.rows.mechanisms[part - 1].sigma, ys = of(source[channel]);
    const label = this.rows.mechanisms.length && !total ? channelNames[channel] + " " + this.rows.mechanisms[part - 1].label : channelNames[channel];
    const series = { name: label, xs, ys, width: total ? (xs.length > 200 ? 1.9 - 0.2 * channel : 3.2 - 0.6 * channel) : 1.4, points: this.coarse, bands: [], colour: "--c" + channel, dash: [] };
    if (alone && !total) series.colour = partColours[part % partColours.length];
    if (!total && !alone) series.dash = [[6, 4], [2, 3], [8, 3, 2, 3], [12, 4], [4, 8]][(part - 1) % 5];
    if (total) this.addBands(series, of(this.rows.error[channel]), of(this.rows.model[channel]));
    return series;
  }

  addBands(series, error, model) {
    if (this.model) series.bands.push(bandOf(series.ys, model, 0.16));
    if (this.numerical) series.bands.push(bandOf(series.ys, error, 0.35));
    series.errors = [[series.name + " numerical error (dB)", error], [series.name + " model uncertainty (dB)", model]];
    series.more = (i) => "  numerical ±" + error[i].toFixed(2) + ", model ±" + model[i].toFixed(2) + " dB";
  }

  update(keepView) {
    const { rows } = this.chosen.cuts[this.cut], of = (levels) => Float32Array.from(rows, (row) => levels[row]);
    const xs = Float64Array.from(rows, (row) => this.rows.values[this.chosen.name][row]), series = [];
    this.channels.forEach((on, channel) => {
      if (on) this.shown.forEach((too, part) => { if (too) series.push(this.seriesOf(channel, part, xs, of)); });
    });
    this.rows.incoherent.forEach((levels, i) => {
      if (this.incoherent[i]) series.push({ name: "incoherent of " + "VH"[i], xs, ys: of(levels), width: 1.6, points: this.coarse, colour: "--c" + (4 + i), dash: [3, 3] });
    });
    this.plot.setSeries(series, keepView);
    const round = (this.chosen.name === "phi" || this.chosen.name === "rx_phi") && xs[xs.length - 1] - xs[0] >= 45;
    this.polarSection.hidden = !round;
    document.querySelector('nav a[href="#polar"]').hidden = !round;
    if (round) this.polar.setSeries(series);
  }
}

function addMap(map) {
  if (!map) return;
  const sigma = fourLevels(map.sigma), first = strongestChannel(sigma);
  const { controls, holder } = addPlotSection("map", "Map", map.fixed ? "At " + map.fixed + "." : "");
  const plot = new HeatPlot(holder, { label: "σ over two quantities", xLabel: quantityLabels[map.x.quantity], yLabel: quantityLabels[map.y.quantity], caption: map.fixed });
  const gridOf = (channel) => ({ levels: sigma[channel], columns: map.x.count, rows: map.y.count, x: [map.x.first, map.x.last], y: [map.y.first, map.y.last] });
  addHeatControls(controls, plot, first, gridOf, "map");
}

// plot.caption: what else is shown beside the channel.
function addHeatControls(controls, plot, first, gridOf, name) {
  const words = plot.caption;
  const show = (channel, keepView) => {
    plot.caption = () => ["σ " + channelNames[channel], words].filter(Boolean).join(", ");
    plot.setGrid(gridOf(channel), keepView);
  };
  controls.append(choice("channel", channelNames, first, (i) => show(i, true)), rangeChoice(40, (range) => plot.setRange(range)),
    ...saveButtons(name, () => plot.picture()));
  show(first, false);
}

// What varies among looks, or their number.
function lookAxis(profiles, rows, sweep) {
  const name = rows.swept.filter((each) => each !== "ghz");
  const one = name.length === 1 ? sweep.looks[name[0]] : null, size = profiles.looks_a_block;
  const looks = sweep.looks.phi.length, middles = Array.from({ length: profiles.blocks }, (_, i) => (i * size + Math.min((i + 1) * size, looks) - 1) / 2);
  const even = one && profiles.blocks > 1 && one.every((value, i) => Math.abs(value - one[0] - i * (one[1] - one[0])) < 1e-3 * Math.abs(one[1] - one[0]));
  const at = (i) => (even ? (one[Math.floor(middles[i])] + one[Math.ceil(middles[i])]) / 2 : middles[i]);
  return { label: even ? quantityLabels[name[0]] : "look", at, first: at(0), last: at(profiles.blocks - 1) };
}

function addProfiles(profiles, rows, sweep) {
  if (!profiles) return;
  const sigma = fourLevels(profiles.sigma), count = profiles.range.count, axis = lookAxis(profiles, rows, sweep);
  const ranges = Float64Array.from({ length: count }, (_, i) => profiles.range.first + i * (profiles.range.last - profiles.range.first) / (count - 1));
  const strongest = sigma[strongestChannel(sigma)], peak = strongest.indexOf(peakOf(strongest));
  const state = { look: Math.floor(peak / count), channels: [true, false, false, true] };
  const placeWords = (i) => axis.label.replace(/ \(degrees\)/, "") + " " + numberText(axis.at(i), 7) + (axis.label === "look" ? "" : "°");
  const { controls, holder } = addPlotSection("profile", "Range profile",
    `Range beyond the phase reference, away from the radar. A peak is ${numberText(profiles.resolution, 3)} m wide (3 dB, ${profiles.window} window); what is ${numberText(profiles.unambiguous, 4)} m farther away appears at the same range.` +
    " The dashed line is where the look's model uncertainty would be if all of it came from one range.");
  const plot = new CurvePlot(holder, { label: "range profile", xLabel: "range (m)", yLabel: "σ (dBsm)", range: 60, caption: () => (profiles.blocks > 1 ? placeWords(state.look) : "") });
  const update = (keepView) => {
    const series = channelNames.map((name, i) => ({ name, colour: "--c" + i, xs: ranges, ys: sigma[i].subarray(state.look * count, (state.look + 1) * count) })).filter((_, i) => state.channels[i]);
    const model = profiles.model[state.look];
    if (model !== null) series.push({ name: "model", colour: "--muted", dash: [6, 5], width: 1, bare: true, xs: [ranges[0], ranges[count - 1]], ys: Float32Array.of(model, model) });
    plot.setSeries(series, keepView);
  };
  if (profiles.blocks > 1) controls.append(slider("at", Array.from({ length: profiles.blocks }, (_, i) => placeWords(i)), state.look, (i) => { state.look = i; update(true); }));
  controls.append(toggles("channels", channelNames, state.channels, () => update(true), (i) => "--c" + i),
    ...saveButtons("profile", () => plot.picture(), () => plot.table()));
  update(false);
  if (profiles.blocks > 1) addWaterfall(sigma, profiles, axis);
}

function addWaterfall(sigma, profiles, axis) {
  const words = "Range profiles of all looks" + (profiles.looks_a_block > 1 ? `, the strongest of every ${profiles.looks_a_block}.` : ".");
  const { controls, holder } = addPlotSection("waterfall", "Waterfall", words), first = strongestChannel(sigma);
  const plot = new HeatPlot(holder, { label: "range profiles of all looks", xLabel: "range (m)", yLabel: axis.label });
  const gridOf = (channel) => ({ levels: sigma[channel], columns: profiles.range.count, rows: profiles.blocks, x: [profiles.range.first, profiles.range.last], y: [axis.first, axis.last] });
  addHeatControls(controls, plot, first, gridOf, "waterfall");
}

// Cross-range to the right, away from the radar upwards.
const dopplerLabels = { range_m: "range (m)", velocity_m_per_s: "velocity towards the radar (m/s)", time_s: "time (s)" };

function addDoppler(doppler) {
  if (!doppler) return;
  const { x, y } = doppler, sigma = fourLevels(doppler.sigma), heading = x.quantity === "time_s" ? "Spectrogram" : "Range and velocity";
  const { controls, holder } = addPlotSection("doppler", heading, (doppler.look === null ? "" : `Of look ${doppler.look} of a pulse. `) +
    `What comes nearer has a positive velocity. A peak is ${numberText(doppler.resolution, 3)} m/s wide (3 dB, ${doppler.window} window); what is ${numberText(doppler.unambiguous, 4)} m/s faster appears at the same velocity.`);
  const plot = new HeatPlot(holder, { label: heading, xLabel: dopplerLabels[x.quantity], yLabel: dopplerLabels[y.quantity] });
  addHeatControls(controls, plot, strongestChannel(sigma), (channel) => ({ levels: sigma[channel], columns: x.count, rows: y.count, x: [x.first, x.last], y: [y.first, y.last] }), "doppler");
}

const isarGrid = (isar, channel) => ({ levels: isar.levels[channel], columns: isar.cross.count, rows: isar.range.count,
  x: [isar.cross.first, isar.cross.last], y: [isar.range.first, isar.range.last] });

// The target on the plane of two axes.
function flattened(scene, across, up) {
  const flat = (places) => {
    const points = new Float32Array(places.length / 3 * 2);
    for (let i = 0; i < places.length / 3; ++i)
      [across, up].forEach((axis, j) => { points[2 * i + j] = axis[0] * places[3 * i] + axis[1] * places[3 * i + 1] + axis[2] * places[3 * i + 2]; });
    return points;
  };
  return scene && { lines: flat(floatsOf(scene.lines)), points: flat(floatsOf(scene.vertices)), corners: indicesOf(scene.triangles) };
}

function addImage(id, heading, words, labels, first, gridOf, flat) {
  const { controls, holder } = addPlotSection(id, heading, words, "plot tall");
  const plot = new HeatPlot(holder, { label: heading, equal: true, xLabel: labels[0], yLabel: labels[1], flat, linesOn: true, radar: id === "isar" });
  addHeatControls(controls, plot, first, gridOf, id);
  if (flat) controls.append(toggle("target", true, (on) => { plot.linesOn = on; plot.draw(); }));
}

function addIsar(isar, scene) {
  if (!isar) return;
  addImage("isar", "ISAR image", "Where the return comes from, computed from all frequencies and angles. Range increases away from the radar as it stands at the middle angle. Resolution " +
    `${numberText(isar.range_resolution, 3)} m in range, ${numberText(isar.cross_resolution, 3)} m across (3 dB, ${isar.window} window).` + (isar.in_space ? " Along the third axis the strongest cell is shown." : ""),
    ["cross-range (m)", "range (m)"], strongestChannel(isar.levels), (channel) => isarGrid(isar, channel), flattened(scene, isar.cross_axis, isar.range_axis));
}

function addLookImages(scene, sweep) {
  for (const look of scene ? scene.looks : []) {
    const cells = look.cells;
    if (!cells) continue;
    const sigma = fourLevels(cells.sigma), ends = (i, count) => [cells.corner[i] + cells.cell[i] / 2, cells.corner[i] + cells.cell[i] * (count - 0.5)];
    addImage("image" + look.look, "Image of look " + look.look, "The target as the radar sees it, " + lookWords(sweep, look.look) + `, at ${numberText(look.ghz, 6)} GHz: σ of each cell alone; cells add up with their phases. ` +
      "What a tube sends back at any bounce is in the cell that it set out from.",
      ["u (m)", "v (m)"], strongestChannel(sigma), (channel) => ({ levels: sigma[channel], columns: cells.columns, rows: cells.rows, x: ends(0, cells.columns), y: ends(1, cells.rows) }), flattened(scene, cells.u, cells.v));
  }
}

function buildPage() {
  const { sweep } = report, rows = new Rows(sweep), looks = sweep.looks.phi.length, frequencies = sweep.ghz.length;
  document.getElementById("title").textContent = report.title;
  document.getElementById("lead").textContent = `${looks} look${looks > 1 ? "s" : ""}, ${sweep.bistatic ? "bistatic" : "monostatic"}, ` +
    (frequencies > 1 ? `${frequencies} frequencies from ${numberText(Math.min(...sweep.ghz), 7)} to ${numberText(Math.max(...sweep.ghz), 7)} GHz` : `${numberText(sweep.ghz[0], 7)} GHz`) + `. Made by raytube from ${report.file}.`;
  const centres = unpackedCentres(report.centres);
  if (report.isar) report.isar.levels = fourLevels(report.isar.sigma);
  addWords(report);
  new CurveView(rows);
  addMap(report.map);
  addProfiles(report.profiles, rows, sweep);
  addDoppler(report.doppler);
  addIsar(report.isar, report.scene);
  addLookImages(report.scene, sweep);
  addSpace(report.scene, sweep, report.isar, centres);
  addCentres(centres, sweep);
  addUncertainty(report.record);
  addRecord(report.record);
  const redraw = () => redrawers.forEach((each) => each());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  window.addEventListener("beforeprint", () => { document.documentElement.dataset.theme = "light"; redraw(); });
  window.addEventListener("afterprint", () => { delete document.documentElement.dataset.theme; redraw(); });
}

buildPage();
