// Draws scenery, ways and characters on a canvas. World metres are turned into pixels here and not by the canvas: its
// own transformation works in single precision, which is too coarse far from the origin.

function darkPreferred() {
  return matchMedia('(prefers-color-scheme: dark)').matches;
}

function theme() {
  const style = getComputedStyle(document.documentElement);
  const names = ['canvas', 'solid', 'mover', 'edge', 'chain', 'grid', 'text', 'quiet', 'bad', 'accent'];
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/// As many as there are contenders. Ours, the first, is the only blue one.
const INKS = {
  light: [
    '#0b5cad', '#d1590a', '#2a7d3f', '#a3268f', '#7a5c00', '#007d84', '#6a4fc4', '#c0304f', '#4b5a66', '#5b7a12',
    '#8c4a2f', '#7d2f5e', '#b07a00'
  ],
  dark: [
    '#74b4f5', '#ff9a4d', '#74cf8d', '#eb86da', '#dcbb4b', '#55cdd4', '#ac98fa', '#ff8aa2', '#aebac4', '#b5d560',
    '#dba184', '#d79ac0', '#ffd27a'
  ],
};
const DASHES = [[], [7, 4], [2, 3], [9, 3, 2, 3], [4, 2], [12, 4], [1, 2]];

/// A contender has the same colour in every scene, whatever its scalar type and mode; the dashes tell these apart.
/// @param names  contenders and labels of the whole report, in a fixed order.
function inkOf(run, names) {
  const list = INKS[darkPreferred() ? 'dark' : 'light'];
  const colour = Math.max(0, names.contenders.indexOf(run.contender)),
        dash = Math.max(0, names.labels.indexOf(run.label));
  return {colour: list[colour % list.length], dash: DASHES[dash % DASHES.length]};
}

/// A camera: the world point in the middle, and pixels per metre.
class Camera {
  constructor(x = 0, y = 0, scale = 32) {
    Object.assign(this, {x, y, scale});
  }
  fit(box, width, height, margin = 0.06) {
    const w = Math.max(box[2] - box[0], 1e-12), h = Math.max(box[3] - box[1], 1e-12);
    this.x = (box[0] + box[2]) / 2;
    this.y = (box[1] + box[3]) / 2;
    this.scale = Math.min(width / w, height / h) * (1 - 2 * margin);
  }
  zoom(factor, x, y) {
    this.x = x + (this.x - x) / factor;
    this.y = y + (this.y - y) / factor;
    this.scale *= factor;
  }
}

class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
  }

  begin(camera, colours) {
    const ratio = window.devicePixelRatio || 1;
    this.width = Math.max(this.canvas.clientWidth, 1);
    this.height = Math.max(this.canvas.clientHeight, 1);
    const pixels = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
    if (this.canvas.width !== pixels[0] || this.canvas.height !== pixels[1])
      [this.canvas.width, this.canvas.height] = pixels;
    this.camera = camera;
    this.colours = colours;
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.setLineDash([]);
    this.context.globalAlpha = 1;
    this.context.fillStyle = colours.canvas;
    this.context.fillRect(0, 0, this.width, this.height);
  }

  toX(x) {
    return (x - this.camera.x) * this.camera.scale + this.width / 2;
  }
  toY(y) {
    return this.height / 2 - (y - this.camera.y) * this.camera.scale;
  }
  worldX(px) {
    return (px - this.width / 2) / this.camera.scale + this.camera.x;
  }
  worldY(py) {
    return (this.height / 2 - py) / this.camera.scale + this.camera.y;
  }

  sees(box) {
    return box[2] >= this.worldX(0) && box[0] <= this.worldX(this.width) && box[3] >= this.worldY(this.height) &&
        box[1] <= this.worldY(0);
  }

  /// Adds a line through pixels to the path.
  line(points) {
    points.forEach(([x, y], i) => (i === 0 ? this.context.moveTo(x, y) : this.context.lineTo(x, y)));
  }

  /// The same through metres. @param flat one coordinate after the other.
  ring(flat, close) {
    this.context.moveTo(this.toX(flat[0]), this.toY(flat[1]));
    for (let i = 2; i < flat.length; i += 2) this.context.lineTo(this.toX(flat[i]), this.toY(flat[i + 1]));
    if (close) this.context.closePath();
  }

  pixels(corners) {
    return corners.map(([x, y]) => [this.toX(x), this.toY(y)]);
  }

  /// Draws the lines that `add` adds to the path.
  stroke(colour, width, dash, add) {
    const c = this.context;
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.setLineDash(dash);
    c.beginPath();
    add();
    c.stroke();
    c.setLineDash([]);
  }

  /// As it is at a fraction of a step.
  scenery({byId}, record, t) {
    const visible = [], moving = [];
    for (const defined of byId.values()) {
      const collider = placed(defined, record, t);
      if (this.sees(collider.box)) (collider === defined ? visible : moving).push(collider);
    }
    this.solids(visible.filter((collider) => !collider.sensor), this.colours.solid);
    this.solids(moving.filter((collider) => !collider.sensor), this.colours.mover);
    for (const collider of [...visible, ...moving])
      if (collider.sensor) this.sensor(collider);
  }

  solids(visible, fill) {
    const polygons = visible.filter((collider) => !collider.chain);
    const c = this.context;
    c.beginPath();
    for (const collider of polygons) this.outline(collider);
    c.fillStyle = fill;
    c.fill('nonzero');
    // Outlines of pieces that are a few pixels wide would be nothing but grey; paper would vanish without one.
    const isOutlined = ({box}) => {
      const thickness = Math.min(box[2] - box[0], box[3] - box[1]) * this.camera.scale;
      return thickness > 7 || thickness < 2;
    };
    this.stroke(this.colours.edge, 0.75, [], () => polygons.filter(isOutlined).forEach((one) => this.outline(one)));
    for (const collider of visible) {
      if (collider.chain)
        this.chain(collider);
      else if (collider.oneWay)
        this.blockingSides(collider);
    }
  }

  outline(collider) {
    for (const ring of collider.rings) this.ring(ring, !collider.chain);
  }

  /// Blocks nothing: an outline that lets see through.
  sensor(collider) {
    this.stroke(this.colours.quiet, 1.5, [5, 4], () => this.outline(collider));
  }

  chain(collider) {
    const flat = collider.rings[0];
    this.stroke(this.colours.chain, 2, [], () => this.ring(flat, false));
    if (!collider.oneWay) return;
    this.stroke(this.colours.chain, 1, [], () => {
      for (let i = 0; i + 3 < flat.length; i += 2) this.ticks(flat.slice(i, i + 4), collider.oneWay);
    });
  }

  /// Of a one-way polygon: its outer ring is counter-clockwise, so that an edge faces to its right.
  blockingSides({rings: [ring], oneWay}) {
    const flat = [...ring, ...ring.slice(0, 2)];
    this.stroke(this.colours.chain, 1, [], () => {
      for (let i = 0; i + 3 < flat.length; i += 2) {
        const [x0, y0, x1, y1] = flat.slice(i, i + 4);
        if ((y1 - y0) * oneWay[0] - (x1 - x0) * oneWay[1] > 0) this.ticks([x0, y0, x1, y1], oneWay);
      }
    });
  }

  /// Short strokes on the side from which a one-way segment blocks.
  ticks([x0, y0, x1, y1], oneWay) {
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length === 0) return;
    let nx = -(y1 - y0) / length, ny = (x1 - x0) / length;
    const facing = nx * oneWay[0] + ny * oneWay[1];
    if (facing === 0) return;
    if (facing < 0) {
      nx = -nx;
      ny = -ny;
    }
    const count = Math.max(1, Math.min(200, Math.floor((length * this.camera.scale) / 10)));
    for (let i = 0; i < count; ++i) {
      const part = (i + 0.5) / count, x = this.toX(x0 + (x1 - x0) * part), y = this.toY(y0 + (y1 - y0) * part);
      this.line([[x, y], [x + nx * 6, y - ny * 6]]);
    }
  }

  /// The outline of one collider, emphasised.
  highlight(collider, colour, dash = []) {
    this.context.globalAlpha = 0.5;
    this.stroke(colour, 2, dash, () => this.outline(collider));
    this.context.globalAlpha = 1;
  }

  octagon(hull, x, y, {colour, fill = false, dash = [], alpha = 1}) {
    const c = this.context;
    c.globalAlpha = alpha;
    this.stroke(colour, 1.75, dash, () => {
      this.ring(hull.map((v, i) => v + (i % 2 === 0 ? x : y)), true);
      if (!fill) return;
      c.globalAlpha = alpha * 0.25;
      c.fillStyle = colour;
      c.fill();
      c.globalAlpha = alpha;
    });
    c.globalAlpha = 1;
    this.dot(x, y, 1.75, colour);
  }

  /// Of a character, beside the dot in its middle.
  number(number, x, y, colour) {
    this.context.fillStyle = colour;
    this.context.font = '12px system-ui, sans-serif';
    this.context.fillText(number, this.toX(x) + 4, this.toY(y) - 4);
  }

  dot(x, y, radius, colour) {
    const c = this.context;
    c.fillStyle = colour;
    c.beginPath();
    c.arc(this.toX(x), this.toY(y), radius, 0, 2 * Math.PI);
    c.fill();
  }

  /// The way within one step, a diamond at each corner.
  way(path, colour, dashed) {
    const c = this.context, pixels = this.pixels(path);
    this.stroke(colour, 2.5, dashed ? [3, 3] : [], () => this.line(pixels));
    c.fillStyle = colour;
    for (const [x, y] of pixels.slice(1, -1)) {
      c.beginPath();
      this.line([[x - 4, y], [x, y - 4], [x + 4, y], [x, y + 4]]);
      c.fill();
    }
  }

  /// All the ways of a run from one stored step to another.
  trajectory(steps, from, to, {colour, dash, alpha}) {
    this.context.globalAlpha = alpha;
    this.stroke(colour, 1.5, dash, () => {
      let joined = [];
      for (let i = Math.max(from, 0); i < to; ++i) {
        if (steps[i].respawn) {
          this.line(joined);
          joined = [];
        }
        joined.push(...this.pixels(steps[i].path));
      }
      this.line(joined);
    });
    this.context.globalAlpha = 1;
  }

  contact({point: [x, y], normal: [nx, ny]}, colour, length = 26) {
    const c = this.context, px = this.toX(x), py = this.toY(y), ex = px + nx * length, ey = py - ny * length;
    const barb = (side) => [ex - 6 * nx + side * ny, ey + 6 * ny + side * nx];
    this.stroke(colour, 2, [], () => {
      this.line([[px, py], [ex, ey]]);
      this.line([barb(4), [ex, ey], barb(-4)]);
    });
    c.fillStyle = this.colours.canvas;
    c.beginPath();
    c.arc(px, py, 4, 0, 2 * Math.PI);
    c.fill();
    c.stroke();
  }

  velocity(x, y, [vx, vy], colour) {
    const speed = Math.hypot(vx, vy);
    if (!(speed > 0)) return;
    const [[px, py]] = this.pixels([[x, y]]), length = Math.min(60, 14 + 8 * Math.log1p(speed));
    const end = [px + (vx / speed) * length, py - (vy / speed) * length];
    this.stroke(colour, 1, [2, 2], () => this.line([[px, py], end]));
  }

  cross(x, y) {
    const px = this.toX(x), py = this.toY(y);
    this.stroke(this.colours.bad, 2.5, [], () => {
      this.line([[px - 5, py - 5], [px + 5, py + 5]]);
      this.line([[px + 5, py - 5], [px - 5, py + 5]]);
    });
  }

  scaleBar() {
    const c = this.context, metres = niceLength(90 / this.camera.scale), pixels = metres * this.camera.scale,
          y = this.height - 12;
    c.globalAlpha = 0.8;
    c.fillStyle = this.colours.canvas;
    c.fillRect(6, y - 20, pixels + 12, 26);
    c.globalAlpha = 1;
    const ends = [[12, y - 4], [12, y], [12 + pixels, y], [12 + pixels, y - 4]];
    this.stroke(this.colours.quiet, 1.5, [], () => this.line(ends));
    c.fillStyle = this.colours.quiet;
    c.font = '12px system-ui, sans-serif';
    c.fillText(lengthInWords(metres), 18, y - 5);
  }
}

/// The point of a convex outline that lies farthest in a direction: the middle of them where it is a side.
function farthest(flat, dx, dy) {
  const along = [];
  for (let i = 0; i < flat.length; i += 2) along.push(flat[i] * dx + flat[i + 1] * dy);
  const most = Math.max(...along), near = 1e-3 * (most - Math.min(...along));
  const found = along.flatMap((value, i) => (most - value <= near ? [i] : []));
  const mean = (k) => found.reduce((sum, i) => sum + flat[2 * i + k], 0) / found.length;
  return [mean(0), mean(1)];
}

/// The largest of 1, 2, 5 times a power of ten that is not above the given length.
function niceLength(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return [5, 2, 1].find((digit) => digit * power <= length * (1 + 1e-9)) * power;
}

function lengthInWords(metres) {
  const units = [[1000, 'km'], [1, 'm'], [1e-3, 'mm'], [1e-6, '\u00b5m'], [1e-9, 'nm']];
  const [size, unit] = units.find(([s]) => metres >= (s === 1000 ? s : s / 10) * (1 - 1e-9)) || units[units.length - 1];
  return `${Number((metres / size).toPrecision(3))} ${unit}`;
}
