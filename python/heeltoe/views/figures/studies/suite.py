"""A suite of records: how far the dam slides in each, and their response spectra."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from heeltoe.errors.sanitize import plain
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.study.answers.suite import SuiteRecord, suite_spectra
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.write import number
from heeltoe.views.figures.studies.common import headed, slip_scale
from heeltoe.views.figures.style import COLOURS, WIDTH, styled
from heeltoe.views.words.studies import STATISTICS

_OVER = {"mean": ("#000000", "-"), "median": ("#000000", "--"), "84%": ("#000000", ":")}
_LONGEST = 34
# Height of a row, and room beside the names, which the layout takes for shorter than they are [in].
_ROW, _PAD = 0.24, 0.12


def suite_figures(study: StudyResults, units: str = "si") -> dict[str, Figure | None]:
    """Return the figures of a suite by name; none of another study."""
    if study.suite is None:
        return {}
    return {"suite": suite_figure(study, units), "suite-spectra": suite_spectra_figure(study)}


@styled
def suite_figure(study: StudyResults, units: str = "si") -> Figure | None:
    """Draw the residual slip of each record as a bar, its other sign as a mark, the numbers over all as lines."""
    suite = study.suite
    if suite is None:
        return None
    models, (scale, unit) = suite.models, slip_scale(units)
    count = len(models[0].records)
    layout = ConstrainedLayoutEngine(w_pad=_PAD)
    figure = Figure(figsize=(WIDTH, 1.7 + _ROW * max(count, 5)), layout=layout)
    panels = figure.subplots(1, len(models), sharey=True, squeeze=False)[0]
    order = sorted(range(count), key=lambda place: _slip(models[0].records[place]))
    for axes, row in zip(panels, models, strict=True):
        records = [row.records[place] for place in order]
        _bars(axes, records, scale)
        for name, (colour, dash) in _OVER.items() if count > 1 else ():
            value = row.statistics[RESIDUAL_SLIP.key][name]
            if value is not None:
                label = f"{STATISTICS[name]}: {number(scale * value, 3)} {unit}"
                axes.axvline(scale * value, color=colour, linestyle=dash, linewidth=1.2, label=label, zorder=3)
        for check in row.limits:
            if check.name == "residual_slip":
                label = f"allowed: {number(scale * check.allowed, 3)} {unit}"
                axes.axvline(scale * check.allowed, color=COLOURS["crack"], linewidth=1.6, label=label, zorder=3)
        axes.set_xlim(0.0, None)
        axes.set_xlabel(f"residual slip, either way [{unit}]")
        axes.set_title(f"{row.model} model", fontsize=9, loc="left")
        axes.grid(visible=False, axis="y")
    if len(models) == 1:
        named = panels[0].get_legend_handles_labels()
        if named[0]:
            figure.legend(*named, loc="outside lower center", ncols=4, fontsize=8)
    else:
        for axes in panels:
            axes.legend(loc="lower right", fontsize=7, frameon=True, framealpha=0.95, edgecolor="none")
    panels[0].set_yticks(np.arange(count), [_name(models[0].records[place].motion) for place in order], fontsize=8)
    panels[0].set_ylim(-0.6, count - 0.4)
    return headed(figure, study, "each record by its worse sign; mark: its other sign")


def _slip(record: SuiteRecord) -> float:
    return float("inf") if record.residual_slip_m is None else float(record.residual_slip_m)


def _name(name: str) -> str:
    text = plain(name)
    # Names of one event differ at their ends.
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST // 2]}…{text[1 - _LONGEST // 2 :]}"


def _bars(axes: Axes, records: list[SuiteRecord], scale: float) -> None:
    for row, record in enumerate(records):
        if record.residual_slip_m is None:
            axes.annotate(record.outcome, (0.0, row), (4.0, 0.0), textcoords="offset points", va="center", fontsize=8)
            continue
        colour = COLOURS["rotation"] if record.governs else COLOURS["slip"]
        axes.barh(row, scale * record.residual_slip_m, 0.62, color=colour, alpha=0.85)
        other = record.other_sign_residual_slip_m
        if other is not None:
            axes.plot(scale * other, row, marker="|", markersize=9, markeredgewidth=1.8, color="#FFFFFF", zorder=2)


@styled
def suite_spectra_figure(study: StudyResults) -> Figure | None:
    """Draw the response spectra of the records as they shake the dam, their mean, and the target; None where the study
    does not keep them."""
    suite = study.suite
    records = [] if suite is None else suite.models[0].records
    spectra = suite_spectra(study.walk, records)
    if spectra is None:
        return None
    figure = Figure(figsize=(WIDTH, 4.2), layout="constrained")
    axes = figure.subplots()
    period = spectra["period_s"]
    for record, values in zip(records, spectra["records"] / STANDARD_GRAVITY, strict=True):
        governs = record.governs
        look = (
            {"color": COLOURS["rotation"], "linewidth": 1.6, "zorder": 3}
            if governs
            else {"color": "#999999", "linewidth": 0.7}
        )
        label = _name(record.motion) + ", which governs" * (len(records) > 1) if governs else None
        axes.semilogx(period, values, label=label, **look)
    if len(records) > 1:
        axes.plot([], [], color="#999999", linewidth=0.7, label="other records")
        mean = spectra["mean"] / STANDARD_GRAVITY
        axes.semilogx(period, mean, color="#000000", linewidth=2.2, label="mean", zorder=4)
    target = spectra["target"]
    if target is not None:
        values = np.array(target["pseudo_acceleration_m_s2"]) / STANDARD_GRAVITY
        label = f"target: {plain(target['name'])}"
        axes.semilogx(
            target["period_s"], values, color=COLOURS["toe"], linestyle="--", linewidth=2.0, label=label, zorder=4
        )
    scale = (study.manifest["study"]["motions"] or {}).get("scale")
    if scale and scale["measure"] == "sa":
        at = float(str(scale["period"]).split()[0])
        axes.axvline(at, color="#444444", linestyle=":", linewidth=1.2, label=f"scaled at {at:.3g} s")
    axes.set_xlim(period[0], period[-1])
    axes.set_ylim(0.0, None)
    axes.set_xlabel("period [s]")
    axes.set_ylabel(f"pseudo-acceleration, {100.0 * spectra['damping']:.3g} % damping [g]")
    axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0], ["0.05", "0.1", "0.2", "0.5", "1", "2", "4"])
    axes.legend(loc="upper right", fontsize=8, frameon=True, framealpha=0.9, edgecolor="none")
    return headed(figure, study, "response spectra of the records as they shake the dam")
