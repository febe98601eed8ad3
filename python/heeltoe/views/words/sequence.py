"""What each motion of a sequence does, as rows of a table."""

from __future__ import annotations

from collections.abc import Iterator

from heeltoe.errors.sanitize import plain
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.response import Response
from heeltoe.views.words.numbers import Amount, Cell, in_one_unit

COLUMNS = ("motion", "peak", "slip in it", "slip after it", "opens upstream", "at rest", "static checks")


def part_lines(motion: GroundMotion, gravity: float) -> Iterator[str]:
    """Walk the motions of a sequence: name, peak, from when to when, and what was done to each."""
    for number, part in enumerate(motion.parts, 1):
        yield "; ".join(
            (
                f"{number} {plain(part.name)}: {part.pga / gravity:.4g} g, {part.begins:.4g} to {part.ends:.4g} s",
                *map(plain, part.processing),
            )
        )


def sequence_rows(response: Response, units: str) -> list[list[str]]:
    """Return the rows of :data:`COLUMNS`; slips are positive downstream."""
    rows: list[tuple[Cell, ...]] = []
    for number, stage in enumerate(response.sequence, 1):
        rows.append(
            (
                f"{number} ({stage.begins_s:.4g} s)",
                f"{stage.pga_g:.3g} g",
                Amount(stage.slip_m),
                Amount(stage.residual_slip_m),
                Amount(stage.opening_upstream_m, "opening"),
                "yes" if stage.at_rest else "no",
                "met" if stage.static["ok"] else f"{len(stage.static['missed'])} not met",
            )
        )
    return in_one_unit(rows, units)
