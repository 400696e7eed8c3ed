#!/usr/bin/env python3
"""A clip labelled as a person does it, in Chromium: by mouse and keys, with relock killed in the middle.

Usage: label_test.py RELOCK PICTURES      from the project's root; PICTURES: a folder for screenshots
"""

import csv
import json
import os
import re
import shutil
import signal
import subprocess
import urllib.error
import urllib.request

import checks
from checks import expect

FRAMES, GAP = 30, 14  # the clip's frames; after this one some are missing
SHIFT, CONTROL, ENTER, DELETE, RIGHT, END, HOME = "\ue008", "\ue009", "\ue007", "\ue017", "\ue014", "\ue010", "\ue011"


def made_clip(folder):
    """The first frames of real footage, with a gap, and without its labels. And where its target truly is."""
    os.makedirs(f"{folder}/images")
    for frame in range(1, FRAMES + 1):
        shutil.copy(f"recordings/klahaag/images/{frame:05}.jpg", f"{folder}/images")
    with open(f"{folder}/timestamps.csv", "w", encoding="utf-8") as times:
        times.write("timestamp_ns\n")
        for frame in range(FRAMES):
            times.write(f"{33333333 * (frame + (4 if frame > GAP else 0))}\n")
    with open("recordings/klahaag/labels.csv", encoding="utf-8") as labels:
        rows = [{k: float(row[k]) for k in ("x", "y", "width", "height")} for row in csv.DictReader(labels)]
    return [(r["x"], r["y"], r["width"], r["height"]) for r in rows[:FRAMES]]


class Labelling:
    """`relock label`, running."""

    def __init__(self, clip):
        self.process = subprocess.Popen([checks.program, "label", clip, "--no-browser"], stdout=subprocess.PIPE, text=True)
        self.link = re.search(r"http://127\.0\.0\.1:\d+/[0-9a-f]+/", self.process.stdout.readline())[0]

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self.process.stdout.close()

    def ask(self, path, body=None, **headers):
        """Status and what was said."""
        request = urllib.request.Request(path if path.startswith("http") else self.link + path, body, headers)
        try:
            with urllib.request.urlopen(request) as answer:
                return answer.status, answer.read().decode()
        except urllib.error.HTTPError as fault:
            return fault.code, fault.read().decode()


class Hand:
    """On mouse and keys."""

    def __init__(self, browser):
        self.browser = browser

    def open(self, link):
        self.browser._ask("POST", "/url", {"url": link})
        expect("the page is there", True, self.browser.wait_for("window.page && page.data && page.bitmapFrame === page.frame"))

    def place(self, *points):
        """Where points of the picture are in the window."""
        return self.browser.run("""const r = document.getElementById('picture').getBoundingClientRect(), v = page.view;
            return arguments[0].map((p) => { const [x, y] = v.onCanvas(p); return [r.left + x / v.ratio, r.top + y / v.ratio]; });""", points)

    def drag(self, a, b):
        a, b = self.place(a, b)
        self.browser.pointer(("move", *a), ("down",), ("move", *b), ("up",))
        self.settle()

    def click(self, p):
        self.browser.pointer(("move", *self.place(p)[0]), ("down",), ("up",))
        self.settle()

    def press(self, *chord):
        actions = [{"type": "keyDown", "value": key} for key in chord] + [{"type": "keyUp", "value": key} for key in reversed(chord)]
        self.browser._ask("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def type(self, *chord):
        self.press(*chord)
        self.settle()

    def settle(self):
        expect("everything is saved and shown", True, self.browser.wait_for("!page.saving && page.bitmapFrame === page.frame && !page.waits", 20))

    def look(self, expression):
        return self.browser.run(f"return {expression}")

    def hold(self, key, kind):
        self.browser._ask("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": [{"type": kind, "value": key}]}]})

    def box(self, box):
        """Drawn anew, whatever is there."""
        x, y, width, height = box
        self.hold(SHIFT, "keyDown")
        self.drag((x, y), (x + width, y + height))
        self.hold(SHIFT, "keyUp")


def keys_on_disk(clip):
    with open(f"{clip}/labels.keys.json", encoding="utf-8") as file:
        return json.load(file)["targets"]


def labels_on_disk(clip):
    with open(f"{clip}/labels.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def middle(row):
    return float(row["x"]) + float(row["width"]) / 2, float(row["y"]) + float(row["height"]) / 2


def is_led_through_the_clip(hand, clip, truth, labelling):
    """Clicks where the page leads, until it needs no more. relock is killed after the third."""
    hand.type("b")
    clicks = 0
    while clicks < FRAMES and (next_click := hand.look("page.data.targets[0].to_go.next")):
        hand.type("n")
        expect("N leads there", next_click["frame"], hand.look("page.frame"))
        hand.box(truth[next_click["frame"]])
        clicks += 1
        expect("what was placed is on disk at once", clicks, len(keys_on_disk(clip)[0]["keys"]))
        if clicks == 3:
            before, seen = keys_on_disk(clip), hand.look("page.data.targets")
            labelling.kill()
            hand.press("a")
            expect("that relock is gone is told", True, hand.browser.wait_for("!document.getElementById('fault').hidden"))
            labelling = Labelling(clip)
            hand.open(labelling.link)
            hand.browser.wait_for("!page.data.looking")
            expect("nothing is lost", before, keys_on_disk(clip))
            expect("it is all shown again", [t["keys"] for t in seen], hand.look("page.data.targets.map((t) => t.keys)"))
            hand.type("b")
        hand.browser.wait_for("!page.data.looking")
    expect("a click on every other frame is more than it needs, though the camera jerks", True, 2 <= clicks < FRAMES // 2)
    rows = labels_on_disk(clip)
    expect("every frame has a label", list(range(FRAMES)), [int(row["frame"]) for row in rows])
    expect("of a hand or of the curve", {"hand": clicks, "spline": FRAMES - clicks},
           {s: [row["source"] for row in rows].count(s) for s in ("hand", "spline")})
    off = [max(abs(a - b) for a, b in zip(middle(row), (x + w / 2, y + h / 2))) for row, (x, y, w, h) in zip(rows, truth)]
    expect("all are where the target is, to a tenth of its size", [], [f"frame {i}: {o:.1f} px" for i, o in enumerate(off) if o > 4.5])
    beyond = sum(o > 2 * max(1, float(row["sigma_px"])) for o, row in zip(off, rows))
    expect("nine of ten to two sigma, as stated", True, beyond <= FRAMES // 10)
    return labelling


def says_what_is_not_seen(hand, clip):
    hand.type(END)
    hand.type("a")
    expect("the last frame is absent", "absent", labels_on_disk(clip)[-1]["label"])
    hand.type(CONTROL, "z")
    expect("and is not any more", "visible", labels_on_disk(clip)[-1]["label"])
    hand.type(HOME)
    hand.type("g")
    expect("G goes to the frame after the gap", GAP + 1, hand.look("page.frame"))
    hand.type("o")
    expect("what is hidden keeps its place and is not visible", ("unlabelled", True),
           (labels_on_disk(clip)[GAP + 1]["label"], labels_on_disk(clip)[GAP + 1]["x"] != ""))
    hand.type(DELETE)
    expect("Delete forgets", [], [k for k in keys_on_disk(clip)[0]["keys"] if k["frame"] == GAP + 1])


def zooms_and_nudges(hand):
    hand.type(RIGHT)
    hand.type("z")
    expect("Z shows pixels", True, hand.look("page.view.scale >= 8"))
    before = hand.look("page.data.targets[0].frames.outlines[page.frame]")["box"]
    hand.type(ENTER)
    hand.type(CONTROL, RIGHT)
    after = hand.look("page.data.targets[0].frames.outlines[page.frame]")["box"]
    expect("a nudge is a pixel", [1.0, 0.0], [round(after[0] - before[0], 3), round(after[1] - before[1], 3)])
    expect("what is placed on large pixels is more exact", True, hand.look("page.data.targets[0].frames.sigma_px[page.frame] <= 0.25"))
    hand.type(CONTROL, "z")
    hand.type(CONTROL, "z")
    hand.type("z")


def has_other_targets_and_outlines(hand, clip, truth):
    hand.press(SHIFT, "T")
    hand.browser._ask("POST", "/alert/text", {"text": "<b>sign"})
    hand.browser._ask("POST", "/alert/accept")
    hand.browser._ask("DELETE", "/actions")  # the keys that were down when it opened
    hand.settle()
    hand.browser.wait_for("page.target === 1")
    hand.type(HOME)
    hand.type("q")
    quad = [(400, 200), (440, 205), (438, 240), (402, 236)]
    for corner in quad:
        hand.click(corner)
    placed = keys_on_disk(clip)[1]["keys"][0]["quad"]
    expect("a quad has its corners where they were clicked", True, all(abs(a - b) < 1 for a, b in zip(placed, sum(quad, ()))))
    hand.drag(quad[2], (450, 250))
    expect("a corner can be dragged", True, abs(keys_on_disk(clip)[1]["keys"][0]["quad"][4] - 450) < 1.5)
    hand.type(RIGHT)
    hand.type("e")
    hand.drag((300, 250), (360, 250))
    hand.click((330, 262))
    x, y, a, b, turn = keys_on_disk(clip)[1]["keys"][1]["ellipse"]
    expect("an ellipse goes along its axis, to its width", True, max(abs(x - 330), abs(y - 250), abs(a - 30), abs(b - 12)) < 1.5 and min(turn, 180 - turn) < 2)
    hand.type(RIGHT)
    hand.type("c")
    hand.click((200, 150))
    expect("a centre is where it was clicked", True, abs(keys_on_disk(clip)[1]["keys"][2]["ellipse"][0] - 200) < 1)
    expect("the other target's labels stay", "hand", next(r for r in labels_on_disk(clip) if r["target"] == "target")["source"])
    expect("a name is a name", True, hand.look("!document.querySelector('b')"))
    hand.type("t")


def strangers_are_refused(labelling):
    link, origin = labelling.link, labelling.link.rsplit("/", 2)[0]
    expect("the page itself is answered", 200, labelling.ask("state")[0])
    expect("another token is not", 403, labelling.ask(origin + "/" + "0" * 32 + "/state")[0])
    expect("nor none", 403, labelling.ask(origin + "/")[0])
    expect("nor a name that somebody made for this machine", 403, labelling.ask("state", Host="evil.example")[0])
    undo = b'{"do": "undo"}'
    expect("nor another page", 403, labelling.ask("edit", undo, Origin="http://evil.example")[0])
    for path in ("picture/../../etc/passwd", "..%2f..%2fetc%2fpasswd", "labels.csv", "images/00001.jpg", "picture/-1", "picture/99999"):
        status, said = labelling.ask(path)
        expect(f"{path} is not served", True, status in (403, 404, 422) and "root:" not in said and "frame,target" not in said)


def is_checked(clip, sheet):
    expect("the labels are checked", (0, ""), checks.relock("label", clip, "--check", "--sheet", sheet))
    with open(sheet, "rb") as picture:
        expect("and drawn on a sheet", b"\x89PNG", picture.read(4))


def refused(clip, file, content):
    """What relock says when a file is other than it left it. It must be as it was afterwards."""
    with open(file, "rb") as kept:
        before = kept.read()
    with open(file, "wb") as changed:
        changed.write(content(before))
    said = checks.relock("label", clip, "--no-browser")
    with open(file, "rb") as now:
        expect("it is not written over", content(before), now.read())
    with open(file, "wb") as back:
        back.write(before)
    return said


def foreign_files_are_refused(clip):
    keys, labels = f"{clip}/labels.keys.json", f"{clip}/labels.csv"
    for name, file, change, word in [
            ("of another recording", keys, lambda b: b.replace(b'"pictures": "', b'"pictures": "0'), "another recording"),
            ("of a newer relock", keys, lambda b: b.replace(b'"version": 1', b'"version": 2'), "newer relock"),
            ("broken in the middle", keys, lambda b: b[:len(b) // 2], "broken"),
            ("that hold something else", keys, lambda b: b'{"a": 1}', "no key frames"),
            ("changed by hand", labels, lambda b: b + b"\n", "not what relock label wrote")]:
        status, said = refused(clip, file, change)
        expect(f"labels {name} are refused in one sentence", (2, True, 1), (status, word in said, said.count("\n")))
    os.rename(keys, keys + ".away")
    status, said = checks.relock("label", clip, "--no-browser")
    expect("labels that were made otherwise are not written over", (2, True), (status, "not made by relock label" in said))
    os.rename(keys + ".away", keys)


def screenshots(hand):
    browser = hand.browser
    for name, width, height in (("large", 1600, 1000), ("small", 480, 640)):
        browser.resize(width, height)
        hand.type("n")
        hand.settle()
        expect("nothing is scrolled sideways", True, hand.look("document.documentElement.scrollWidth <= innerWidth"))
        expect("the picture has room", True, hand.look("document.getElementById('picture').clientHeight > 200"))
        browser.screenshot(f"{checks.pictures}/label-{name}.png")
    browser.resize(1280, 900)
    hand.type("?")
    browser.screenshot(f"{checks.pictures}/label-keys.png")
    hand.type("?")


def labels_a_clip(browser, work):
    clip = f"{work}/clip"
    truth = made_clip(clip)
    labelling, hand = Labelling(clip), Hand(browser)
    try:
        hand.open(labelling.link)
        labelling = is_led_through_the_clip(hand, clip, truth, labelling)
        says_what_is_not_seen(hand, clip)
        zooms_and_nudges(hand)
        has_other_targets_and_outlines(hand, clip, truth)
        screenshots(hand)
        strangers_are_refused(labelling)
        elsewhere = [url for url in browser.requests() if url.startswith("http") and not url.startswith("http://127.0.0.1:")]
        expect("nothing is fetched from elsewhere", [], elsewhere)
        told = [line for line in browser.console() if "ERR_CONNECTION" not in line and "favicon" not in line]
        expect("the console is empty, but for the time when relock was gone", [], told)
    finally:
        labelling.kill()
    is_checked(clip, f"{checks.pictures}/label-check.png")
    foreign_files_are_refused(clip)


checks.main(labels_a_clip)
