"""How the slips of a study are distributed, and which mode of motion makes them."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.result.contract import JOINT_METER_M
from heeltoe.study.answers.answers import MODES, farther, modes
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.units.write import length, number
from heeltoe.views.figures.panels import SLIP_KINDS
from heeltoe.views.figures.studies.common import LINES, farthest, headed, slip_scale, strength_of
from heeltoe.views.figures.style import MODE_COLOURS, MODE_HATCHES, WIDTH, styled

_LABELS = {"sliding": "sliding", "slide_rocking": "slide-rocking", "drifting": "drifting"}
_POINTS = 400
# Numbers from this one on are too long to stand beside each other above bars.
_LONG = 100


@styled
def slips_figure(study: StudyResults, units: str = "si") -> Figure | None:
    """Draw which share of the runs of each model slides farther than a distance; None where nothing slides."""
    largest = farthest(study)
    if not largest > JOINT_METER_M:
        return None
    x = np.geomspace(JOINT_METER_M, largest, _POINTS)
    scale, unit = slip_scale(units)
    beyond, known = farther(study.walk, x)
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    axes = figure.subplots()
    for place, row in enumerate(study.summary):
        which = study.walk.models.index(row["model"])
        if not known[which]:
            continue
        colour, dash = LINES[place % len(LINES)]
        lost = row["runs"] - known[which]
        text = f"{row['model']} model" + (f", {lost:,} without a slip left out" if lost else "")
        axes.plot(scale * x, beyond[which] / known[which], color=colour, linestyle=dash, linewidth=1.8, label=text)
    axes.set_xscale("log")
    axes.set_ylim(0.0, None)
    axes.set_xlim(scale * x[0], scale * x[-1])
    axes.set_xlabel(f"residual slip, either way [{unit}]")
    axes.set_ylabel("share of the runs that slide farther")
    axes.legend(loc="upper right")
    return headed(figure, study, f"farther than a joint meter's {length(JOINT_METER_M, units)}")


@styled
def modes_figure(study: StudyResults, units: str = "si") -> Figure | None:
    """Draw which mode of motion makes most of the slip, in shares of the runs that slide at each strength; None where
    nothing slides."""
    names = [row["model"] for row in study.summary if row["dominant_mode"]]
    if not names:
        return None
    strength = strength_of(study, units)
    middle, counts = modes(study.walk, study.walk.measure(strength.measure, strength.period))
    occurring = counts.any(axis=(0, 1))
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
    panels = figure.subplots(1, len(names), sharey=True, squeeze=False)[0]
    for name, axes in zip(names, panels, strict=True):
        runs = counts[study.walk.models.index(name)]
        total = runs.sum(axis=1)
        filled = np.flatnonzero(total)
        bottom = np.zeros(filled.size)
        for which in np.flatnonzero(occurring).tolist():
            mode = MODES[which]
            share = runs[filled, which] / total[filled]
            kind = SLIP_KINDS[mode]
            look = {"color": MODE_COLOURS[kind], "hatch": MODE_HATCHES[kind], "edgecolor": "white"}
            axes.bar(np.arange(filled.size), share, 0.85, bottom, label=_LABELS[mode], **look)
            bottom += share
        axes.set_xticks(np.arange(filled.size), [number(middle[k] / strength.scale, 2) for k in filled], fontsize=8)
        turned = 45 if total.max() >= _LONG else 0
        for at, k in enumerate(filled.tolist()):
            axes.text(at, 1.01, f"{total[k]:,}", ha="center", va="bottom", fontsize=7, rotation=turned)
        axes.set_title(f"{name} model: runs that slide", fontsize=9, loc="left", pad=26)
        axes.set_xlabel(strength.label)
        axes.grid(visible=False)
    panels[0].set_ylim(0.0, 1.0)
    panels[0].set_ylabel("share by what makes most of the slip")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return headed(figure, study)
