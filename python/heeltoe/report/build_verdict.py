"""Static checks, and everything beside what the user allows."""

from __future__ import annotations

from typing import Any

from heeltoe.report.content import Block, Code, Inline, Section, Table, paragraph
from heeltoe.report.numbers import NOTHING, digits
from heeltoe.report.subject import Subject

_LIMITS = {
    "residual_slip": "Residual slip, either way",
    "peak_slip": "Largest slip, either way",
    "opening_upstream": "Opening at the upstream face",
    "opening_downstream": "Opening at the downstream face",
}


def statics(subject: Subject) -> Section | None:
    """Return the static checks; None where there are none."""
    checks = tuple(getattr(subject.statics, "checks", ()))
    if not checks:
        return None
    rows: list[tuple[Inline, ...]] = []
    for check in checks:
        rows.append((str(check.load_case), str(check.name), _plain(check.value), _plain(check.required), _met(check.met), str(check.source)))
    blocks: list[Block] = [
        Table(
            ("load case", "check", "value", "required", "met", "source"),
            tuple(rows),
            "Static checks before, during and after the earthquake; factors have no unit.",
            "llrrll",
            (2.4, 3.2, 1.4, 1.5, 1.0, 3.8),
        )
    ]
    blocks += [paragraph(str(check.sentence)) for check in checks if getattr(check, "sentence", "")]
    return Section("Static checks", tuple(blocks))


def limits(subject: Subject) -> Section:
    """Return the verdict against the limits that the user has set."""
    n = subject.numbers
    rows: list[tuple[Inline, ...]] = []
    for run in subject.runs:
        for place, check in enumerate(run.response.limits):
            key = f"{run.prefix}limits.{place}."
            label = _LIMITS.get(check.name, check.name)
            rows.append(
                (
                    label if len(subject.runs) == 1 else f"{label}, {run.name}",
                    n(key + "value_m"),
                    n(key + "allowed_m"),
                    "yes" if check.met else "NO",
                )
            )
    blocks: list[Block] = []
    if rows:
        blocks.append(Table(("", "result", "allowed", "met"), tuple(rows), "Results beside the limits.", "lrrl"))
    elif any(run.response.ok for run in subject.runs):
        blocks.append(
            paragraph(
                "The case sets no limits. To have the results judged, add for example ",
                Code('residual_slip = "100 mm"'),
                " under ",
                Code("[limits]"),
                ".",
            )
        )
    else:
        blocks.append(paragraph("There is no result to compare with limits."))
    failed = [check for check in getattr(subject.statics, "checks", ()) if check.met is False]
    if failed:
        blocks.append(paragraph(f"Static checks that are not met: {'; '.join(f'{c.name} ({c.load_case})' for c in failed)}."))
    return Section("Verdict against limits", tuple(blocks))


def _plain(value: Any) -> Inline:
    if isinstance(value, int | float) and not isinstance(value, bool):
        return digits(float(value), 3)
    return NOTHING if value is None else str(value)


def _met(met: bool | None) -> Inline:
    return NOTHING if met is None else ("yes" if met else "NO")


