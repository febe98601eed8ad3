"""Water that moves with the dam, and when rest ends: closed forms beside what the program makes of a case."""

from __future__ import annotations

from collections.abc import Iterator

from heeltoe.case.model import Case
from heeltoe.case.read import read_case
from heeltoe.mechanics.block import build_block
from heeltoe.mechanics.loads import reservoir_pressure, uplift
from heeltoe.mechanics.virtual_water import virtual_mass
from heeltoe.models.run import rigid
from validation.row import Row
from validation.sources import ENDS_WITH_MOTION, TYPICAL_SECTION

_G, _WATER, _CONCRETE = 9.81, 1000.0, 2650.0
_WIDTH, _DEPTH = 80.0, 90.0


def water() -> Iterator[Row]:
    """Typical dam, 90 m of water: still and moving water and uplift beside their integrals."""
    case = _typical()
    moved, still, lift = virtual_mass(case), reservoir_pressure(case), uplift(case)
    yield Row("push of the reservoir [kN]", 0.5 * _WATER * _G * _DEPTH**2 / 1e3, still.horizontal / 1e3, 1e-12)
    yield Row("its moment about the heel [kN m]", -_WATER * _G * _DEPTH**3 / 6.0 / 1e3, still.moment / 1e3, 1e-12)
    yield Row("uplift, triangular [kN]", 0.5 * _WATER * _G * _DEPTH * _WIDTH / 1e3, lift.vertical / 1e3, 1e-12)
    yield Row("Westergaard's mass, 7/12 rho h^2 [t]", 7.0 / 12.0 * _WATER * _DEPTH**2 / 1e3, moved.mass / 1e3, 1e-12)
    yield Row("its height, 0.4 h [m]", 0.4 * _DEPTH, moved.height, 1e-12)
    # The integral of sqrt(1 - x) (x - 2/5)^2 over its own mass.
    second = 8.0 / 35.0 * 3.0 / 10.0
    yield Row("its inertia about it, 12/175 m h^2", second, moved.inertia / (moved.mass * _DEPTH**2), 1e-12)


def rest_ends() -> Iterator[Row]:
    """Typical dam, 90 m of water: the acceleration at which it slides, and at which it rocks about its toe."""
    push, lift = 0.5 * _WATER * _G * _DEPTH**2, 0.5 * _WATER * _G * _DEPTH * _WIDTH
    rectangle, triangle = 8.0 * 100.0, 0.5 * 72.0 * 90.0
    mass = _CONCRETE * (rectangle + triangle)
    water_mass = 7.0 / 12.0 * _WATER * _DEPTH**2
    sliding = (1.0 * (mass * _G - lift) - push) / (mass + water_mass)
    # About the toe: what holds is the weight; uplift, push and the inertia of concrete and water turn the dam over.
    weight = _CONCRETE * _G * (rectangle * (_WIDTH - 4.0) + triangle * (72.0 * 2.0 / 3.0))
    against = lift * _WIDTH * 2.0 / 3.0 + push * _DEPTH / 3.0
    arm = _CONCRETE * (rectangle * 50.0 + triangle * 30.0) + water_mass * 0.4 * _DEPTH
    rocking = (weight - against) / arm
    critical = build_block(_typical()).critical_accelerations()
    equation = "Zhu (2004), equation 4.3.12, by hand"
    yield Row("sliding downstream [g]", sliding / _G, critical.sliding_downstream / _G, 1e-12, remark=equation)
    yield Row("rocking about the toe [g]", rocking / _G, critical.rocking_downstream / _G, 1e-12)
    for part, moves in ((0.999, 0.0), (1.001, 1.0)):
        peak = part * sliding / _G
        step = {"points": [["0 s", "0 g"], ["1 s", f"{-peak} g"], ["1 s", "0 g"], ["2 s", "0 g"]]}
        slip = rigid(_typical(motion=step)).residual_slip_m
        what = f"slides under a ramp to {part} of that ({moves:g})"
        yield Row(what, moves, float(slip > 0.0), 0.0, relative=False, kind="condition")


def _typical(**more: object) -> Case:
    return read_case(
        {
            "gravity": f"{_G} m/s^2",
            "section": TYPICAL_SECTION,
            "concrete": {"density": f"{_CONCRETE} kg/m^3"},
            "crack": {"friction": 1.0},
            "reservoir": {"depth": f"{_DEPTH} m"},
            **ENDS_WITH_MOTION,
            **more,
        }
    )
