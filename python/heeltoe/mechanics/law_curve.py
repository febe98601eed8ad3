"""The curve of a friction law: how much shear a crack bears over its normal stress, by slip, speed or pressure."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number
from heeltoe.case.crack.crack import Crack
from heeltoe.case.crack.law import Law
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import near
from heeltoe.kernel.friction import shear_stress
from heeltoe.mechanics.block import build_block
from heeltoe.mechanics.friction import crack_law, references_of_law

#: Numbers that show what a law looks like; they are those of no dam.
SAMPLES: dict[str, dict[str, Any]] = {
    "constant": {"static_friction": 1.2, "kinetic_friction": 1.0},
    "slip weakening": {"peak_friction": 1.2, "residual_friction": 0.8, "slip": "20 mm"},
    "speed weakening": {"peak_friction": 1.2, "residual_friction": 0.9, "speed": "0.1 m/s"},
    "cohesion": {"cohesion": "0.3 MPa", "residual_friction": 0.8, "slip": "5 mm"},
    "barton-bandis": {"jrc": 10, "jcs": "20 MPa", "residual_angle": "32 deg"},
    "lift joint": {
        "surface": "untreated",
        "basic_friction": 0.7,
        "roughness_friction": [["0.1 MPa", 0.4], ["0.5 MPa", 0.2], ["2 MPa", 0.1]],
    },
}
#: Normal stress of a law that belongs to no dam [Pa].
SAMPLE_STRESS = 1e6
_POINTS = 241
# The curve goes on to so many times the way or the speed over which friction is lost.
_BEYOND = 3.0


class LawCurve(Block):
    """The apparent friction of a law, strength over normal stress."""

    law: Annotated[str, Number("Name of the law.")]
    title: Annotated[str, Number("The owner: a case, or numbers that only show its shape.")]
    over: Annotated[str, Number('Its argument: "slip path", "slip speed" or "normal stress".')]
    at: Annotated[Floats, Number("Places along that, in m, m/s or Pa.")]
    friction: Annotated[Floats, Number("Apparent friction there of a crack that slips.")]
    at_rest: Annotated[float, Number("Apparent friction before any slip under `normal_stress_pa`.")]
    normal_stress_pa: Annotated[
        float, Number("Normal stress: that of the curve, or the one of the dam's static loads.", "Pa")
    ]
    references: Annotated[tuple[str, ...], Number("Where the law is from.")]


def sample_curve(name: str) -> LawCurve:
    """Return the curve of a law by its name, with numbers that show its shape.

    Raises
    ------
    InputError
        Where there is no such law.
    """
    if name not in SAMPLES:
        raise InputError("law-unknown", "law", name, names=", ".join(SAMPLES), near=near(name, SAMPLES))
    fields = SAMPLES[name]
    crack = Crack(**fields) if name == "constant" else Crack(law=Law(name=name, **fields))  # type: ignore[arg-type]
    return _curve(crack, SAMPLE_STRESS, "sample numbers, those of no dam")


def curve_of(case: Case) -> LawCurve:
    """Return the curve of the crack of a case, under its static loads.

    Raises
    ------
    InputError
        Where the crack does not cut the section in two.
    """
    block = build_block(case)
    return _curve(case.crack, max(block.normal_force, 1.0) / block.width, case.title or "untitled case")


def curves_of(case: Case) -> dict[str, LawCurve]:
    """Return the curves of all cracks of a case that have a law: ``law`` is that of ``[crack]``, ``crack-1/law`` that
    of the uppermost where it is another one. Without a law the curve is that of the coefficients of ``[crack]``.

    Raises
    ------
    InputError
        Where a crack does not cut the section in two.
    """
    curves = {}
    for place, alone in enumerate(case.single_crack_cases):
        if alone.crack.law is not None:
            curve = curve_of(alone)
            at = f"crack at {alone.crack.elevation:g} m" if case.further_cracks else ""
            title = ", ".join(text for text in (curve.title, at) if text)
            curves["law" if place == case.asked else f"crack-{place + 1}/law"] = replace(curve, title=title)
    return curves or {"law": curve_of(case)}


def _curve(crack: Crack, stress: float, title: str) -> LawCurve:
    law, kernel = crack.law, crack_law(crack)
    name = "constant" if law is None else law.name
    over, end = _goes_by(law, stress)
    at = np.linspace(0.0, end, _POINTS)
    if over == "normal stress":
        at = at[1:]
        friction = shear_stress(kernel, at)[1] / at
    else:
        path, speed = (at, 0.0) if over == "slip path" else (0.0, at)
        friction = shear_stress(kernel, stress, path, speed)[1] / stress
    at_rest = float(shear_stress(kernel, stress)[0]) / stress
    if crack.roughness is not None:
        # Up the asperities, before they wear: the tangent of the sum of both angles.
        slope = crack.roughness.slope
        friction, at_rest = (friction + slope) / (1.0 - slope * friction), crack.apparent_friction
        title = f"{title}; up its asperities, before they wear"
    sources = () if law is None else references_of_law(law)
    return LawCurve(
        law=name,
        title=title,
        over=over,
        at=at,
        friction=friction,
        at_rest=at_rest,
        normal_stress_pa=stress,
        references=sources,
    )


def _goes_by(law: Law | None, stress: float) -> tuple[str, float]:
    """Return what the curve goes by, and how far it is drawn."""
    if law is not None and law.speed is not None:
        return "slip speed", _BEYOND * law.speed
    if law is not None and law.name in ("barton-bandis", "lift joint"):
        return "normal stress", _BEYOND * stress
    way = None if law is None else law.slip
    return "slip path", _BEYOND * (0.01 if way is None else way)
