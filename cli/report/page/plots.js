// What all plots have in common. uPlot draws axes and curves.

const FONT = "12px system-ui, sans-serif";

function axis(options) {
  return {stroke: () => style("--soft"), font: FONT, labelFont: FONT, grid: {stroke: () => style("--line"), width: 1},
          ticks: {stroke: () => style("--line"), width: 1, size: 4}, ...options};
}

/** Seconds with as many digits as the step needs. */
function secondsText(plot, splits) {
  const step = splits.length > 1 ? splits[1] - splits[0] : 1;
  const whole = decimals => Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) < 1e-6;
  const decimals = [0, 1, 2, 3].find(whole) ?? 4;
  return splits.map(value => `${fixed(value, decimals)} s`);
}

const SHAPES = ["circle", "square", "triangle", "diamond", "plus", "cross"];

/** A mark of its own for each method: told apart without colour. */
function drawMark(context, index, x, y, radius) {
  const r = radius;
  context.beginPath();
  switch (SHAPES[index % SHAPES.length]) {
    case "circle": context.arc(x, y, r, 0, 2 * Math.PI); break;
    case "square": context.rect(x - 0.9 * r, y - 0.9 * r, 1.8 * r, 1.8 * r); break;
    case "triangle": context.moveTo(x, y - 1.2 * r); context.lineTo(x + 1.1 * r, y + 0.8 * r); context.lineTo(x - 1.1 * r, y + 0.8 * r); context.closePath(); break;
    case "diamond": context.moveTo(x, y - 1.3 * r); context.lineTo(x + 1.3 * r, y); context.lineTo(x, y + 1.3 * r); context.lineTo(x - 1.3 * r, y); context.closePath(); break;
    case "plus": context.rect(x - 1.2 * r, y - 0.4 * r, 2.4 * r, 0.8 * r); context.rect(x - 0.4 * r, y - 1.2 * r, 0.8 * r, 2.4 * r); break;
    default: context.moveTo(x - r, y - r); context.lineTo(x + r, y + r); context.moveTo(x + r, y - r); context.lineTo(x - r, y + r); context.stroke(); return;
  }
  context.fill();
}

const DASHES = [[], [6, 3], [2, 3], [8, 3, 2, 3]];
const dashOf = index => DASHES[Math.floor(index / CURVES.length) % DASHES.length];

/** Buttons that say which methods are drawn; they are the legend, too. */
function methodChips(names, chosen, changed) {
  const row = element("div", {class: "chips", role: "group", "aria-label": "Which methods are drawn"});
  names.forEach((name, i) => {
    const swatch = element("canvas", {"aria-hidden": "true"});
    const chip = element("button", {type: "button", "aria-pressed": chosen.has(i) ? "true" : "false"}, swatch, name);
    keepDrawn(() => {
      const context = sizeCanvas(swatch, 26, 12);
      context.clearRect(0, 0, 26, 12);
      context.strokeStyle = context.fillStyle = curveColour(i);
      context.lineWidth = 2;
      context.setLineDash(dashOf(i));
      context.beginPath(); context.moveTo(0, 6); context.lineTo(26, 6); context.stroke();
      context.setLineDash([]);
      drawMark(context, i, 13, 6, 4);
    });
    chip.addEventListener("click", () => {
      chosen.has(i) ? chosen.delete(i) : chosen.add(i);
      chip.setAttribute("aria-pressed", chosen.has(i) ? "true" : "false");
      changed();
    });
    row.append(chip);
  });
  return row;
}

/** The first few that are worth drawing: methods before yardsticks. */
function firstChosen(methods, most = 6) {
  const own = methods.map((method, i) => [method, i]).filter(([method]) => !method.yardstick).map(([, i]) => i);
  return new Set((own.length ? own : methods.map((_, i) => i)).slice(0, most));
}

/** Makes a plot again whenever it has to be drawn anew, as wide as its place. */
function keepPlotted(place, make) {
  let plot = null;
  const draw = () => {
    if (plot) plot.destroy();
    place.replaceChildren();
    const width = Math.floor(place.clientWidth);
    plot = width > 40 ? make(width, place) : null;
  };
  keepDrawn(draw);
  return draw;
}
