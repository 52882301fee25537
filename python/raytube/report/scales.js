// Numbers and colours along axes.
const viridis = [[68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140], [34, 168, 132], [68, 191, 112],
  [122, 209, 81], [189, 223, 38], [253, 231, 37]];  // the colour map of that name (CC0)

// Of a share from 0 to 1.
function paletteColour(share) {
  const at = Math.min(Math.max(share, 0), 1) * (viridis.length - 1), i = Math.min(Math.floor(at), viridis.length - 2), rest = at - i;
  return viridis[i].map((from, c) => Math.round(from + rest * (viridis[i + 1][c] - from)));
}

const shareOf = (level, top, range) => 1 + (level - top) / range;
const rgbOf = (share) => paletteColour(share).map((c) => c / 255);

// The next even level above a peak.
const topOf = (peak) => (Number.isFinite(peak) ? 2 * Math.ceil(peak / 2) : 0);

const cssColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function tickStep(span, most, degrees) {
  const rough = span / most, power = 10 ** Math.floor(Math.log10(rough));
  if (degrees && rough > 5 && rough <= 90) return [10, 15, 30, 45, 90].find((step) => step >= rough);
  return power * [1, 2, 5, 10].find((factor) => factor * power >= rough * (1 - 1e-9));
}

function ticksOf(low, high, most, degrees) {
  if (!(high > low)) return [low];
  const step = tickStep(high - low, most, degrees), ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) ticks.push(i * step);
  return ticks;
}

function tickText(value, ticks) {
  const step = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : Math.abs(value) || 1;
  const digits = Math.min(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), 12);
  return Number(value.toFixed(digits)) === 0 ? "0" : value.toFixed(digits).replace("-", "\u2212");
}

const numberText = (value, digits = 5) => String(Number(value.toPrecision(digits))).replace("-", "\u2212");
const levelText = (level) => (level === -Infinity ? "\u2212\u221e dBsm" : level.toFixed(2).replace("-", "\u2212") + " dBsm");

const dynamicRanges = [20, 30, 40, 50, 60, 80];
const rangeChoice = (chosen, change) =>
  choice("levels", dynamicRanges.map((db) => db + " dB"), dynamicRanges.indexOf(chosen), (i) => change(dynamicRanges[i]));
