// Lanes of all methods under one axis of time, with gaps and blur above.

const RIGHT = 14;
const leftOf = width => width < 640 ? 92 : 150;

/** Values over time with a break at every gap: [times, values] as uPlot takes them. */
function broken(times, values, period) {
  const xs = [], ys = [];
  for (let i = 0; i < times.length; ++i) {
    if (i && times[i] - times[i - 1] > 1.5 * period) { xs.push(times[i - 1] + period); ys.push(null); }
    xs.push(times[i]);
    ys.push(Number.isNaN(values[i]) ? null : values[i]);
  }
  return [xs, ys];
}

class Timeline {
  constructor(place, comparison, target, targetIndex) {
    Object.assign(this, {place, comparison, target, targetIndex, ...opened(comparison)});
    this.lanes = target.lanes.map(laneData);
    this.range = [0, this.end];
    this.at = {lane: 0, frame: 0};
    this.build();
    keepDrawn(() => this.draw());
  }

  build() {
    const button = (text, label, act) => element("button", {type: "button", title: label, "aria-label": label, onclick: act}, text);
    this.tools = element("div", {class: "tools"},
      button("+", "Zoom in", () => this.zoom(0.5)), button("−", "Zoom out", () => this.zoom(2)),
      button("◀", "Earlier", () => this.move(-0.5)), button("▶", "Later", () => this.move(0.5)),
      button("All", "The whole recording", () => this.show(0, this.end)),
      button("Next loss", "Go to the next loss", () => this.toLoss(1)),
      element("span", {class: "hint"}, "Drag to zoom, click a mark for its picture. Keys: ← → frame, ↑ ↓ method, + − 0 zoom, n p losses, Enter picture."));
    this.axisPlace = element("div", {class: "axis"});
    this.names = element("div", {class: "names"});
    this.canvas = element("canvas", {"aria-hidden": "true"});
    this.cross = element("div", {class: "cross", hidden: true});
    this.marked = element("div", {class: "marked", hidden: true});
    this.band = element("div", {class: "band", hidden: true});
    this.said = element("p", {class: "sr", "aria-live": "polite"});
    this.board = element("div", {class: "board", tabindex: 0, role: "application",
      "aria-label": `Timelines of ${this.lanes.length} methods, target ${this.target.id}. Arrow keys move, Enter opens the picture.`},
      this.canvas, this.band, this.cross, this.marked);
    for (const [i, lane] of this.lanes.entries())
      this.names.append(element("div", {class: "name" + (lane.yardstick ? " yardstick" : ""), title: `${lane.method}: ${lane.story}`,
        style: `top:${this.topOf(i)}px`}, lane.method));
    this.place.append(this.tools, element("div", {class: "timeline"}, this.axisPlace, this.names, this.board), this.said);
    this.place.append(this.stories(), this.lines());
    this.listen();
    this.place.dataset.lanes = this.lanes.length;
    this.place.dataset.losses = this.lanes.reduce((sum, lane) => sum + lane.losses.length, 0);
    this.place.timeline = this;
  }

  stories() {
    return element("details", {class: "stories"}, element("summary", {}, "The same in words"),
      element("dl", {}, ...this.lanes.flatMap(lane => [element("dt", {}, lane.method), element("dd", {}, lane.story)])));
  }

  topOf(i) { return 8 + i * (LANE + LANE_GAP + 4); }
  get height() { return this.topOf(this.lanes.length) + 2; }
  x(time) { return (time - this.range[0]) / (this.range[1] - this.range[0]) * this.inner; }
  time(x) { return this.range[0] + x / this.inner * (this.range[1] - this.range[0]); }

  draw() {
    this.width = this.place.clientWidth;  // kept: asking the page is slow, and every mark needs it
    this.inner = this.width - leftOf(this.width) - RIGHT;
    if (this.width < 60) return;
    this.drawAxis();
    this.board.style.marginLeft = `${leftOf(this.width)}px`;
    this.board.style.width = `${this.inner}px`;
    this.names.style.width = `${leftOf(this.width) - 8}px`;
    this.names.style.top = `${this.plot.height}px`;
    this.context = sizeCanvas(this.canvas, this.inner, this.height);
    this.paints = paints(this.context);
    this.drawLanes();
    this.redrawLines?.();
  }

  /** The curve above the lanes: blur, or agreement where there is no label; and the axis of time. */
  curve() {
    const {target} = this;
    if (target.agreement) return {label: "methods agree", values: unpacked(target.agreement), range: [0, 1]};
    if (target.blur) return {label: "blur, px", values: unpacked(target.blur), range: null};
    return {label: "", values: new Float32Array(this.times.length).fill(NaN), range: [0, 1]};
  }

  drawAxis() {
    this.plot?.destroy();
    const curve = this.curve(), known = curve.label !== "", left = leftOf(this.width);
    const [xs, ys] = broken(this.times, curve.values, this.period);
    this.plot = new uPlot({
      width: this.width, height: known ? 120 : 54, padding: [6, RIGHT, 0, 0],
      cursor: {y: false, drag: {x: true, y: false, setScale: false}, points: {show: false}},
      legend: {show: false},
      select: {show: true},
      scales: {x: {time: false, range: () => this.range}, y: {range: (_, low, high) => curve.range || [0, Math.max(high || 1, 1) * 1.08]}},
      axes: [axis({values: secondsText, size: 26, space: 70}),
             axis({size: left - 18, values: (_, splits) => splits.map(v => known ? String(v) : ""), label: curve.label || " ", labelSize: 18, space: 24,
                   grid: {show: known, stroke: () => style("--line"), width: 1}, ticks: {show: false}})],
      series: [{}, {stroke: style("--ink"), width: 1.2, points: {show: this.times.length < 2, size: 5}, spanGaps: false}],
      hooks: {drawClear: [plot => this.drawGaps(plot.ctx, plot.bbox)],
              setSelect: [plot => this.chosen(plot)],
              setCursor: [plot => this.hover(plot.cursor.left, null)]},
    }, [xs, ys], this.axisPlace);
  }

  chosen(plot) {
    const {left, width} = plot.select;
    if (width > 4) this.show(this.time(left), this.time(left + width));
    plot.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
  }

  /** Bands where no frame came; those that were taken away on purpose are hatched, those of the recording plain. */
  drawGaps(context, box) {
    const scale = box.width / this.inner;
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.width, box.height);
    context.clip();
    for (const gap of this.gaps) {
      const x0 = this.x(gap.from) * scale, x1 = this.x(gap.to) * scale;
      if (x1 < 0 || x0 > box.width) continue;
      context.fillStyle = style(gap.injected ? "--injected" : "--gap");
      context.fillRect(box.left + x0, box.top, Math.max(scale, x1 - x0), box.height);
    }
    context.restore();
  }

  drawLanes() {
    const {context, inner, height} = this;
    if (!context) return;
    context.clearRect(0, 0, inner, height);
    this.lanes.forEach((_, i) => {
      context.fillStyle = style("--panel");
      context.fillRect(0, this.topOf(i), inner, LANE);
    });
    this.drawGaps(context, {left: 0, top: 0, width: inner, height});
    let drawn = 0;
    this.lanes.forEach((lane, i) => {
      drawn += drawLane(context, this.paints, lane, this, time => this.x(time), this.range[0], this.range[1], inner, this.topOf(i));
      drawLosses(context, lane, this.times, time => this.x(time), inner, this.topOf(i));
    });
    this.place.dataset.marks = drawn;
    this.place.dataset.range = this.range.map(value => value.toFixed(4)).join(" ");
    this.mark();
  }

  show(from, to) {
    const least = Math.min(this.end, 3 * this.period), span = Math.max(least, Math.min(this.end, to - from));
    const begin = Math.max(0, Math.min((from + to - span) / 2, this.end - span));
    this.range = [begin, begin + span];
    this.plot.setScale("x", {min: this.range[0], max: this.range[1]});
    this.drawLanes();
    this.linesPlot?.setScale("x", {min: this.range[0], max: this.range[1]});
  }

  zoom(factor, about = null) {
    const [from, to] = this.range, middle = about ?? (from + to) / 2;
    this.show(middle - (middle - from) * factor, middle + (to - middle) * factor);
  }
  move(share) {
    const step = share * (this.range[1] - this.range[0]);
    this.show(this.range[0] + step, this.range[1] + step);
  }

  /** Of all methods but yardsticks; of yardsticks where there is nothing else. */
  toLoss(direction) {
    const own = this.lanes.some(lane => !lane.yardstick);
    const all = this.lanes.flatMap((lane, i) => lane.yardstick && own ? [] : lane.losses.map(loss => ({lane: i, frame: loss.lost})))
      .sort((a, b) => a.frame - b.frame || a.lane - b.lane);
    if (!all.length) { this.said.textContent = "There is no loss."; return; }
    const rank = at => at.frame * 1000 + at.lane, here = rank(this.at);
    const next = direction > 0 ? all.find(at => rank(at) > here) || all[0] : all.filter(at => rank(at) < here).pop() || all[all.length - 1];
    this.go(next.lane, next.frame);
  }

  go(lane, frame) {
    this.at = {lane: Math.max(0, Math.min(this.lanes.length - 1, lane)), frame: Math.max(0, Math.min(this.times.length - 1, frame))};
    const time = this.times[this.at.frame], [from, to] = this.range;
    if (time < from || time > to) this.show(time - (to - from) / 2, time + (to - from) / 2);
    this.mark();
    this.said.textContent = this.linesOf(this.at.lane, this.at.frame, time).join("; ");
  }

  /** A frame around the mark that the keys are at. */
  mark() {
    const x = this.x(this.times[this.at.frame]), width = Math.max(3, this.x(this.times[this.at.frame] + this.period) - x);
    this.marked.hidden = document.activeElement !== this.board || x < 0 || x > this.inner;
    Object.assign(this.marked.style, {left: `${x - 2}px`, width: `${width + 4}px`, top: `${this.topOf(this.at.lane) - 2}px`, height: `${LANE + 4}px`});
  }

  linesOf(laneIndex, frame, time) {
    const lane = this.lanes[laneIndex], letter = lane.letters[frame], gap = this.gaps.find(g => time >= g.from && time < g.to);
    if (gap && letter !== ".") return [`${lane.method}, ${fixed(time, 3)} s`, `no frame came for ${gap.slots - 1} slot${gap.slots > 2 ? "s" : ""} (${fixed(gap.to - gap.from, 3)} s)${gap.injected ? ": taken away" : ""}`];
    const lines = [`${lane.method}, frame ${frame}, ${fixed(this.times[frame], 3)} s`, `${verdictText(lane, frame, this.target)}: ${VERDICTS[letter].says}`];
    const loss = lane.losses.find(l => frame > l.good && frame <= l.ended);
    if (loss) lines.push(loss.what);
    lines.push(this.shown.has(frame) ? "click for its picture" : "no picture of this frame");
    return lines;
  }

  hover(x, y, event = null) {
    const inside = x !== null && x >= 0 && x <= this.inner;
    this.cross.hidden = !inside;
    if (!inside) { hideTip(); return; }
    this.cross.style.left = `${x}px`;
    if (!event) return;
    const lane = Math.max(0, Math.min(this.lanes.length - 1, Math.floor((y - this.topOf(0)) / (this.topOf(1) - this.topOf(0)))));
    const time = this.time(x), frame = Math.max(0, frameAt(this.times, time));
    this.hovered = {lane, frame};
    showTip(this.linesOf(lane, frame, time), event.clientX, event.clientY);
  }

  listen() {
    const {board} = this, placeOf = event => {
      const box = board.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    let begun = null;
    board.addEventListener("pointerdown", event => { if (event.button === 0) { begun = placeOf(event)[0]; board.setPointerCapture(event.pointerId); } });
    board.addEventListener("pointermove", event => {
      const [x, y] = placeOf(event), dragged = begun !== null && Math.abs(x - begun) > 4;
      this.band.hidden = !dragged;
      if (dragged) Object.assign(this.band.style, {left: `${Math.min(x, begun)}px`, width: `${Math.abs(x - begun)}px`});
      this.hover(x, y, event);
      this.plot.setCursor({left: x, top: 10}, false);
    });
    board.addEventListener("pointerleave", () => this.hover(null));
    board.addEventListener("pointerup", event => {
      const [x, y] = placeOf(event), from = begun;
      begun = null;
      this.band.hidden = true;
      if (from === null) return;
      if (Math.abs(x - from) > 4) return this.show(this.time(Math.min(x, from)), this.time(Math.max(x, from)));
      this.hover(x, y, event);
      if (this.hovered) { this.at = this.hovered; this.mark(); this.openAt(); }
    });
    board.addEventListener("dblclick", () => this.show(0, this.end));
    board.addEventListener("wheel", event => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY / 300), this.time(placeOf(event)[0]));
    }, {passive: false});
    board.addEventListener("focus", () => this.mark());
    board.addEventListener("blur", () => { this.marked.hidden = true; });
    board.addEventListener("keydown", event => this.key(event));
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const {lane, frame} = this.at, far = event.shiftKey ? 10 : 1;
    const acts = {
      ArrowLeft: () => this.go(lane, frame - far), ArrowRight: () => this.go(lane, frame + far),
      ArrowUp: () => this.go(lane - 1, frame), ArrowDown: () => this.go(lane + 1, frame),
      Home: () => this.go(lane, 0), End: () => this.go(lane, this.times.length - 1),
      "+": () => this.zoom(0.5, this.times[frame]), "=": () => this.zoom(0.5, this.times[frame]), "-": () => this.zoom(2, this.times[frame]), 0: () => this.show(0, this.end),
      n: () => this.toLoss(1), p: () => this.toLoss(-1), Enter: () => this.openAt(), " ": () => this.openAt(),
    };
    if (!acts[event.key]) return;
    acts[event.key]();
    event.preventDefault();
  }

  openAt() {
    hideTip();
    openPicture(this.comparison, this.target, this.at.frame, this.lanes[this.at.lane]);
  }

  /** Errors as lines over the same axis, drawn only when asked for: many lines over one another tell little. */
  lines() {
    const place = element("div", {class: "lines"}), chosen = firstChosen(this.lanes, 4), sizes = sizesOf(this.target);
    const ofSize = error => error.map((e, i) => sizes[i] > 0 ? 100 * e / sizes[i] : NaN);
    const make = width => {
      const left = leftOf(width), all = [...chosen], columns = all.map(i => broken(this.times, ofSize(this.lanes[i].error), this.period));
      const xs = columns.length ? columns[0][0] : [0, this.end];
      return this.linesPlot = new uPlot({
        width, height: 220, padding: [8, RIGHT, 0, 0], legend: {show: false},
        cursor: {y: false, drag: {setScale: false}, points: {show: false}}, select: {show: true},
        scales: {x: {time: false, range: () => this.range}, y: {range: (_, low, high) => [0, Math.max(30, Math.min(high || 30, 200)) * 1.05]}},
        axes: [axis({values: secondsText, size: 26, space: 70}), axis({size: left - 18, label: "error, % of D", labelSize: 18})],
        series: [{}, ...all.map(i => ({stroke: curveColour(i), width: 1.6, dash: dashOf(i), spanGaps: false, points: {size: 5, fill: curveColour(i)}}))],
        hooks: {drawClear: [plot => this.drawGaps(plot.ctx, plot.bbox)], setSelect: [plot => this.chosen(plot)]},
      }, [xs, ...columns.map(column => column[1])], place);
    };
    const draw = () => {
      this.linesPlot?.destroy();
      this.linesPlot = null;
      place.replaceChildren();
      if (details.open && place.clientWidth > 60) make(place.clientWidth);
    };
    const chips = methodChips(this.lanes.map(lane => lane.method), chosen, draw);
    const details = element("details", {class: "errors", ontoggle: draw},
      element("summary", {}, "Errors as lines"), chips, place);
    this.redrawLines = draw;
    return details;
  }
}

function legend(lettersThere) {
  return element("ul", {class: "legend", "aria-label": "What marks mean"},
    ...[..."gHSWMFru?-"].filter(letter => lettersThere.has(letter)).map(letter =>
      element("li", {}, legendMark(letter), element("span", {}, element("strong", {}, VERDICTS[letter].name), " ", VERDICTS[letter].says))),
    element("li", {}, element("span", {class: "key onset"}, "▼"), element("span", {}, element("strong", {}, "Loss"), " a lock was lost; the line below lasts until it ended")),
    element("li", {}, element("span", {class: "key gap"}), element("span", {}, element("strong", {}, "Gap"), " no frame came")),
    element("li", {}, element("span", {class: "key injected"}), element("span", {}, element("strong", {}, "Gap"), " frames were taken away")));
}

function drawTimelines(section) {
  const there = new Set();
  for (const comparison of data.comparisons)
    for (const target of comparison.targets)
      for (const lane of target.lanes) for (const letter of lane.verdicts.replace(/\d/g, "")) there.add(letter);
  section.append(legend(there));
  let first = true;
  for (const comparison of data.comparisons) {
    const folded = element("details", {class: "comparison", open: first});
    folded.append(element("summary", {}, comparison.heading));
    if (comparison.end) folded.append(element("p", {class: "note"}, comparison.end));
    const fill = () => {
      if (folded.dataset.filled) return;
      folded.dataset.filled = "yes";
      comparison.targets.forEach((target, index) => {
        if (!target.lanes.length) return;
        const place = element("div", {class: "target"});
        folded.append(element("h3", {}, `target ${target.id}`, target.code ? element("small", {}, ` ${target.code}`) : null));
        if (target.agreement)
          folded.append(element("p", {class: "note"}, "Most frames have no label, so nobody is judged there. The curve says how many pairs of methods put the target at one place (within half its size); the marks say who said a place at all."));
        else if (!target.blur)
          folded.append(element("p", {class: "note"}, "The blur of this target is not known."));
        folded.append(place);
        new Timeline(place, comparison, target, index);
      });
    };
    section.append(folded);
    if (first) fill();
    folded.addEventListener("toggle", () => { if (folded.open) fill(); });
    folded.fill = fill;
    first = false;
  }
  section.append(element("p", {class: "note"}, "Where several frames fall on one dot, it shows the most frequent verdict, of equals the worse; a triangle marks every loss, however short."));
}
