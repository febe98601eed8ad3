"""A page for each of the worst dams of a table: what it is, how it does over the motions, which are the worst ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from heeltoe.case.model import Case
from heeltoe.case.paths import quantity_of
from heeltoe.errors.sanitize import plain
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.units.parse import DIMENSIONS, STANDARD_GRAVITY
from heeltoe.units.write import digits
from heeltoe.views.content.drawings import drawing
from heeltoe.views.content.study_subject import StudySubject
from heeltoe.views.content.tree import Block, Code, Inline, Section, Strong, Table, paragraph
from heeltoe.views.words.fields import shown
from heeltoe.views.words.numbers import Amount, in_one_unit
from heeltoe.views.words.studies import limit_of

#: Dams that have a page, and the motions that each shows.
PAGES, _MOTIONS = 10, 12
# Of the width of a page.
_SHARE = 0.62


def dam_pages(subject: StudySubject) -> Section | None:
    """Return a page for each of the worst dams of a table; None of a study without one."""
    portfolio = subject.results.portfolio
    if not portfolio:
        return None
    worst = [dam.dam for dam in portfolio[-1].dams[:PAGES]]
    runs = _runs(subject, worst)
    pages = tuple(_page(subject, dam, runs[dam]) for dam in worst)
    count = len(portfolio[-1].dams)
    which = f"the {len(worst)} worst of {count:,} dams" if count > len(worst) else "each dam"
    text = f"A page for {which}, by the ranks of the {portfolio[-1].model} model."
    return Section("Dam by dam", (paragraph(text), *pages))


def _runs(subject: StudySubject, dams: list[int]) -> dict[int, list[dict[str, object]]]:
    """Return the runs of some dams with the values that vary, by the place of the dam."""
    fields = list(_fields(subject))
    kept: dict[int, list[dict[str, Any]]] = {dam: [] for dam in dams}
    names = ("sample", "model", "motion", "reversed", "factor", "outcome", RESIDUAL_SLIP.key, *fields)
    for runs in subject.results.walk(*names):
        here = runs.table.filter(np.isin(runs.whole("sample"), dams))
        for row in here.to_pylist():
            kept[row["sample"]].append(row)
    return kept


def _fields(subject: StudySubject) -> Mapping[str, str]:
    """Return the units of the fields that the table of dams gives."""
    names = subject.results.dataset.schema.names
    varied = names[names.index("factor") + 1 : names.index("outcome")]
    return {name: DIMENSIONS[quantity].unit if (quantity := quantity_of(name)) else "" for name in varied}


def _page(subject: StudySubject, dam: int, runs: list[dict[str, Any]]) -> Section:
    """Return the page of a dam."""
    from heeltoe.views.figures.section import section_figure

    units, results = subject.units, subject.results
    fields = {
        name: f"{runs[0][name]!r} {unit}".strip() if isinstance(runs[0][name], float) else runs[0][name]
        for name, unit in _fields(subject).items()
    }
    case, name = subject.case.with_(fields), str(results.manifest["dams"][dam])
    blocks: list[Block] = [paragraph(Strong("Rank. "), " ".join(_ranks(subject, dam)))]
    rows: list[tuple[Inline, ...]] = [
        (Code(field), shown(text, units, field.rpartition(".")[2]), shown(_base(subject.case, field), units))
        for field, text in fields.items()
    ]
    blocks.append(Table(("field", "this dam", "base case"), tuple(rows), "Fields that the table of dams gives.", "lrr"))
    figure = drawing(f"dam-{dam}", section_figure(case, units), "Section of the dam with its crack.", _SHARE)
    blocks += [_motions(subject, runs), replace(figure, held=True)]
    return Section(plain(name), tuple(blocks), page=True)


def _base(case: Case, field: str) -> Any:
    value: Any = case.model_dump(mode="json")
    for name in field.split("."):
        value = value.get(name) if isinstance(value, Mapping) else None
    return value


def _ranks(subject: StudySubject, dam: int) -> list[str]:
    """Say for each model which rank a dam has, and by which number."""
    sentences = []
    for row in subject.results.portfolio or ():
        own = next(entry for entry in row.dams if entry.dam == dam)
        of = f"{own.rank} of {len(row.dams):,} by the {row.model} model"
        if row.motions == 1:
            slip = own.residual_slip_m["largest"]
            ((text,),) = in_one_unit([[Amount(slip, zero="0")]], subject.units)
            sentences.append(f"{of}, in one motion: {'it fails' if slip is None else f'the residual slip is {text}'}.")
            continue
        shares = [
            f"{100.0 * share:.1f} % of the motions exceed the {limit_of(limit.limit, limit.value, subject.units)}"
            for limit, share in zip(row.limits, own.exceeds, strict=True)
        ]
        slips = [Amount(own.residual_slip_m[name], zero="0") for name in ("median", "84%", "largest")]
        ((half, most, largest),) = in_one_unit([slips], subject.units)
        slid = f"the residual slip stays below {half} in half of the motions and below {most} in 84 %"
        end = f"; the largest is {largest}" if own.residual_slip_m["largest"] is not None else "; some runs fail"
        sentences.append(f"{of}: {'; '.join([*shares, slid])}{end}.")
    return sentences


def _motions(subject: StudySubject, runs: list[dict[str, Any]]) -> Table:
    """Return the runs of a dam that slip most, those without a result first."""
    peaks = {
        motion["name"]: motion["measures"]["pga"] / STANDARD_GRAVITY for motion in subject.results.manifest["motions"]
    }
    ranked = sorted(runs, key=lambda run: np.inf if run[RESIDUAL_SLIP.key] is None else abs(run[RESIDUAL_SLIP.key]))
    worst = ranked[::-1][:_MOTIONS]
    slips = in_one_unit([[Amount(run[RESIDUAL_SLIP.key], zero="0")] for run in worst], subject.units)
    several = len(subject.results.walk.models) > 1
    rows: list[tuple[Inline, ...]] = [
        (
            Code(plain(run["motion"])),
            digits(peaks[run["motion"]] * run["factor"], 3),
            ("reversed" if run["reversed"] else "recorded") + (f", {run['model']}" if several else ""),
            run["outcome"],
            slip,
        )
        for run, (slip,) in zip(worst, slips, strict=True)
    ]
    some = f"The {len(worst)} worst of its {len(runs):,} runs" if len(runs) > len(worst) else "Its runs"
    caption = f"{some}: residual slip, positive downstream."
    return Table(("motion", "PGA [g]", "sign", "ended", "slip"), tuple(rows), caption, "lrllr")
