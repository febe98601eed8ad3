"""Subject of the report of a study."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from heeltoe.case.model import Case
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.views.content.tree import FigureBlock
from heeltoe.views.words.numbers import Numbers


@dataclass(frozen=True, eq=False)
class StudySubject:
    """Subject of the report.

    Attributes
    ----------
    found
        The study.
    directory
        Where relative paths of its base case start.
    numbers
        Writes the numbers of the study's JSON.
    figures
        Figures of the study, by name.
    command
        Typed command; empty without one.
    """

    results: StudyResults
    directory: Path
    numbers: Numbers
    figures: Mapping[str, FigureBlock]
    command: str

    @cached_property
    def case(self) -> Case:
        """Its base case."""
        return Case.of(self.results.manifest["case"], self.directory)

    @property
    def study(self) -> dict[str, Any]:
        """The study file as read."""
        return dict(self.results.manifest["study"])

    @property
    def units(self) -> str:
        """The name of the units, ``"si"`` or ``"us"``."""
        return self.numbers.units.name

    def figure(self, *names: str) -> tuple[FigureBlock, ...]:
        """Return those of the figures that are there."""
        return tuple(self.figures[name] for name in names if name in self.figures)
