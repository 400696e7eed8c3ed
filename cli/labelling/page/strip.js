// The recording in true time: what is said of every frame, how sure it is, and where its gaps are.

import { colours, extentOf } from "./view.js";

const kTop = 16, kBar = 14, kCurve = 34; // px: the axis, the labels, the doubt

export class Strip {
  constructor(canvas) {
    this.canvas = canvas;
    this.pen = canvas.getContext("2d");
  }

  #x(time) {
    return 8 + ((this.width - 16) * time) / Math.max(this.length, 1e-9);
  }

  /// The frame at a place of the mouse.
  frameAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const time = ((event.clientX - box.left - 8) / Math.max(1, this.width - 16)) * this.length;
    let best = 0;
    this.times.forEach((t, i) => {
      if (Math.abs(t - time) < Math.abs(this.times[best] - time)) best = i;
    });
    return best;
  }

  draw({ recording, targets }, chosen, frame, gaps) {
    const ratio = window.devicePixelRatio || 1, pen = this.pen, style = getComputedStyle(document.documentElement);
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
    this.canvas.width = this.width * ratio;
    this.canvas.height = this.height * ratio;
    pen.scale(ratio, ratio);
    this.times = recording.times_s;
    this.length = this.times.at(-1) || 1;
    this.ink = style.getPropertyValue("--ink");
    this.soft = style.getPropertyValue("--soft");
    this.#axis();
    this.#gaps(gaps);
    this.#labels(targets[chosen]);
    this.#doubt(targets[chosen]);
    this.#keys(targets[chosen]);
    this.#others(targets, chosen);
    pen.fillStyle = this.ink;
    pen.fillRect(this.#x(this.times[frame]) - 0.75, 0, 1.5, this.height);
  }

  #axis() {
    const pen = this.pen, steps = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600];
    const step = steps.find((s) => (s / this.length) * this.width > 60) ?? 1200;
    pen.fillStyle = this.soft;
    pen.font = "11px system-ui, sans-serif";
    for (let t = 0; t <= this.length; t += step) {
      pen.fillRect(this.#x(t), 10, 1, 5);
      if (this.#x(t) + 34 < this.width) pen.fillText(`${+t.toFixed(1)} s`, this.#x(t) + 3, 11);
    }
  }

  /// Hatched where no frame was recorded.
  #gaps(gaps) {
    const pen = this.pen;
    pen.strokeStyle = this.soft;
    for (const i of gaps) {
      const from = this.#x(this.times[i - 1]), to = Math.max(this.#x(this.times[i]), from + 2);
      pen.save();
      pen.beginPath();
      pen.rect(from, kTop, to - from, kBar);
      pen.clip();
      pen.beginPath();
      for (let x = from - kBar; x < to; x += 4) {
        pen.moveTo(x, kTop + kBar);
        pen.lineTo(x + kBar, kTop);
      }
      pen.stroke();
      pen.restore();
    }
  }

  /// Runs of equal letters: visible is full height, occluded half, absent a line, unlabelled dots, unknown nothing.
  #labels(target) {
    const pen = this.pen, letters = target.frames.labels, bottom = kTop + kBar;
    for (let i = 0; i < letters.length; ) {
      let j = i + 1;
      while (j < letters.length && letters[j] === letters[i] && !this.#far(j)) ++j;
      const from = this.#x(this.times[i]), to = Math.max(from + 1, this.#x(j < letters.length && !this.#far(j) ? this.times[j] : this.times[j - 1]));
      pen.fillStyle = letters[i] === "v" ? colours.curve : this.soft;
      if (letters[i] === "v") pen.fillRect(from, kTop, to - from, kBar);
      if (letters[i] === "o") pen.fillRect(from, bottom - kBar / 2, to - from, kBar / 2);
      if (letters[i] === "a") pen.fillRect(from, bottom - 2, to - from, 2);
      if (letters[i] === "u") for (let x = from; x < to; x += 5) pen.fillRect(x, bottom - 2, 2, 2);
      i = j;
    }
  }

  #far(i) {
    return this.gapSet?.has(i);
  }

  /// Two sigma as part of the target's size, up to a half; below, dots where the picture disagrees.
  #doubt(target) {
    const pen = this.pen, floor = kTop + kBar + kCurve, { outlines, sigma_px: sigma } = target.frames;
    pen.strokeStyle = this.soft;
    pen.strokeRect(this.#x(0), floor, this.#x(this.length) - this.#x(0), 0);
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = this.soft;
    pen.fillText("doubt", this.#x(0) + 2, floor - kCurve + 12);
    pen.fillStyle = colours.curve;
    const wide = Math.min(5, Math.max(1, (this.width - 16) / outlines.length - 1));
    outlines.forEach((outline, i) => {
      if (!outline || sigma[i] === null) return;
      const high = Math.min(1, (4 * sigma[i]) / extentOf(outline)) * (kCurve - 4);
      pen.fillRect(this.#x(this.times[i]) - wide / 2, floor - high, wide, high);
    });
    pen.fillStyle = colours.other;
    target.likeness.forEach((like, i) => {
      if (like === null || like >= 0.5) return;
      pen.beginPath();
      pen.arc(this.#x(this.times[i]), floor + 4, 2, 0, 7);
      pen.fill();
    });
  }

  #keys(target) {
    const pen = this.pen;
    for (const key of target.keys) {
      const x = this.#x(this.times[key.frame]), y = kTop + kBar / 2;
      pen.beginPath();
      pen.moveTo(x, y - 6);
      pen.lineTo(x + 4, y);
      pen.lineTo(x, y + 6);
      pen.lineTo(x - 4, y);
      pen.closePath();
      pen.fillStyle = key.state === "placed" ? colours.key : this.ink;
      pen.fill();
      pen.strokeStyle = this.ink;
      pen.lineWidth = 0.7;
      pen.stroke();
    }
    const next = target.to_go.next;
    if (!next) return;
    const x = this.#x(this.times[next.frame]);
    pen.fillStyle = this.ink;
    pen.beginPath();
    pen.moveTo(x, kTop + kBar + 2);
    pen.lineTo(x + 5, kTop + kBar + 11);
    pen.lineTo(x - 5, kTop + kBar + 11);
    pen.fill();
  }

  /// A line for each other target: where it is visible.
  #others(targets, chosen) {
    let y = kTop + kBar + kCurve + 10;
    targets.forEach((target, t) => {
      if (t === chosen) return;
      this.pen.fillStyle = this.soft;
      [...target.frames.labels].forEach((letter, i) => {
        if (letter === "v") this.pen.fillRect(this.#x(this.times[i]) - 0.5, y, 1.5, 3);
      });
      y += 5;
    });
  }
}
