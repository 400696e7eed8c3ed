// Placing outlines by mouse: new ones, and those that are there by their inside and their handles.

import { centreOf, pathOf } from "./view.js";

const kLeast = 2; // px: less is a slip
const kAnew = 1 / 3; // a corner dragged so near to the other one draws a new box over the old one

export function moved(outline, dx, dy) {
  if (outline.box) return { box: [outline.box[0] + dx, outline.box[1] + dy, outline.box[2], outline.box[3]] };
  if (outline.quad) return { quad: outline.quad.map((v, i) => v + (i % 2 ? dy : dx)) };
  const [x, y, ...rest] = outline.ellipse;
  return { ellipse: [x + dx, y + dy, ...rest] };
}

export function scaled(outline, factor) {
  const [cx, cy] = centreOf(outline);
  if (outline.box) {
    const [, , w, h] = outline.box;
    return { box: [cx - (factor * w) / 2, cy - (factor * h) / 2, factor * w, factor * h] };
  }
  if (outline.quad) return { quad: outline.quad.map((v, i) => (i % 2 ? cy + factor * (v - cy) : cx + factor * (v - cx))) };
  const [x, y, a, b, turn] = outline.ellipse;
  return { ellipse: [x, y, factor * a, factor * b, turn] };
}

const between = (p, q) => ({ box: [Math.min(p[0], q[0]), Math.min(p[1], q[1]), Math.abs(p[0] - q[0]), Math.abs(p[1] - q[1])] });

/// An ellipse with these ends of one axis, and another axis of this half length.
function along(p, q, half) {
  const long = Math.hypot(q[0] - p[0], q[1] - p[1]) / 2, turn = (Math.atan2(q[1] - p[1], q[0] - p[0]) * 180) / Math.PI;
  return ellipse((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, long, half, turn);
}

function ellipse(x, y, a, b, turn) {
  if (b > a) [a, b, turn] = [b, a, turn + 90];
  return { ellipse: [x, y, a, Math.max(b, 0.5), ((turn % 180) + 180) % 180] };
}

/// How far a point is from the line through an ellipse's axis.
function aside([x, y], [cx, cy], degrees) {
  const turn = (degrees * Math.PI) / 180;
  return Math.abs(-(x - cx) * Math.sin(turn) + (y - cy) * Math.cos(turn));
}

/// Where an outline can be taken hold of, and what becomes of it when that is dragged to p.
export function handlesOf(outline) {
  const path = pathOf(outline);
  if (outline.box) return path.map((at, i) => ({ at, drag: (p) => between(p, path[(i + 2) % 4]) }));
  if (outline.quad)
    return path.map((at, i) => ({ at, drag: (p) => ({ quad: outline.quad.with(2 * i, p[0]).with(2 * i + 1, p[1]) }) }));
  const [x, y, a, b, turn] = outline.ellipse, far = (at) => Math.hypot(at[0] - x, at[1] - y);
  const towards = (p) => (Math.atan2(p[1] - y, p[0] - x) * 180) / Math.PI;
  return [
    { at: path[0], drag: (p) => ellipse(x, y, far(p), b, towards(p)) },
    { at: path[36], drag: (p) => ellipse(x, y, far(p), b, towards(p)) },
    { at: path[18], drag: (p) => ellipse(x, y, a, aside(p, [x, y], turn), turn) },
    { at: path[54], drag: (p) => ellipse(x, y, a, aside(p, [x, y], turn), turn) },
  ];
}

function inside(outline, [x, y]) {
  const path = pathOf(outline);
  let within = false;
  for (let i = 0, j = path.length - 1; i < path.length; j = i++) {
    const [xi, yi] = path[i], [xj, yj] = path[j];
    if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) within = !within;
  }
  return within;
}

/// What is being placed. `shown()` is the outline that is there, `place(outline)` is called when a new one is whole.
export class Tools {
  tool = "box";
  draft = null; // what would be placed
  #hold = null; // what a drag does with p
  #corners = []; // of a quad
  #axis = null; // of an ellipse whose width is still to be told
  #anew = false; // an ellipse is being drawn, not dragged

  constructor({ shown, place, reach, fresh }) {
    Object.assign(this, { shown, place, reach, fresh });
  }

  choose(tool) {
    this.cancel();
    this.tool = tool;
  }

  cancel() {
    this.draft = this.#hold = this.#axis = null;
    this.#corners = [];
    this.#anew = false;
  }

  get corners() {
    return this.#corners;
  }

  /// `anew`: whatever is there already, draw another one.
  down(p, anew = false) {
    if (this.#axis) return; // the click that tells the width ends in up()
    if (this.tool === "centre") {
      const outline = this.shown() ?? this.fresh(), [x, y] = centreOf(outline);
      this.#hold = (q) => moved(outline, q[0] - x, q[1] - y);
    } else if (!this.#corners.length && !anew) {
      this.#hold = this.#grip(p);
    }
    if (!this.#hold && this.tool === "box") this.#hold = (q) => between(p, q);
    this.#anew = !this.#hold && this.tool === "ellipse";
    if (this.#anew) this.#hold = (q) => along(p, q, Math.hypot(q[0] - p[0], q[1] - p[1]) / 4);
    if (!this.#hold && this.tool === "quad") return this.#corner(p);
    this.from = p;
    this.draft = this.#hold(p);
  }

  /// By a handle or by the inside, if there is an outline of the tool's kind.
  #grip(p) {
    const outline = this.shown();
    if (!outline?.[this.tool]) return null;
    for (const handle of handlesOf(outline))
      if (Math.hypot(p[0] - handle.at[0], p[1] - handle.at[1]) < this.reach()) return handle.drag;
    return inside(outline, p) ? (q) => moved(outline, q[0] - p[0], q[1] - p[1]) : null;
  }

  #corner(p) {
    this.#corners.push(p);
    if (this.#corners.length < 4) return;
    const quad = this.#corners.flat();
    this.cancel();
    this.place({ quad });
  }

  move(p) {
    if (this.#hold) this.draft = this.#hold(p);
    if (this.#axis) this.draft = along(...this.#axis, aside(p, this.#middle(), this.#turn()));
  }

  #middle() {
    const [p, q] = this.#axis;
    return [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
  }

  #turn() {
    const [p, q] = this.#axis;
    return (Math.atan2(q[1] - p[1], q[0] - p[0]) * 180) / Math.PI;
  }

  up(p) {
    this.move(p);
    const outline = this.draft;
    if (!outline) return;
    if (this.#anew) {
      const axis = [this.from, p];
      this.cancel();
      if (Math.hypot(p[0] - axis[0][0], p[1] - axis[0][1]) < kLeast) return;
      this.#axis = axis;
      this.draft = outline;
      return;
    }
    const drawn = this.#drawnOver(outline, p);
    this.cancel();
    if (drawn) return this.place(drawn);
    if (outline.box && (outline.box[2] < kLeast || outline.box[3] < kLeast)) return;
    this.place(outline);
  }

  /// From the top left corner to the bottom right one of what is nearly the same box already: no corner was meant.
  #drawnOver(outline, p) {
    const old = this.shown()?.box, box = between(this.from, p);
    const shrunk = old && outline.box && outline.box[2] < kAnew * old[2] && outline.box[3] < kAnew * old[3];
    return shrunk && box.box[2] > kAnew * old[2] && box.box[3] > kAnew * old[3] ? box : null;
  }
}
