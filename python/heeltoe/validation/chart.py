"""How the rows of a case are drawn: references as marks, ours as lines."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heeltoe.validation.row import Row
from heeltoe.views.figures.style import WIDTH, styled

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
            found = re.search(self.pattern, row.what)
            if found and panel in row.what:
                yield found.groupdict().get("series") or "", float(found["x"]), row

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
                    axes.plot(places, [row.ours for _, row in of_kind], dashes, color=colour, label=ours)
