"""What the static check of the usual loads tells whoever runs an earthquake: whether the crack is open before."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from heeltoe.case.model import Case
from heeltoe.mechanics.block import Block, build_block
from heeltoe.result.response import Response
from heeltoe.warnings import Notice

R = TypeVar("R", bound=Response)

if TYPE_CHECKING:
    from heeltoe.models.statics.load_case import Solved

# A crack that opens without changing the uplift by this part of the force across it changes no result.
_NOTICED = 1e-3


def with_standing(response: R, case: Case) -> R:
    """Return the response with a warning where the usual loads open the crack, water following.

    The models of the earthquake keep the uplift of the case. A run that never started says why by itself.
    """
    said = standing_warnings(case) if response.summary else ()
    return replace(response, warnings=(*response.warnings, *said)) if said else response


def standing_warnings(case: Case) -> tuple[Notice, ...]:
    """Return what the usual loads do to the crack that a run of the earthquake does not count; nothing where the crack
    stays closed."""
    block = build_block(case)
    position = block.resultant_position
    # In the middle third nothing opens: no need for more. What floats at once, every model says by itself.
    if position is None or 1.0 / 3.0 <= position / block.width <= 2.0 / 3.0:
        return ()
    from heeltoe.models.statics.cases import usual

    solved = usual(case)
    if solved.load_case.outcome == "stands":
        return _opened(case, block, solved)
    return (Notice("crack-opens-through"),)


def _opened(case: Case, block: Block, solved: Solved) -> tuple[Notice, ...]:
    found = solved.load_case
    change = block.normal_force - found.normal_force_n
    if not found.cracked_length_m or abs(change) < _NOTICED * block.normal_force:
        return ()
    remedy = "heeltoe statics counts it"
    # Meant to be copied into the case: it stays as it is in all units.
    if case.reservoir is not None:
        unit = case.gravity * case.reservoir.density
        points = [f'[{x / block.width:.4g}, "{p / unit:.4g} m"]' for x, p in solved.settled.profile.tolist()]
        drawn = ", ".join(dict.fromkeys(points))
        remedy = f'to count it set uplift.pattern = "profile", points = [{drawn}]'
        if case.uplift.intensity != 1.0:
            remedy += " and intensity = 1"
    said = Notice(
        "crack-opens",
        length_m=found.cracked_length_m,
        corner=found.cracked_from,
        share=found.cracked_length_m / block.width,
        lift_n=change,
        remedy=remedy,
    )
    return (said,)
