"""How the slips of a study are distributed, and which mode of motion makes them."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.result.contract import JOINT_METER_M
from heeltoe.study.answers import MODES, groups
from heeltoe.study.opened import Opened, codes
from heeltoe.views.figures.studies.common import LINES, headed, strength_of
from heeltoe.views.figures.style import MODE_COLOURS, MODE_HATCHES, WIDTH, styled

_KINDS = {"sliding": "slide", "slide_rocking": "slide-rock", "drifting": "drift"}
_LABELS = {"sliding": "sliding", "slide_rocking": "slide-rocking", "drifting": "drifting"}
_POINTS = 400


@styled
def slips_figure(found: Opened) -> Figure | None:
    """Draw which share of the runs of each model slides farther than so much; None where nothing slides."""
    table = found.to_table(["model", "residual_slip_m"])
    slip = np.abs(np.asarray(table["residual_slip_m"].to_numpy(), dtype=np.float64))
    names, model = codes(table, "model")
    if not (slip > JOINT_METER_M).any():
        return None
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    axes = figure.subplots()
    x = np.geomspace(JOINT_METER_M, float(np.nanmax(slip)), _POINTS)
    for place, name in enumerate(names):
        known = np.sort(slip[(model == place) & np.isfinite(slip)])
        if not known.size:
            continue
        farther = 1.0 - np.searchsorted(known, x, side="right") / known.size
        colour, dash = LINES[place % len(LINES)]
        lost = int((model == place).sum()) - known.size
        text = f"{name} model" + (f", {lost:,} without a slip left out" if lost else "")
        axes.plot(1e3 * x, farther, color=colour, linestyle=dash, linewidth=1.8, label=text)
    axes.set_xscale("log")
    axes.set_ylim(0.0, None)
    axes.set_xlim(1e3 * x[0], 1e3 * x[-1])
    axes.set_xlabel("residual slip, either way [mm]")
    axes.set_ylabel("share of the runs that slide farther")
    axes.legend(loc="upper right")
    return headed(figure, found, "farther than a joint meter's 0.1 mm")


@styled
def modes_figure(found: Opened) -> Figure | None:
    """Draw which mode of motion makes most of the slip, in shares of the runs that slide at each strength; None where
    nothing slides."""
    table = found.to_table(["model", "peak_slip_downstream_m", "peak_slip_upstream_m", *(f"slip_{m}_m" for m in MODES)])

    def column(name: str) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        return np.nan_to_num(np.asarray(table[name].to_numpy(), dtype=np.float64))

    slides = np.maximum(column("peak_slip_downstream_m"), -column("peak_slip_upstream_m")) > JOINT_METER_M
    if not slides.any():
        return None
    names, model = codes(table, "model")
    most = np.argmax([np.abs(column(f"slip_{mode}_m")) for mode in MODES], axis=0)
    strength, label = strength_of(found)
    group = groups(strength)
    middle = np.exp(np.bincount(group, np.log(strength)) / np.maximum(np.bincount(group), 1))
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
    panels = figure.subplots(1, len(names), sharey=True, squeeze=False)[0]
    for place, (name, axes) in enumerate(zip(names, panels, strict=True)):
        here = slides & (model == place)
        total = np.bincount(group[here], minlength=middle.size)
        there = np.flatnonzero(total)
        if not there.size:
            axes.text(0.5, 0.5, "none", transform=axes.transAxes, ha="center")
        bottom = np.zeros(there.size)
        for number, mode in enumerate(MODES):
            share = np.bincount(group[here & (most == number)], minlength=middle.size)[there] / total[there]
            kind = _KINDS[mode]
            look = {"color": MODE_COLOURS[kind], "hatch": MODE_HATCHES[kind], "edgecolor": "white"}
            axes.bar(np.arange(there.size), share, 0.85, bottom, label=_LABELS[mode], **look)
            bottom += share
        axes.set_xticks(np.arange(there.size), [f"{middle[k]:.2g}" for k in there], fontsize=8)
        for at, k in enumerate(there.tolist()):
            axes.text(at, 1.01, f"{total[k]:,}", ha="center", va="bottom", fontsize=7, rotation=45)
        axes.set_title(f"{name} model: runs that slide", fontsize=9, loc="left", pad=26)
        axes.set_xlabel(label)
        axes.grid(visible=False)
    panels[0].set_ylim(0.0, 1.0)
    panels[0].set_ylabel("share by what makes most of the slip")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return headed(figure, found)
