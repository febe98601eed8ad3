"""Blocks of Zhu (2004), chapters IV and V, and of the prototypes made after it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from heeltoe.case.read import read_case
from heeltoe.models.run import rigid
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.response import Response
from validation.plain import rectangle, run, sampled
from validation.row import Row
from validation.sources import ENDS_WITH_MOTION

_PRINTED = "printed as parabolas, exact"
_TWO = "two prototypes, good for the digits in which they agree"


def impulse() -> Iterator[Row]:
    """Block 1 x 1 m, friction 0.2, ground 0.8 g for 0.1 s: the printed parabolas."""
    response = impulse_response()
    t, g = response.histories["time_s"], response.gravity
    printed = np.where(t <= 0.1, -0.3 * g * t**2, 0.1 * g * t**2 - 0.08 * g * t + 0.004 * g)
    worst = float(np.abs(response.histories["slip_m"] - printed).max())
    yield Row(
        "largest distance from the parabolas [m]", 0.0, worst, 1e-9, relative=False, remark=_PRINTED, kind="thesis"
    )
    yield Row("slip after 0.4 s [m]", -0.012 * g, response.residual_slip_m, 1e-12, remark=_PRINTED, kind="thesis")


def impulse_response() -> Response:
    """Push the block of the impulse."""
    case = read_case(
        {
            "title": "Block 1 x 1 m, friction 0.2",
            "section": {"polygon": [["0 m", "0 m"], ["1 m", "0 m"], ["1 m", "1 m"], ["0 m", "1 m"]]},
            "crack": {"friction": 0.2},
            "motion": {
                "points": [["0 s", "0.8 g"], ["0.1 s", "0.8 g"], ["0.1 s", "0 g"], ["0.4 s", "0 g"]],
            },
            **ENDS_WITH_MOTION,
        }
    )
    return rigid(case, output_step=0.001)


def sine() -> Iterator[Row]:
    """Block 1 x 1 m, friction 0.2, ground 0.5 g sin(pi t / 0.2): printed times of zero slip velocity."""
    block = rectangle(1.0, 1.0, 0.2, gravity=9.80665)
    ground = sampled(lambda t: 0.5 * 9.80665 * np.sin(np.pi * t / 0.2), 1e-5, 1.6)
    rocking = run(block, *ground)
    printed = (0.026198, 0.261845, 0.454995, 0.657297, 0.856571, 1.056805, 1.256730, 1.456755)
    times = rocking.times_of("slip starts")[:1] + rocking.times_of("slip stops")
    for k, (reference, ours) in enumerate(zip(printed, times, strict=False), 1):
        yield Row(
            f"zero velocity {k} [s]",
            reference,
            ours,
            1e-6,
            relative=False,
            remark="printed with six decimals",
            kind="thesis",
        )


def drifting() -> Iterator[Row]:
    """Rectangle 8 x 10 m, 5 m of water, triangular uplift, friction 1.2, e = 0.5; half sine of 1.5 g and 0.4 s."""
    response = drifting_response()
    remark = _TWO
    yield Row("slip [mm]", 20.839, 1e3 * response.residual_slip_m, 1e-4, remark=remark, kind="prototype")
    part = 1e3 * response.slip_by_mode_m["drifting"]
    yield Row(
        "drifting part [mm]",
        20.5,
        part,
        0.02,
        remark=f"{remark}; the part depends on when bouncing is called contact",
        kind="prototype",
    )
    yield Row("rocking upstream [rad]", 6.352e-3, response.rocking_upstream_rad, 1e-3, remark=remark, kind="prototype")
    yield Row(
        "rocking downstream [rad]", 4.0988e-2, response.rocking_downstream_rad, 1e-3, remark=remark, kind="prototype"
    )
    yield Row("at rest in the end", 1.0, float(response.final_mode == "rest"), 0.0, kind="prototype")


def drifting_response() -> Response:
    """Shake the rectangle that drifts."""
    case = read_case(
        {
            "title": "Rectangle 8 x 10 m, 5 m of water",
            "gravity": "9.81 m/s^2",
            "section": {"polygon": [["0 m", "0 m"], ["8 m", "0 m"], ["8 m", "10 m"], ["0 m", "10 m"]]},
            "concrete": {"density": "2650 kg/m^3"},
            "crack": {"friction": 1.2, "restitution": 0.5},
            "reservoir": {"depth": "5 m", "virtual_mass_rotates": False},
            **ENDS_WITH_MOTION,
        }
    )
    ground = sampled(lambda t: np.where(t < 0.4, -1.5 * 9.81 * np.sin(np.pi * t / 0.4), 0.0), 0.005, 3.0)
    return rigid(case, GroundMotion.from_points(*ground, name="half sine"))


def dry_block() -> Iterator[Row]:
    """Dry block 1 x 3 m, friction 1, ground 0.8 g for 0.1 s sampled at 0.005 s; rocking both ways, g = 9.81."""
    time = np.arange(301, dtype=np.float64) * 0.005
    ground = np.where(time < 0.0975, 0.8 * 9.81, 0.0)
    for restitution, reference in ((0.0, 0.016974), (0.5, 0.016974), (0.9, 0.01683)):
        block = rectangle(1.0, 3.0, 1.0, gravity=9.81, restitution=restitution)
        summary = run(block, time, ground).summary
        label = f"e = {restitution:g}: rocking"
        yield Row(f"{label} upstream [rad]", 0.023497, summary.rotation_max, 1e-4, remark=_TWO, kind="prototype")
        yield Row(f"{label} downstream [rad]", reference, -summary.rotation_min, 5e-4, remark=_TWO, kind="prototype")
        yield Row(f"e = {restitution:g}: slip [m]", 0.0, summary.slip, 0.0, relative=False, kind="prototype")
