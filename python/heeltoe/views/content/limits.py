"""The verdict: results compared with the user's limits, and static checks that are not met."""

from __future__ import annotations

from heeltoe.models.statics.joints import Joint
from heeltoe.result.verdict import limited
from heeltoe.units.sentences import quantity
from heeltoe.views.content.subject import Subject
from heeltoe.views.content.tree import Block, Code, Inline, Section, Table, paragraph

_QUANTITIES = {"m": "displacement", "rad": "rotation", "g": "g"}
_EXAMPLE = {"si": "100 mm", "us": "4 in"}


def limits(subject: Subject) -> Section:
    """Return the verdict against the limits that the user has set."""
    n = subject.numbers
    rows: list[tuple[Inline, ...]] = []
    for run in subject.runs:
        for place, check in enumerate(run.response.limits):
            key = f"{run.prefix}limits.{place}."
            label = limited(check, subject.units)
            label = label[0].upper() + label[1:]
            rows.append(
                (
                    label if len(subject.runs) == 1 else f"{label}, {run.name}",
                    n(key + "value", _QUANTITIES[check.unit]),
                    n(key + "allowed", _QUANTITIES[check.unit]),
                    n(key + "utilisation", "share"),
                    ("yes" if check.met else "NO") + ("" if check.certain else ", within its uncertainty"),
                )
            )
    blocks: list[Block] = []
    if rows:
        blocks.append(
            Table(
                ("", "result", "allowed", "used", "met"),
                tuple(rows),
                "Results beside the limits, slips either way.",
                "lrrrl",
            )
        )
    elif any(run.response.ok for run in subject.runs):
        blocks.append(
            paragraph(
                "The case sets no limits. To have the results judged, add for example ",
                Code(f'residual_slip = "{_EXAMPLE[subject.units]}"'),
                " under ",
                Code("[limits]"),
                ".",
            )
        )
    else:
        blocks.append(paragraph("There is no result to compare with limits."))
    joints = () if subject.joints is None else subject.joints.ranked
    failed = "; ".join(
        f"{check.name} ({check.load_case}{_at(joint, subject) if len(joints) > 1 else ''})"
        for joint in joints
        for check in joint.statics.checks
        if not check.met
    )
    if any(joint.statics.checks for joint in joints):
        blocks.append(paragraph(f"Static checks not met: {failed}." if failed else "All static checks are met."))
    return Section("Verdict against limits", tuple(blocks))


def _at(joint: Joint, subject: Subject) -> str:
    return f" at {quantity(joint.elevation_m, '.5g m', subject.units)}"
