"""Static checks of the small dams of a book on the strength of materials.

The numbers of B. K. Sarkar, *Strength of Materials*, chapter 14, are those of a public program of its worked examples
(FOSSEE, Scilab textbook companion 3772); the book itself was not at hand. Of its problems those are taken that
hold water and of which the program does not say that the book errs; none has uplift.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from heeltoe.models.statics.load_case import LoadCase
from validation.row import Row
from validation.textbooks import G, case_of, dam

_DRY = {"uplift": {"pattern": "none"}}


def sarkar() -> Iterator[Row]:
    """Sarkar, chapter 14: dams of 3 to 30 m without uplift, their stresses, widths and sliding factor."""
    height = 10.0**0.5
    load_case = _dam([(0.0, 0.0), (2.0, 0.0), (2.0, height), (0.0, height)], 25.0, height, 10.0, friction=0.5)
    yield _row("14.1, a wall 2 m wide as high as no tension allows, stress at heel [kPa]", 0.0, _heel(load_case), 1e-6)
    yield _row("14.1, its sliding factor", 1.58, load_case.sliding_factor, 0.006)
    load_case = _dam(_trapezium(1.0, 4.0, 6.0), 22.4, 5.5, 10.0)
    yield _row("14.3, stress at toe [kPa]", 112.38, _toe(load_case), 0.006)
    yield _row("14.3, stress at heel [kPa]", 55.62, _heel(load_case), 0.006)
    load_case = _dam(_trapezium(5.13, 17.08, 30.0), 22.56, 29.0, 9.81)
    rounded = "on the way to the widths 27.17 stands for 27.21, 0.16 % of an arm, which is 1.3 kPa"
    yield _row("14.5, 30 m, widths of no tension, stress at toe [kPa]", 880.0, _toe(load_case), 1.4, rounded)
    yield _row("14.5, 30 m, widths of no tension, stress at heel [kPa]", 0.0, _heel(load_case), 1.4, rounded)
    load_case = _dam(_trapezium(1.0, 4.13, 8.0), 22.4, 7.5, 9.81, friction=0.6)
    yield _row("14.7, sliding factor of the least width for it", 1.0, load_case.sliding_factor, 0.001)
    battered = [(0.0, 0.0), (7.0, 0.0), (2.0, 10.0), (1.0, 10.0)]
    load_case = _dam(battered, 19.62, 10.0, 9.81)
    yield _row("14.8, battered, stress at toe [kPa]", 228.23, _toe(load_case), 0.006)
    yield _row("14.8, battered, stress at heel [kPa]", 10.01, _heel(load_case), 0.006)


def _trapezium(top: float, base: float, height: float) -> list[tuple[float, float]]:
    return [(0.0, 0.0), (base, 0.0), (top, height), (0.0, height)]


def _dam(
    corners: list[tuple[float, float]], weight: float, depth: float, water: float, friction: float = 0.6
) -> LoadCase:
    """Return the usual case of a dam of some unit weight before water of some depth and unit weight [kN/m3]."""
    fields: dict[str, Any] = dam(corners, weight, depth, friction, **_DRY)
    fields["reservoir"] |= {"density": f"{water / G * 1e3!r} kg/m^3"}
    return case_of(fields)


def _toe(load_case: LoadCase) -> float | None:
    return None if load_case.toe_stress_pa is None else load_case.toe_stress_pa / 1e3


def _heel(load_case: LoadCase) -> float | None:
    return None if load_case.heel_stress_pa is None else load_case.heel_stress_pa / 1e3


def _row(what: str, printed: float, ours: float | None, good: float, reason: str = "") -> Row:
    assert ours is not None
    remark = "Sarkar, Strength of Materials, chapter 14, to the digits that are printed" + (reason and f"; {reason}")
    return Row(what, printed, ours, good, relative=False, remark=remark, kind="book")
