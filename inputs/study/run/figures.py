# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact force against time, restitution against inelasticity: computed values over closed forms.  Colours and the
writing of all figures."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

Force = Callable[[np.ndarray], np.ndarray]

# Okabe and Ito's colours, told apart by all kinds of eyes and in grey.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MARKERS = ("o", "s", "^", "D", "v", "P")


@dataclass(frozen=True)
class Curve:
    """A computed history, t [s] and F [N], and what it is compared with."""

    label: str
    t: np.ndarray
    F: np.ndarray
    exact: Force
    paper: Force | None = None  # eq. 35 for this curve's own parameters


@dataclass(frozen=True)
class Line:
    """A closed form that belongs to no computed curve, in black."""

    label: str
    force: Force
    style: str


def force_figure(
    path: Path,
    title: str,
    curves: Sequence[Curve],
    exact_label: str,
    lines: Sequence[Line] = (),
) -> None:
    """Computed forces as markers over their closed forms; SI in, microseconds on the axis."""
    figure = Figure(figsize=(9.0, 4.6), layout="constrained")
    axes = figure.subplots()
    t = np.linspace(0.0, 1.04 * max(contact_end(curve) for curve in curves), 801)
    for curve, colour, marker in zip(curves, COLOURS, MARKERS):
        axes.plot(1e6 * t, curve.exact(t), color=colour, linewidth=1.3)
        if curve.paper:
            axes.plot(1e6 * t, curve.paper(t), color=colour, linewidth=1.0, linestyle=":")
        every = max(1, len(curve.t) // 32)
        shown = slice(every // 2, np.count_nonzero(curve.t <= contact_end(curve)), every)
        style = dict(linestyle="none", marker=marker, markersize=4.5, markerfacecolor="none")
        axes.plot(1e6 * curve.t[shown], curve.F[shown], color=colour, label=curve.label, **style)
    for line in lines:
        style = dict(color="k", linewidth=1.2, linestyle=line.style)
        axes.plot(1e6 * t, line.force(t), label=line.label, **style)
    handles, labels = axes.get_legend_handles_labels()
    handles.append(Line2D([], [], color="0.4", linewidth=1.3))
    labels.append(exact_label)
    if any(curve.paper for curve in curves):
        handles.append(Line2D([], [], color="0.4", linewidth=1.0, linestyle=":"))
        labels.append("eq. 35 of the paper")
    beside = dict(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    legend = axes.legend(handles, labels, title="markers: computed", frameon=False, **beside)
    legend.set_alignment("left")
    axes.set(title=title, xlabel="time [µs]", ylabel="contact force [N]", xlim=(0.0, 1e6 * t[-1]))
    axes.set_ylim(bottom=0.0)
    axes.grid(color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)
    save(figure, path)


@dataclass(frozen=True)
class Mark:
    """One impact: Zener's inelasticity [-], and the restitution [-] without and with correction."""

    label: str
    inelasticity: float
    uncorrected: float
    corrected: float


@dataclass(frozen=True)
class Theory:
    """A curve restitution(inelasticity), in black."""

    label: str
    inelasticity: np.ndarray
    restitution: np.ndarray
    style: str


def restitution_figure(path: Path, marks: Sequence[Mark], curves: Sequence[Theory]) -> None:
    """Computed restitutions over those of theories; below, how far from the first of these all are."""
    figure = Figure(figsize=(10.5, 6.0), layout="constrained")
    axes, below = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 2.0))
    first = curves[0]

    def difference(x: np.ndarray | float, e: np.ndarray | float) -> np.ndarray:
        return e - np.interp(x, first.inelasticity, first.restitution)

    for curve in curves:
        line = dict(color="k", linewidth=1.2, linestyle=curve.style)
        axes.plot(curve.inelasticity, curve.restitution, label=curve.label, **line)
        below.plot(curve.inelasticity, difference(curve.inelasticity, curve.restitution), **line)
    looks = [(marker, colour) for marker in MARKERS for colour in COLOURS]
    for mark, (marker, colour) in zip(marks, looks):
        style = dict(linestyle="none", marker=marker, markersize=7.0, color=colour)
        axes.plot(mark.inelasticity, mark.corrected, label=mark.label, **style)
        below.plot(mark.inelasticity, difference(mark.inelasticity, mark.corrected), **style)
        style["markerfacecolor"] = "none"
        axes.plot(mark.inelasticity, mark.uncorrected, **style)
        below.plot(mark.inelasticity, difference(mark.inelasticity, mark.uncorrected), **style)
    beside = dict(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    legend = axes.legend(frameon=False, title="filled: corrected\nhollow: uncorrected, coarse mesh", **beside)
    legend.set_alignment("left")
    axes.set(title="Thin plates: how much of its speed a ball keeps", ylabel="restitution", ylim=(0.0, 1.0))
    below.set(xlabel=r"inelasticity $\lambda = \alpha m/T$", ylabel="less Zener's", xlim=(0.0, first.inelasticity[-1]))
    for each in (axes, below):
        each.grid(color="0.92", linewidth=0.6)
        each.set_axisbelow(True)
    save(figure, path)


def contact_end(curve: Curve) -> float:
    """Time of the last sample with a force [s]."""
    return curve.t[curve.F > 0.0][-1]


def save(figure: Figure, path: Path) -> None:
    """Writes the picture as a whole or not at all."""
    partial = path.with_name(path.name + ".partial")
    figure.savefig(partial, dpi=180, format="png")
    os.replace(partial, path)
