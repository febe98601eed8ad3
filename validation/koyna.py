"""Koyna Dam by the decoupled chain, El Centro 1940 at 0.49 g, beside an independent program.

The program has the arrangement of Zhu (2004), section 5.5.2, which "uniformly attaches along the crack the mass of the
upper portion"; the virtual water of the block is in one point, as there. The slips of the thesis belong to the record
of 1967, which is not part of the project."""

from __future__ import annotations

from collections.abc import Iterator

from heeltoe.models.run import decoupled
from validation.row import Row
from validation.sources import plane_case
from validation.thesis_dams import record_named

_G = 9.80665
_FRICTION = (0.8, 1.0, 1.2)
# Residual slips of the program in mm, by damping and uplift, for each friction.
_INDEPENDENT = {
    (0.05, "triangular"): (762.0, 467.0, 473.0),
    (0.05, "uniform"): (1447.0, 953.0, 872.0),
    (0.10, "triangular"): (356.0, 148.0, 148.0),
    (0.10, "uniform"): (663.0, 389.0, 401.0),
}
_GOOD = 0.01
_LITERAL = "the mass of the concrete alone; a dam that bounces differs by some mm between two programs"
_ANOTHER = (
    "another arrangement on purpose: a rigid body has its lever arm, its inertia and its virtual water, swings at "
    "0.355 s instead of 0.258 s, and brings 2.5 times the ground's peak to the crack instead of 4.1 times"
)


def koyna_chain() -> Iterator[Row]:
    """Residual slips in mm: the mass on the crack, as in the thesis, and the part above as a rigid body."""
    for part in ("mass on the crack", "rigid body"):
        for (damping, uplift), slips in _INDEPENDENT.items():
            if part == "rigid body" and damping != 0.05:
                continue
            for friction, slip in zip(_FRICTION, slips, strict=True):
                what = f"{part}, {damping:.0%}, {uplift} uplift, friction {friction}"
                alike = part == "mass on the crack"
                remark = _LITERAL if alike else _ANOTHER
                ours = _slip_mm(part, damping, uplift, friction)
                yield Row(what, slip, ours, _GOOD if alike else None, remark=remark, kind="prototype")


def _slip_mm(part: str, damping: float, uplift: str, friction: float) -> float:
    case = plane_case(
        {
            "section": {
                "height": "103 m",
                "crest_width": "14.8 m",
                "neck_height": "66.5 m",
                "neck_width": "20.36 m",
                "base_width": "70.2 m",
            },
            "concrete": {"density": "2643 kg/m^3", "modulus": "31 GPa", "poisson": 0.2, "damping": damping},
            "crack": {"elevation": "66.5 m", "friction": friction, "restitution": 0.5},
            "reservoir": {"depth": "91.75 m", "virtual_mass_rotates": False},
            "uplift": {"pattern": uplift},
            "decoupled": {"upper_part": part},
        }
    )
    motion = record_named("elcentro-1940-180-nga").scaled_to(0.49 * _G).cut(30.0)
    slip: float = decoupled(case, motion).residual_slip_m
    return 1e3 * slip
