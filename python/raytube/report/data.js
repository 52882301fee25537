"use strict";
// What the page shows, as raytube wrote it; packed numbers unpacked.
const report = JSON.parse(document.getElementById("data").textContent);
const channelNames = ["VV", "VH", "HV", "HH"];

function bytesOf(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}
const floatsOf = (text) => new Float32Array(bytesOf(text));
const indicesOf = (text) => new Uint32Array(bytesOf(text));

// Hundredths of a decibel; the least one stands for nothing at all.
function levelsOf(text) {
  const hundredths = new Int16Array(bytesOf(text)), levels = new Float32Array(hundredths.length);
  for (let i = 0; i < levels.length; ++i) levels[i] = hundredths[i] === -32768 ? -Infinity : hundredths[i] / 100;
  return levels;
}
const fourLevels = (texts) => texts.map(levelsOf);

// An element with attributes and children; names that begin with "on" are listeners.
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

function addSection(id, heading, ...children) {
  const section = make("section", { id }, make("h2", {}, heading), ...children);
  document.getElementById("main").append(section);
  document.getElementById("nav").append(make("a", { href: "#" + id }, heading));
  return section;
}

const note = (text) => make("p", { class: "note" }, text);

// A section of controls, what is drawn, and a note. kind: classes of what is drawn.
function addPlotSection(id, heading, words, kind = "plot") {
  const controls = make("div", { class: "controls" }), holder = make("div", { class: kind });
  return { controls, holder, section: addSection(id, heading, controls, holder, note(words)) };
}

function group(legend, ...children) {
  return make("fieldset", {}, make("legend", {}, legend), ...children);
}

function toggle(text, checked, change, colour) {
  const box = make("input", { type: "checkbox", checked, onchange: () => change(box.checked) });
  const label = make("label", {}, box);
  if (colour) label.append(make("span", { class: "swatch", style: "border-color: var(" + colour + ")" }));
  label.append(text);
  return label;
}

// A group of one for each entry of a list of states, with a colour where colourOf gives one.
const toggles = (legend, names, states, change, colourOf = () => undefined) =>
  group(legend, ...names.map((name, i) => toggle(name, states[i], (on) => { states[i] = on; change(); }, colourOf(i))));

function choice(legend, options, chosen, change) {
  const list = make("select", { "aria-label": legend, onchange: () => change(list.selectedIndex) });
  options.forEach((text, i) => list.append(make("option", { selected: i === chosen }, text)));
  return group(legend, list);
}

// A slider over a list, with the words for what it stands at.
function slider(legend, texts, chosen, change) {
  const words = make("span", {}, texts[chosen]);
  const bar = make("input", { type: "range", min: 0, max: texts.length - 1, value: chosen, "aria-label": legend, oninput: () => {
    words.textContent = texts[bar.valueAsNumber];
    change(bar.valueAsNumber);
  } });
  return group(legend, bar, words);
}

const ascending = (a, b) => (a < b ? [a, b] : [b, a]);
const peakOf = (levels) => levels.reduce((a, b) => Math.max(a, b), -Infinity);
const strongestChannel = (four) => four.reduce((best, levels, i) => (peakOf(levels) > peakOf(four[best]) ? i : best), 0);
