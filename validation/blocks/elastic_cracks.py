"""Cracks of the elastic dam that are not one plane of constant friction: friction laws, kinks, several cracks."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from heeltoe.case.model import Case
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.mesh.kinks import angles
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake, flexible, rigid
from validation.row import Row
from validation.sources import TYPICAL_SECTION, plane_case

_G = 9.80665
_UNSHAKEN_AFTER = {"silence": "0 s"}
#: A push that slides the low dam, and pulses that slide the high one.
_PUSH = {
    "points": [["0 s", "0 g"], ["0.05 s", "-9 m/s^2"], ["0.25 s", "-9 m/s^2"], ["0.3 s", "0 g"], ["2 s", "0 g"]],
}
_PULSES = [["0 s", "0 g"], ["0.15 s", "-0.6 g"], ["0.4 s", "0.5 g"], ["0.65 s", "-0.5 g"], ["0.9 s", "0.3 g"]]
_LAWS: dict[str, dict[str, Any]] = {
    "slip weakening": {
        "name": "slip weakening",
        "peak_friction": 0.7,
        "residual_friction": 0.5,
        "slip": "20 mm",
    },
    "speed weakening": {
        "name": "speed weakening",
        "peak_friction": 0.7,
        "residual_friction": 0.5,
        "speed": "0.1 m/s",
    },
    "cohesion": {"name": "cohesion", "cohesion": "15 kPa", "residual_friction": 0.4},
    "Barton-Bandis": {"name": "barton-bandis", "jrc": 6, "jcs": "10 MPa", "residual_angle": "20 deg"},
}


def _low(crack: dict[str, Any], modulus: str, step: str) -> Case:
    """Return a low dam that stands on all of its crack."""
    corners = [["0 m", "0 m"], ["40 m", "0 m"], ["34 m", "8 m"], ["0 m", "8 m"]]
    return plane_case(
        {
            "section": {"polygon": corners},
            "concrete": {"modulus": modulus},
            "crack": crack,
            "reservoir": {"depth": "7.5 m"},
            "uplift": {"pattern": "triangular"},
            "motion": _PUSH,
            "flexible": {"elements_across": 4, "evidence": "none", "time_step": step},
        }
    )


def flexible_laws() -> Iterator[Row]:
    """Friction laws in the elastic dam: stiff, it is the block with the same law; with equal numbers it is Coulomb's.

    A dam 8 m high on a crack of 40 m with water of 7.5 m, pushed downstream by 9 m/s2 for 0.25 s. At 200 000 GPa every
    node of the crack has nearly the mean of the block's linear stress, by which the block's law goes.
    """
    for name, law in _LAWS.items():
        case = _low({"law": law}, "200000 GPa", "0.05 ms")
        dam, block = flexible(case), rigid(case)
        why = "a law goes by the stress of each node, in the block by their mean"
        yield Row(
            f"{name}: slip [m]", block.residual_slip_m, dam.residual_slip_m, 0.03, remark=why, kind="own run", digits=5
        )
    flat = {"name": "slip weakening", "peak_friction": 0.6, "residual_friction": 0.6, "slip": "20 mm"}
    weak, plain = (flexible(_low(crack, "20 GPa", "0.2 ms")) for crack in ({"law": flat}, {"friction": 0.6}))
    what = "weakening from 0.6 to 0.6, 20 GPa: slip [m]"
    yield Row(what, plain.residual_slip_m, weak.residual_slip_m, 1e-10, kind="own run")


def sawtooth(rise: float, friction: float, push: float) -> Case:
    """Return a block of 8 m x 3 m on four teeth with flanks of a slope [rad], pushed downstream [m/s2]."""
    height = math.tan(rise)
    kinks = [[f"{place} m", f"{height * (place % 2)} m"] for place in range(1, 8)]
    return plane_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["8 m", "0 m"], ["8 m", "6 m"], ["0 m", "6 m"]]},
            "concrete": {"modulus": "1000 GPa"},
            "crack": {"elevation": "3 m", "kinks": kinks, "friction": friction},
            "uplift": {"pattern": "none"},
            "motion": {"points": [["0 s", f"{-push} m/s^2"], ["0.25 s", f"{-push} m/s^2"]]},
            "analysis": _UNSHAKEN_AFTER,
            "flexible": {"elements_across": 8, "evidence": "none", "time_step": "0.1 ms"},
        }
    )


def kinked_crack() -> Iterator[Row]:
    """Cracks that are not straight: a block climbs a sawtooth as a slope; a step without friction bears by itself.

    A block of 8 m x 3 m and 1000 GPa on teeth of 1 m slides where the push exceeds g tan(phi + i), and climbs as a
    point on a slope does. Below a dam of 110 m a step of 6 m without friction bears the water's push by the pressures
    normal to its pieces alone.
    """
    for degrees, friction in ((10.0, 0.3), (20.0, 0.2)):
        rise = math.radians(degrees)
        strength = _G * math.tan(math.atan(friction) + rise)
        kind = f"teeth of {degrees:g} degrees, friction {friction}"
        held = float(np.abs(flexible(sawtooth(rise, friction, 0.95 * strength)).histories["slip_m"]).max())
        yield Row(
            f"{kind}, 95 % of its resistance: largest slip [m]", 0.0, held, 1e-3, relative=False, kind="condition"
        )
        push = 1.4 * strength
        ours = float(flexible(sawtooth(rise, friction, push)).histories["slip_m"][-1])
        uphill = push * math.cos(rise) - _G * math.sin(rise)
        uphill -= friction * (_G * math.cos(rise) + push * math.sin(rise))
        slip = 0.5 * uphill * 0.25**2 * math.cos(rise)
        why = "block and teeth spring as the push begins at once"
        yield Row(f"{kind}, 140 % of it: slip after 0.25 s [m]", slip, ours, 0.05, remark=why, digits=5)
    yield _weakening_teeth()
    case = plane_case(
        {
            "section": {"height": "110 m", "crest_width": "8 m", "base_width": "90 m"},
            "concrete": {"modulus": "20 GPa"},
            "crack": {
                "elevation": "20 m",
                "friction": 0.0,
                "kinks": [["30 m", "0 m"], ["36 m", "6 m"], ["60 m", "0 m"]],
            },
            "reservoir": {"depth": "105 m"},
            "uplift": {"pattern": "none"},
            "motion": {"points": _PULSES},
            "flexible": {"elements_across": 6, "evidence": "none"},
        }
    )
    built = build_flexible_dam(case)
    along, across = built.crack_forces[0]
    body = built.bodies[0]
    push, weight = float(body.load[::2].sum()), float(body.load[1::2].sum())
    yield Row("step without friction: force along the crack [N/m]", -push, float(along.sum()), 1e-9)
    yield Row("step without friction: force across the crack [N/m]", -weight, float(across.sum()), 1e-9)
    slope = np.array(angles(body.mesh, body.mesh.crack, case))
    inner = np.flatnonzero(np.abs(np.diff(slope)) < 1e-9) + 1
    off = float(np.abs(along[inner] + np.tan(slope[inner]) * across[inner]).max() / abs(push))
    what = "step without friction: force along a piece, over the push"
    yield Row(what, 0.0, off, 1e-9, relative=False, kind="condition")


def _weakening_teeth() -> Row:
    """Up a slope with mu = mu_p - (mu_p - mu_r) d / D the motion is d'' = a + k d: d = a / k (cosh(sqrt(k) t) - 1)."""
    rise, peak, residual, over = math.radians(10.0), 0.4, 0.2, 0.2
    push = 1.5 * _G * math.tan(math.atan(peak) + rise)
    law = {"name": "slip weakening", "peak_friction": peak, "residual_friction": residual, "slip": f"{over} m"}
    ours = float(flexible(sawtooth(rise, peak, push).with_({"crack.law": law})).histories["slip_m"][-1])
    pressed = _G * math.cos(rise) + push * math.sin(rise)
    uphill, grows = push * math.cos(rise) - _G * math.sin(rise) - peak * pressed, (peak - residual) / over * pressed
    slip = uphill / grows * (math.cosh(math.sqrt(grows) * 0.25) - 1.0) * math.cos(rise)
    what = "teeth of 10 degrees, friction 0.4 to 0.2 over 0.2 m, 150 %: slip after 0.25 s [m]"
    return Row(what, slip, ours, 0.03, remark="block and teeth spring as the push begins at once", digits=5)


def _slabs(base: dict[str, Any], upper: dict[str, Any]) -> Case:
    """Return two dry stiff slabs of 16 m x 1 m and 16 m x 2 m, one on the other, under a pulse; their cracks have a
    coefficient of friction or a law."""
    return plane_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["16 m", "0 m"], ["16 m", "3 m"], ["0 m", "3 m"]]},
            "concrete": {"density": "2500 kg/m^3", "modulus": "20000 GPa", "poisson": 0.2},
            "crack": {"elevation": "0 m", **base},
            "further_cracks": [{"elevation": "2 m", **upper}],
            "uplift": {"pattern": "none"},
            "motion": {"points": [["0 s", "0 g"], ["0.05 s", "-0.5 g"], ["0.25 s", "-0.5 g"], ["0.3 s", "0 g"]]},
            "flexible": {"elements_across": 4, "evidence": "none", "time_step": "0.05 ms"},
        }
    )


def several_cracks() -> Iterator[Row]:
    """An elastic dam cracked at two levels: stiff slabs are two rigid blocks; with its base bonded the neck is alone.

    Slabs of 1 m on 2 m and 16 m wide with 20 000 GPa, under 0.5 g for 0.25 s: friction 0.3 below and 0.2 above, and
    with either crack bonded. The typical dam of 100 m has cracks at its base and at 90 m, 20 GPa and all modes, and
    five pulses; its base is bonded by a pressure that draws its faces together.
    """
    for base, upper, kind in ((0.3, 0.2, "both slide"), (0.3, 5.0, "upper bonded"), (5.0, 0.2, "base bonded")):
        case = _slabs({"friction": base}, {"friction": upper})
        dam, blocks = flexible(case).cracks, rigid(case).cracks
        for name, ours, reference in zip(("upper crack", "base"), dam, blocks, strict=True):
            slip, elastic_slip = reference["residual_slip_m"], ours["residual_slip_m"]
            yield Row(
                f"slabs, {kind}: slip of the {name} [m]",
                slip,
                elastic_slip,
                1e-3 if slip else 1e-5,
                relative=slip != 0.0,
                kind="own run",
                digits=5,
            )
    yield from _laws_of_slabs()
    yield from _bonded_base()


def _laws_of_slabs() -> Iterator[Row]:
    weak = {"law": {"name": "slip weakening", "peak_friction": 0.3, "residual_friction": 0.15, "slip": "50 mm"}}
    bonded = {"friction": 5.0}
    for place, case in enumerate((_slabs(bonded, weak), _slabs(weak, bonded))):
        name = ("upper crack", "base")[place]
        ours, block = flexible(case).cracks[place], rigid(case.single_crack_cases[place])
        what = f"slabs, friction 0.3 to 0.15 over 50 mm, other crack bonded: slip of the {name} [m]"
        yield Row(what, block.residual_slip_m, ours["residual_slip_m"], 2e-3, kind="own run", digits=5)
    anchor = {"head_x": "8 m", "head_elevation": "3 m", "foot_x": "8 m", "foot_elevation": "-2 m"}
    bare = _slabs({"friction": 0.3}, {"friction": 0.2})
    held = bare.with_({"anchors": [anchor | {"prestress": "500 kN/m"}]})
    forces = [[float(force[1].sum()) for force in build_flexible_dam(case).crack_forces] for case in (bare, held)]
    for name, without, with_anchor in zip(("upper crack", "base"), *forces, strict=True):
        yield Row(f"slabs, anchor of 500 kN/m: more force on the {name} [N/m]", 5e5, with_anchor - without, 1e-9)


def _bonded_base() -> Iterator[Row]:
    case = plane_case(
        {
            "section": TYPICAL_SECTION,
            "concrete": {"density": "2650 kg/m^3", "modulus": "20 GPa", "poisson": 0.143},
            "crack": {"elevation": "0 m", "friction": 0.9},
            "further_cracks": [{"elevation": "90 m", "friction": 0.8, "uplift": "triangular", "uplift_intensity": 1.0}],
            "reservoir": {"depth": "100 m"},
            "motion": {"points": [*_PULSES, ["1 s", "0 g"]], "duration": "1.5 s"},
            "analysis": _UNSHAKEN_AFTER,
            "flexible": {"elements_across": 4, "modes": 5000, "damping": "stiffness", "evidence": "none"},
        }
    )
    free, alone = _run(case), _run(case.single_crack_cases[0])
    # As a file may not have it: the pressure is negative, and friction beyond all that is plausible.
    crack = case.crack.model_copy(update={"friction": 1e3})
    drawn = case.uplift.model_copy(update={"pattern": "uniform", "intensity": -300.0})
    both = _run(case.model_copy(update={"crack": crack, "uplift": drawn}))
    neck, base = both.summaries
    yield Row("typical dam, base bonded: slip of the neck [m]", alone.summary.slip, neck.slip, 1e-6, kind="own run")
    what = "typical dam, base bonded: slip of the base [m]"
    yield Row(what, 0.0, base.slip, 1e-8, relative=False, kind="condition")
    worst = max(summary.energy_residual for summary in free.summaries)
    what = "typical dam, neither bonded: worst ledger, unexplained over turnover"
    yield Row(what, 0.0, worst, 1e-11, relative=False, kind="condition")
    lost = sum(summary.crack_friction for summary in free.summaries)
    what = "typical dam, neither bonded: work of friction of both cracks [J/m]"
    yield Row(what, free.summary.energy_friction, lost, 1e-9, kind="condition", digits=5)


def _run(case: Case) -> Any:
    return ShakenDam(case, build_flexible_dam(case), earthquake(case).shaking).run(2e-4, 0.01)
