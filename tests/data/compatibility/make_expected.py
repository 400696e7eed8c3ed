#!/usr/bin/env python3
"""Makes the sequences in this folder and lets the toolkits score them.

Usage: make_expected.py GOT10K VOT EVO      the toolkits' sources, see README.md

Only the toolkits' own functions compute scores here. What they import and do not need for that (readers of
data sets, plots, command lines) is replaced by stand-ins, so that no data set is asked for.
"""
import importlib.abc
import importlib.machinery
import json
import math
import os
import sys
import types

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
PICTURE = (320, 240)


class StandIn(type):
    def __getattr__(cls, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return Anything


class Anything(metaclass=StandIn):
    def __init__(self, *args, **kwargs):
        pass

    def __call__(self, *args, **kwargs):
        return args[0] if args and callable(args[0]) else Anything()

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return Anything()


class StandInFinder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds what the toolkits import and these scores do not need."""

    NAMES = {"PIL", "attributee", "bidict", "cachetools", "class_registry", "colorama", "cv2", "dateutil",
             "fire", "lazy_object_proxy", "matplotlib", "numexpr", "phx", "pylatex", "rosbags", "requests", "six", "tqdm", "trax",
             "tkinter", "wget", "yaml", "seaborn", "pandas"}

    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] not in self.NAMES:
            return None
        return importlib.machinery.ModuleSpec(name, self, is_package=True)

    def create_module(self, spec):
        module = types.ModuleType(spec.name)
        module.__getattr__ = lambda name: self.missing(name)
        return module

    @staticmethod
    def missing(name):
        if name.startswith("__"):
            raise AttributeError(name)
        return Anything

    def exec_module(self, module):
        pass


class Dice:
    """Numbers in [-1, 1], the same everywhere."""

    def __init__(self, seed):
        self.state = seed

    def roll(self):
        self.state = (self.state * 1103515245 + 12345) % 2**31
        return self.state / 2**30 - 1


def write(name, lines):
    path = os.path.join(HERE, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as out:
        out.writelines(line + "\n" for line in lines)


def numbers(cells, form="%.3f"):
    return ",".join(form % cell for cell in cells)


def boxes(name, frames, seed, wander, reach):
    """True boxes on a loop of radius `reach`, and answers that wander off by up to `wander` px."""
    dice = Dice(seed)
    truth, answers = [], []
    for i in range(frames):
        angle = 2 * math.pi * i / frames
        w, h = 40 + 15 * math.sin(angle), 30 + 6 * math.cos(3 * angle)
        x, y = 140 + reach * math.cos(angle), 105 + 0.75 * reach * math.sin(angle)
        off = wander * (i / frames)
        truth.append([round(v, 3) for v in (x, y, w, h)])
        answers.append([round(v, 3) for v in (x + off * dice.roll(), y + off * dice.roll(),
                                              w + 5 * dice.roll(), h + 5 * dice.roll())])
    answers[0] = truth[0]
    return np.array(truth), np.array(answers)


def make_boxes():
    sequences = {"inside": boxes("inside", 120, 1, 40, 60), "lost": boxes("lost", 150, 2, 250, 90),
                 "border": boxes("border", 80, 3, 30, 170)}
    truth, answers = sequences["border"]
    answers[20:25] = 0  # nothing said
    for name, (truth, answers) in sequences.items():
        cover = [8] * len(truth)
        if name == "border":
            cover[10:14] = [0] * 4
        write(f"boxes/{name}/groundtruth.txt", map(numbers, truth))
        write(f"boxes/{name}/answers.txt", map(numbers, answers))
        write(f"boxes/{name}/cover.label", map(str, cover))
    return sequences


def load(name):
    return np.loadtxt(os.path.join(HERE, name), delimiter=",")


def score_got10k(sequences):
    from got10k.experiments.got10k import ExperimentGOT10k
    from got10k.utils.metrics import rect_iou

    experiment = ExperimentGOT10k.__new__(ExperimentGOT10k)
    experiment.nbins_iou = 101
    result, pooled = {}, []

    def scores(ious):
        ao, sr, _, curve = experiment._evaluate(ious, np.array([]))
        return {"frames": len(ious), "ao": ao, "sr50": sr, "success": list(curve)}

    for name in sequences:
        cover = load(f"boxes/{name}/cover.label")[1:]
        answers, truth = load(f"boxes/{name}/answers.txt"), load(f"boxes/{name}/groundtruth.txt")
        ious = rect_iou(answers[1:], truth[1:], bound=PICTURE)[cover > 0]
        result[name] = scores(ious)
        pooled.append(ious)
    result["all"] = scores(np.concatenate(pooled))
    return result


def score_otb(sequences):
    from got10k.experiments.otb import ExperimentOTB

    experiment = ExperimentOTB.__new__(ExperimentOTB)
    experiment.nbins_iou, experiment.nbins_ce = 21, 51
    result, success, precision = {}, [], []
    for name in sequences:
        answers, truth = load(f"boxes/{name}/answers.txt"), load(f"boxes/{name}/groundtruth.txt")
        answers[0] = truth[0]
        curves = experiment._calc_curves(*experiment._calc_metrics(answers, truth))
        success.append(curves[0])
        precision.append(curves[1])
        result[name] = {"success": list(curves[0]), "precision": list(curves[1])}
    result["all"] = {"success": list(np.mean(success, axis=0)), "precision": list(np.mean(precision, axis=0))}
    return result


def corners(cx, cy, w, h, angle, skew):
    c, s = math.cos(angle), math.sin(angle)
    square = [(-w, -h), (w, -h * (1 + skew)), (w, h), (-w, h)]
    return [v for x, y in square for v in (cx + (c * x - s * y) / 2, cy + (s * x + c * y) / 2)]


def make_regions(name, frames, seed, polygons, failures):
    """A VOT result file: a start, regions, a failure every now and then, four frames of nothing."""
    dice = Dice(seed)
    truth, answers, restart = [], [], 0
    for i in range(frames):
        angle = 2 * math.pi * i / frames
        cx, cy = 160 + 150 * math.cos(angle + seed), 120 + 60 * math.sin(2 * angle)
        w, h = 45 + 12 * math.sin(angle), 28 + 7 * math.cos(angle)
        off = 12.0 * (i - restart) / frames + 4
        if polygons:
            truth.append(numbers(corners(cx, cy, w, h, angle, 0.2)))
            answers.append(numbers(corners(cx + off * dice.roll(), cy + off * dice.roll(), w, h,
                                           angle + 0.2 * dice.roll(), 0)))
        else:
            truth.append(numbers((cx - w / 2, cy - h / 2, w, h)))
            answers.append(numbers((cx - w / 2 + off * dice.roll(), cy - h / 2 + off * dice.roll(), w, h)))
        if i == restart:
            answers[i] = "1"
        if i < restart:
            answers[i] = "0"
        if i in failures:
            answers[i], restart = "2", i + 5
    write(f"regions/{name}/groundtruth.txt", truth)
    write(f"regions/{name}/{name}_001.txt", answers)


def make_all_regions():
    make_regions("boxes", 150, 1, False, [40, 100])
    make_regions("polygons", 200, 2, True, [30, 90, 197])
    make_regions("whole", 120, 3, True, [])
    return ["boxes", "polygons", "whole"]


class Sequence:
    def __init__(self, truth):
        self.truth = truth
        self.size = PICTURE

    def groundtruth(self):
        return self.truth


def score_vot(names, low, high):
    from vot.analysis.supervised import (compute_accuracy, compute_eao_curve, count_failures,
                                         locate_failures_inits)
    from vot.region import calculate_overlaps
    from vot.region.io import read_trajectory

    result, overlaps_all, success_all = {}, [], []
    accuracy_sum = failure_sum = frames = 0
    for name in names:
        truth = read_trajectory(os.path.join(HERE, f"regions/{name}/groundtruth.txt"))
        regions = read_trajectory(os.path.join(HERE, f"regions/{name}/{name}_001.txt"))
        overlaps = calculate_overlaps(regions, truth, PICTURE)
        accuracy = compute_accuracy(regions, Sequence(truth), 10, True, True)[0]
        failures = count_failures(regions)[0]
        result[name] = {"overlaps": overlaps, "accuracy": float(accuracy), "failures": failures}
        accuracy_sum += accuracy * len(truth)
        failure_sum += failures * len(truth)
        frames += len(truth)
        # As EAOCurve.subcompute takes a trajectory apart.
        failed, started = locate_failures_inits(regions)
        for start, end in zip(started, failed):
            overlaps_all.append(overlaps[start:end])
            success_all.append(False)
        if len(started) > len(failed):
            overlaps_all.append(overlaps[started[-1]:])
            success_all.append(True)
    curve = compute_eao_curve(overlaps_all, [1] * len(overlaps_all), success_all)
    failures, accuracy = failure_sum / frames, accuracy_sum / frames
    # As AverageAccuracyRobustness.aggregate and EAOScore.compute have it.
    result["all"] = {"accuracy": float(accuracy), "failures_mean": failures,
                     "robustness": math.exp(-30 * failures / (frames / len(names))),
                     "curve": [float(v) for v in curve], "low": low, "high": high,
                     "eao": float(np.mean(curve[low:high + 1]))}
    return result


ANCHORS = {"boxes": ([0, 60], [149]), "polygons": ([0, 50, 100], [199])}


def make_multistart():
    """A result file for each anchor: answers go astray for longer the later a run is."""
    from vot.region.io import read_trajectory

    for name, (forward, backward) in ANCHORS.items():
        truth = read_trajectory(os.path.join(HERE, f"regions/{name}/groundtruth.txt"))
        dice = Dice(11)
        for anchor in forward + backward:
            played = truth[anchor::-1] if anchor in backward else truth[anchor:]
            lines = ["1"]
            for i, region in enumerate(played[1:], 1):
                astray = 70 if 20 < i < 24 or (anchor in (60, 100, 199) and 50 < i < 62) else 9
                lines.append(str(region.move(round(astray * dice.roll()), round(astray * (1 + dice.roll()) / 2))))
            write(f"regions/{name}/{name}_{anchor:08d}.txt", lines)


def score_multistart(low, high):
    from vot.analysis import multistart
    from vot.region.io import read_trajectory

    class Played:
        def __init__(self, sequence, frames):
            self.truth = [sequence.truth[i] for i in frames]
            self.size = PICTURE

        def object(self, name):
            return None

        def groundtruth(self, i=None):
            return self.truth if i is None else self.truth[i]

        def __len__(self):
            return len(self.truth)

    class Recording:
        def __init__(self, name):
            self.name = name
            self.truth = read_trajectory(os.path.join(HERE, f"regions/{name}/groundtruth.txt"))

        def __len__(self):
            return len(self.truth)

    class Stored:
        def __init__(self, regions):
            self.stored = regions

        @staticmethod
        def exists(results, name):
            return True

        @staticmethod
        def read(results, name):
            return Stored(read_trajectory(os.path.join(HERE, f"regions/{name.split('_')[0]}/{name}.txt")))

        def regions(self):
            return self.stored

    multistart.find_anchors = lambda sequence, _: ANCHORS[sequence.name]
    multistart.FrameMapSequence, multistart.Trajectory = Played, Stored

    def analysis(kind):
        made = kind.__new__(kind)
        made.burnin, made.grace, made.threshold, made.ignore_masks, made.high = 10, 10, 0.1, "_ignore", high
        return made

    experiment = types.SimpleNamespace(results=lambda *_: None, anchor="anchor")
    sequences = [Recording(name) for name in ANCHORS]

    def each(kind):
        return [analysis(kind).subcompute(experiment, None, sequence, []) for sequence in sequences]

    shares = each(multistart.AccuracyRobustness)
    total = analysis(multistart.AverageAccuracyRobustness).aggregate(None, sequences, shares)
    averaged = analysis(multistart.EAOCurve)
    averaged.curves = types.SimpleNamespace(high=high)
    curve = averaged.aggregate(None, sequences, each(multistart.EAOCurves))[0]
    return {"accuracy": total[0], "robustness": total[1], "low": low, "high": high,
            "curve": [float(v) for v in curve], "eao": float(np.mean(curve[low:high + 1]))}


def make_paths():
    dice = Dice(7)
    truth, answers = [], []
    for i in range(60):
        t = 0.04 * i
        x, y = 100 + 80 * math.cos(t), 90 + 50 * math.sin(1.7 * t)
        truth.append(f"{t:.6f} {x:.4f} {y:.4f} 0 0 0 0 1")
        if i % 7 != 3:
            turned = (1.1 * (0.98 * x - 0.2 * y) + 12 + dice.roll(), 1.1 * (0.2 * x + 0.98 * y) - 5 + dice.roll())
            answers.append(f"{t:.6f} {turned[0]:.4f} {turned[1]:.4f} 0 0 0 0 1")
    write("paths/truth.txt", truth)
    write("paths/answers.txt", answers)


def score_evo():
    from evo.core import metrics, sync
    from evo.tools import file_interface

    result = {}
    for name, align, scale in (("none", False, False), ("rigid", True, False), ("similarity", True, True)):
        truth = file_interface.read_tum_trajectory_file(os.path.join(HERE, "paths/truth.txt"))
        answers = file_interface.read_tum_trajectory_file(os.path.join(HERE, "paths/answers.txt"))
        truth, answers = sync.associate_trajectories(truth, answers)
        if align:
            answers.align(truth, correct_scale=scale)
        ape = metrics.APE(metrics.PoseRelation.translation_part)
        ape.process_data((truth, answers))
        result[name] = {k: float(v) for k, v in ape.get_all_statistics().items()}
        result[name]["frames"] = len(ape.error)
    return result


def main():
    sys.path[:0] = sys.argv[1:4]
    sys.meta_path.append(StandInFinder())
    expected = {}
    sequences = make_boxes()
    expected["got10k"] = score_got10k(sequences)
    expected["otb"] = score_otb(["inside", "lost"])
    expected["vot"] = score_vot(make_all_regions(), 20, 90)
    make_multistart()
    expected["vot-multistart"] = score_multistart(30, 160)
    make_paths()
    expected["evo"] = score_evo()
    for toolkit, scores in expected.items():
        with open(os.path.join(HERE, f"expected-{toolkit}.json"), "w") as out:
            json.dump(scores, out, indent=1)
            out.write("\n")


main()
