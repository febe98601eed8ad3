"""Curves over the strength of the motion: how far dams slide, and how probable it is that a limit is exceeded."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from heeltoe.base.arrays import Floats
from heeltoe.result.contract import JOINT_METER_M, RESIDUAL_SLIP
from heeltoe.study.answers.fragility import Curve
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.study.run.aggregate import SHAKEN
from heeltoe.units.write import length
from heeltoe.views.figures.studies.common import LINES, Strength, farthest, headed, measured, slip_scale, strength_of
from heeltoe.views.figures.style import WIDTH, styled
from heeltoe.views.words.studies import limits_of

#: More curves than these are a cloud: evenly chosen ones stand for them.
_CURVES = 200
_SLIP = RESIDUAL_SLIP.key


@styled
def bands_figure(study: StudyResults, units: str = "si") -> Figure | None:
    """Draw what 16, 50 and 84 % of the runs stay below, by the strength of the motion; of an incremental dynamic
    analysis each motion beside. None where no strength varies or nothing slides."""
    strength, largest = strength_of(study, units), farthest(study)
    by_model = study.bands(_SLIP, strength.measure, strength.period)
    if not largest > JOINT_METER_M or max(len(row["strength"]) for row in by_model.values()) < 2:
        return None
    names, (scale, unit) = list(by_model), slip_scale(units)
    edge = scale * JOINT_METER_M / 2.0
    figure = Figure(figsize=(WIDTH, 4.2 if len(names) == 1 else 3.8), layout="constrained")
    panels = figure.subplots(1, len(names), sharex=True, sharey=True, squeeze=False)[0]
    thin = _single_curves(study, strength) if study.complete and (study.walk.strengths or 1) > 1 else None
    for name, axes in zip(names, panels, strict=True):
        which = study.walk.models.index(name)
        if thin is not None:
            _thin(axes, thin[0][..., which], np.maximum(scale * thin[1][..., which], edge))
        _band(axes, by_model[name], strength.scale, lambda slip: np.maximum(scale * slip, edge))
        if not np.isfinite(by_model[name]["low"]).any():
            axes.text(0.5, 0.5, "no run has a slip", transform=axes.transAxes, ha="center")
        axes.set_title(f"{name} model", fontsize=9, loc="left")
        axes.set_xlabel(strength.label)
    axes = panels[0]
    axes.set_yscale("log")
    axes.set_ylim(edge, 2.0 * scale * largest)
    axes.set_xlim(0.0, None)
    axes.set_ylabel(f"residual slip, either way [{unit}]")
    panels[-1].legend(loc="lower right", fontsize=8)
    shown = "thin: one dam in one motion" if thin is not None else "over all that varies"
    return headed(figure, study, shown, f"slips below {length(JOINT_METER_M / 2.0, units)} stand on the lower edge")


def _single_curves(study: StudyResults, strength: Strength) -> tuple[Floats, Floats]:
    """Return strength and slip of some single dams in single motions, (curves, strengths, models)."""
    strengths, models = study.walk.strengths or 1, len(study.walk.models)
    count = study.store.count // (strengths * models)
    chosen = np.unique(np.linspace(0, count - 1, min(count, _CURVES)).astype(np.int64))
    of, slip = (np.full((chosen.size, strengths * models), np.nan) for _ in range(2))
    measure = study.walk.measure(strength.measure, strength.period)
    for runs in study.walk("run", *SHAKEN, _SLIP):
        curve, place = np.divmod(runs.whole("run"), strengths * models)
        at = np.minimum(np.searchsorted(chosen, curve), chosen.size - 1)
        here = chosen[at] == curve
        of[at[here], place[here]] = runs.strength(measure)[here] / strength.scale
        slip[at[here], place[here]] = np.abs(runs.numbers(_SLIP))[here]
    shape = (chosen.size, strengths, models)
    return of.reshape(shape), slip.reshape(shape)


def _thin(axes: Axes, strength: Floats, seen: Floats) -> None:
    order = np.argsort(strength, axis=1)
    lines = np.stack([np.take_along_axis(column, order, axis=1) for column in (strength, seen)], axis=-1)
    axes.add_collection(LineCollection(list(lines), colors="#999999", linewidths=0.5, alpha=0.6, zorder=1))


def _band(axes: Axes, band: dict[str, list[float]], scale: float, seen: Callable[[Floats], Floats]) -> None:
    middle = np.array(band["strength"]) / scale
    low, median, high = (
        # Runs without a result count as infinitely far; the line ends there.
        seen(np.where(np.isfinite(column), column, np.nan))
        for column in (np.array(band[name]) for name in ("low", "median", "high"))
    )
    colour = LINES[0][0]
    axes.fill_between(middle, low, high, color=colour, alpha=0.15, linewidth=0.0)
    for values, dash, wide, text in ((high, "--", 1.4, "84 %"), (median, "-", 2.4, "50 %"), (low, ":", 1.4, "16 %")):
        axes.plot(
            middle,
            values,
            color=colour,
            linestyle=dash,
            linewidth=wide,
            marker="o",
            markersize=3,
            label=f"{text} stay below",
        )


@styled
def fragility_figure(study: StudyResults, units: str = "si") -> Figure | None:
    """Draw the shares of the runs that exceed each limit with their bounds, and the fragility curves with their bands;
    where there is no curve, the strengths between which half of the dams come to exceed. None without runs."""
    asked = study.manifest["study"]["fragility"]
    known = [curve for curve in study.fragility if curve.shares]
    if not known:
        return None
    strength = measured(asked["measure"], asked["period"], units)
    models = list(dict.fromkeys(curve.model for curve in known))
    limits = list(dict.fromkeys((limit, value) for _, limit, value in study.counted))
    labels = limits_of(limits, units)
    figure = Figure(figsize=(WIDTH, 4.4), layout="constrained")
    panels = figure.subplots(1, len(models), sharex=True, sharey=True, squeeze=False)[0]
    strongest = max(curve.shares[-1].strength for curve in known) / strength.scale
    x = np.linspace(0.0, 1.03 * strongest, 241)[1:]
    for name, axes in zip(models, panels, strict=True):
        for curve in (curve for curve in known if curve.model == name):
            look = LINES[limits.index((curve.limit, curve.value)) % len(LINES)]
            _curve(axes, curve, (x, strength.scale), (*look, labels[curve.limit, curve.value]))
        axes.set_title(f"{name} model", fontsize=9, loc="left")
        axes.set_xlabel(strength.label)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), fontsize=8, ncols=2 if len(models) == 1 else 1)
    panels[0].set_ylim(0.0, 1.0)
    panels[0].set_xlim(0.0, 1.03 * strongest)
    panels[0].set_ylabel("probability that it is exceeded")
    within = any(curve.knowledge is not None for curve in known)
    sure = f"{asked['confidence']:.0%}"
    band = f"; shaded: {sure}, event by event" if within else ""
    return headed(figure, study, *_do_not_stand(study), f"points: shares of the runs with exact bounds, {sure}{band}")


def _do_not_stand(study: StudyResults) -> list[str]:
    several = len(study.not_standing) > 1
    return [
        f"{100.0 * one.share:.1f} % of the dams do not stand" + (f", {name}" if several else "")
        for name, one in study.not_standing.items()
        if one.count
    ]


def _curve(axes: Axes, curve: Curve, along: tuple[Floats, float], look: tuple[str, str, str]) -> None:
    (x, scale), (colour, dash, label) = along, look
    strength = x * scale
    style: dict[str, Any] = {"color": colour, "linestyle": dash, "linewidth": 1.8}
    if curve.median is not None:
        misfit = f" (does not fit, p = {curve.fit.p:.2g})" if curve.fit and not curve.fit.fits else ""
        axes.plot(x, curve.probability(strength), **style, label=label + misfit)
        within = curve.within(strength)
        if within is not None:
            axes.fill_between(x, *within, color=colour, alpha=0.15, linewidth=0.0)
    else:
        axes.plot([], [], color=colour, linestyle="", marker="o", markerfacecolor="white", label=f"{label}: no curve")
        low, high = curve.gap
        if low is not None and high is not None:
            # Half of the dams come to exceed it somewhere here.
            axes.plot([low / scale, high / scale], [0.5, 0.5], color=colour, linestyle=":", linewidth=1.4, marker="|")
    shares = np.array([share.share for share in curve.shares])
    ends = np.abs(np.array([share.interval for share in curve.shares]).T - shares)
    at = np.array([share.strength for share in curve.shares]) / scale
    axes.errorbar(
        *(at, shares, ends),
        linestyle="",
        marker="o",
        markersize=4,
        color=colour,
        markerfacecolor="white",
        elinewidth=0.8,
        clip_on=False,
    )
