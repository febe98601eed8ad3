"""Margin of each static check."""

from __future__ import annotations

from typing import Any

from matplotlib.figure import Figure

from heeltoe.models.statics.checks import Check
from heeltoe.models.statics.model import Statics
from heeltoe.units.write import number
from heeltoe.views.figures.style import COLOURS, WIDTH, heading, styled

# A check that is met so many times over ends the axis.
_MOST = 3.0
_ROW, _AROUND = 0.24, 1.6
# Of what there is none, there may be endlessly much.
_ENDLESS = 1e6
_CLIPPED: dict[str, Any] = {"ha": "right", "va": "center", "fontsize": 7, "color": "#FFFFFF"}


@styled
def statics_figure(statics: Statics) -> Figure:
    """Draw each check as a bar of value over required value, or the inverse for an upper bound, so that a check is met
    where its bar reaches one."""
    figure = Figure(figsize=(WIDTH, _AROUND + _ROW * len(statics.checks)), layout="constrained")
    axes = figure.subplots()
    missed = sum(not check.met for check in statics.checks)
    sentence = "all checks are met" if not missed else f"{missed} of {len(statics.checks)} checks are not met"
    heading(figure, statics.title or "Untitled case", f"{statics.criteria}: {sentence}")
    names = []
    # An equilibrium that is met has no margin to show.
    drawn = [check for check in statics.checks if check.value is not None or not check.met] or list(statics.checks)
    for row, check in enumerate(drawn):
        share = _share(check)
        reached = min(share, _MOST)
        axes.barh(
            row,
            reached,
            height=0.65,
            facecolor=COLOURS["slip"] if check.met else "white",
            edgecolor=COLOURS["slip"] if check.met else COLOURS["crack"],
            hatch="" if check.met else "///",
            linewidth=1.0,
        )
        if share > _MOST:
            text = "beyond" if share >= _ENDLESS else f"{share:.3g}"
            axes.annotate(f"{text} →", (_MOST, row), (-3, 0), "data", "offset points", **_CLIPPED)
        names.append(f"{check.load_case}: {check.name}{_numbers(check)}")
    axes.axvline(1.0, color="#000000", linewidth=1.0, linestyle="--")
    axes.set_yticks(range(len(names)), names, fontsize=8)
    axes.tick_params(axis="y", length=0)
    axes.invert_yaxis()
    axes.set_xlim(0.0, _MOST)
    axes.grid(visible=False, axis="y")
    axes.set_xlabel("reached over required [-]; met from 1 on")
    return figure


def _share(check: Check) -> float:
    """Return the share of the required value that is reached; from one on it is met."""
    if check.value is None or check.required is None:
        return 1.0 if check.met else 0.0
    over, under = (check.value, check.required) if check.at_least else (check.required, check.value)
    return _ENDLESS if under <= 0.0 else max(over / under, 0.0)


def _numbers(check: Check) -> str:
    if check.value is None or check.required is None:
        return ""
    return f" {number(check.value)} ({'at least' if check.at_least else 'at most'} {number(check.required)})"
