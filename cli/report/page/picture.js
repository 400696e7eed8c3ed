// A frame with the truth and every answer drawn on it.

const loaded = new Map();
function imageOf(url) {
  if (!loaded.has(url))
    loaded.set(url, new Promise((done, fail) => {
      const image = new Image();
      image.onload = () => done(image);
      image.onerror = fail;
      image.src = url;
    }));
  return loaded.get(url);
}

function pathOf(context, outline) {
  const [kind, ...n] = outline;
  context.beginPath();
  if (kind === "b") context.rect(...n);
  else if (kind === "e") context.ellipse(n[0], n[1], n[2], n[3], n[4], 0, 2 * Math.PI);
  else {
    context.moveTo(n[0], n[1]);
    for (let i = 2; i < n.length; i += 2) context.lineTo(n[i], n[i + 1]);
    context.closePath();
  }
}

function boundsOf(outline) {
  const [kind, ...n] = outline;
  if (kind === "b") return [n[0], n[1], n[0] + n[2], n[1] + n[3]];
  if (kind === "e") return [n[0] - n[2], n[1] - n[2], n[0] + n[2], n[1] + n[2]];
  const x = n.filter((_, i) => i % 2 === 0), y = n.filter((_, i) => i % 2 === 1);
  return [Math.min(...x), Math.min(...y), Math.max(...x), Math.max(...y)];
}

/** A line that is seen on any ground: with a dark rim. */
function outlined(context, scale, colour, width, dash, draw) {
  for (const [stroke, thickness] of [["rgba(0,0,0,.65)", width + 1.6], [colour, width]]) {
    context.strokeStyle = stroke;
    context.lineWidth = thickness / scale;
    context.setLineDash(dash.map(length => length / scale));
    draw();
    context.stroke();
  }
  context.setLineDash([]);
}

const ofTarget = (said, target) => !said.t || said.t === target.id || said.t === target.code;

/**
 * Draws what there is of a frame: truth solid and green, answers dashed with a cross at their centre.
 * `view`: the part of the picture, px of the recording. `lanes`: whose answers; the first of `strong` stand out.
 */
function drawFrame(canvas, comparison, frame, image, view, width, height, lanes, strong) {
  const context = sizeCanvas(canvas, width, height);
  const scale = width / view.width, native = image.width / comparison.picture[0];
  context.fillStyle = "#222";
  context.fillRect(0, 0, width, height);
  context.save();
  context.scale(scale, scale);
  context.translate(-view.x, -view.y);
  context.imageSmoothingQuality = "high";
  context.save();
  context.scale(1 / native, 1 / native);
  context.drawImage(image, -0.5 * native, -0.5 * native);
  context.restore();
  frame.truth.forEach(outline => {
    if (outline) outlined(context, scale, "#00d68f", 2, [], () => pathOf(context, outline));
  });
  for (const {lane, target} of lanes) {
    const colour = strong.has(lane) ? "#ff8c3a" : "rgba(255,255,255,.8)", thin = strong.has(lane) ? 2 : 1;
    for (const said of frame.said[lane.run]) {
      if (!ofTarget(said, target)) continue;
      outlined(context, scale, colour, thin, [5, 3], () => pathOf(context, said.o));
      const [x, y] = said.c, arm = 5 / scale;
      outlined(context, scale, colour, thin, [], () => {
        context.beginPath();
        context.moveTo(x - arm, y); context.lineTo(x + arm, y);
        context.moveTo(x, y - arm); context.lineTo(x, y + arm);
      });
    }
  }
  context.restore();
}

/** The surroundings of the target and of what was said of it. */
function closeView(comparison, frame, targetIndex, lane, target, shape) {
  const boxes = [];
  if (frame.truth[targetIndex]) boxes.push(boundsOf(frame.truth[targetIndex]));
  for (const said of frame.said[lane.run]) if (ofTarget(said, target)) boxes.push(boundsOf(said.o));
  const [W, H] = comparison.picture;
  if (!boxes.length) return {x: -0.5, y: -0.5, width: W, height: W / shape};
  const x0 = Math.min(...boxes.map(b => b[0])), y0 = Math.min(...boxes.map(b => b[1]));
  const x1 = Math.max(...boxes.map(b => b[2])), y1 = Math.max(...boxes.map(b => b[3]));
  const first = boxes[0], size = Math.max(first[2] - first[0], first[3] - first[1]);
  let width = Math.max(x1 - x0 + 1.5 * size, (y1 - y0 + 1.5 * size) * shape, 5 * size);
  width = Math.min(width, Math.max(W, H * shape));
  const height = width / shape;
  const into = (from, length, whole) => length >= whole ? (whole - length) / 2 - 0.5 : Math.max(-0.5, Math.min(from, whole - length - 0.5));
  return {x: into((x0 + x1 - width) / 2, width, W), y: into((y0 + y1 - height) / 2, height, H), width, height};
}

// The dialog.

const dialog = document.getElementById("picture");
let looking = null;

function verdictText(lane, frame, target) {
  const verdict = VERDICTS[lane.letters[frame]], error = lane.error[frame], size = sizesOf(target)[frame];
  if (Number.isNaN(error)) return verdict.name;
  return `${verdict.name}, ${fixed(error, 1)} px off${size > 0 ? ` (${fixed(100 * error / size, 0)} % of D)` : ""}`;
}

function nearestShown(comparison, frame, direction) {
  const frames = comparison.shown.map(shown => shown.f);
  if (direction > 0) return frames.find(f => f > frame);
  if (direction < 0) return frames.filter(f => f < frame).pop();
  return frames.length ? frames.reduce((best, f) => Math.abs(f - frame) < Math.abs(best - frame) ? f : best) : undefined;
}

function openPicture(comparison, target, frame, strong) {
  looking = {comparison, target, frame, strong: new Set(strong ? [strong] : [])};
  showPicture();
  if (!dialog.open) dialog.showModal();
}

function showPicture() {
  const {comparison, target, frame, strong} = looking;
  const {times, shown} = opened(comparison), here = shown.get(frame);
  const to = (frame, text, label) => element("button", {type: "button", disabled: frame === undefined, "aria-label": label,
    onclick: () => { looking.frame = frame; showPicture(); }}, text);
  const canvas = element("canvas", {role: "img", "aria-label": `Frame ${frame} with truth and answers`});
  const nearest = nearestShown(comparison, frame, 0);
  const place = here ? canvas : element("p", {class: "nothing"},
    nearest === undefined ? "There are no pictures in this report. " : "There is no picture of this frame: pictures are of losses, starts and worst frames only. ",
    nearest === undefined ? "" : to(nearest, `Show the nearest, frame ${nearest}`, "Nearest picture"));
  const rows = target.lanes.map(lane => element("tr", {class: strong.has(lane) ? "strong" : null},
    element("th", {scope: "row"}, element("button", {type: "button", "aria-pressed": strong.has(lane) ? "true" : "false",
      onclick: () => { strong.has(lane) ? strong.delete(lane) : strong.add(lane); showPicture(); }}, lane.method)),
    element("td", {}, verdictText(laneData(lane), frame, target))));
  dialog.replaceChildren(
    element("div", {class: "bar"}, element("h3", {id: "picture-title"}, `Frame ${frame}, ${fixed(times[frame], 3)} s, target ${target.id}`),
      to(nearestShown(comparison, frame, -1), "←", "Picture before"), to(nearestShown(comparison, frame, 1), "→", "Next picture"),
      element("button", {type: "button", onclick: () => dialog.close()}, "Close")),
    element("div", {class: "look"}, element("figure", {}, place,
      here ? element("figcaption", {}, element("span", {class: "truth"}, "—"), " truth  ", element("span", {class: "answer-mark"}, "- + -"), " marked answers; white: the others. Choose a method to mark it.") : null),
      element("div", {class: "wide"}, element("table", {class: "verdicts"}, element("tbody", {}, ...rows)))));
  dialog.dataset.frame = frame;
  dialog.dataset.picture = here ? "yes" : "no";
  if (!here) return;
  const [W, H] = comparison.picture;
  const width = Math.min(960, window.innerWidth * 0.62, (window.innerHeight - 170) * W / H);
  const room = window.innerWidth < 760 ? window.innerWidth - 60 : width;
  imageOf(data.recordings[comparison.recording].pictures[here.p]).then(image => {
    drawFrame(canvas, comparison, here, image, {x: -0.5, y: -0.5, width: W, height: H}, room, room * H / W,
              target.lanes.map(lane => ({lane, target})), strong);
    dialog.dataset.drawn = frame;
  });
}

dialog.addEventListener("keydown", event => {
  const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
  if (!step || !looking) return;
  const next = nearestShown(looking.comparison, looking.frame, step);
  if (next !== undefined) { looking.frame = next; showPicture(); }
  event.preventDefault();
});
dialog.addEventListener("click", event => { if (event.target === dialog) dialog.close(); });
