"""What a reference case declares beside its rows."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heeltoe.result.response import Response
from heeltoe.views.figures.style import WIDTH, styled
from validation.row import Row

# Okabe and Ito's colours, with dashes beside them for print.
_LINES = (("#0072B2", "-"), ("#D55E00", "--"), ("#009E73", "-."), ("#CC79A7", ":"), ("#56B4E9", "-"), ("#000000", "--"))
#: So many places stand on the axis themselves.
_MOST_TICKS = 8
_MARKS = {"thesis": "o", "book": "s", "prototype": "x", "program": "D", "closed form": "o"}


@dataclass(frozen=True)
class Chart:
    """Rows as curves.

    Attributes
    ----------
    pattern
        What finds a point in a row's text: a regular expression with the group ``x`` and, where there are several
        curves, ``series``.
    x, y
        What stands on the axes.
    log
        Which of x and y go by decades.
    panels
        What a row's text must have to stand in each panel, by its heading; one panel without.
    """

    pattern: str
    x: str
    y: str
    log: str = ""
    panels: tuple[tuple[str, str], ...] = ()

    def points(self, rows: list[Row], panel: str = "") -> Iterator[tuple[str, float, Row]]:
        """Return curve and place of each row that is drawn."""
        for row in rows:
            match = re.search(self.pattern, row.what)
            if match and panel in row.what:
                yield match.groupdict().get("series") or "", float(match["x"]), row

    @styled
    def draw(self, rows: list[Row]) -> Figure:
        """Draw rows."""
        panels = self.panels or (("", ""),)
        figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
        axes = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
        for place, (title, panel) in zip(axes, panels, strict=True):
            self._draw_panel(place, list(self.points(rows, panel)))
            place.set_title(title, fontsize=9, loc="left")
            place.set_xlabel(self.x)
        axes[0].set_ylabel(self.y)
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8)
        return figure

    def _draw_panel(self, axes: Axes, points: list[tuple[str, float, Row]]) -> None:
        if "y" in self.log:
            axes.set_yscale("log")
        places = sorted({x for _, x, _ in points})
        if "x" in self.log:
            axes.set_xscale("log")
        elif len(places) <= _MOST_TICKS:
            axes.set_xticks(places)
        for number, series in enumerate(dict.fromkeys(name for name, *_ in points)):
            colour, dashes = _LINES[number % len(_LINES)]
            mine = [(x, row) for name, x, row in points if name == series]
            for kind in dict.fromkeys(row.kind for _, row in mine):
                of_kind = sorted(((x, row) for x, row in mine if row.kind == kind), key=lambda pair: pair[0])
                places = [x for x, _ in of_kind]
                name = f"{series}, {kind}" if series else kind
                axes.plot(
                    places,
                    [row.reference for _, row in of_kind],
                    linestyle="",
                    marker=_MARKS.get(kind, "o"),
                    markerfacecolor="none",
                    color=colour,
                    label=name,
                )
                if kind == next(iter(dict.fromkeys(row.kind for _, row in mine))):
                    ours = f"{series}, heeltoe" if series else "heeltoe"
                    # One point is no line.
                    mark = "_" if len(places) == 1 else ""
                    axes.plot(
                        places,
                        [row.ours for _, row in of_kind],
                        dashes,
                        color=colour,
                        label=ours,
                        marker=mark,
                        markersize=14,
                    )


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
