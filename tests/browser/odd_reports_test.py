#!/usr/bin/env python3
"""Reports of what nobody hoped for: a method that said nothing, hardly any label, one frame, names that are HTML, two
hundred methods. Every one is a page that can be read.

Usage: odd_reports_test.py RELOCK PICTURES      from the project's root; PICTURES: a folder for screenshots
"""

import json
import os
import shutil

import checks
from checks import expect, relock

CLIP = "recordings/klahaag"
SCRIPT = "</script><script>window.hacked = true</script><img src=x onerror='window.hacked = true'>"


def recording(folder, frames, labelled, name="odd"):
    """The first frames of the clip, with labels of some of them."""
    os.makedirs(f"{folder}/images")
    for i in range(frames):
        shutil.copy(f"{CLIP}/images/{i + 1:05}.jpg", f"{folder}/images")
    with open(f"{CLIP}/labels.csv") as labels, open(f"{folder}/labels.csv", "w") as own:
        own.writelines([next(labels)] + [next(labels) for _ in range(labelled)])
    with open(f"{folder}/recording.toml", "w") as description:
        description.write(f"name = {json.dumps(name)}\nrate_hz = 30.0\n[[target]]\nid = \"shirt\"\n")
    return folder


def again_as(run, names):
    """Copies of a run, as if methods of these names had made it."""
    place = os.path.dirname(run)
    record = json.load(open(f"{run}/run.json"))
    for i, name in enumerate(names):
        copy = f"{place}/copy-{i}"
        shutil.copytree(run, copy)
        record["inputs"]["method"] = name
        json.dump(record, open(f"{copy}/run.json", "w"))


def run_in(results, method):
    return next(folder for folder, _, files in os.walk(results) if "run.json" in files and os.path.basename(folder) == method)


def page_of(browser, work, name, sequence, methods="kcf,csrt", names=()):
    results, page = f"{work}/{name}", f"{work}/{name}.html"
    expect(f"{name}: the run is made", (0, ""), relock("run", "--sequence", sequence, "--methods", methods, "--out", results))
    if names:
        again_as(run_in(results, "kcf"), names)
    expect(f"{name}: the report is made", (0, ""), relock("report", results, "-o", page))
    browser.open(page)
    expect(f"{name}: the page is drawn", True, browser.wait_for("document.documentElement.dataset.ready"))
    browser.screenshot(f"{checks.pictures}/{name}.png")
    expect(f"{name}: the console is empty", [], browser.console())
    return browser.run("return JSON.parse(document.getElementById('data').textContent)")


def odd(browser, work):
    data = page_of(browser, work, "hardly-labelled", recording(f"{work}/a", 40, 1))
    target = data["comparisons"][0]["targets"][0]
    expect("without labels it is told who said a place", True, any("u" in lane["verdicts"] for lane in target["lanes"]))
    expect("and whether methods agree", True, target["agreement"] is not None)
    expect("in words, too", True, browser.run("return document.getElementById('timelines').innerText.includes('how many pairs of methods')"))
    expect("the answer does not pretend", True, "not known" in data["tables"][0]["words"][0])

    data = page_of(browser, work, "one-frame", recording(f"{work}/b", 1, 1))
    expect("a single frame has its lanes", len(data["comparisons"][0]["targets"][0]["lanes"]), browser.run("return document.querySelectorAll('.name').length"))

    data = page_of(browser, work, "script", recording(f"{work}/c", 20, 20, SCRIPT), names=[SCRIPT, "a'b\"c&d"])
    expect("names stay names", SCRIPT, browser.run("return document.getElementById('title').textContent"))
    expect("of methods, too", True, browser.run("return [...document.querySelectorAll('.name')].some(n => n.textContent === arguments[0])", SCRIPT))
    expect("and nothing of them runs", None, browser.run("return window.hacked"))

    data = page_of(browser, work, "mute", recording(f"{work}/d", 30, 30), "mute")
    expect("who said nothing has a lane of Misses", True, "M29" in next(l for l in data["comparisons"][0]["targets"][0]["lanes"] if l["method"] == "mute")["verdicts"])

    page_of(browser, work, "many", recording(f"{work}/e", 30, 30), names=[f"method-{i}" for i in range(200)])
    expect("two hundred methods have their lanes", 206, browser.run("return document.querySelectorAll('.name').length"))
    expect("and nothing is scrolled sideways", True, browser.run("return document.documentElement.scrollWidth <= innerWidth"))


checks.main(odd)
