// Every loss, in words and pictures.

const ENDS = {recovered: "found again", chance: "came back by chance", reset: "started again", target_left: "last seen before the target left",
              labels_stopped: "last labelled", recording_stopped: "end of the recording"};

function lossPicture(comparison, target, targetIndex, lane, frame, caption) {
  const {times, shown} = opened(comparison), here = shown.get(frame);
  const text = element("figcaption", {}, element("strong", {}, caption), ` frame ${frame}, ${fixed(times[frame], 2)} s`);
  if (!here) return element("figure", {class: "none"}, element("div", {class: "nothing"}, "no picture"), text);
  const canvas = element("canvas", {role: "img", "aria-label": `${caption}: frame ${frame}, truth and the answer of ${lane.method}`});
  const button = element("button", {type: "button", class: "frame", title: "The whole frame, with all answers",
    onclick: () => openPicture(comparison, target, frame, lane)}, canvas);
  const width = 300, height = 190;
  sizeCanvas(canvas, width, height);
  whenNear(canvas, () => imageOf(data.recordings[comparison.recording].pictures[here.p]).then(image =>
    drawFrame(canvas, comparison, here, image, closeView(comparison, here, targetIndex, lane, target, width / height), width, height, [{lane, target}], new Set([lane]))));
  return element("figure", {}, button, text);
}

function lossCard(comparison, target, targetIndex, lane, loss, number) {
  return element("li", {class: "loss"},
    element("p", {}, element("span", {class: "count"}, String(number)), element("strong", {}, loss.what), " ", loss.target, " ", loss.said),
    element("div", {class: "pictures"},
      lossPicture(comparison, target, targetIndex, lane, loss.good, "held"),
      lossPicture(comparison, target, targetIndex, lane, loss.lost, "lost"),
      loss.ended !== loss.lost ? lossPicture(comparison, target, targetIndex, lane, loss.ended, ENDS[loss.end] || "ended") : null));
}

const OPEN_LOSSES = 40;

function drawLossesSection(section) {
  const groups = [];
  for (const comparison of data.comparisons)
    comparison.targets.forEach((target, index) => {
      for (const lane of target.lanes)
        if (lane.losses.length && (!lane.yardstick || target.lanes.every(other => other.yardstick))) groups.push({comparison, target, index, lane});
    });
  const total = groups.reduce((sum, group) => sum + group.lane.losses.length, 0);
  if (!total) section.append(element("p", {}, "No method lost the target."));
  let open = 0;
  for (const {comparison, target, index, lane} of groups) {
    const count = lane.losses.length, folded = element("details", {class: "losses", open: open + count <= OPEN_LOSSES});
    if (folded.open) open += count;
    const where = [data.comparisons.length > 1 ? comparison.heading : null, `target ${target.id}`].filter(text => text).join(", ");
    folded.append(element("summary", {}, element("strong", {}, lane.method), `, ${where}: ${count} loss${count > 1 ? "es" : ""}`));
    const list = element("ol", {class: "cards"});
    folded.append(list);
    const fill = () => {
      if (folded.dataset.filled) return;
      folded.dataset.filled = "yes";
      laneData(lane);
      lane.losses.forEach((loss, i) => list.append(lossCard(comparison, target, index, lane, loss, i + 1)));
    };
    folded.addEventListener("toggle", () => { if (folded.open) fill(); });
    section.append(folded);
    if (folded.open) whenNear(folded, fill);
  }
  const {wanted, kept, budget_mb, missing} = data.pictures;
  for (const why of missing) section.append(element("p", {class: "note"}, `Without pictures: ${why}.`));
  section.append(element("p", {class: "note"}, `Truth is drawn solid and green, the method's answer dashed and orange with a cross. `,
    `There are pictures of ${kept} of ${wanted} frames about losses, starts and worst answers; all pictures together may take ${budget_mb} MB. Losses of the yardsticks are in the timelines only.`));
}
