// Small tools. Text from data goes into the page as text only.

/** element("p", {class: "note"}, "words", child, …) */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.filter(child => child !== null && child !== undefined));
  return made;
}

function svg(tag, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Colours of Okabe and Ito, which people with any colour vision tell apart; each comes with a shape of its own. */
const CURVES = ["--blue", "--vermillion", "--green", "--purple", "--orange", "--sky", "--ink", "--soft"];
const curveColour = index => style(CURVES[index % CURVES.length]);

const fixed = (value, decimals) => value.toFixed(decimals);

/** A number, or what stands for one. */
function numberText(value, decimals) {
  if (value === null || value === undefined) return "n/a";
  if (typeof value === "string") return value === "infinite" ? "∞" : "−∞";
  return fixed(value, decimals);
}

function intervalText(interval, decimals) {
  return interval ? ` [${numberText(interval[0], decimals)}, ${numberText(interval[1], decimals)}]` : "";
}

/** A canvas of this size in CSS px, sharp on any screen and on paper. */
function sizeCanvas(canvas, width, height) {
  const scale = Math.max(window.devicePixelRatio || 1, 2);
  canvas.width = Math.round(width * scale);
  canvas.height = Math.round(height * scale);
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const context = canvas.getContext("2d");
  context.setTransform(scale, 0, 0, scale, 0, 0);
  return context;
}

// Whatever is drawn is drawn again when the window's width, the colours or the medium change.
const drawings = new Set();
function keepDrawn(draw) { drawings.add(draw); draw(); }
function drawAll() { for (const draw of drawings) draw(); }

/** Calls `show` once, when the element comes near the window, or the page is printed. */
const waiting = new Map();
const watcher = new IntersectionObserver(entries => {
  for (const entry of entries) if (entry.isIntersecting) showNow(entry.target);
}, {rootMargin: "600px"});
function whenNear(node, show) { waiting.set(node, show); watcher.observe(node); }
function showNow(node) {
  const show = waiting.get(node);
  waiting.delete(node);
  watcher.unobserve(node);
  if (show) show();
}

const tip = document.getElementById("tip");
function showTip(lines, x, y) {
  tip.replaceChildren(...lines.map((line, i) => element(i ? "div" : "strong", {}, line)));
  tip.hidden = false;
  const box = tip.getBoundingClientRect();
  tip.style.left = `${Math.max(4, Math.min(x + 14, window.innerWidth - box.width - 8))}px`;
  tip.style.top = `${y + box.height + 24 > window.innerHeight ? y - box.height - 12 : y + 16}px`;
}
function hideTip() { tip.hidden = true; }
