"""Curves over the strength of the motion: how far dams slide, and how probable it is that a limit is exceeded."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from heeltoe.arrays import Floats
from heeltoe.result.contract import JOINT_METER_M
from heeltoe.study.answers import bands, observed
from heeltoe.study.fragility import LIMITED, Curve, exceeding
from heeltoe.study.opened import Opened, codes
from heeltoe.units.write import length
from heeltoe.views.figures.studies.common import LINES, headed, measured, strength_of
from heeltoe.views.figures.style import WIDTH, styled

#: More curves than these are a cloud: evenly chosen ones stand for them.
_CURVES = 200
_SLIP = "residual_slip_m"
_LIMITS = {"residual_slip": "residual slip", "peak_slip": "peak slip", "opening": "opening", "rotation": "rotation"}


@styled
def bands_figure(found: Opened) -> Figure | None:
    """Draw what 16, 50 and 84 % of the runs stay below, by the strength of the motion; of an incremental dynamic
    analysis each motion beside. None where no strength varies or nothing slides."""
    strength, label = strength_of(found)
    table = found.to_table(["model", _SLIP])
    slip = np.abs(np.asarray(table[_SLIP].to_numpy(), dtype=np.float64))
    names, model = codes(table, "model")
    if strength.size < 2 or np.ptp(strength) <= 1e-9 * strength.max() or not (slip > JOINT_METER_M).any():
        return None
    figure = Figure(figsize=(WIDTH, 4.2 if len(names) == 1 else 3.8), layout="constrained")
    panels = figure.subplots(1, len(names), sharex=True, sharey=True, squeeze=False)[0]
    thin = _single_curves(found, strength) if found.complete else None
    for place, (name, axes) in enumerate(zip(names, panels, strict=True)):
        here = model == place
        if thin is not None:
            which = found.told["study"]["model"].index(name)
            _thin(axes, thin[0][..., which], thin[1][..., which])
        _band(axes, bands(strength[here], slip[here]))
        if not np.isfinite(slip[here]).any():
            axes.text(0.5, 0.5, "no run has a slip", transform=axes.transAxes, ha="center")
        axes.set_title(f"{name} model", fontsize=9, loc="left")
        axes.set_xlabel(label)
    axes = panels[0]
    axes.set_yscale("log")
    axes.set_ylim(1e3 * JOINT_METER_M / 2.0, 2.0 * 1e3 * float(np.nanmax(slip)))
    axes.set_xlim(0.0, None)
    axes.set_ylabel("residual slip, either way [mm]")
    panels[-1].legend(loc="lower right", fontsize=8)
    shown = "thin: one dam in one motion" if thin is not None else "over all that varies"
    return headed(figure, found, shown, "slips below 0.05 mm stand on the lower edge")


def _single_curves(found: Opened, strength: Floats) -> tuple[Floats, Floats] | None:
    """Return strength and slip of single dams in single motions, (curves, strengths, models); None where motions do
    not go through strengths."""
    if (found.strengths or 1) < 2:
        return None
    slip = np.abs(found.cube(_SLIP))
    of = strength.reshape(slip.shape).reshape(-1, *slip.shape[2:])
    slip = slip.reshape(-1, *slip.shape[2:])
    chosen = np.unique(np.linspace(0, len(slip) - 1, min(len(slip), _CURVES)).astype(np.int64))
    return of[chosen], slip[chosen]


def _thin(axes: Axes, strength: Floats, slip: Floats) -> None:
    # What is less than a joint meter reads stands on the lower edge.
    seen = 1e3 * np.maximum(slip, JOINT_METER_M / 2.0)
    order = np.argsort(strength, axis=1)
    lines = np.stack([np.take_along_axis(each, order, axis=1) for each in (strength, seen)], axis=-1)
    axes.add_collection(LineCollection(list(lines), colors="#999999", linewidths=0.5, alpha=0.6, zorder=1))


def _band(axes: Axes, band: dict[str, list[float]]) -> None:
    middle = np.array(band["strength"])
    low, median, high = (
        # Runs without a result count as infinitely far; the line ends there.
        1e3 * np.where(np.isfinite(each), np.maximum(each, JOINT_METER_M / 2.0), np.nan)
        for each in (np.array(band[name]) for name in ("low", "median", "high"))
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
def fragility_figure(found: Opened) -> Figure | None:
    """Draw the fragility curves with what they lie within, and the shares of the runs that exceed; None without runs
    on which one could stand."""
    asked = found.told["study"]["fragility"]
    fitted = [each for each in found.curves if each[1].median is not None]
    if not fitted:
        return None
    strength, label = measured(found, asked["measure"], asked["period"])
    si = found.strength(asked["measure"], asked["period"])
    columns = sorted({name for _, curve in fitted for name in LIMITED[curve.limit]})
    table = found.to_table(["model", "outcome", *columns])
    names, model = codes(table, "model")
    outcomes, code = codes(table, "outcome")
    outcome = np.array(outcomes)[code]
    values = {name: np.asarray(table[name].to_numpy(), dtype=np.float64) for name in columns}
    models = list(dict.fromkeys(name for name, _ in fitted))
    figure = Figure(figsize=(WIDTH, 4.4), layout="constrained")
    panels = figure.subplots(1, len(models), sharex=True, sharey=True, squeeze=False)[0]
    x = np.linspace(0.0, strength.max(), 241)[1:]
    to_si = float(si.max() / strength.max())
    for name, axes in zip(models, panels, strict=True):
        here = model == names.index(name)
        for place, curve in enumerate(each for of, each in fitted if of == name):
            shares = exceeding(
                {key: each[here] for key, each in values.items()}, outcome[here], curve.limit, curve.value
            )
            _curve(axes, curve, x, to_si, observed(strength[here], shares), LINES[place % len(LINES)])
        axes.set_title(f"{name} model", fontsize=9, loc="left")
        axes.set_xlabel(label)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), fontsize=8, ncols=3 if len(models) == 1 else 1)
    panels[0].set_ylim(0.0, 1.0)
    panels[0].set_xlim(0.0, None)
    panels[0].set_ylabel("probability that it is exceeded")
    within = any(curve.covariance is not None for _, curve in fitted)
    band = f"; shaded: {asked['confidence']:.0%} confidence, event by event" if within else ""
    return headed(figure, found, f"points: shares of the runs{band}")


def _curve(
    axes: Axes, curve: Curve, x: Floats, to_si: float, points: tuple[list[float], list[float]], look: tuple[str, str]
) -> None:
    colour, dash = look
    amount = f"{curve.value:.3g} rad" if curve.limit == "rotation" else length(curve.value, "si")
    strength: Any = x * to_si
    axes.plot(
        x,
        curve.probability(strength),
        color=colour,
        linestyle=dash,
        linewidth=1.8,
        label=f"{_LIMITS[curve.limit]} {amount}",
    )
    within = curve.within(strength)
    if within is not None:
        axes.fill_between(x, *within, color=colour, alpha=0.15, linewidth=0.0)
    axes.plot(*points, linestyle="", marker="o", markersize=4, color=colour, markerfacecolor="white", clip_on=False)
