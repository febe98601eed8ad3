"""Static checks of dams that books work out by hand.

The numbers of Punmia and others, *Irrigation and Water Power Engineering*, chapter 8, are those that public programs of
its worked examples print (FOSSEE, Scilab textbook companion 2087); the book itself was not at hand.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from heeltoe.case.read import read_case
from heeltoe.mechanics.virtual_water import moving_force
from heeltoe.mechanics.zangar import coefficient
from heeltoe.models.statics.load_case import LoadCase
from heeltoe.models.statics.model import statics
from validation.row import Row

#: Gravity of all these books [m/s^2].
G = 9.81
# Books let the base take the tension that they find.
_WHOLE = {"bonded": 1.0, "tensile_strength": "100 MPa"}
_PRINTED = "Punmia, example {}, to the digits that are printed"
_APART = "with horizontal and vertical parts of a force counted apart, as the book does"


def dam(corners: list[tuple[float, float]], weight: float, water: float, friction: float, **more: Any) -> Any:
    """Return the fields of a dam of some corners [m], of concrete of a unit weight [kN/m3], before water [m]."""
    fields: dict[str, Any] = {
        "gravity": f"{G} m/s^2",
        "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
        "concrete": {"density": f"{weight / G * 1e3!r} kg/m^3"},
        "crack": {"friction": friction},
        "reservoir": {"depth": f"{water} m"},
        "statics": _WHOLE,
    }
    return fields | more


def case_of(fields: Any, name: str = "usual") -> LoadCase:
    return next(load_case for load_case in statics(read_case(fields)).cases if load_case.name == name)


def _stresses(
    label: str, load_case: LoadCase, toe: float, heel: float, example: str, good: float = 0.06
) -> Iterator[Row]:
    """Return stresses at toe and heel beside printed ones [kPa], good for the last digit unless said otherwise."""
    remark = _PRINTED.format(example)
    for end, printed, ours in (("toe", toe, load_case.toe_stress_pa), ("heel", heel, load_case.heel_stress_pa)):
        assert ours is not None
        yield Row(
            f"{label}, stress at {end} [kPa]", printed, ours / 1e3, good, relative=False, remark=remark, kind="book"
        )


def _factor(label: str, printed: float, ours: float | None, good: float, example: str, **more: Any) -> Row:
    assert ours is not None
    remark = _PRINTED.format(example)
    if "reason" in more:
        remark += f"; {more.pop('reason')}"
    return Row(label, printed, ours, good, relative=False, remark=remark, kind="book", **more)


def _overturning_apart(load_case: LoadCase) -> float:
    """Return stabilising over overturning moments about the toe, horizontal and vertical parts of each force apart."""
    parts = [
        moment
        for line in load_case.sheet("toe").lines
        for moment in ((line.distance_m or 0.0) * line.vertical_n, -(line.height_m or 0.0) * line.horizontal_n)
    ]
    return sum(part for part in parts if part > 0.0) / -sum(part for part in parts if part < 0.0)


def punmia_walls() -> Iterator[Row]:
    """Punmia, chapter 8: walls of 6 and 10 m, reservoir empty and full, with uplift and without."""
    wall = [(0.0, 0.0), (4.5, 0.0), (1.5, 6.0), (0.0, 6.0)]
    heavy = 2.4 * G
    dry = dam(wall, heavy, 6.0, 0.6)
    del dry["reservoir"]
    yield from _stresses("8.9, empty", case_of(dry), 15.7, 172.7, "8.9")
    yield from _stresses("8.9, full", case_of(dam(wall, heavy, 6.0, 0.6)), 120.3, 9.2, "8.9")
    wide = [(0.0, 0.0), (4.94, 0.0), (1.5, 6.0), (0.0, 6.0)]
    yield _factor("8.10, sliding factor", 0.82, case_of(dam(wide, 20.0, 6.0, 0.6)).sliding_factor, 0.006, "8.10")
    slim = [(0.0, 0.0), (3.77, 0.0), (1.5, 6.0), (0.0, 6.0)]
    without = case_of(dam(slim, 20.0, 6.0, 0.6, uplift={"pattern": "none"}))
    yield _factor("8.11, no uplift, sliding factor", 1.074, without.sliding_factor, 6e-4, "8.11")
    sloped = [(0.0, 0.0), (8.25, 0.0), (2.0, 10.0), (1.0, 10.0)]
    load_case = case_of(dam(sloped, 22.4, 10.0, 0.75))
    yield from _stresses("8.14", load_case, 170.7, -5.8, "8.14")
    yield _factor("8.14, sliding factor", 1.04, load_case.sliding_factor, 0.006, "8.14")
    yield _factor("8.14, overturning factor", 1.47, _overturning_apart(load_case), 0.006, "8.14", reason=_APART)


def punmia_dams() -> Iterator[Row]:
    """Punmia, chapter 8: dams of 70 to 90 m with drains, tailwater and seismic coefficients.

    The book has 0.299 p h^2 for the moment of Zangar's pressure, of which 0.2917 is the integral, leaves out its
    vertical part on the slope, and reads 0.712 off the curve for a slope of 0.1, where ours is 0.698, or 0.735 where
    half the face is vertical.
    """
    tall = [(0.0, 0.0), (52.5, 0.0), (10.5, 60.0), (10.5, 70.0), (3.5, 70.0), (3.5, 35.0)]
    drains = {"pattern": "drained", "drain_position": 6.5 / 52.5, "drain_efficiency": 2.0 / 3.0}
    empty = dam(tall, 24.0, 70.0, 0.7)
    del empty["reservoir"]
    yield from _stresses("8.16, empty", case_of(empty), 143.5, 1512.5, "8.16")
    without = case_of(dam(tall, 24.0, 70.0, 0.7, uplift={"pattern": "none"}))
    yield from _stresses("8.16, full, no uplift", without, 1301.7, 423.0, "8.16")
    full = case_of(dam(tall, 24.0, 70.0, 0.7, uplift=drains))
    yield from _stresses("8.16, full, drains", full, 1347.9, 62.9, "8.16")
    yield _factor("8.16, full, drains, sliding factor", 1.079, full.sliding_factor, 6e-4, "8.16")
    shaken = {"seismic_coefficient": 0.1, "vertical_seismic_coefficient": 0.08, **_WHOLE}
    zangar = {"hydrodynamic": "zangar"}
    moved = dam(tall, 24.0, 70.0, 0.7, uplift=drains, statics=shaken)
    moved["reservoir"] |= zangar
    quake = case_of(moved, "pseudo-static downstream, lifting")
    yield from _shaken("8.16", quake, (1717.3, -439.0, 0.761), "8.16")
    broad = [(0.0, 0.0), (73.1, 0.0), (15.0, 83.0), (15.0, 90.0), (8.0, 90.0), (8.0, 28.0)]
    moved = dam(broad, 23.5, 89.0, 0.75, uplift={"intensity": 2.0 / 3.0})
    moved["statics"] = {"seismic_coefficient": 0.1, **_WHOLE}
    moved["reservoir"] |= zangar
    quake = case_of(moved, "pseudo-static downstream")
    yield from _shaken("8.15", quake, (1948.3, -342.0, 0.874), "8.15")
    reason = f"{_APART}; {_BY_THE_BOOK}"
    apart = _overturning_apart(quake)
    yield _factor("8.15, overturning factor", 1.439, apart, 6e-4, "8.15", explained=0.03, reason=reason)
    high = [(0.0, 0.0), (56.0, 0.0), (6.0, 75.0), (6.0, 84.0), (0.0, 84.0)]
    drains = {"pattern": "drained", "drain_position": 8.0 / 56.0, "drain_efficiency": 2.0 / 3.0}
    load_case = case_of(dam(high, 23.5, 80.0, 0.7, uplift=drains, tailwater={"depth": "6 m"}))
    yield from _stresses("8.20, drains and tailwater", load_case, 1586.7, -49.3, "8.20")


def _shaken(label: str, load_case: LoadCase, printed: tuple[float, float, float], example: str) -> Iterator[Row]:
    """Return stresses at toe and heel [kPa] and sliding factor under a seismic coefficient beside printed ones."""
    assert load_case.toe_stress_pa is not None
    assert load_case.heel_stress_pa is not None
    reason = f"{_PRINTED.format(example)}; {_BY_THE_BOOK}"
    ours = load_case.toe_stress_pa / 1e3, load_case.heel_stress_pa / 1e3
    for end, of_book, value in zip(("toe", "heel"), printed[:2], ours, strict=True):
        what = f"{label}, seismic, stress at {end} [kPa]"
        yield Row(what, of_book, value, 0.06, relative=False, remark=reason, kind="book", explained=0.02 * printed[0])
    yield _factor(
        f"{label}, seismic, sliding factor",
        printed[2],
        load_case.sliding_factor,
        6e-4,
        example,
        explained=0.01,
        reason=_BY_THE_BOOK,
    )


_BY_THE_BOOK = "the book's moment, slope and curve of Zangar's pressure"


def zangar_pressure() -> Iterator[Row]:
    """Zangar's pressure: sums over a vertical face, and C_m of sloping ones as books have it."""
    fields = dam([(0.0, 0.0), (70.0, 0.0), (7.0, 90.0), (7.0, 100.0), (0.0, 100.0)], 24.0, 98.0, 0.7)
    fields["reservoir"] |= {"hydrodynamic": "zangar"}
    force = moving_force(read_case(fields), -G)
    unit = 0.735 * G * 1e3 * 98.0
    print_ = "Zangar (1952), as Punmia's examples 8.1 and 8.2 have it"
    push, turn = force.horizontal / (unit * 98.0), -force.moment / (unit * 98.0**2)
    yield Row("shear at the base, of C_m a rho h^2", 0.726, push, 5e-4, remark=print_, kind="book")
    yield Row(
        "moment at the base, of C_m a rho h^3",
        0.299,
        turn,
        2e-3,
        remark=f"{print_}; the integral of the printed pressure is (1/4 + 1/3)/2 = 0.2917",
        kind="book",
        explained=0.026,
    )
    yield Row("the same by its integral", 7.0 / 24.0, turn, 1e-12)
    line = "Punmia, example 8.13, has the straight line 0.735 (1 - angle/90 degrees); ours is Zangar's curve"
    yield Row("C_m of a slope of 0.15", 0.6653, coefficient(0.15), 1e-3, remark=line, kind="book", explained=0.025)
    curve = "Punmia, example 8.16, reads it off the curve; ours off another copy of it"
    yield Row("C_m of a slope of 0.1", 0.712, coefficient(0.1), 5e-3, remark=curve, kind="book", explained=0.025)


def elementary() -> Iterator[Row]:
    """Elementary profiles: the widths that just stand by two books, and the forces of a lecture's dam."""
    weight, height = 2.4, 50.0
    for share in (0.0, 0.5, 1.0):
        base = height / (weight - share) ** 0.5
        triangle = [(0.0, 0.0), (base, 0.0), (0.0, height)]
        load_case = case_of(dam(triangle, weight * G, height, 0.7, uplift={"intensity": share}))
        remark = "Asawa, Irrigation and Water Resources Engineering, section 16.5: b^2 (s - c) = h^2 leaves no tension"
        assert load_case.heel_stress_pa is not None
        ours = load_case.heel_stress_pa / 1e3
        what = f"uplift {share:g}, stress at heel [kPa]"
        yield Row(what, 0.0, ours, 1e-6, relative=False, remark=remark, kind="book")
    friction = 0.75
    triangle = [(0.0, 0.0), (height / (friction * (weight - 1.0)), 0.0), (0.0, height)]
    yield Row(
        "sliding factor of the width for it",
        1.0,
        case_of(dam(triangle, weight * G, height, friction)).sliding_factor or 0.0,
        1e-9,
        remark="IASRI, stability analysis of gravity dams, lesson 32, equation 32.3: b = h / (mu (s - 1))",
        kind="book",
    )
    lecture = [(0.0, 0.0), (62.0, 0.0), (12.0, 75.0), (12.0, 84.0), (0.0, 84.0)]
    sheet = case_of(dam(lecture, 2.4 * G, 80.0, 0.7)).sheet("toe")
    lines = {line.name: line for line in sheet.lines}
    remark = "a lecture, Determination of forces in dam (84 m high, water of 80 m): 2419.2 t at 56 m, 4500 t at 33.33 m"
    yield Row("weight [t]", 6919.2, -lines["weight"].vertical_n / G / 1e3, 1e-6, remark=remark, kind="book")
    turning = 2419.2 * 56.0 + 4500.0 * 100.0 / 3.0
    yield Row("its moment about the toe [t m]", turning, lines["weight"].moment_nm / G / 1e3, 1e-6, remark=remark)
    yield Row(
        "push of the water [t]", 3200.0, lines["reservoir"].horizontal_n / G / 1e3, 1e-6, remark=remark, kind="book"
    )
    yield Row("its height [m]", 26.67, lines["reservoir"].height_m or 0.0, 2e-4, remark=remark, kind="book")
