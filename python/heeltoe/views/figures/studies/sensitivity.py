"""Sensitivity of the slip: Sobol's indices, and one field at a time."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heeltoe.study.answers.study_results import StudyResults
from heeltoe.views.figures.studies.common import headed, slip_scale
from heeltoe.views.figures.style import COLOURS, WIDTH, styled
from heeltoe.views.words.studies import ends_of

_HIGH, _LOW = COLOURS["rotation"], COLOURS["slip"]


@styled
def sobol_figure(study: StudyResults) -> Figure | None:
    """Draw first and total indices of the residual slip with their bounds; None where it does not vary."""
    by_model = {name: answer for name, answer in study.sensitivity().items() if answer.indices}
    if not by_model:
        return None
    figure, panels = _panels(by_model, max(len(item.indices) for item in by_model.values()))
    for axes, (name, answer) in zip(panels, by_model.items(), strict=True):
        indices = answer.indices[::-1]
        rows = np.arange(len(indices))
        for kind, shift, marker, colour in (("total", 0.12, "o", _HIGH), ("first", -0.12, "s", _LOW)):
            low, high = np.array([index[f"{kind}_interval"] for index in indices]).T
            axes.hlines(rows + shift, low, high, color=colour, linewidth=1.4)
            values = [index[kind] for index in indices]
            text = {"first": "by itself (first)", "total": "with all others (total)"}[kind]
            axes.plot(values, rows + shift, marker, color=colour, markersize=5, label=text)
        _rows(axes, [index.name for index in indices])
        axes.axvline(0.0, color="#444444", linewidth=0.8)
        axes.set_xlabel("share of the variance of the slip")
        axes.set_title(f"{name} model{_left_out(answer.left_out, 'rows')}", fontsize=9, loc="left")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    confidence = next(iter(by_model.values())).confidence
    return headed(figure, study, f"Sobol's indices of the residual slip, {confidence:.0%} intervals")


@styled
def tornado_figure(study: StudyResults, units: str = "si") -> Figure | None:
    """Draw what each field by itself makes of the slip; None where no motion gave a result for all dams."""
    by_model = {name: answer for name, answer in study.tornado().items() if answer["fields"]}
    if not by_model:
        return None
    figure, panels = _panels(by_model, max(len(item["fields"]) for item in by_model.values()))
    scale, unit = slip_scale(units)
    for axes, (name, answer) in zip(panels, by_model.items(), strict=True):
        fields = answer["fields"][::-1]
        base = scale * (answer["base"] or 0.0)
        for row, field in enumerate(fields):
            ends = [(text, scale * slip) for slip, text in ends_of(field, units)]
            _bar(axes, row, ends, base)
        axes.axvline(base, color="#444444", linewidth=0.8)
        axes.margins(x=0.2)
        _rows(axes, [field["name"] for field in fields])
        axes.set_xlabel(f"residual slip, either way, mean of the motions [{unit}]")
        axes.set_title(f"{name} model{_left_out(answer['left_out'], 'motions')}", fontsize=9, loc="left")
    # Room for the values beside the bars, but no slips below zero.
    low, high = panels[-1].get_xlim()
    ticks = [tick for tick in panels[-1].get_xticks() if max(low, 0.0) <= tick <= high]
    for axes in panels:
        axes.set_xticks(ticks)
        axes.set_xlim(low, high)
    return headed(figure, study, "one field at a time; the line is the case as it is")


def _panels(by_model: Mapping[str, object], rows: int) -> tuple[Figure, list[Axes]]:
    figure = Figure(figsize=(WIDTH, 1.3 + (0.8 + 0.42 * rows) * len(by_model)), layout="constrained")
    return figure, list(figure.subplots(len(by_model), 1, sharex=True, squeeze=False)[:, 0])


def _bar(axes: Axes, row: int, ends: list[tuple[str, float]], base: float) -> None:
    """Draw how far the slip goes from that of the case, to either side, and at which values."""
    for (text, at), colour, side in ((ends[0], _LOW, "right"), (ends[-1], _HIGH, "left")):
        outward = at >= base if side == "left" else at <= base
        if not outward:
            continue  # all values lie on the other side of the case
        axes.barh(row, at - base, 0.6, left=base, color=colour)
        shift = (4.0 if side == "left" else -4.0, 0.0)
        axes.annotate(text, (at, row), shift, textcoords="offset points", ha=side, va="center", fontsize=8, zorder=5)


def _rows(axes: Axes, names: list[str]) -> None:
    axes.set_yticks(np.arange(len(names)), names)
    axes.set_ylim(-0.6, len(names) - 0.4)
    axes.grid(visible=False, axis="y")


def _left_out(count: int, what: str) -> str:
    return f", {count:,} {what} left out" if count else ""
