// What losses came with, and how long a start holds.

/** Steps that lost the target against what they came with, with whiskers; a group of marks for each bin. */
function binsPlot(axisOf, methods, chosen) {
  return (width, place) => {
    const shown = [...chosen].sort((a, b) => a - b), bins = axisOf.bins, count = Math.max(1, shown.length);
    const used = bins.map((_, b) => shown.some(i => methods[i][axisOf.key][b][0] > 0));
    let most = 1;
    for (const i of shown) for (const [taken, , , high] of methods[i][axisOf.key]) if (taken >= 5) most = Math.max(most, 100 * high);
    for (const i of shown) for (const [taken, lost] of methods[i][axisOf.key]) if (taken) most = Math.max(most, 100 * lost / taken);
    const spread = 0.62, offset = k => count === 1 ? 0 : (k / (count - 1) - 0.5) * spread;
    return new uPlot({
      width, height: 250, padding: [10, 10, 0, 0], legend: {show: false}, cursor: {show: false},
      scales: {x: {time: false, range: [-0.5, bins.length - 0.5]}, y: {range: [0, Math.min(100, most * 1.06)]}},
      axes: [axis({label: axisOf.title, labelSize: 20, size: 28, splits: bins.map((_, i) => i), values: (_, splits) => splits.map(i => bins[i] ?? ""), grid: {show: false}}),
             axis({label: "lost, % of steps", labelSize: 20, size: 44})],
      series: [{}, {show: true, stroke: "transparent", points: {show: false}}],
      hooks: {draw: [plot => {
        const context = plot.ctx, ratio = plot.bbox.width / plot.over.clientWidth;
        context.save();
        context.beginPath();
        context.rect(plot.bbox.left, plot.bbox.top - 4 * ratio, plot.bbox.width, plot.bbox.height + 8 * ratio);
        context.clip();
        shown.forEach((i, k) => {
          context.strokeStyle = context.fillStyle = curveColour(i);
          context.lineWidth = 1.4 * ratio;
          const points = [];
          methods[i][axisOf.key].forEach(([taken, lost, low, high], b) => {
            if (!taken) return;
            const x = plot.valToPos(b + offset(k), "x", true), at = value => plot.valToPos(100 * value, "y", true);
            points.push([x, at(lost / taken)]);
            context.beginPath();
            context.moveTo(x, at(low)); context.lineTo(x, at(high));
            context.moveTo(x - 3 * ratio, at(high)); context.lineTo(x + 3 * ratio, at(high));
            context.moveTo(x - 3 * ratio, at(low)); context.lineTo(x + 3 * ratio, at(low));
            context.globalAlpha = 0.55;
            context.stroke();
            context.globalAlpha = 1;
          });
          context.setLineDash(dashOf(i).map(length => length * ratio));
          context.beginPath();
          points.forEach(([x, y], n) => n ? context.lineTo(x, y) : context.moveTo(x, y));
          context.globalAlpha = 0.5;
          context.stroke();
          context.globalAlpha = 1;
          context.setLineDash([]);
          for (const [x, y] of points) drawMark(context, i, x, y, 4 * ratio);
        });
        context.restore();
      }]},
    }, [bins.map((_, i) => i), bins.map(() => null)], place);
  };
}

/** A Kaplan-Meier curve goes down at its steps and is flat between. */
function survivalPlot(methods, chosen) {
  return (width, place) => {
    const shown = [...chosen].filter(i => methods[i].survival).sort((a, b) => a - b);
    const times = [...new Set(shown.flatMap(i => methods[i].survival.curve.map(point => point[0])))].sort((a, b) => a - b);
    const column = (i, which) => {
      const curve = methods[i].survival.curve, last = curve[curve.length - 1][0];
      let k = -1;
      return times.map(time => {
        while (k + 1 < curve.length && curve[k + 1][0] <= time) ++k;
        return k < 0 || time > last ? null : curve[k][which] === null ? null : 100 * curve[k][which];
      });
    };
    const stepped = uPlot.paths.stepped({align: 1}), banded = shown.length <= 3, series = [{}], values = [times], bands = [];
    for (const i of shown) {
      const colour = curveColour(i);
      series.push({stroke: colour, width: 2, dash: dashOf(i), paths: stepped, points: {show: false}});
      values.push(column(i, 1));
      if (!banded) continue;
      for (const which of [3, 2]) { series.push({stroke: "transparent", paths: stepped, points: {show: false}}); values.push(column(i, which)); }
      bands.push({series: [series.length - 2, series.length - 1], fill: colour + "26"});
    }
    return new uPlot({
      width, height: 250, padding: [10, 14, 0, 0], legend: {show: false}, cursor: {show: false},
      scales: {x: {time: false, range: [0, Math.max(0.1, times[times.length - 1] || 1)]}, y: {range: [0, 104]}},
      axes: [axis({label: "since it was given the target", labelSize: 20, size: 28, values: secondsText}), axis({label: "still held, % of starts", labelSize: 20, size: 44})],
      series, bands,
    }, times.length ? values : [[0, 1]], place);
  };
}

function drawGroup(section, group) {
  const {methods} = group, chosen = firstChosen(methods), draws = [];
  const plots = element("div", {class: "plots"});
  const add = (title, words, make) => {
    const place = element("div", {class: "plot"});
    plots.append(element("figure", {}, element("figcaption", {}, element("strong", {}, title), " ", words), place));
    draws.push(() => keepPlotted(place, make));
  };
  for (const axisOf of data.why.axes)
    if (methods.some(method => method[axisOf.key].some(bin => bin[0] > 0)))
      add({gap: "Gaps.", blur: "Blur.", displacement: "Displacement."}[axisOf.key],
        "Of the steps from one frame to the next with the target held, how many lost it.", binsPlot(axisOf, methods, chosen));
  if (methods.some(method => method.survival))
    add("Survival.", "How long a start holds.", survivalPlot(methods, chosen));
  const redraw = [];
  const chips = methodChips(methods.map(method => method.method), chosen, () => redraw.forEach(draw => draw()));
  if (data.why.groups.length > 1) section.append(element("h3", {}, group.heading));
  section.append(chips, plots);
  whenNear(plots, () => { for (const draw of draws) redraw.push(draw()); });
  const words = element("ul", {class: "words"});
  for (const method of methods) {
    if (method.attribution.length) words.append(element("li", {}, element("strong", {}, method.method), ": ", method.attribution.join("; "), "."));
    if (method.survival && !method.yardstick) words.append(element("li", {}, method.survival.words, "."));
  }
  if (words.children.length) section.append(words);
  section.append(countsTable(methods));
}

/** The figures behind the plots. */
function countsTable(methods) {
  const body = element("tbody");
  for (const method of methods)
    for (const axisOf of data.why.axes) {
      if (!method[axisOf.key].some(bin => bin[0] > 0)) continue;
      body.append(element("tr", {}, element("th", {scope: "row"}, method.method), element("td", {}, axisOf.title),
        element("td", {}, axisOf.bins.map((bin, b) => method[axisOf.key][b][0] ? `${bin}: ${method[axisOf.key][b][1]} of ${method[axisOf.key][b][0]}` : null).filter(text => text).join(", "))));
    }
  return element("details", {}, element("summary", {}, "The counts behind these plots"),
    element("div", {class: "wide"}, element("table", {class: "plain"}, element("thead", {}, element("tr", {}, ...["Method", "By", "Lost of steps taken"].map(text => element("th", {scope: "col"}, text)))), body)));
}

function drawWhy(section) {
  for (const group of data.why.groups) drawGroup(section, group);
  section.append(element("p", {class: "note"}, "Whiskers and shading are 95 % intervals (Wilson's; Greenwood's). What is seen in a recording goes with losses; only gaps that were drawn at random cause them."));
  if (!data.map) return;
  section.append(element("h3", {}, "The map"), element("figure", {class: "map"}, element("img", {src: data.map, alt: "Who has the target for longer, over gaps and blur"}),
    element("figcaption", {}, "Who has the target for longer, over gaps and blur: where tracking is ahead, where detection is, and where the flights do not decide.")));
}
