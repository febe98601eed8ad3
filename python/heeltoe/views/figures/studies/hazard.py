"""The hazard at the site with the fragility curves over it, how well the annual probabilities are known, and which
motions and events make them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterSciNotation, LogLocator, NullFormatter

from heeltoe.errors.sanitize import plain
from heeltoe.study.answers.hazard import AnnualRate
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.views.figures.studies.common import LINES, headed, measured
from heeltoe.views.figures.style import WIDTH, styled
from heeltoe.views.words.studies import limits_of

#: Events of a hazard that figure and table show, and the letters of a name.
_SHOWN, _LONGEST = 12, 28
#: An axis of probabilities that spans less than this factor has two numbers in each decade.
_NARROW = 300.0
#: Of the last rate of the hazard curve, the least that its axis shows.
_LEAST = 1e-3


@styled
def hazard_figure(study: StudyResults, units: str = "si") -> Figure | None:
    """Draw the hazard curve, on the left, and on the right the share of each annual rate that motions of each strength
    make, with its fractiles and the shares of events below; None where no limit has a rate."""
    rows = [row for row in study.hazard or () if row["annual_rate"]]
    if not rows:
        return None
    settings, hazard = study.manifest["study"]["fragility"], study.manifest["hazard"]
    strength = measured(settings["measure"], settings["period"], units)
    limits = limits_of([(row["limit"], row["value"]) for row in rows], units)
    several = len({row["model"] for row in rows}) > 1
    names = [
        limits[row["limit"], row["value"]] + (f", {row['model']}" if several else "") + _least(row) for row in rows
    ]
    known = any(row["by_event"] for row in rows)
    events = _events(rows)
    below = 1.3 + 0.2 * max(len(events), 2 * len(rows))
    figure = Figure(figsize=(WIDTH, 3.9 + known * below), layout="constrained")
    panels = figure.subplots(2, 2, height_ratios=[3.9, below]) if known else figure.subplots(1, 2, squeeze=False)
    (left, right), *lower = panels
    at = np.array(hazard["strength"]) / strength.scale
    left.loglog(at, hazard["annual_rate"], color="#000000", marker="o", markersize=3.5, linewidth=1.6)
    left.set_xlabel(strength.label)
    left.set_ylabel("exceeded so often a year")
    left.set_title("hazard, and the annual rates of the limits", fontsize=9, loc="left")
    for place, (row, label) in enumerate(zip(rows, names, strict=True)):
        colour, dash = LINES[place % len(LINES)]
        left.axhline(row["annual_rate"], color=colour, linestyle=dash, linewidth=1.3)
        high = row["annual_rate_bounds"][1]
        if high is not None and high > row["annual_rate"]:
            left.axhline(high, color=colour, linestyle=":", linewidth=1.0)
        if row["annual_rate_interval"] is not None:
            left.axhspan(*row["annual_rate_interval"], color=colour, alpha=0.12, linewidth=0.0)
        edges = np.array([row["contribution"][0]["from"], *(part["to"] for part in row["contribution"])])
        shares = 100.0 * np.array([part["share"] for part in row["contribution"]])
        right.stairs(shares, edges / strength.scale, color=colour, linestyle=dash, linewidth=1.6, label=label)
    # An interval that all but reaches zero would leave no room for the hazard.
    left.set_ylim(bottom=max(left.get_ylim()[0], _LEAST * hazard["annual_rate"][-1]))
    right.set_xscale("log")
    right.set_ylim(0.0, None)
    right.set_xlabel(strength.label)
    right.set_ylabel("share of the annual rate [%]")
    right.set_title("which motions make it", fontsize=9, loc="left")
    for axes in (left, right):
        axes.set_xlim(at[0], at[-1])
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter(NullFormatter())
    for fractiles, shares in lower:
        _fractiles(fractiles, rows)
        _shares(shares, rows, events)
    figure.legend(*right.get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8)
    return headed(figure, study, "fragility over hazard; dotted: at most, with motions beyond the hazard curve")


def _least(row: AnnualRate) -> str:
    return " (at least)" if row["annual_rate_bounds"][1] is None else ""


def _events(rows: Sequence[AnnualRate]) -> list[str]:
    """Return the events that make most of the rates together."""
    made = Counter[str]()
    for row in rows:
        made.update({part["event"]: part["share"] for part in row["by_event"]})
    return [event for event, _ in made.most_common(_SHOWN)]


def _fractiles(axes: Axes, rows: Sequence[AnnualRate]) -> None:
    """Draw the fractiles of the annual probability of each limit: 5 to 95 % thin, 16 to 84 % thick."""
    for place, row in enumerate(rows):
        colour, known = LINES[place % len(LINES)][0], row["annual_probability_fractiles"]
        if known is not None:
            axes.plot([known["5%"], known["95%"]], [-place] * 2, color=colour, linewidth=1.4)
            axes.plot([known["16%"], known["84%"]], [-place] * 2, color=colour, linewidth=5.0, solid_capstyle="butt")
        axes.plot(row["annual_probability"], -place, "o", color="#000000", markersize=4.5, zorder=3)
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0) if high < _NARROW * low else (1.0,), numticks=6))
    axes.xaxis.set_major_formatter(LogFormatterSciNotation(minor_thresholds=(np.inf, np.inf)))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_ylim(0.6 - len(rows), 0.6)
    axes.set_yticks([])
    axes.set_xlabel("probability a year (thin: 5 to 95 %, thick: 16 to 84 %)")
    axes.set_title("how well it is known", fontsize=9, loc="left")


def _shares(axes: Axes, rows: Sequence[AnnualRate], events: Sequence[str]) -> None:
    """Draw the share of each rate that some events make, the largest above."""
    height = 0.8 / len(rows)
    for place, row in enumerate(rows):
        shares = {part["event"]: 100.0 * part["share"] for part in row["by_event"]}
        at = [-k + 0.4 - height * (place + 0.5) for k in range(len(events))]
        widths = [shares.get(event, 0.0) for event in events]
        axes.barh(at, widths, height, color=LINES[place % len(LINES)][0])
    axes.set_yticks([-k for k in range(len(events))], [plain(event)[:_LONGEST] for event in events], fontsize=7)
    axes.set_ylim(0.6 - len(events), 0.6)
    axes.set_xlabel("share of the annual rate [%]")
    axes.set_title("which events make it", fontsize=9, loc="left")
    axes.grid(visible=False, axis="y")
