"use strict";
// The page's data block, read back as cli/report/encoded.h wrote it.

const data = JSON.parse(document.getElementById("data").textContent);

/** Numbers that were packed into two bytes each; NaN where there is none. */
function unpacked(text) {
  const bytes = atob(text), values = new Float32Array(bytes.length / 2);
  for (let i = 0; i < values.length; ++i) {
    const steps = bytes.charCodeAt(2 * i) | (bytes.charCodeAt(2 * i + 1) << 8);
    values[i] = steps === 65535 ? NaN : steps * data.packed_step;
  }
  return values;
}

/** "g1H23" as one letter a frame. */
function letters(runs) {
  return runs.replace(/([^0-9])(\d+)/g, (_, letter, count) => letter.repeat(Number(count)));
}

/** Seconds from the first frame on. */
function timesOf(comparison) {
  const times = [];
  let at = 0;
  for (const [step, count] of comparison.times)
    for (let i = 0; i < count; ++i) times.push((at += step) / 1e6);
  return Float64Array.from(times);
}

/** What the timelines need of a comparison, made once and only when it is looked at. */
function opened(comparison) {
  if (comparison.opened) return comparison.opened;
  const times = timesOf(comparison), period = comparison.period_us / 1e6;
  const delivery = letters(comparison.delivery);
  const shown = new Map(comparison.shown.map(frame => [frame.f, frame]));
  return comparison.opened = {times, period, shown, gaps: gapsOf(times, period, delivery),
                              end: times[times.length - 1] + period};
}

/** Where no frame was delivered for two slots or more: from, to, slots, and whether the frames were taken away. */
function gapsOf(times, period, delivery) {
  const gaps = [];
  let last = -1;
  for (let i = 0; i < times.length; ++i) {
    if (delivery[i] === ".") continue;
    if (last >= 0) {
      const slots = Math.max(1, Math.floor((times[i] - times[last]) / period + 0.5));
      if (slots > 1) gaps.push({from: times[last] + period, to: times[i], slots, injected: i > last + 1});
    }
    last = i;
  }
  return gaps;
}

function laneData(lane) {
  if (!lane.letters) {
    lane.letters = letters(lane.verdicts);
    lane.error = unpacked(lane.errors);
  }
  return lane;
}

function sizesOf(target) { return target.sizes ??= unpacked(target.size); }

/** The last frame at or before a time. */
function frameAt(times, time) {
  let low = 0, high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle + 1; else high = middle;
  }
  return low - 1;
}

const VERDICTS = {
  H: {name: "Hit", says: "it knew where the target is"},
  S: {name: "Stray", says: "it said a wrong place"},
  W: {name: "WrongId", says: "it took it for another"},
  M: {name: "Miss", says: "it said nothing"},
  F: {name: "FalseAlarm", says: "it saw a target that is not there"},
  r: {name: "CorrectReject", says: "no target, and it said so"},
  g: {name: "Given", says: "it was handed the true place"},
  u: {name: "Said", says: "it said a place; there is no label to judge it by"},
  "?": {name: "Unlabelled", says: "it said nothing; there is no label"},
  "-": {name: "Skipped", says: "it was still busy"},
  ".": {name: "Dropped", says: "this frame did not come"},
  " ": {name: "NotStarted", says: "it was not asked"},
};
// When several frames fall on one dot: the most frequent, of equals the one that stands first here.
const WORST_FIRST = "gFWSMu?-Hr. ";
