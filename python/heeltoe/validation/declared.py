"""What a reference case declares beside its rows."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal

from heeltoe.result.response import Response
from heeltoe.validation.chart import Chart
from heeltoe.validation.row import Row

Model = Literal["rigid", "flexible", "decoupled", "statics"]
MODELS: tuple[Model, ...] = ("rigid", "flexible", "decoupled", "statics")


@dataclass(frozen=True)
class Declared:
    """A reference case.

    Attributes
    ----------
    rows
        The program that makes its rows; its docstring says what the case is.
    models
        The models that it tries.
    source
        Where the references come from.
    convergence
        How it is seen that ours does not depend on step and mesh, or why there is nothing to see.
    spread
        How far ours moves with a little more or less shaking, or why that does not apply.
    chart
        How its rows are drawn, where a figure says more than the table.
    history
        Runs what its figure of histories shows.
    long
        Whether it takes more than a moment; the slow tests compute it.
    records
        Whether it needs strong-motion records that are no part of the project.
    steady
        How far, as a part of them, numbers may be from ours on another machine: a motion in which dams strike carries
        rounding on. Where it is infinite the page is held to words and verdicts alone.
    """

    rows: Callable[[], Iterable[Row]]
    models: tuple[Model, ...]
    source: str
    convergence: str
    spread: str
    chart: Chart | None = None
    history: Callable[[], Response] | None = None
    long: bool = False
    records: bool = False
    steady: float = 0.0

    @property
    def title(self) -> str:
        """What the case is, in a line."""
        return self.text.partition("\n")[0]

    @property
    def text(self) -> str:
        """What the case is."""
        # An optimizing Python keeps no docstrings.
        lines = (self.rows.__doc__ or "").strip().splitlines()
        return "\n".join(line.strip() for line in lines)


@dataclass(frozen=True)
class Absent:
    """What could stand in the book and does not.

    Attributes
    ----------
    what
        The reference.
    models
        The models that it would try.
    why
        Why it cannot be reproduced.
    """

    what: str
    models: tuple[Model, ...]
    why: str
