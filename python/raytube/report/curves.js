// Curves in decibels: over a quantity, and over azimuth as radius.

// Indices of what is drawn: of the points of each dot across the first, the least, the largest and the last.
function thinned(xs, ys, toDot) {
  if (xs.length < 4000) return null;
  const kept = [];
  for (let i = 0; i < xs.length;) {
    const dot = Math.floor(toDot(xs[i]));
    let least = i, most = i, j = i;
    for (; j < xs.length && Math.floor(toDot(xs[j])) === dot; ++j) {
      if (ys[j] < ys[least]) least = j;
      if (ys[j] > ys[most]) most = j;
    }
    kept.push(...[...new Set([i, least, most, j - 1])].sort((a, b) => a - b));
    i = j;
  }
  return kept;
}

// series: { name, colour (a variable of the style), dash, width, xs, ys, bands: [{ low, high, opacity }] }
class CurvePlot extends Frame {
  setSeries(series, keepView) {
    this.series = series;
    const xs = series.flatMap((s) => [s.xs[0], s.xs[s.xs.length - 1]]).filter(Number.isFinite);
    const top = series.reduce((most, s) => Math.max(most, peakOf(s.ys)), -Infinity);
    const high = Number.isFinite(top) ? 5 * Math.ceil(top / 5 + 0.2) : 0;
    const low = this.lowest(series, high);
    const x = xs.length ? [Math.min(...xs), Math.max(...xs)] : [0, 1];
    const room = x[0] === x[1] ? 0.5 : series.some((s) => s.points) ? 0.02 * (x[1] - x[0]) : 0;
    x[0] -= room;
    x[1] += room;
    const before = keepView && this.shown;
    this.full = { x, y: [low, high] };
    if (before) this.draw();
    else this.reset();
  }

  // Down to the weakest value, but for nulls: no lower than the range of levels chosen.
  lowest(series, high) {
    const floor = high - this.range;
    const least = series.reduce((low, s) => s.ys.reduce((a, b) => (b > floor ? Math.min(a, b) : a), low), high - 10);
    return Math.max(floor, 5 * Math.floor(least / 5 - 0.2));
  }

  paint() {
    this.pen.clearRect(0, 0, this.width, this.height);
    this.paintGrid(true);
    this.clip();
    for (const s of this.series) for (const band of s.bands || []) this.paintBand(s, band);
    for (const s of this.series) this.paintCurve(s);
    if (this.marked !== undefined && this.marked !== null) this.paintMark();
    this.pen.restore();
  }

  indices(s) {
    return thinned(s.xs, s.ys, (x) => this.toX(x)) || s.xs.keys();
  }

  atY(y) {
    return this.toY(Math.max(y, this.view.y[0] - (this.view.y[1] - this.view.y[0])));
  }

  paintCurve(s) {
    const pen = this.pen;
    takeLine(pen, s);
    pen.fillStyle = pen.strokeStyle;
    pen.beginPath();
    if (!s.points) for (const i of this.indices(s)) pen.lineTo(this.toX(s.xs[i]), this.atY(s.ys[i]));
    pen.stroke();
    pen.setLineDash([]);
    if (s.points || (s.xs.length <= 40 && !s.bare))
      for (const i of this.indices(s)) this.dot(this.toX(s.xs[i]), this.atY(s.ys[i]), s.xs.length <= 200 ? 2.5 : 1.6);
  }

  paintBand(s, band) {
    if (s.points) return this.paintBars(s, band);
    const pen = this.pen, indices = [...this.indices(s)];
    pen.fillStyle = cssColour(s.colour);
    pen.globalAlpha = band.opacity;
    pen.beginPath();
    for (const i of indices) pen.lineTo(this.toX(s.xs[i]), this.atY(band.high[i]));
    for (const i of indices.reverse()) pen.lineTo(this.toX(s.xs[i]), this.atY(band.low[i]));
    pen.fill();
    pen.globalAlpha = 1;
    return undefined;
  }

  paintBars(s, band) {
    const pen = this.pen;
    pen.strokeStyle = cssColour(s.colour);
    pen.globalAlpha = 1.5 * band.opacity;
    pen.lineWidth = Math.min(6, Math.max(1, 0.5 * this.area.width / s.xs.length));
    pen.setLineDash([]);
    for (const i of this.indices(s)) this.line(this.toX(s.xs[i]), this.atY(band.low[i]), this.toX(s.xs[i]), this.atY(band.high[i]));
    pen.globalAlpha = 1;
  }

  // The curves shown, as comma-separated values.
  table() {
    const series = this.series.filter((s) => !s.bare), xs = series.length ? series[0].xs : [];
    const columns = series.flatMap((s) => [[s.name + " (dBsm)", s.ys], ...(s.errors || [])]);
    const level = (value) => (value === -Infinity ? "-inf" : value.toFixed(2));
    const lines = [[this.xLabel, ...columns.map(([name]) => name)].map((name) => '"' + name + '"').join()];
    for (let i = 0; i < xs.length; ++i) lines.push([Number(xs[i].toPrecision(12)), ...columns.map(([, values]) => level(values[i]))].join());
    return lines.join("\n") + "\n";
  }

  paintMark() {
    const pen = this.pen, { top, height } = this.area;
    pen.strokeStyle = cssColour("--axis");
    pen.lineWidth = 1;
    this.line(this.toX(this.marked), top, this.toX(this.marked), top + height);
    for (const s of this.series) {
      const i = nearest(s.xs, this.marked);
      pen.fillStyle = cssColour(s.colour);
      this.dot(this.toX(s.xs[i]), this.atY(s.ys[i]), 4);
    }
  }

  wordsAt({ x }) {
    if (!this.series.length || !this.series[0].xs.length) return "";
    const i = nearest(this.series[0].xs, this.fromX(x));
    this.marked = this.series[0].xs[i];
    const lines = this.series.map((s) => {
      const j = nearest(s.xs, this.marked);
      return s.name + "  " + levelText(s.ys[j]) + (s.more ? s.more(j) : "");
    });
    return [this.xLabel + "  " + numberText(this.marked, 7), ...lines].join("\n");
  }
}

// In an ascending list.
function nearest(xs, x) {
  let low = 0, high = xs.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] < x) low = middle;
    else high = middle;
  }
  return Math.abs(xs[low] - x) <= Math.abs(xs[high] - x) ? low : high;
}

// Radius: the level over the bottom; azimuth 0 on the right, 90 degrees on top.
class PolarPlot extends Frame {
  constructor(holder, options) {
    super(holder, { equal: true, margin: { left: 30, right: 30, top: 22, bottom: 22 }, ...options });
  }

  setSeries(series) {
    this.series = series;
    const top = series.reduce((most, s) => Math.max(most, peakOf(s.ys)), -Infinity);
    this.top = 10 * Math.ceil((Number.isFinite(top) ? top : 0) / 10);
    this.bottom = this.top - this.range;
    this.full = { x: [-this.range, this.range], y: [-this.range, this.range] };
    this.reset();
  }

  point(degrees, level) {
    const radius = Math.max(level - this.bottom, 0), angle = degrees * Math.PI / 180;
    return [this.toX(radius * Math.cos(angle)), this.toY(radius * Math.sin(angle))];
  }

  paint() {
    this.pen.clearRect(0, 0, this.width, this.height);
    this.paintRings();
    for (const s of this.series) this.paintCurve(s);
    if (this.marked) this.paintMark();
  }

  paintRings() {
    const pen = this.pen, [x0, y0] = this.point(0, this.bottom);
    pen.strokeStyle = cssColour("--grid");
    pen.lineWidth = 1;
    for (let level = this.bottom + 10; level <= this.top; level += 10) {
      pen.beginPath();
      pen.arc(x0, y0, this.point(0, level)[0] - x0, 0, 2 * Math.PI);
      pen.stroke();
    }
    for (let angle = 0; angle < 360; angle += 30) this.line(x0, y0, ...this.point(angle, this.top));
    this.paintRingLabels();
  }

  paintRingLabels() {
    const pen = this.pen;
    pen.fillStyle = cssColour("--muted");
    for (let angle = 0; angle < 360; angle += 30)
      write(pen, angle + "\u00b0", ...this.point(angle, this.top + 0.06 * this.range), "center", "middle");
    for (let level = this.bottom + 10; level <= this.top; level += 10)
      write(pen, tickText(level, [0, 10]) + (level === this.top ? " dBsm" : ""), ...this.point(75, level), "left", "middle");
  }

  paintCurve(s) {
    const pen = this.pen, count = s.xs.length, places = Array.from(s.xs, (x, i) => this.point(x, s.ys[i]));
    takeLine(pen, s);
    pen.fillStyle = pen.strokeStyle;
    if (s.points) {
      for (const [x, y] of places) this.dot(x, y, 2);
      return;
    }
    pen.beginPath();
    for (const place of places) pen.lineTo(...place);
    const step = (s.xs[count - 1] - s.xs[0]) / (count - 1);
    if (s.xs[0] + 360 - s.xs[count - 1] < 1.5 * step) pen.closePath();
    pen.stroke();
    pen.setLineDash([]);
  }

  paintMark() {
    const pen = this.pen;
    pen.strokeStyle = cssColour("--axis");
    this.line(...this.point(0, this.bottom), ...this.point(this.marked.angle, this.top));
  }

  wordsAt({ x, y }) {
    const s = this.series[0];
    if (!s || !s.xs.length) return "";
    let angle = Math.atan2(this.fromY(y), this.fromX(x)) * 180 / Math.PI;
    while (angle < s.xs[0] - 180 / 2 && angle + 360 <= s.xs[s.xs.length - 1] + 90) angle += 360;
    const i = nearest(s.xs, angle);
    this.marked = { angle: s.xs[i] };
    return [numberText(s.xs[i], 7) + "\u00b0", ...this.series.map((each) => each.name + "  " + levelText(each.ys[nearest(each.xs, s.xs[i])]))].join("\n");
  }
}
