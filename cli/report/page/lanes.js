// Lanes: a row for each method, a mark for each frame. Marks differ in colour, height and pattern.

const LANE = 26, LANE_GAP = 6;

/** How a verdict is drawn: colour, from and to as shares of the lane's height from its foot, and a pattern. */
const LOOKS = {
  H: {colour: "--blue", from: 0, to: 1},
  g: {colour: "--ink", from: 0, to: 1},
  S: {colour: "--vermillion", from: 0, to: 0.6, pattern: "hatch"},
  W: {colour: "--purple", from: 0, to: 0.6, pattern: "dots"},
  M: {colour: "--orange", from: 0, to: 0.18},
  F: {colour: "--vermillion", from: 0.55, to: 1, pattern: "hatch"},
  r: {colour: "--soft", from: 0.46, to: 0.54},
  u: {colour: "--sky", from: 0.2, to: 0.8, pattern: "dots"},
  "?": {colour: "--soft", from: 0, to: 0.06},
  "-": {colour: "--soft", from: 0, to: 0.18, pattern: "dots"},
};

function patternOf(context, colour, kind) {
  const scale = 2, size = kind === "hatch" ? 5 : 4, tile = document.createElement("canvas");
  tile.width = tile.height = size * scale;
  const draw = tile.getContext("2d");
  draw.scale(scale, scale);
  draw.globalAlpha = 0.28;
  draw.fillStyle = colour;
  draw.fillRect(0, 0, size, size);
  draw.globalAlpha = 1;
  if (kind === "hatch") {
    draw.strokeStyle = colour;
    draw.lineWidth = 1.7;
    for (const shift of [-size, 0, size]) {
      draw.beginPath(); draw.moveTo(shift, size); draw.lineTo(shift + size, 0); draw.stroke();
    }
  } else {
    draw.beginPath(); draw.arc(size / 2, size / 2, 1.2, 0, 2 * Math.PI); draw.fill();
  }
  const pattern = context.createPattern(tile, "repeat");
  pattern.setTransform(new DOMMatrix([1 / scale, 0, 0, 1 / scale, 0, 0]));
  return pattern;
}

function paints(context) {
  const all = {};
  for (const [letter, look] of Object.entries(LOOKS)) {
    const colour = style(look.colour);
    all[letter] = {...look, fill: look.pattern ? patternOf(context, colour, look.pattern) : colour, edge: look.pattern ? colour : null};
  }
  return all;
}

/** One stretch of one verdict. */
function drawMarkOf(context, paint, x, width, top) {
  const y = top + LANE * (1 - paint.to), height = LANE * (paint.to - paint.from);
  context.fillStyle = paint.fill;
  context.fillRect(x, y, width, height);
  if (paint.edge) {  // patterns have a lid, so that their height is read even where they are narrow
    context.fillStyle = paint.edge;
    context.fillRect(x, y, width, 1.5);
  }
}

/** The letter for a dot on which several frames fall. */
function commonest(counts) {
  let best = " ", most = 0;
  for (const letter of WORST_FIRST) {
    const count = counts[letter] || 0;
    if (letter === "g" && count) return "g";
    if (count > most && (letter !== "." || !most)) best = letter, most = count;
  }
  return best;
}

/** Draws one lane between the times that `x` maps to 0 and `width`. Returns how many stretches it drew. */
function drawLane(context, all, lane, {times, period}, x, from, to, width, top) {
  const text = lane.letters, first = Math.max(0, frameAt(times, from)), pixels = x(from + period) - x(from);
  let drawn = 0;
  const put = (letter, begin, end) => {
    const paint = all[letter];
    if (!paint || end <= 0 || begin >= width) return;
    const left = Math.max(0, begin), right = Math.min(width, end);
    drawMarkOf(context, paint, left, Math.max(0.5, right - left), top);
    ++drawn;
  };
  if (pixels >= 1) {
    const seam = pixels > 7 ? 1 : 0;
    let letter = " ", begin = 0, end = 0;
    for (let i = first; i < times.length && times[i] <= to; ++i) {
      const left = x(times[i]), right = Math.min(i + 1 < times.length ? x(times[i + 1]) : Infinity, left + pixels);
      if (text[i] === letter && !seam && left - end < 0.5) { end = right; continue; }
      put(letter, begin, end);
      letter = text[i], begin = left, end = right - seam;
    }
    put(letter, begin, end);
    return drawn;
  }
  let column = -1, counts = {}, letter = " ", begin = 0;
  const flush = next => {
    const now = column < 0 ? " " : commonest(counts);
    if (now !== letter) { put(letter, begin, column); letter = now, begin = column; }
    if (next > column + 1) { put(letter, begin, column + 1); letter = " "; }
    column = next, counts = {};
  };
  for (let i = first; i < times.length && times[i] <= to; ++i) {
    const at = Math.floor(x(times[i]));
    if (at !== column) flush(at);
    counts[text[i]] = (counts[text[i]] || 0) + 1;
  }
  flush(column + 2);
  return drawn;
}

/** A triangle at the onset of every loss and a line under the lane while it lasts: no loss is too short to be seen. */
function drawLosses(context, lane, times, x, width, top) {
  context.fillStyle = context.strokeStyle = style("--ink");
  for (const loss of lane.losses) {
    const begin = x(times[loss.good]), end = x(times[loss.ended]);
    if (end < 0 || begin > width) continue;
    context.fillRect(Math.max(0, begin), top + LANE + 1.5, Math.max(1, Math.min(width, end) - Math.max(0, begin)), 1.5);
    const onset = x(times[loss.lost]);
    if (onset < 0 || onset > width) continue;
    context.beginPath();
    context.moveTo(onset, top + 1); context.lineTo(onset - 4, top - 5); context.lineTo(onset + 4, top - 5);
    context.closePath();
    context.fill();
  }
}

/** A sample of a verdict for the legend. */
function legendMark(letter) {
  const canvas = element("canvas", {"aria-hidden": "true"});
  keepDrawn(() => {
    const context = sizeCanvas(canvas, 22, LANE + 2);
    context.clearRect(0, 0, 22, LANE + 2);
    context.fillStyle = style("--panel");
    context.fillRect(0, 1, 22, LANE);
    drawMarkOf(context, paints(context)[letter], 2, 18, 1);
  });
  return canvas;
}
