"""All results at a glance, as plots."""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from .judge import Row, best_errors
from .standings import classes, standings

#: Colours of programs: fairmesh's, and all others'.
OWN, OTHER = "#c0392b", "#5d6d7e"
COLUMNS = 3
#: Factors over the nearest result that are shown.
MOST = 100.0


def plots(rows: list[Row], folder: Path) -> list[str]:
    """Writes them, and gives the lines of Markdown that show them."""
    return [errors(rows, folder), profiles(rows, folder)]


def errors(rows: list[Row], folder: Path) -> str:
    """Every result as a dot, programs in the order of their means, which are strokes from the least seed's to the largest."""
    all_classes = classes(rows)
    height = math.ceil(len(all_classes) / COLUMNS)
    figure, axes = plt.subplots(height, COLUMNS, figsize=(13, 2.9 * height), layout="constrained", squeeze=False)
    for axis, ((family, task), some) in zip(axes.flat, all_classes.items(), strict=False):
        _class(axis, some)
        axis.set_title(f"{task}, {family}", fontsize=10)
    for axis in axes.flat[len(all_classes) :]:
        axis.set_visible(False)
    figure.savefig(folder / "errors.png", dpi=80)
    plt.close(figure)
    return "Every result's distance from the truth, in per cent of the width (left is nearer):\n\n![errors by class and program](benchmark/errors.png)"


def _class(axis: Axes, rows: list[Row]) -> None:
    order = standings(rows)[::-1]
    for place, one in enumerate(order):
        colour = OWN if one.program.startswith("fairmesh") else OTHER
        far = [100 * max(each.error(), 1e-5) for each in one.rows]
        axis.plot(far, [place] * len(far), "o", color=colour, alpha=0.3, markersize=3)
        axis.plot([100 * min(one.of_seeds), 100 * max(one.of_seeds)], [place, place], color=colour, linewidth=3)
        axis.plot([100 * one.mean], [place], "|", color=colour, markersize=12, markeredgewidth=2)
    axis.set_xscale("log")
    axis.set_yticks(range(len(order)), [one.program for one in order], fontsize=8)
    axis.tick_params(axis="x", labelsize=8)
    axis.grid(axis="x", alpha=0.3)


def profiles(rows: list[Row], folder: Path) -> str:
    """For each task the share of cases in which a program is at most so many times as far as the nearest one (Dolan and More, 2002)."""
    tasks = [task for task in dict.fromkeys(one.task for one in rows) if len({one.program for one in rows if one.task == task}) > 2]
    figure, axes = plt.subplots(1, len(tasks), figsize=(13, 3.6), layout="constrained", squeeze=False)
    for axis, task in zip(axes.flat, tasks, strict=True):
        some = [one for one in rows if one.task == task]
        best = best_errors(some)
        for name in dict.fromkeys(one.program for one in some):
            ratios = sorted(one.error() / best[one.problem()] if one.rms is not None else math.inf for one in some if one.program == name)
            width = 2.5 if name.startswith("fairmesh") else 1.2
            done = [ratio for ratio in ratios if ratio < MOST]
            shares = [k / len(ratios) for k in range(len(done) + 1)]
            axis.step([1, *done, MOST], [*shares, shares[-1]], where="post", label=name, linewidth=width)
        axis.set(xscale="log", xlim=(1, MOST), ylim=(0, 1.02), xlabel="times as far as the nearest", title=task)
        axis.legend(fontsize=7)
    figure.savefig(folder / "profiles.png", dpi=80)
    plt.close(figure)
    return "The share of cases in which a program is at most so many times as far as the nearest one:\n\n![profiles by task](benchmark/profiles.png)"
