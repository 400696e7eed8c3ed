#!/usr/bin/env python3
"""The report as somebody sees it who opens it: `relock report` of a real run, in Chromium.

Usage: report_test.py RELOCK PICTURES      from the project's root; PICTURES: a folder for screenshots
"""

import checks
from checks import expect, relock


def made(folder):
    """A run on real footage with gaps, and its report."""
    results, page = f"{folder}/results", f"{folder}/report.html"
    gaps = "trace(recordings/gap_traces/tagslam_test_14_top_left.csv)"
    expect("the run is made", (0, ""), relock("run", "--sequence", "recordings/klahaag-prints", "--methods", "kcf,csrt,aruco,apriltag",
                                              "--gaps", gaps, "--seed", "5", "--out", results))
    expect("the report is made", (0, ""), relock("report", results, "-o", page))
    return page


LANES = "document.querySelectorAll('.target')[1]"  # apriltag, which kcf loses
PLACE = f"""const board = {LANES}.querySelector('.board'), line = {LANES}.timeline, lane = arguments[0], frame = arguments[1];
            board.scrollIntoView({{block: 'center'}});
            const box = board.getBoundingClientRect();
            return [box.left + line.x(line.times[frame] + line.period / 2), box.top + line.topOf(lane) + 12];"""


def place_of(browser, lane, frame):
    return browser.run(PLACE, lane, frame)


def looked_at(browser, work):
    page = made(work)
    browser.open(page)
    expect("the page is drawn", True, browser.wait_for("document.documentElement.dataset.ready"))
    data = browser.run("return JSON.parse(document.getElementById('data').textContent)")
    lanes = [lane for target in data["comparisons"][0]["targets"] for lane in target["lanes"]]
    expect("there is a lane for every method and target", len(lanes),
           browser.run("return document.querySelectorAll('.name').length"))
    expect("every loss has its mark", sum(len(lane["losses"]) for lane in lanes),
           browser.run("return [...document.querySelectorAll('.target')].reduce((sum, t) => sum + Number(t.dataset.losses), 0)"))
    told = sum(len(lane["losses"]) for lane in lanes if not lane["yardstick"])
    browser.run("for (const fold of document.querySelectorAll('details.losses')) fold.scrollIntoView()")
    expect("every loss of a method has its card", True, browser.wait_for(f"document.querySelectorAll('.loss').length === {told}"))
    expect("the answer has a row for every method", len({lane["method"] for lane in lanes}),
           browser.run("return document.querySelector('table.answer').querySelectorAll('tbody tr:not(.divider)').length"))
    hover_and_click(browser, data)
    zoom(browser)
    keys(browser)
    lines(browser)
    expect("nothing is scrolled sideways", True, browser.run("return document.documentElement.scrollWidth <= innerWidth"))
    fetched = [url for url in browser.requests() if not url.startswith("data:")]
    expect("nothing is fetched but the page itself", [f"file://{page}"], fetched)
    expect("the console is empty", [], browser.console())
    screenshots(browser)


def hover_and_click(browser, data):
    target = data["comparisons"][0]["targets"][1]
    expect("it is the target that is lost", "apriltag", target["id"])
    lane = next(i for i, lane in enumerate(target["lanes"]) if lane["losses"] and not lane["yardstick"])
    loss, method = target["lanes"][lane]["losses"][0], target["lanes"][lane]["method"]
    x, y = place_of(browser, lane, loss["lost"])
    browser.pointer(("move", x, y))
    tip = browser.run("const tip = document.getElementById('tip'); return tip.hidden ? '' : tip.innerText")
    expect("hovering tells method and frame", True, f"{method}, frame {loss['lost']}," in tip)
    expect("and time, verdict and the loss", True, " s\n" in tip and ("Miss" in tip or "Stray" in tip) and loss["what"] in tip)
    browser.screenshot(f"{checks.pictures}/hover.png")
    browser.pointer(("down",), ("up",))
    expect("a click opens the frame", True, browser.wait_for(f"document.getElementById('picture').dataset.drawn === '{loss['lost']}'"))
    expect("the picture is not empty", True, browser.run("""
        const canvas = document.querySelector('#picture canvas'), pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
        return new Set(pixels).size > 50;"""))
    expect("every answer is told beside it", len(target["lanes"]), browser.run("return document.querySelectorAll('#picture tbody tr').length"))
    browser.screenshot(f"{checks.pictures}/picture.png")
    browser.keys("\ue014")  # right
    expect("the keys go on to the next picture", True, browser.run("return Number(document.getElementById('picture').dataset.frame)") > loss["lost"])
    browser.keys("\ue00c")  # escape
    expect("escape closes it", False, browser.run("return document.getElementById('picture').open"))


def range_of(browser):
    return [float(value) for value in browser.run(f"return {LANES}.dataset.range").split()]


def zoom(browser):
    whole, marks = range_of(browser), browser.run(f"return Number({LANES}.dataset.marks)")
    x0, y = place_of(browser, 0, 10)
    x1, _ = place_of(browser, 0, 20)
    browser.pointer(("move", x0, y), ("down",), ("move", (x0 + x1) / 2, y), ("move", x1, y), ("up",))
    part = range_of(browser)
    expect("the lanes lie under the axis", True, browser.run(f"""
        const axis = {LANES}.querySelector('.u-over').getBoundingClientRect(), board = {LANES}.querySelector('.board').getBoundingClientRect();
        return Math.abs(axis.left - board.left) < 1 && Math.abs(axis.right - board.right) < 1;"""))
    expect("dragging zooms in", True, whole[0] < part[0] and part[1] < whole[1])
    expect("to what was dragged over", True, 0.15 < (part[1] - part[0]) / (whole[1] - whole[0]) < 0.25)
    expect("fewer marks are drawn then", True, browser.run(f"return Number({LANES}.dataset.marks)") < marks)
    expect("axis and lanes show the same time", part, browser.run(f"return [{LANES}.timeline.plot.scales.x.min, {LANES}.timeline.plot.scales.x.max].map(v => Number(v.toFixed(4)))"))
    browser.run(f"{LANES}.querySelector('button[aria-label=\"The whole recording\"]').click()")
    expect("a button shows all again", whole, range_of(browser))


def keys(browser):
    browser.run(f"{LANES}.querySelector('.board').focus()")
    browser.keys("n")
    said = browser.run(f"return {LANES}.querySelector('[aria-live]').textContent")
    expect("n goes to the next loss and says what it is", True, "lost" in said.lower())
    browser.keys("+")
    expect("+ zooms in", True, range_of(browser)[1] - range_of(browser)[0] < 1.7)
    browser.keys("\ue007")  # enter
    expect("enter opens the picture", True, browser.run("return document.getElementById('picture').open"))
    browser.keys("\ue00c0")
    expect("0 shows all again", 0.0, range_of(browser)[0])


def lines(browser):
    browser.run(f"{LANES}.querySelector('details.errors').open = true")
    expect("errors are drawn as lines on request", True, browser.wait_for(f"{LANES}.querySelector('.lines canvas')"))
    expect("and broken at gaps", True, browser.run(f"return {LANES}.timeline.linesPlot.data[1].includes(null)"))


def screenshots(browser):
    browser.run("scrollTo(0, 0)")
    browser.screenshot(f"{checks.pictures}/wide.png", whole_page=True)
    browser.run("document.getElementById('theme').click()")
    browser.screenshot(f"{checks.pictures}/dark.png", whole_page=True)
    browser.run("document.getElementById('theme').click()")
    browser.print(f"{checks.pictures}/print.pdf")
    browser.resize(500, 900)
    browser.wait_for("document.querySelector('.board canvas').clientWidth < 480")
    expect("nothing is scrolled sideways in a narrow window", True, browser.run("return document.documentElement.scrollWidth <= innerWidth"))
    browser.screenshot(f"{checks.pictures}/narrow.png", whole_page=True)


checks.main(looked_at)
