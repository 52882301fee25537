// What is to be read: how sure the numbers are, what is missing, and the record of the run.
const countedWords = (name) => name.replace(/_/g, " ").replace(/ m2$/, " (m²)").replace(/ m$/, " (m)").replace(/ s$/, " (s)");

function valueText(value) {
  if (value === null) return "none";
  if (Array.isArray(value)) return value.map(valueText).join(", ");
  if (typeof value === "object") return Object.entries(value).map(([name, each]) => name + " " + valueText(each)).join("; ");
  if (typeof value === "number" && !Number.isInteger(value)) return numberText(value, 6);
  return String(value);
}

function tableOf(rows, headings) {
  const table = make("table");
  if (headings) table.append(make("tr", {}, ...headings.map((text) => make("th", {}, text))));
  for (const row of rows) table.append(make("tr", {}, ...row.map((cell) => make("td", {}, cell))));
  return make("div", { class: "scroll" }, table);
}

const listOf = (texts) => make("ul", {}, ...texts.map((text) => make("li", {}, text)));

function addWords(report) {
  const { sentences, notes, record, sweep } = report;
  const section = addSection("words", "In words", make("p", {}, sentences.peak), make("p", {}, sentences.error), make("p", {}, sentences.model));
  const warnings = record && record.warnings || [];
  section.append(make("h3", {}, "Warnings"));
  section.append(warnings.length ? listOf(warnings) : make("p", {}, record ? "None." : "Not known: there is no run.json beside the result."));
  if (record && record.counts && record.counts.beyond_bound && record.counts.beyond_bound.length)
    section.append(make("p", {}, "Mechanisms beyond what the size of the target allows, or without a number; do not use these rows: " + valueText(record.counts.beyond_bound)));
  if (notes.length) section.append(make("h3", {}, "Not in this report"), listOf(notes));
  section.append(make("h3", {}, "How to read it"), make("p", { class: "note" },
    "S in metres, σ = 4π|S|², levels in dBsm: 10 log10(σ / 1 m²). VH: receive V, transmit H; V is θ̂, H is φ̂. θ is counted from +z, φ from +x " +
    "towards +y, both point from the target to the radar. Time factor e^(+jωt), phase reference the origin of the mesh's coordinates." +
    (sweep.bistatic ? " The result is bistatic: angles without rx are the transmitter's." : "")));
}

function addUncertainty(record) {
  const parts = record && record.model_uncertainty || [];
  if (!parts.length) return;
  addSection("uncertainty", "Model uncertainty", note("What asymptotic physics leaves out, by cause; shares of the sum of squares over all rows, VV and HH."),
    tableOf(parts.map((part) => [part.what, (100 * part.share).toFixed(1) + "\u00a0%", numberText(part.rms_m, 3), String(part.rows_largest), part.remedy]),
      ["cause", "share", "rms (m)", "rows in which it is the largest", "remedy"]));
}

function addRecord(record) {
  if (!record) return;
  addSettings(record);
  addMesh(record.mesh);
  addRun(record);
}

function addSettings(record) {
  if (!record.case) return;
  const columns = make("div", { class: "columns" });
  for (const [section, keys] of Object.entries(record.case)) {
    if (keys === null || typeof keys !== "object") continue;
    columns.append(make("div", {}, make("h3", {}, section), tableOf(Object.entries(keys).map(([name, value]) => [name, valueText(value)]))));
  }
  addSection("settings", "Settings", note("The case with every default filled in."), columns);
}

function addMesh(mesh) {
  if (!mesh) return;
  const counts = Object.entries(mesh).filter(([name, value]) => name !== "sha256" && name !== "notes" && typeof value === "number" && value !== 0);
  const notes = (mesh.notes || []).map(valueText);
  addSection("mesh", "Mesh", note("What was read, mended and traced; counts that are zero are left out."),
    tableOf(counts.map(([name, value]) => [countedWords(name), valueText(value)])), notes.length ? listOf(notes) : "",
    note("SHA-256 " + valueText(mesh.sha256)));
}

function addRun(record) {
  const counts = record.counts || {}, time = record.time || {};
  const plain = Object.entries(counts).filter(([name, value]) => typeof value === "number" && value !== 0);
  const section = addSection("run", "Run", make("p", {}, `raytube ${record.version || ""}` + (record.threads ? `, ${record.threads} threads` : "") +
    (time.total_s ? `, ${numberText(time.total_s, 3)} s, of which ${numberText(time.solve_s, 3)} s went into the solve.` : ".")));
  if (counts.mechanisms) section.append(make("h3", {}, "Mechanisms beside the tubes"),
    tableOf(counts.mechanisms.map((m) => [m.label, m.on ? "on" : "off: " + m.why_not, m.on ? `${m.looks} looks with it, ${m.looks_without} without` : ""])));
  if (counts.skipped && counts.skipped.length) section.append(make("h3", {}, "Left out"),
    tableOf(counts.skipped.map((s) => [s.what, String(s.count), s.why]), ["what", "how often", "why"]));
  if (plain.length) section.append(make("h3", {}, "Counts"), tableOf(plain.map(([name, value]) => [countedWords(name), valueText(value)])));
}
