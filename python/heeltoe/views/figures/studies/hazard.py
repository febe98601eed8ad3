"""The hazard at the site with the fragility curves over it, and which motions make the annual rates."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.study.answers.study_results import Opened
from heeltoe.views.figures.studies.common import LINES, headed, measured
from heeltoe.views.figures.style import WIDTH, styled
from heeltoe.views.words.studies import limits_of


@styled
def hazard_figure(found: Opened, units: str = "si") -> Figure | None:
    """Draw the hazard curve, on the left, and on the right the share of each annual rate that motions of each strength
    make; None where no limit has a rate."""
    rows = [row for row in found.hazard or () if row["annual_rate"]]
    if not rows:
        return None
    study, hazard = found.told["study"]["fragility"], found.told["hazard"]
    strength = measured(study["measure"], study["period"], units)
    limits = limits_of([(row["limit"], row["value"]) for row in rows], units)
    figure = Figure(figsize=(WIDTH, 3.9), layout="constrained")
    left, right = figure.subplots(1, 2)
    at = np.array(hazard["strength"]) / strength.scale
    left.loglog(at, hazard["annual_rate"], color="#000000", marker="o", markersize=3.5, linewidth=1.6)
    left.set_xlabel(strength.label)
    left.set_ylabel("exceeded so often a year")
    left.set_title("hazard, and the annual rates of the limits", fontsize=9, loc="left")
    several = len({row["model"] for row in rows}) > 1
    for place, row in enumerate(rows):
        colour, dash = LINES[place % len(LINES)]
        label = limits[row["limit"], row["value"]] + (f", {row['model']}" if several else "")
        left.axhline(row["annual_rate"], color=colour, linestyle=dash, linewidth=1.3)
        if row["annual_rate_interval"] is not None:
            left.axhspan(*row["annual_rate_interval"], color=colour, alpha=0.12, linewidth=0.0)
        edges = np.array([row["contribution"][0]["from"], *(part["to"] for part in row["contribution"])])
        shares = 100.0 * np.array([part["share"] for part in row["contribution"]])
        right.stairs(shares, edges / strength.scale, color=colour, linestyle=dash, linewidth=1.6, label=label)
    right.set_xscale("log")
    right.set_ylim(0.0, None)
    right.set_xlabel(strength.label)
    right.set_ylabel("share of the annual rate [%]")
    right.set_title("which motions make it", fontsize=9, loc="left")
    for axes in (left, right):
        axes.set_xlim(at[0], at[-1])
    figure.legend(*right.get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8)
    return headed(figure, found, "fragility over hazard")
