"""Result of the static check of the usual loads for a run: whether the crack is open before."""

from __future__ import annotations

from typing import TYPE_CHECKING

from heeltoe.case.model import Case
from heeltoe.mechanics.block import StaticState
from heeltoe.mechanics.loads import crack_water_density
from heeltoe.warnings.notice import Notice

if TYPE_CHECKING:
    from heeltoe.models.statics.load_case import Solved

# A crack that opens without changing the uplift by this part of the force across it changes no result.
_NOTICED = 1e-3


def standing_warnings(case: Case, static: StaticState) -> tuple[Notice, ...]:
    """Return what the usual loads do to the crack that a run of the earthquake does not count; nothing where the crack
    stays closed.

    The models of the earthquake keep the uplift of the case, of which `static` is the state of its block.
    """
    position, width = static.resultant_from_heel_m, case.cut.crack_width
    # In the middle third nothing opens: no need for more. What floats at once, every model says by itself.
    if position is None or 1.0 / 3.0 <= position / width <= 2.0 / 3.0:
        return ()
    from heeltoe.models.statics.cases import usual

    solved = usual(case)
    if solved.load_case.outcome == "stands":
        return _opened(case, static.normal_force_n, solved)
    return (Notice("crack-opens-through"),)


def _opened(case: Case, normal_force: float, solved: Solved) -> tuple[Notice, ...]:
    load_case = solved.load_case
    width = case.cut.crack_width
    change = normal_force - load_case.normal_force_n
    if not load_case.cracked_length_m or abs(change) < _NOTICED * normal_force:
        return ()
    remedy = "heeltoe statics counts it"
    # Meant to be copied into the case: it stays as it is in all units.
    if case.reservoir is not None or case.tailwater is not None:
        unit = case.gravity * crack_water_density(case)
        points = [f'[{x / width:.4g}, "{p / unit:.4g} m"]' for x, p in solved.settled.profile.tolist()]
        drawn = ", ".join(dict.fromkeys(points))
        remedy = f'to count it set uplift.pattern = "profile", points = [{drawn}]'
        if case.uplift.intensity != 1.0:
            remedy += " and intensity = 1"
    notice = Notice(
        "crack-opens",
        length_m=load_case.cracked_length_m,
        corner=load_case.cracked_from,
        share=load_case.cracked_length_m / width,
        lift_n=abs(change),
        more="more" if change > 0.0 else "less",
        remedy=remedy,
    )
    return (notice,)
