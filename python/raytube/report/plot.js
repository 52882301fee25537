// Canvases that one can zoom and hover over. A frame knows its axes; what is drawn inside them is of its kind.
const frames = [];

class Frame {
  constructor(holder, options) {
    Object.assign(this, { holder, equal: false, margin: { left: 64, right: 18, top: 12, bottom: 46 } }, options);
    this.canvas = make("canvas", { tabindex: 0, "aria-label": this.label || "plot" });
    holder.append(this.canvas);
    this.pen = this.canvas.getContext("2d");
    this.listen();
    frames.push(this);
    new ResizeObserver(() => this.draw()).observe(holder);
  }

  setExtent(x, y) {
    this.full = { x, y };
    this.reset();
  }
  reset() {
    this.shown = { x: [...this.full.x], y: [...this.full.y] };
    this.draw();
  }

  get area() {
    const { left, right, top, bottom } = this.margin;
    return { left, top, width: this.width - left - right, height: this.height - top - bottom };
  }
  toX(x) { return this.area.left + (x - this.view.x[0]) / (this.view.x[1] - this.view.x[0]) * this.area.width; }
  toY(y) { return this.area.top + (this.view.y[1] - y) / (this.view.y[1] - this.view.y[0]) * this.area.height; }
  fromX(px) { return this.view.x[0] + (px - this.area.left) / this.area.width * (this.view.x[1] - this.view.x[0]); }
  fromY(py) { return this.view.y[1] - (py - this.area.top) / this.area.height * (this.view.y[1] - this.view.y[0]); }

  // With equal axes a metre is as long along both: the shorter one shows more.
  fit() {
    this.view = { x: [...this.shown.x], y: [...this.shown.y] };
    if (!this.equal) return;
    const perX = (this.view.x[1] - this.view.x[0]) / this.area.width, perY = (this.view.y[1] - this.view.y[0]) / this.area.height;
    const widen = (range, factor) => {
      const middle = (range[0] + range[1]) / 2, half = (range[1] - range[0]) / 2 * factor;
      range[0] = middle - half;
      range[1] = middle + half;
    };
    if (perX < perY) widen(this.view.x, perY / perX);
    else widen(this.view.y, perX / perY);
  }

  // Once before the next picture, however often it is asked for.
  draw() {
    this.asked = this.asked || requestAnimationFrame(() => {
      this.asked = 0;
      this.drawNow();
    });
  }

  drawNow(dots = window.devicePixelRatio || 1) {
    const box = this.holder.getBoundingClientRect();
    this.width = box.width;
    this.height = box.height;
    if (!this.shown || this.area.width < 10 || this.area.height < 10) return;
    this.canvas.width = Math.round(box.width * dots);
    this.canvas.height = Math.round(box.height * dots);
    this.pen.setTransform(dots, 0, 0, dots, 0, 0);
    this.pen.font = "13px system-ui, sans-serif";
    this.fit();
    this.paint();
    if (this.dragged) this.paintDragged();
  }

  clip() {
    const { left, top, width, height } = this.area;
    this.pen.save();
    this.pen.beginPath();
    this.pen.rect(left, top, width, height);
    this.pen.clip();
  }

  paintGrid(lines) {
    const pen = this.pen, { left, top, width, height } = this.area;
    const degrees = (label) => label.endsWith("(degrees)");
    const xs = ticksOf(...this.view.x, Math.max(width / 90, 5), degrees(this.xLabel)), ys = ticksOf(...this.view.y, height / 45, degrees(this.yLabel));
    pen.lineWidth = 1;
    pen.strokeStyle = cssColour("--grid");
    pen.fillStyle = cssColour("--muted");
    for (const x of xs) {
      if (lines) this.line(this.toX(x), top, this.toX(x), top + height);
      write(pen, tickText(x, xs), this.toX(x), top + height + 6, "center", "top");
    }
    for (const y of ys) {
      if (lines) this.line(left, this.toY(y), left + width, this.toY(y));
      write(pen, tickText(y, ys), left - 6, this.toY(y), "right", "middle");
    }
    pen.strokeStyle = cssColour("--axis");
    pen.strokeRect(left, top, width, height);
    this.paintLabels();
  }

  paintLabels() {
    const pen = this.pen, { left, top, width, height } = this.area;
    write(pen, this.xLabel || "", left + width / 2, this.height - 4, "center", "bottom");
    pen.save();
    pen.translate(14, top + height / 2);
    pen.rotate(-Math.PI / 2);
    write(pen, this.yLabel || "", 0, 0, "center", "middle");
    pen.restore();
  }

  // For a file: in light colours, three dots to a pixel of the page, title and key above.
  picture() {
    const dots = 3, line = 20, { theme } = document.documentElement.dataset;
    document.documentElement.dataset.theme = "light";
    this.marked = null;
    this.drawNow(dots);
    const key = this.series ? this.series.map((s) => [s.name, s]) : [], width = (text) => this.pen.measureText(text).width;
    const heading = [report.title, this.caption && this.caption()].filter(Boolean).join(" \u2013 "), places = [];
    let x = 20, y = 2;
    for (const [name] of key) {
      if (x + 50 + width(name) > this.width) [x, y] = [20, y + 1];
      places.push([x, y]);
      x += 54 + width(name);
    }
    const above = line * (key.length ? y + 1 : 2), canvas = onPaper(this.canvas, dots * above), pen = canvas.getContext("2d");
    pen.scale(dots, dots);
    pen.textBaseline = "middle";
    pen.font = "bold 14px system-ui, sans-serif";
    pen.fillStyle = cssColour("--ink");
    pen.fillText(heading, 20, line, this.width - 40);
    pen.font = this.pen.font;
    key.forEach(([name, s], i) => {
      const [left, row] = places[i], middle = line * row + 2;
      takeLine(pen, s);
      pen.beginPath();
      pen.moveTo(left, middle);
      pen.lineTo(left + 26, middle);
      pen.stroke();
      pen.fillText(name, left + 32, middle);
    });
    if (theme) document.documentElement.dataset.theme = theme;
    else delete document.documentElement.dataset.theme;
    this.drawNow();
    return canvas;
  }

  line(x0, y0, x1, y1) {
    this.pen.beginPath();
    this.pen.moveTo(x0, y0);
    this.pen.lineTo(x1, y1);
    this.pen.stroke();
  }

  dot(x, y, radius) {
    this.pen.beginPath();
    this.pen.arc(x, y, radius, 0, 2 * Math.PI);
    this.pen.fill();
  }

  paintDragged() {
    const { from, to } = this.dragged;
    this.pen.fillStyle = "#4a96ec33";
    this.pen.strokeStyle = cssColour("--accent");
    this.pen.fillRect(from.x, from.y, to.x - from.x, to.y - from.y);
    this.pen.strokeRect(from.x, from.y, to.x - from.x, to.y - from.y);
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  listen() {
    const canvas = this.canvas;
    canvas.addEventListener("pointerdown", (event) => {
      this.dragged = { from: this.place(event), to: this.place(event) };
      try { canvas.setPointerCapture(event.pointerId); } catch { /* a pointer that a script made */ }
    });
    canvas.addEventListener("pointermove", (event) => {
      if (this.dragged) {
        this.dragged.to = this.place(event);
        this.draw();
      } else {
        this.hover(event);
      }
    });
    canvas.addEventListener("pointerup", () => this.endDrag());
    canvas.addEventListener("pointercancel", () => { this.dragged = null; });
    canvas.addEventListener("pointerleave", () => this.leave());
    canvas.addEventListener("dblclick", () => this.reset());
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("keydown", (event) => { if (event.key === "Escape") this.reset(); });
  }

  endDrag() {
    const { from, to } = this.dragged || {};
    this.dragged = null;
    if (from && Math.abs(to.x - from.x) > 6 && Math.abs(to.y - from.y) > 6) {
      this.shown = { x: ascending(this.fromX(from.x), this.fromX(to.x)), y: ascending(this.fromY(from.y), this.fromY(to.y)) };
    }
    this.draw();
  }

  wheel(event) {
    event.preventDefault();
    if (!this.view) return;
    const { x, y } = this.place(event), factor = Math.exp(0.0015 * event.deltaY), at = { x: this.fromX(x), y: this.fromY(y) };
    for (const axis of event.shiftKey ? ["x"] : ["x", "y"])
      this.shown[axis] = this.view[axis].map((end) => at[axis] + (end - at[axis]) * factor);
    this.draw();
  }

  hover(event) {
    const words = this.wordsAt ? this.wordsAt(this.place(event)) : "";
    this.draw();
    showTip(words, event);
  }
  leave() {
    this.marked = null;
    this.draw();
    showTip("");
  }
}

function write(pen, text, x, y, align, baseline) {
  pen.textAlign = align;
  pen.textBaseline = baseline;
  pen.fillText(text, x, y);
}

// That of a series.
function takeLine(pen, series) {
  pen.strokeStyle = cssColour(series.colour);
  pen.lineWidth = series.width || 1.6;
  pen.setLineDash(series.dash || []);
}

function showTip(words, event) {
  const tip = document.getElementById("tip");
  tip.hidden = !words;
  if (!words) return;
  tip.textContent = words;
  const right = event.clientX + 16 + tip.offsetWidth > window.innerWidth;
  tip.style.left = (right ? event.clientX - 12 - tip.offsetWidth : event.clientX + 16) + "px";
  tip.style.top = Math.max(4, Math.min(event.clientY + 12, window.innerHeight - tip.offsetHeight - 4)) + "px";
}

// A copy on the background of the page, with room above.
function onPaper(source, above = 0) {
  const canvas = make("canvas", { width: source.width, height: source.height + above }), pen = canvas.getContext("2d");
  pen.fillStyle = cssColour("--surface");
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.drawImage(source, 0, above);
  return canvas;
}

function saveAs(name, blob) {
  const address = URL.createObjectURL(blob);
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

// picture: makes a canvas; table: makes a text of comma-separated values, where there is one.
function saveButtons(name, picture, table) {
  const file = report.file.replace(/\.\w+$/, "") + "_" + name;
  const buttons = [make("button", { onclick: () => picture().toBlob((blob) => saveAs(file + ".png", blob)) }, "save PNG")];
  if (table) buttons.push(make("button", { onclick: () => saveAs(file + ".csv", new Blob([table()], { type: "text/csv" })) }, "save CSV"));
  return buttons;
}

const redrawAll = () => frames.forEach((frame) => frame.draw());
