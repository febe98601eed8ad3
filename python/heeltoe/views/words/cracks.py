"""What each of several cracks did, as rows of a table."""

from __future__ import annotations

from heeltoe.result.response import Response
from heeltoe.units.sentences import written
from heeltoe.views.words.numbers import Amount, Cell, in_one_unit

COLUMNS = ("crack at", "residual slip", "peak down", "peak up", "opening up", "opening down", "strikes")


def crack_rows(response: Response, units: str) -> list[list[str]]:
    """Return the rows of :data:`COLUMNS`, from the crest down."""
    cells: list[list[Cell]] = []
    for place, crack in enumerate(response.cracks):
        at = written("{at_m:g m}", units, at_m=crack.elevation)
        mark = " (leads)" if place == response.asked else ""
        slips = (crack.residual_slip_m, crack.peak_slip_downstream_m, -crack.peak_slip_upstream_m)
        openings = (crack.opening_upstream_m, crack.opening_downstream_m)
        amounts = [*(Amount(slip, "slip") for slip in slips), *(Amount(opening, "opening") for opening in openings)]
        cells.append([f"{at}{mark}", *amounts])
    rows = in_one_unit(cells, units)
    return [[*row, str(crack.impacts)] for crack, row in zip(response.cracks, rows, strict=True)]
