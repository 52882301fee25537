// Levels over two axes as colours.

// A canvas of one dot a value; values below the range are transparent, if so asked. grid: { levels, columns, rows }, rows upwards.
function colourDots(grid, top, range, clear) {
  const canvas = make("canvas", { width: grid.columns, height: grid.rows }), pen = canvas.getContext("2d");
  const dots = pen.createImageData(grid.columns, grid.rows);
  for (let row = 0; row < grid.rows; ++row)
    for (let column = 0; column < grid.columns; ++column) {
      const share = shareOf(grid.levels[row * grid.columns + column], top, range);
      const at = 4 * ((grid.rows - 1 - row) * grid.columns + column);
      dots.data.set(paletteColour(share), at);
      dots.data[at + 3] = clear && !(share > 0) ? 0 : 255;
    }
  pen.putImageData(dots, 0, 0);
  return canvas;
}

function paintColourBar(pen, { left, top, height, width }, levelTop, range) {
  for (let i = 0; i < height; ++i) {
    pen.fillStyle = "rgb(" + paletteColour(1 - i / height) + ")";
    pen.fillRect(left, top + i, width, 1.5);
  }
  const ticks = ticksOf(levelTop - range, levelTop, height / 40);
  pen.fillStyle = cssColour("--muted");
  for (const level of ticks) write(pen, tickText(level, ticks), left + width + 5, top + (levelTop - level) / range * height, "left", "middle");
  write(pen, "dBsm", left - 4, top - 8, "left", "bottom");
}

// grid: { levels, columns, rows, x: [first, last], y: [first, last] } of the middles of cells
class HeatPlot extends Frame {
  constructor(holder, options) {
    super(holder, { range: 40, margin: { left: 64, right: 90, top: 30, bottom: 46 }, ...options });
  }

  setGrid(grid, keepView) {
    this.grid = grid;
    this.top = topOf(peakOf(grid.levels));
    this.cell = ["x", "y"].map((axis, i) => {
      const cells = i ? grid.rows : grid.columns;
      return cells > 1 ? (grid[axis][1] - grid[axis][0]) / (cells - 1) : 1;
    });
    const ends = (axis, cell) => [grid[axis][0] - cell / 2, grid[axis][1] + cell / 2];
    this.ends = { x: ends("x", this.cell[0]), y: ends("y", this.cell[1]) };
    this.full = { x: ascending(...this.ends.x), y: ascending(...this.ends.y) };
    this.colour();
    if (keepView && this.shown) this.draw();
    else this.reset();
  }

  setRange(range) {
    this.range = range;
    this.colour();
    this.draw();
  }
  colour() { this.dots = colourDots(this.grid, this.top, this.range, false); }

  paint() {
    const pen = this.pen, { x, y } = this.ends, { left, top, width, height } = this.area;
    pen.clearRect(0, 0, this.width, this.height);
    this.clip();
    pen.fillStyle = cssColour("--page");
    pen.fillRect(left, top, width, height);
    pen.imageSmoothingEnabled = false;
    pen.save();
    pen.translate(this.toX(x[0]), this.toY(y[1]));
    pen.scale((this.toX(x[1]) - this.toX(x[0])) / this.dots.width, (this.toY(y[0]) - this.toY(y[1])) / this.dots.height);
    pen.drawImage(this.dots, 0, 0);
    pen.restore();
    this.paintLines();
    if (this.radar) {
      pen.fillStyle = "#ffffff";
      write(pen, "\u2191 away from the radar", Math.max(this.toX(this.full.x[0]), left) + 8, top + height - 8, "left", "bottom");
    }
    pen.restore();
    this.paintGrid(false);
    paintColourBar(pen, { left: left + width + 18, top: top + 4, width: 14, height: height - 8 }, this.top, this.range);
  }

  // The target, flat: its outline, and its edges.
  paintLines() {
    if (!this.flat || !this.linesOn) return;
    const { lines } = this.flat, pen = this.pen;
    pen.strokeStyle = "#ffffff";
    pen.globalAlpha = 0.35;
    pen.lineWidth = 0.8;
    pen.beginPath();
    for (let i = 0; i < lines.length; i += 4) {
      pen.moveTo(this.toX(lines[i]), this.toY(lines[i + 1]));
      pen.lineTo(this.toX(lines[i + 2]), this.toY(lines[i + 3]));
    }
    pen.stroke();
    pen.globalAlpha = 1;
    pen.drawImage(this.outline(), 0, 0, this.width, this.height);
  }

  // All facets stroked, and what is inside them taken away again; kept as long as the view is the same.
  outline() {
    const { width, height } = this.canvas, view = [width, height, ...this.view.x, ...this.view.y].join();
    if (this.outlined === view) return this.outlineDots;
    this.outlined = view;
    this.outlineDots = make("canvas", { width, height });
    const pen = this.outlineDots.getContext("2d"), dots = width / this.width, { points, corners } = this.flat;
    pen.scale(dots, dots);
    pen.strokeStyle = "#ffffff";
    pen.lineWidth = 2.5;
    pen.lineJoin = "round";
    pen.beginPath();
    for (let i = 0; i < corners.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((j) => [this.toX(points[2 * corners[i + j]]), this.toY(points[2 * corners[i + j] + 1])]);
      const turns = (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0]);  // all the same way, so that none takes away another
      pen.moveTo(...a);
      pen.lineTo(...(turns ? b : c));
      pen.lineTo(...(turns ? c : b));
      pen.closePath();
    }
    pen.stroke();
    pen.globalCompositeOperation = "destination-out";
    pen.fill();
    return this.outlineDots;
  }

  wordsAt({ x, y }) {
    const grid = this.grid, at = [this.fromX(x), this.fromY(y)];
    const column = Math.floor((at[0] - this.ends.x[0]) / this.cell[0]), row = Math.floor((at[1] - this.ends.y[0]) / this.cell[1]);
    if (column < 0 || row < 0 || column >= grid.columns || row >= grid.rows) return "";
    const middle = [grid.x[0] + column * this.cell[0], grid.y[0] + row * this.cell[1]];
    return this.xLabel + "  " + numberText(middle[0]) + "\n" + this.yLabel + "  " + numberText(middle[1]) + "\n" +
      levelText(grid.levels[row * grid.columns + column]);
  }
}

// [slow][fast] as [fast][slow]
function transposed(levels, slow, fast) {
  const turned = new Float32Array(levels.length);
  for (let i = 0; i < slow; ++i) for (let j = 0; j < fast; ++j) turned[j * slow + i] = levels[i * fast + j];
  return turned;
}
