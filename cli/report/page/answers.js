// The table at the top: who had the target, for how long, and how sure that is.

const SCALE_WIDTH = 120;

/** A share on a scale from 0 to 1: a bar for the value, a whisker for its interval. */
function shareScale(share, muted) {
  const x = value => 1 + Math.max(0, Math.min(1, value)) * (SCALE_WIDTH - 2);
  const drawing = svg("svg", {width: SCALE_WIDTH, height: 14, viewBox: `0 0 ${SCALE_WIDTH} 14`, preserveAspectRatio: "none", "aria-hidden": "true", class: "scale" + (muted ? " muted" : "")});
  drawing.append(svg("rect", {class: "track", x: 1, y: 4, width: SCALE_WIDTH - 2, height: 6}));
  drawing.append(svg("rect", {class: "bar", x: 1, y: 4, width: x(share.value) - 1, height: 6}));
  if (share.interval) {
    const [low, high] = share.interval.map(x);
    for (const at of [`M${low} 7H${high}`, `M${low} 2V12`, `M${high} 2V12`]) drawing.append(svg("path", {class: "whisker", d: at}));
  }
  return drawing;
}

const STANDING = {
  best: ["★", "the best"],
  tied: ["=", "as good as the best: the interval of their paired difference holds zero"],
  untold: ["?", "the data are too few to tell it from the best"],
};

function shareCell(share, muted) {
  if (share.value === null) return element("td", {class: "share"}, "n/a");
  const mark = STANDING[share.standing];
  return element("td", {class: "share"}, shareScale(share, muted),
    element("span", {class: "number"}, fixed(100 * share.value, 1), " %"),
    mark ? element("abbr", {class: "standing", title: mark[1]}, mark[0]) : element("span", {class: "standing"}),
    element("small", {}, share.interval ? `${fixed(100 * share.interval[0], 0)} to ${fixed(100 * share.interval[1], 0)} %` : " "));
}

function lossesCell(method) {
  const told = method.per_minute === null ? "" : `${numberText(method.per_minute, 1)}${intervalText(method.per_minute_interval, 1)} / min`;
  const silent = method.losses - (method.kinds.Declared || 0);
  return element("td", {}, element("span", {class: "number"}, String(method.losses)),
    element("small", {}, silent ? `${silent} silent` : "", silent && told ? ", " : "", told));
}

function recoverCell(method) {
  if (method.losses === 0) return element("td", {class: "none"}, "–");
  const value = method.recover_s === null ? `> ${numberText(method.watched_s, 2)}` : numberText(method.recover_s, 2);
  return element("td", {}, element("span", {class: "number"}, value, " s"),
    element("small", {}, `${method.recovered} of ${method.losses} recovered${intervalText(method.recover_interval, 2)}`));
}

/** Finer than two standard deviations of the labels says nothing of the method. */
function errorCell(method) {
  if (method.error_px === null) return element("td", {class: "none"}, "n/a");
  const least = 2 * (method.sigma_px || 0);
  const value = method.error_px < least ? `< ${fixed(least, 2)}` : fixed(method.error_px, 2);
  return element("td", {}, element("span", {class: "number"}, value, " px"),
    element("small", {}, `${numberText(method.error_percent, 1)} % of D${method.error_px < least ? "" : intervalText(method.error_interval, 1)}`));
}

function costCell(method) {
  if (method.wall_ms === null) return element("td", {class: "none"}, "n/a");
  return element("td", {}, element("span", {class: "number"}, fixed(method.wall_ms, method.wall_ms < 10 ? 2 : 0), " ms"),
    element("small", {}, `p95 ${fixed(method.wall_p95_ms, method.wall_p95_ms < 10 ? 2 : 0)} ms`));
}

const COLUMNS = [
  ["Available", "Share of the time the target could be seen during which the newest right answer was at most 0.1 s old"],
  ["Recognized", "Share of the delivered frames with a visible target on which it was found"],
  ["Losses", "How often a lock was lost, by the event rules"],
  ["Time to recover", "Median from a loss until the method has the target again by itself (Kaplan-Meier)"],
  ["Off by", "Median distance from the true centre where it was found"],
  ["Costs", "Median wall time of a frame"],
];

function answerTable(table, caption) {
  const body = element("tbody");
  let yardsticks = false;
  for (const method of table.methods) {
    if (method.yardstick && !yardsticks) {
      yardsticks = true;
      body.append(element("tr", {class: "divider"}, element("th", {colspan: 7, scope: "colgroup"}, "Yardsticks: how hard it was")));
    }
    body.append(element("tr", {class: method.yardstick ? "yardstick" : null}, element("th", {scope: "row"}, method.method),
      shareCell(method.availability, method.yardstick), shareCell(method.recognition, method.yardstick),
      lossesCell(method), recoverCell(method), errorCell(method), costCell(method)));
  }
  return element("div", {class: "wide", tabindex: 0, role: "region", "aria-label": caption},
    element("table", {class: "answer"}, element("caption", {}, caption),
      element("thead", {}, element("tr", {}, element("th", {scope: "col"}, "Method"),
        ...COLUMNS.map(([name, says]) => element("th", {scope: "col", title: says}, name)))), body));
}

function drawAnswers(section) {
  for (const table of data.tables) {
    section.append(element("p", {class: "lead"}, table.words.join(" ")));
    section.append(answerTable(table, table.heading));
    if (table.remarks.length) section.append(element("ul", {class: "remarks"}, ...table.remarks.map(text => element("li", {}, text))));
    if (table.targets.length) {
      const each = element("details", {}, element("summary", {}, `The same for each of ${table.targets.length} targets`));
      for (const target of table.targets) each.append(answerTable(target, `target ${target.target}`));
      section.append(each);
    }
  }
  section.append(element("p", {class: "note"}, "Whiskers and brackets are 95 % intervals, where the data tell them. ",
    "★ the best; = as good as the best by the paired difference; ? too few data to tell; yardsticks apart. ",
    "“>”: no more than half recovered while they were watched. “<”: below the accuracy of the labels. ",
    "D is the size of the target in the picture. mute never answers, still says the first place for ever, linear goes on at the first velocity, oracle knows the truth."));
}
