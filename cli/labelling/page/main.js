// The labelling page: what is shown, and what keys and buttons do.

import { Server } from "./server.js";
import { Strip } from "./strip.js";
import { handlesOf, moved, scaled, Tools } from "./tools.js";
import { centreOf, colours, View } from "./view.js";

const element = (id) => document.getElementById(id);
const server = new Server(), view = new View(element("picture")), strip = new Strip(element("strip"));
const page = { data: null, frame: 0, target: 0, bitmap: null, proposal: null, gaps: [], saving: 0, view };
window.page = page; // for tests: what is shown

const tools = new Tools({
  shown: () => page.proposal ?? shownOutline(),
  place: (outline) => placed(outline),
  reach: () => view.reach,
  fresh: () => {
    const size = Math.max(8, page.data.recording.width / 40);
    return { ellipse: [0, 0, size, size, 0] };
  },
});

const target = () => page.data.targets[page.target];
const keyHere = () => target().keys.find((key) => key.frame === page.frame);
const outlineOf = (key) => (key?.box || key?.quad || key?.ellipse ? key : null);
const shownOutline = () => outlineOf(keyHere()) ?? target().frames.outlines[page.frame];

// --- Doing.

function complain(fault) {
  element("fault").textContent = fault.message;
  element("fault").hidden = false;
}

async function doing(work) {
  element("fault").hidden = true;
  ++page.saving;
  try {
    await work();
  } catch (fault) {
    complain(fault);
  } finally {
    --page.saving;
    draw();
  }
}

const edit = (request) => doing(async () => show(await server.edit(request)));

function show(data) {
  page.data = data;
  page.target = Math.min(page.target, data.targets.length - 1);
  if (data.looking) follow();
  fillHeader();
  draw();
}

/// Likenesses come in by and by.
function follow() {
  clearTimeout(page.timer);
  page.timer = setTimeout(() => doing(async () => {
    const data = await server.state();
    if (data.version >= page.data.version) show(data);
  }), 400);
}

/// A hand is as sure as the picture is large on the screen.
const handSigma = () => Math.min(8, Math.max(0.25, (page.data.sigma_px * view.ratio) / view.scale));

function placed(outline, source = "hand") {
  page.proposal = null;
  const { box, quad, ellipse } = outline;
  edit({ do: "key", target: target().id, frame: page.frame, state: "placed", box, quad, ellipse, sigma_px: handSigma(), source });
}

function say(state) {
  const outline = state === "occluded" ? outlineOf(keyHere()) : null;
  edit({ do: "key", target: target().id, frame: page.frame, state, box: outline?.box, quad: outline?.quad, ellipse: outline?.ellipse, sigma_px: outline ? handSigma() : undefined });
}

function accept() {
  const outline = page.proposal ?? shownOutline();
  if (outline) placed(outline, page.proposal ? `detector ${page.data.helper}` : "hand");
}

function take() {
  if (keyHere()) edit({ do: "take", target: target().id, frame: page.frame });
}

const undo = () => edit({ do: "undo" });

function newTarget() {
  const id = window.prompt("The new target's name");
  if (!id) return;
  edit({ do: "target", id }).then(() => {
    page.target = Math.max(0, page.data.targets.findIndex((t) => t.id === id));
    fillHeader();
    draw();
  });
}

function chooseTarget(index) {
  page.target = (index + page.data.targets.length) % page.data.targets.length;
  page.proposal = null;
  tools.cancel();
  fillHeader();
  draw();
}

function askDetector() {
  doing(async () => {
    const frame = page.frame, answers = await server.answers(frame);
    if (frame !== page.frame) return;
    if (!answers.length) throw new Error(`${page.data.helper} finds nothing on this frame.`);
    const near = shownOutline(), [x, y] = near ? centreOf(near) : [0, 0];
    const far = (answer) => Math.hypot(centreOf(answer)[0] - x, centreOf(answer)[1] - y);
    page.proposal = near ? answers.reduce((a, b) => (far(b) < far(a) ? b : a)) : answers[0];
  });
}

// --- Going.

function go(frame) {
  const last = page.data.recording.frames - 1;
  page.frame = Math.min(last, Math.max(0, frame));
  page.proposal = null;
  tools.cancel();
  const outline = shownOutline();
  if (!view.fitted && outline && !view.sees(centreOf(outline))) view.centreOn(centreOf(outline));
  draw();
  fetchPicture();
}

async function fetchPicture() {
  const frame = page.frame;
  try {
    const bitmap = await server.picture(frame);
    if (frame !== page.frame) return;
    page.bitmap = bitmap;
    page.bitmapFrame = frame;
    draw();
    for (const near of [frame + 1, frame - 1]) if (near >= 0 && near < page.data.recording.frames) server.picture(near).catch(() => {});
  } catch (fault) {
    complain(fault);
  }
}

function goAmong(frames, way) {
  const ahead = way > 0 ? frames.find((f) => f > page.frame) : frames.findLast((f) => f < page.frame);
  if (ahead !== undefined) go(ahead);
}

function goToNextClick() {
  const next = target().to_go.next;
  if (next) go(next.frame);
}

// --- Showing.

const worth = {
  "nothing yet": "place the target",
  unknown: "nobody said where it is",
  uncertain: "the curve is unsure",
  disagrees: "the picture disagrees",
};
const spoken = { v: "visible", a: "absent", o: "occluded", u: "unlabelled", "?": "not labelled yet" };

function fillHeader() {
  const { recording, targets, undo: undos, may_add_targets: may } = page.data;
  element("name").textContent = recording.name;
  element("name").title = recording.name;
  const select = element("target");
  select.replaceChildren(...targets.map((t, i) => new Option(t.id, i)));
  select.value = page.target;
  element("new-target").disabled = !may;
  element("undo").disabled = !undos;
  for (const button of document.querySelectorAll("[data-tool]"))
    button.setAttribute("aria-pressed", button.dataset.tool === tools.tool);
}

function fillFooter() {
  const { recording, helper } = page.data, { frames, likeness, to_go: toGo } = target(), f = page.frame, key = keyHere();
  const parts = [`frame ${f} of ${recording.frames}`, `${recording.times_s[f].toFixed(3)} s`, spoken[frames.labels[f]]];
  if (key) parts.push(`key frame (${key.source})`);
  if (frames.sigma_px[f] !== null) parts.push(`± ${frames.sigma_px[f]} px`);
  if (likeness[f] !== null && likeness[f] !== undefined) parts.push(`likeness ${likeness[f].toFixed(2)}`);
  if (page.proposal) parts.push(`${helper} says so: Enter takes it over`);
  element("where").textContent = parts.join(" · ");
  element("lead").textContent = toGo.next
    ? `N: frame ${toGo.next.frame}, ${worth[toGo.next.worth]}. About ${toGo.count} more ${toGo.count === 1 ? "click helps" : "clicks help"}.`
    : "No more clicks are needed here.";
  element("take").disabled = !key;
  for (const button of document.querySelectorAll("[data-state]"))
    button.setAttribute("aria-pressed", key?.state === button.dataset.state);
}

function drawOutlines() {
  page.data.targets.forEach((each, t) => {
    if (t === page.target) return;
    const outline = outlineOf(each.keys.find((key) => key.frame === page.frame)) ?? each.frames.outlines[page.frame];
    if (outline) view.outline(outline, { colour: colours.other, width: 1, name: each.id });
  });
  const outline = shownOutline(), key = keyHere();
  if (outline && !tools.draft) {
    view.outline(outline, { colour: key ? colours.key : colours.curve, dash: key ? [] : [6, 4], name: target().id });
    if (!key) view.doubt(outline, target().frames.sigma_px[page.frame], colours.curve);
    if (outline[tools.tool]) for (const { at } of handlesOf(outline)) view.handle(at, key ? colours.key : colours.curve, 2.5);
  }
  if (page.proposal) view.outline(page.proposal, { colour: colours.other, width: 2, dash: [2, 3], name: page.data.helper });
  if (tools.draft) view.outline(tools.draft, { colour: colours.key, width: 1.5 });
  for (const corner of tools.corners) view.handle(corner, colours.key);
}

function draw() {
  if (!page.data || page.waits) return;
  page.waits = requestAnimationFrame(() => {
    page.waits = 0;
    if (view.measure() && (view.fitted ?? true)) view.fit(page.data.recording.width, page.data.recording.height);
    view.clear(page.bitmap);
    if (page.bitmapFrame === page.frame) drawOutlines();
    strip.gapSet = new Set(page.gaps);
    strip.draw(page.data, page.target, page.frame, page.gaps);
    fillFooter();
  });
}

// --- Hearing.

const picture = element("picture");
let drag = null;
picture.addEventListener("pointerdown", (event) => {
  picture.setPointerCapture(event.pointerId);
  if (event.button === 0) tools.down(view.inPicture(event), event.shiftKey);
  else drag = [event.clientX, event.clientY];
  draw();
});
picture.addEventListener("pointermove", (event) => {
  page.mouse = view.inPicture(event);
  if (drag) {
    view.move(event.clientX - drag[0], event.clientY - drag[1]);
    drag = [event.clientX, event.clientY];
  } else tools.move(page.mouse);
  draw();
});
picture.addEventListener("pointerup", (event) => {
  if (event.button === 0) tools.up(view.inPicture(event));
  drag = null;
  draw();
});
picture.addEventListener("contextmenu", (event) => event.preventDefault());
picture.addEventListener("wheel", (event) => {
  event.preventDefault();
  view.zoom(Math.exp(-event.deltaY / 400), view.inPicture(event));
  draw();
}, { passive: false });

const seek = (event) => event.buttons && go(strip.frameAt(event));
element("strip").addEventListener("pointerdown", (event) => {
  element("strip").setPointerCapture(event.pointerId);
  seek(event);
});
element("strip").addEventListener("pointermove", seek);

function nudge(event) {
  const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
  const outline = shownOutline(), by = event.shiftKey ? 0.1 : 1;
  if (outline && way) placed(moved(outline, by * way[0], by * way[1]));
}

function resize(factor) {
  const outline = shownOutline();
  if (outline) placed(scaled(outline, factor));
}

function chooseTool(tool) {
  tools.choose(tool);
  fillHeader();
  draw();
}

function toggleHelp() {
  const keys = element("keys");
  keys.hidden = !keys.hidden;
  element("help").setAttribute("aria-expanded", !keys.hidden);
}

const keys = {
  ArrowRight: (e) => go(page.frame + (e.shiftKey ? 10 : 1)),
  ArrowLeft: (e) => go(page.frame - (e.shiftKey ? 10 : 1)),
  Home: () => go(0),
  End: () => go(page.data.recording.frames - 1),
  n: goToNextClick,
  g: () => goAmong(page.gaps, 1),
  G: () => goAmong(page.gaps, -1),
  k: () => goAmong(target().keys.map((key) => key.frame), 1),
  j: () => goAmong(target().keys.map((key) => key.frame), -1),
  c: () => chooseTool("centre"),
  b: () => chooseTool("box"),
  q: () => chooseTool("quad"),
  e: () => chooseTool("ellipse"),
  a: () => say("absent"),
  o: () => say("occluded"),
  u: () => say("unlabelled"),
  Delete: take,
  Backspace: take,
  Enter: accept,
  "+": () => resize(1.02),
  "=": () => resize(1.02),
  "-": () => resize(1 / 1.02),
  z: () => {
    const outline = shownOutline();
    view.toPixels(outline ? centreOf(outline) : page.mouse ?? [page.data.recording.width / 2, page.data.recording.height / 2]);
    draw();
  },
  t: () => chooseTarget(page.target + 1),
  T: newTarget,
  d: askDetector,
  "?": toggleHelp,
  Escape: () => {
    page.proposal = null;
    tools.cancel();
    draw();
  },
};

document.addEventListener("keydown", (event) => {
  if (!page.data || event.altKey || event.metaKey || event.target.matches("input, select")) return;
  if (event.target.matches("button") && ["Enter", " "].includes(event.key)) return;
  const does = event.ctrlKey ? (event.key === "z" ? undo : event.key.startsWith("Arrow") ? nudge : null) : keys[event.key] ?? keys[event.key.toLowerCase()]; // with Caps Lock, too
  if (!does) return;
  event.preventDefault();
  does(event);
});

element("target").addEventListener("change", (event) => {
  chooseTarget(Number(event.target.value));
  picture.focus();
});
for (const button of document.querySelectorAll("[data-tool]")) button.addEventListener("click", () => chooseTool(button.dataset.tool));
for (const button of document.querySelectorAll("[data-state]")) button.addEventListener("click", () => say(button.dataset.state));
element("new-target").addEventListener("click", newTarget);
element("take").addEventListener("click", take);
element("undo").addEventListener("click", undo);
element("help").addEventListener("click", toggleHelp);
new ResizeObserver(draw).observe(picture);

doing(async () => {
  show(await server.state());
  const { times_s: times, period_s: period } = page.data.recording;
  page.gaps = times.map((_, i) => i).filter((i) => i > 0 && Math.floor((times[i] - times[i - 1]) / period + 0.5) >= 2);
  go(target().to_go.next?.frame ?? 0);
  picture.focus();
});
