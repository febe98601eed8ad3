"""The input: section, what the case says, what was left to defaults; its hash and how to run it again."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence

import numpy as np

from heeltoe.case.field_usage import readers
from heeltoe.case.model import Case
from heeltoe.errors.sanitize import plain
from heeltoe.kernel.build import build_info
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.units.sentences import quantity
from heeltoe.views.content.checks import entered
from heeltoe.views.content.subject import Subject
from heeltoe.views.content.tree import Block, Code, Inline, Listing, Section, Strong, Table, glued, paragraph
from heeltoe.views.words.fields import fields
from heeltoe.views.words.sheet import lines

_SYSTEMS = {"si": "SI", "us": "US"}
_WIDE = 2.6
"""Width of the column that says what a revision changed, over that of each of the others."""


def input_section(subject: Subject) -> Section:
    """Return the section with the drawing of the dam and all fields that the case gives."""
    rows = case_rows(subject.case, subject.units)
    text = (
        f"Fields of the case, in {_SYSTEMS[subject.units]} units {subject.per_width}; x points downstream, z up. "
        "Fields left to the program’s defaults are in the appendix; "
    )
    return Section(
        "Input",
        (
            paragraph(text, Code("heeltoe explain FIELD"), " says what a field means."),
            # Figures first: the tables, which are smaller, fill what is left of the page.
            *subject.figure("section"),
            Table(("field", "value"), tuple(row[:2] for row in rows), "Given by the case.", "ll"),
            *_loads(subject),
        ),
    )


def _loads(subject: Subject) -> tuple[Block, ...]:
    """Return the usual loads as forces, arms and moments, where the report has static checks."""
    if subject.joints is None:
        return ()
    joint = subject.joints.governing
    usual = next((case for case in joint.statics.cases if case.name == "usual"), None)
    if usual is None:
        return ()
    written = lines(usual, subject.units)
    at = quantity(joint.elevation_m, ".5g m", subject.units)
    rows: list[tuple[Inline, ...]] = [tuple(map(glued, row[:-1])) for row in written.rows]
    rows[-1] = tuple(Strong(cell) if isinstance(cell, str) and cell else "" for cell in rows[-1])
    caption = (
        f"Loads before the earthquake on the part above the crack at {at}, {subject.per_width}: H positive downstream, "
        "V upward, M = x\u00a0V\u00a0−\u00a0z\u00a0H counter-clockwise; arms from the heel of the closed part."
    )
    caption += entered(joint.statics, subject.units)
    return (Table(written.head[:-1], tuple(rows), caption, "lrrrrr"),)


def defaults(subject: Subject) -> Section:
    """Return the appendix with all fields at their defaults."""
    models = {"statics", *(run.response.model for run in subject.runs)}
    rows = tuple(
        (Code(path), value)
        for path, value, *_ in fields(
            subject.case, subject.case.model_dump(mode="json"), units=subject.units, given=False
        )
        if value != "none" and readers(path) & models
    )
    return Section(
        "Appendix: defaults",
        (
            paragraph(
                "Fields that the case does not give and that the models of this report or its static checks read, with "
                "the values that were used; what is not listed is none. ",
                Code("heeltoe explain FIELD"),
                " says what one means.",
            ),
            Table(("field", "value"), rows, "Left to defaults.", "ll"),
        ),
    )


def rerun(subject: Subject) -> Section:
    """Return the section that lets anyone run the same again."""
    digest = input_hash(subject.case, *(run.response.components for run in subject.runs[:1]))
    return rerun_section(
        "With the input above, this command writes this report again:",
        subject.command or _command(subject),
        build_info(),
        paragraph(Strong("Input, SHA-256. "), Code(digest)),
        paragraph(
            "The hash covers every field of the case in SI units, defaults included and the title block left out, and "
            "the samples of the ground motion as used, so that the same hash and the same build mean the same numbers."
        ),
    )


def named(case: Case) -> list[str]:
    """Return the project and the revision of a report, for every page, where they are given."""
    project = case.project
    revision = f"revision {project.revision}" if project.revision else ""
    return [plain(text, 40) for text in (project.name, revision) if text]


def revisions(case: Case) -> Table | None:
    """Return the table of revisions of a report, where the case has one."""
    head, *lines = case.project.history() or ((),)
    if not lines:
        return None
    rows: tuple[tuple[Inline, ...], ...] = tuple(tuple(map(plain, line)) for line in lines)
    widths = tuple(_WIDE if name == "Change" else 1.0 for name in head)
    return Table(head, rows, "Revisions of this report.", "l" * len(head), widths)


def input_hash(case: Case, motions: Sequence[GroundMotion | None]) -> str:
    """Return the SHA-256 of a case as canonical JSON, of its mesh files and of the samples of its motions."""
    hashed = hashlib.sha256()
    written = case.model_dump(mode="json", exclude={"project"})
    text = json.dumps(written, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    hashed.update(text.encode())
    for name in (case.flexible.mesh_above, case.flexible.mesh_below):
        path = name and case.base_directory / name
        if path and path.is_file():
            hashed.update(path.read_bytes())
    for motion in motions:
        if motion is not None:
            for samples in (motion.time, motion.acceleration):
                hashed.update(np.ascontiguousarray(samples, dtype="<f8").tobytes())
    return hashed.hexdigest()


def _command(subject: Subject) -> str:
    chosen = subject.result.chosen
    model = subject.result.model if chosen is None else chosen.asked
    spread = " --spread" if any(run.response.spread is not None for run in subject.runs) else ""
    units = "" if subject.units == subject.case.units else f" --units {subject.units}"
    return f"heeltoe run CASE.toml --model {model}{spread}{units} --report"


def case_rows(case: Case, units: str) -> tuple[tuple[Inline, ...], ...]:
    """Return the fields of a case that are given: path, value, meaning."""
    written = case.model_dump(mode="json")
    return tuple(
        (Code(path), value, meaning.replace("`", ""))
        for path, value, _, meaning in fields(case, written, units=units, given=True)
    )


def case_table(case: Case, units: str, caption: str) -> Table:
    """Return the fields of a case that are given as a table."""
    return Table(("field", "value", "meaning"), case_rows(case, units), caption, "lll", (3.8, 2.7, 5.7))


def rerun_section(promise: str, command: str, build: Mapping[str, str], *more: Block) -> Section:
    """Return the section that lets anyone run the same again: what the `command` promises, and the versions."""
    versions = " ".join(f"{name} {version}" for name, version in build.items())
    return Section(
        "To run it again", (paragraph(promise), Listing(command), paragraph(Strong("Build. "), Code(versions)), *more)
    )
