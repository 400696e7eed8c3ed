// Puts the page together: first what is looked at first.

function command(text) {
  return element("pre", {tabindex: 0}, element("code", {}, text));
}

function drawProvenance(section) {
  const {provenance} = data;
  section.append(element("p", {}, `Made by relock ${provenance.relock}. These commands make it again, with the same bytes but for what depends on the clock (the column Costs):`),
    command(provenance.commands.join("\n")));
  const names = ["recording", "method", "options", "protocol", "gaps", "seed", "program", "opencv", "fingerprint", "failures"];
  const same = names.filter(name => provenance.runs.length > 1 && provenance.runs.every(run => String(run[name]) === String(provenance.runs[0][name])));
  const differ = names.filter(name => !same.includes(name));
  const shownAs = value => Array.isArray(value) ? value.join("; ") || "none" : String(value) || "none";
  if (same.length)
    section.append(element("dl", {class: "facts"}, ...same.flatMap(name => [element("dt", {}, name), element("dd", {}, shownAs(provenance.runs[0][name]))])));
  const body = element("tbody");
  const fold = element("details", {}, element("summary", {}, `All ${provenance.runs.length} runs`), element("div", {class: "wide"},
    element("table", {class: "plain"}, element("thead", {}, element("tr", {}, ...differ.map(name => element("th", {scope: "col"}, name)))), body)));
  fold.addEventListener("toggle", () => {
    if (body.children.length) return;
    for (const run of provenance.runs) body.append(element("tr", {}, ...differ.map(name => element("td", {}, shownAs(run[name])))));
  });
  section.append(fold);
}

function chooseTheme() {
  const button = document.getElementById("theme"), dark = matchMedia("(prefers-color-scheme: dark)");
  const set = isDark => {
    document.documentElement.dataset.theme = isDark ? "dark" : "light";
    button.setAttribute("aria-pressed", isDark ? "true" : "false");
  };
  set(dark.matches);
  dark.addEventListener("change", () => { set(dark.matches); drawAll(); });
  button.addEventListener("click", () => { set(document.documentElement.dataset.theme !== "dark"); drawAll(); });
}

function drawOnPaper() {
  let before = null;
  addEventListener("beforeprint", () => {
    before = document.documentElement.dataset.theme;
    document.documentElement.dataset.theme = "light";
    document.documentElement.classList.add("paper");  // its width is what everything is drawn for
    for (const node of [...waiting.keys()]) showNow(node);
    drawAll();
  });
  addEventListener("afterprint", () => {
    document.documentElement.dataset.theme = before;
    document.documentElement.classList.remove("paper");
    drawAll();
  });
}

function redrawWhenResized() {
  let width = innerWidth, timer = 0;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    clearTimeout(timer);
    timer = setTimeout(drawAll, 80);
  });
}

document.title = `${data.title} – relock report`;
document.getElementById("title").textContent = data.title;
chooseTheme();
drawAnswers(document.getElementById("answer"));
drawTimelines(document.getElementById("timelines"));
document.documentElement.dataset.timelineMs = Math.round(performance.now());
requestAnimationFrame(() => setTimeout(() => {
  drawWhy(document.getElementById("why"));
  drawLossesSection(document.getElementById("losses"));
  drawProvenance(document.getElementById("provenance"));
  document.documentElement.dataset.ready = Math.round(performance.now());
}));
drawOnPaper();
redrawWhenResized();
