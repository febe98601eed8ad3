"""Subject of a report: the case, its result, and the numbers in the result's JSON."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from heeltoe.base.blocks import Block, numbers_in
from heeltoe.case.model import Case
from heeltoe.errors.sanitize import plain
from heeltoe.result.response import Response
from heeltoe.units.write import NOTHING
from heeltoe.views.content.tree import FigureBlock, Inline, Table
from heeltoe.views.words.numbers import QUANTITIES, Numbers, Value
from heeltoe.views.words.response import NAMES

if TYPE_CHECKING:
    from heeltoe.models.statics.joints import Joints
    from heeltoe.models.statics.model import Statics

#: Label, key in the JSON, and the quantity where the key does not say it.
Labels = Sequence[tuple[str, str, str | None]]


def labels_of(kind: type[Block], above: str = "") -> Labels:
    """Return what the numbers of a block of results are called in tables; `above` stands before their keys."""
    return [(label, key, QUANTITIES.get(unit, "number")) for label, key, unit in numbers_in(kind, above)]


MODELS = {
    "rigid": "the rigid model",
    "flexible": "the flexible model",
    "decoupled": "the decoupled chain",
}


@dataclass(frozen=True, eq=False)
class Run:
    """One response, and where it stands in the JSON: the prefix is empty, or ``beside.``."""

    response: Response
    prefix: str

    @property
    def name(self) -> str:
        """Head of a column of the run."""
        return NAMES.get(self.response.model, self.response.model)

    @property
    def model(self) -> str:
        """Model that computed the run, in a sentence."""
        return MODELS.get(self.response.model, f"the {self.response.model} model")


@dataclass(frozen=True, eq=False)
class Subject:
    """All that the builders need to know.

    Attributes
    ----------
    case, result
        What was asked, and what came out.
    numbers
        Writes the numbers of the result's JSON.
    figures
        By name, as :func:`heeltoe.views.figures.all.all_figures` calls them.
    joints
        Static checks at the cracks and at the sections that the case lists, if there are any.
    command
        What was typed to get this report; empty if it was not typed.
    """

    case: Case
    result: Response
    numbers: Numbers
    figures: Mapping[str, FigureBlock]
    joints: Joints | None = None
    command: str = ""

    @cached_property
    def runs(self) -> tuple[Run, ...]:
        """Return the response, after the one beside it."""
        return tuple(Run(item, "" if item is self.result else "beside.") for item in self.result.responses)

    @cached_property
    def others(self) -> Mapping[str, Response]:
        """Return the response at further cracks, by name."""
        return self.result.others

    @property
    def statics(self) -> Statics | None:
        """The static checks of the section that governs."""
        return None if self.joints is None else self.joints.governing.statics

    @cached_property
    def references(self) -> tuple[str, ...]:
        """Return the sources for exactly what was used, in the order of their numbers."""
        cited = [text for run in self.runs for text in run.response.citation()]
        joints = () if self.joints is None else self.joints.joints
        checked = [text for joint in joints for text in joint.statics.references]
        return tuple(dict.fromkeys([*cited, *checked]))

    @property
    def first(self) -> Run:
        """Return the run that is judged, and holds everything that the runs share: case, motion, static loads."""
        return self.runs[-1]

    @property
    def units(self) -> str:
        """The name of the units, ``"si"`` or ``"us"``."""
        return self.numbers.units.name

    @property
    def per_width(self) -> str:
        """Width to which forces, energies and masses refer."""
        return "per foot of dam" if self.units == "us" else "per metre of dam"

    @property
    def title(self) -> str:
        """Title of the case."""
        return plain(self.case.title) or "Untitled case"

    def ran(self, model: str) -> bool:
        """Whether a model is part of the report."""
        return any(run.response.model == model for run in self.runs)

    def row(self, label: Inline, key: str, quantity: str | None = None, *, sign: float = 1.0) -> tuple[Inline, ...]:
        """Return a row of a table: the same number of every run."""
        return (label, *(self.numbers(run.prefix + key, quantity, sign=sign) for run in self.runs))

    def compared(self, labels: Labels, caption: str) -> Table:
        """Return a table of such rows: those in which a run has anything but zero."""
        rows = [self.row(*label) for label in labels]
        moved = [row for row in rows if any(isinstance(cell, Value) and cell.number for cell in row[1:])]
        return Table(self.head(), tuple(moved), caption, self.align())

    def values(self, labels: Labels, prefix: str, caption: str, present: Container[str] | None = None) -> Table:
        """Return a table of label and number; `prefix` stands before their keys. Only numbers that are `present`, where
        these are given."""
        shown = [(label, key, quantity) for label, key, quantity in labels if present is None or key in present]
        rows = tuple((label, self.numbers(f"{prefix}{key}", quantity)) for label, key, quantity in shown)
        return Table(("", "value"), rows, caption, "lr")

    def known(self, labels: Labels, prefix: str, caption: str) -> Table:
        """Return such a table of the numbers that there are."""
        known = [key for _, key, _ in labels if self.numbers(prefix + key) != NOTHING]
        return self.values(labels, prefix, caption, known)

    def figure(self, *names: str) -> tuple[FigureBlock, ...]:
        """Return those of the named figures that are there, of every run."""
        prefixes = ["", *(f"{name}/" for name in self.others), *(f"{run.response.model}/" for run in self.runs[:-1])]
        keys = [f"{prefix}{name}" for prefix in prefixes for name in names]
        return tuple(self.figures[key] for key in keys if key in self.figures)

    def head(self, *columns: str) -> tuple[str, ...]:
        """Return the head of a table of :meth:`row`."""
        return ("", *((run.name for run in self.runs) if len(self.runs) > 1 else ("value",)), *columns)

    def align(self, more: int = 0) -> str:
        """Return the alignment of a table of :meth:`row`."""
        return "l" + "r" * (len(self.runs) + more)
