"""The penalty method of Zhu (2004) beside exact contact: where both agree, and where the penalty makes energy."""

from __future__ import annotations

from collections.abc import Iterator

from heeltoe.case.model import Case
from heeltoe.models.run import flexible
from heeltoe.result.response import Response
from validation.row import Row
from validation.sources import ENDS_WITH_MOTION, TYPICAL_SECTION, plane_case
from validation.thesis_dams import record_named

_G = 9.81
_AGREED = 0.04


def penalty() -> Iterator[Row]:
    """IDCE (penalty, Newmark) against exact contact: typical dam, Taft at 0.4 g, 8 elements across."""
    for name, elevation, depth, step in (("base crack", 0.0, 100.0, 2e-4), ("crack at 90 m", 90.0, 95.0, 1e-4)):
        exact = _run(elevation, depth, step, {"contact": "coulomb"})
        slip = 1e3 * exact.residual_slip_m
        for gamma in (0.6, 0.7, 0.9):
            other = _run(elevation, depth, step, {"contact": "idce", "newmark_gamma": gamma})
            yield Row(
                f"{name}, gamma {gamma}: slip [mm]",
                slip,
                1e3 * other.residual_slip_m,
                _AGREED if gamma >= 0.7 else None,
                remark=_remark(other),
                kind="own run",
            )
        wild = _run(elevation, depth, step, {"contact": "idce", "newmark_gamma": 0.5})
        yield Row(
            f"{name}, gamma 0.5: slip [mm]",
            slip,
            1e3 * wild.residual_slip_m,
            None,
            remark=f"average acceleration with a penalty is unstable: {_remark(wild)}",
            kind="own run",
        )
        yield Row(
            f"{name}, gamma 0.5: the result says so (1)",
            1.0,
            float(wild.outcome != "ok" or any(warning.code == "energy-made" for warning in wild.warnings)),
            0.0,
            kind="condition",
        )


def _remark(response: Response) -> str:
    energy = response.energy
    assert energy is not None
    return (
        f"contact makes {energy.gained_j / 1e6:.3g} MJ and the scheme takes {energy.numerical_j / 1e6:.3g} MJ, beside "
        f"{energy.input_j / 1e6:.3g} MJ put in; outcome {response.outcome}"
    )


def _run(elevation: float, depth: float, step: float, options: dict[str, str | float]) -> Response:
    motion = record_named("taft-1952-s69e-caltech").scaled_to(0.4 * _G).cut(20.0)
    return flexible(_case(elevation, depth, step, options), motion)


def _case(elevation: float, depth: float, step: float, options: dict[str, str | float]) -> Case:
    return plane_case(
        {
            "gravity": f"{_G} m/s^2",
            "section": TYPICAL_SECTION,
            "concrete": {"density": "2650 kg/m^3", "modulus": "20 GPa", "poisson": 0.143},
            "crack": {"elevation": f"{elevation} m", "friction": 1.2 if elevation == 0.0 else 1.0},
            "reservoir": {"depth": f"{depth} m"},
            **ENDS_WITH_MOTION,
            "flexible": {
                "damping": "thesis",
                "virtual_mass": "thesis",
                "evidence": "none",
                "time_step": f"{step} s",
                **options,
            },
        }
    )
