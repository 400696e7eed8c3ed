// The picture on the screen, and outlines on it. Places are the picture's own: pixel centres at whole numbers, so the
// picture begins at -0.5.

const kPixels = 8; // screen pixels of a picture's pixel, when zoomed to them

export const colours = { key: "#e69f00", curve: "#56b4e9", other: "#cc79a7", halo: "rgba(0,0,0,.65)" };

/// Corners of an outline, or points of its curve, all round.
export function pathOf(outline) {
  if (outline.box) {
    const [x, y, w, h] = outline.box;
    return [[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
  }
  if (outline.quad) return [0, 2, 4, 6].map((i) => [outline.quad[i], outline.quad[i + 1]]);
  const [cx, cy, a, b, degrees] = outline.ellipse, turn = (degrees * Math.PI) / 180, points = [];
  for (let i = 0; i < 72; ++i) {
    const at = (i * Math.PI) / 36, u = a * Math.cos(at), v = b * Math.sin(at);
    points.push([cx + u * Math.cos(turn) - v * Math.sin(turn), cy + u * Math.sin(turn) + v * Math.cos(turn)]);
  }
  return points;
}

export function centreOf(outline) {
  if (outline.box) return [outline.box[0] + outline.box[2] / 2, outline.box[1] + outline.box[3] / 2];
  if (outline.ellipse) return outline.ellipse.slice(0, 2);
  const q = outline.quad;
  return [(q[0] + q[2] + q[4] + q[6]) / 4, (q[1] + q[3] + q[5] + q[7]) / 4];
}

/// Square root of the area of the box around it: its size, as far as the page needs it.
export function extentOf(outline) {
  const path = pathOf(outline), xs = path.map((p) => p[0]), ys = path.map((p) => p[1]);
  return Math.sqrt((Math.max(...xs) - Math.min(...xs)) * (Math.max(...ys) - Math.min(...ys)));
}

export class View {
  scale = 1;
  left = -0.5; // what is at the canvas's corner
  top = -0.5;

  constructor(canvas) {
    this.canvas = canvas;
    this.pen = canvas.getContext("2d");
  }

  /// Makes the canvas as fine as the screen. Whether its size changed.
  measure() {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.round(this.canvas.clientWidth * ratio), height = Math.round(this.canvas.clientHeight * ratio);
    if (this.canvas.width === width && this.canvas.height === height) return false;
    this.canvas.width = width;
    this.canvas.height = height;
    return true;
  }

  get ratio() {
    return this.canvas.width / Math.max(1, this.canvas.clientWidth);
  }

  fit(width, height) {
    this.size = [width, height];
    this.scale = Math.min(this.canvas.width / width, this.canvas.height / height);
    this.left = -0.5 - (this.canvas.width / this.scale - width) / 2;
    this.top = -0.5 - (this.canvas.height / this.scale - height) / 2;
    this.fitted = true;
  }

  centreOn([x, y]) {
    this.left = x - this.canvas.width / this.scale / 2;
    this.top = y - this.canvas.height / this.scale / 2;
  }

  zoom(factor, [x, y]) {
    const scale = Math.min(64, Math.max(0.1, this.scale * factor));
    this.left = x - ((x - this.left) * this.scale) / scale;
    this.top = y - ((y - this.top) * this.scale) / scale;
    this.scale = scale;
    this.fitted = false;
  }

  toPixels(at) {
    if (!this.fitted) return this.fit(...this.size);
    this.zoom(Math.max(kPixels * this.ratio, 4 * this.scale) / this.scale, at);
    this.centreOn(at);
  }

  move(dx, dy) {
    this.left -= (dx * this.ratio) / this.scale;
    this.top -= (dy * this.ratio) / this.scale;
    this.fitted = false;
  }

  /// Whether a place is well within sight.
  sees([x, y]) {
    const [px, py] = this.onCanvas([x, y]), margin = 0.1;
    return px > margin * this.canvas.width && px < (1 - margin) * this.canvas.width &&
      py > margin * this.canvas.height && py < (1 - margin) * this.canvas.height;
  }

  onCanvas([x, y]) {
    return [(x - this.left) * this.scale, (y - this.top) * this.scale];
  }

  inPicture(event) {
    const box = this.canvas.getBoundingClientRect();
    return [
      this.left + ((event.clientX - box.left) * this.ratio) / this.scale,
      this.top + ((event.clientY - box.top) * this.ratio) / this.scale,
    ];
  }

  /// How far a mouse may be off what it means, px of the picture.
  get reach() {
    return (9 * this.ratio) / this.scale;
  }

  clear(bitmap) {
    const pen = this.pen;
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    if (!bitmap) return;
    pen.imageSmoothingEnabled = this.scale < 2;
    pen.imageSmoothingQuality = "high";
    pen.drawImage(bitmap, ...this.onCanvas([-0.5, -0.5]), bitmap.width * this.scale, bitmap.height * this.scale);
  }

  /// A dark line beneath a bright one is seen on any picture.
  #line(draw, colour, width, dash) {
    const pen = this.pen;
    for (const [ink, more] of [[colours.halo, 2], [colour, 0]]) {
      pen.beginPath();
      draw(pen);
      pen.strokeStyle = ink;
      pen.lineWidth = (width + more) * this.ratio;
      pen.setLineDash(more ? [] : dash.map((d) => d * this.ratio));
      pen.stroke();
    }
    pen.setLineDash([]);
  }

  outline(outline, { colour, width = 1.5, dash = [], name = "" }) {
    const path = pathOf(outline).map((p) => this.onCanvas(p));
    this.#line((pen) => {
      path.forEach((p, i) => (i ? pen.lineTo(...p) : pen.moveTo(...p)));
      pen.closePath();
    }, colour, width, dash);
    this.cross(centreOf(outline), colour);
    if (outline.quad) this.handle([outline.quad[0], outline.quad[1]], colour, 3); // the target's own top left
    if (!name) return;
    const pen = this.pen, top = Math.min(...path.map((p) => p[1])), left = Math.min(...path.map((p) => p[0]));
    pen.font = `600 ${13 * this.ratio}px system-ui, sans-serif`;
    pen.lineWidth = 3 * this.ratio;
    pen.strokeStyle = colours.halo;
    pen.strokeText(name, left, top - 5 * this.ratio);
    pen.fillStyle = colour;
    pen.fillText(name, left, top - 5 * this.ratio);
  }

  cross(at, colour) {
    const [x, y] = this.onCanvas(at), arm = 5 * this.ratio;
    this.#line((pen) => {
      pen.moveTo(x - arm, y);
      pen.lineTo(x + arm, y);
      pen.moveTo(x, y - arm);
      pen.lineTo(x, y + arm);
    }, colour, 1, []);
  }

  handle(at, colour, size = 4) {
    const [x, y] = this.onCanvas(at), half = size * this.ratio, pen = this.pen;
    pen.fillStyle = colours.halo;
    pen.fillRect(x - half - 1, y - half - 1, 2 * half + 2, 2 * half + 2);
    pen.fillStyle = colour;
    pen.fillRect(x - half, y - half, 2 * half, 2 * half);
  }

  /// How far off the centre may be: a ring of two sigma.
  doubt(outline, sigma, colour) {
    const [x, y] = this.onCanvas(centreOf(outline));
    this.#line((pen) => pen.arc(x, y, Math.max(1, 2 * sigma * this.scale), 0, 7), colour, 1, [2, 3]);
  }
}
