"""The static checks in words and numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence

from heeltoe.models.statics.checks import Check
from heeltoe.models.statics.joints import Joint, Joints
from heeltoe.models.statics.model import Statics
from heeltoe.models.statics.spectral import SpectralDemand
from heeltoe.units.sentences import numbers, quantity, written
from heeltoe.units.write import length


def basis(statics: Statics, units: str) -> list[tuple[str, str]]:
    """Return labels and texts of the input of the checks."""
    critical, water = statics.critical_acceleration_g, statics.critical_water_level_m
    lines = [
        ("criteria", f"{statics.criteria}, {statics.structure} structure, {statics.site_information} site information")
    ]
    bonded = any(load_case.cohesive_force_n for load_case in statics.cases)
    for kind in ("sliding", "rocking"):
        down, up = critical[f"{kind}_downstream"], critical[f"{kind}_upstream"]
        text = f"{_acceleration(down)} downstream, {_acceleration(up)} upstream"
        # A crack that slides has no cohesion in the models of the earthquake either.
        lines.append((f"{kind} starts at", f"{text}, without cohesion" if bonded and kind == "sliding" else text))
    none = f"none up to {quantity(statics.highest_water_level_m, '.2f m', units)} of water"
    for key, label in (
        ("sliding", "sliding factor 1 at"),
        ("sliding_required", "sliding factor required at"),
        ("overturning", "overturns at"),
        ("flotation", "floats at"),
    ):
        level = water[key]
        depth = none if level is None else f"{quantity(level, '.2f m', units)} of water"
        lines.append((label, f"{depth}, with cohesion" if bonded and key.startswith("sliding") else depth))
    if statics.response_spectrum is not None:
        lines.append(("response spectrum", _demand(statics.response_spectrum, units)))
    if statics.slip_m is not None:
        lines.append(("residual slip", f"{length(statics.slip_m, units)}: {statics.slip_source}"))
    return lines


def _demand(demand: SpectralDemand, units: str) -> str:
    """Say what an earthquake asks of a section by its spectrum."""
    push = demand.push()
    return written(
        "{spectrum}; {modes}; shear {shear:.4g kN/m}, moment about the heel that of {arm:.3g m} of arm",
        units,
        spectrum=demand.spectrum,
        modes=" and ".join(
            written(
                "{which} mode of {period:.3f s} with {damping:.1f %} of damping",
                units,
                which=which,
                period=mode.period_s,
                damping=mode.damping_ratio,
            )
            for which, mode in (("first", demand.first_mode), ("second", demand.second_mode))
            if mode is not None
        ),
        shear=abs(push.horizontal),
        arm=abs(push.moment / push.horizontal),
    )


def section_warnings(joints: Sequence[Joint], units: str) -> list[str]:
    """Return every warning of some sections once, those that are not of all of them with where they are."""
    joints_of: dict[str, dict[float, None]] = {}
    places = dict.fromkeys(joint.elevation_m for joint in joints)
    for joint in joints:
        for warning in joint.statics.warnings:
            joints_of.setdefault(warning.text(units), {})[joint.elevation_m] = None
    return [
        text if len(of) == len(places) else f"crack at {quantity(list(of), '.5g m', units)}: {text}"
        for text, of in joints_of.items()
    ]


def section_rows(joints: Joints, units: str) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Return head and rows of a table of sections, that which governs first: where, which check governs, its margin,
    the least factors, and the longest crack."""
    heights, unit = numbers([joint.elevation_m for joint in joints.ranked], "z.2f m", units)
    cracks = [
        max((load_case.cracked_length_m for load_case in joint.statics.cases), default=0.0) for joint in joints.ranked
    ]
    lengths, crack_unit = numbers(cracks, "z.2f m", units)
    head = (f"at, {unit}", "governs", "check", "margin", "sliding", "overturning", f"open, {crack_unit}", "not met")
    rows = []
    for joint, height, reach in zip(joints.ranked, heights, lengths, strict=True):
        worst, missed = joint.governing, sum(not check.met for check in joint.statics.checks)
        least = [
            min((value for case in joint.statics.cases if (value := getattr(case, name)) is not None), default=None)
            for name in ("sliding_factor", "overturning_factor")
        ]
        rows.append(
            (
                height,
                "-" if worst is None else worst.load_case,
                "-" if worst is None else worst.name.removesuffix(" factor"),
                "-" if worst is None or worst.margin is None else f"{worst.margin:.2f}",
                *("-" if value is None else f"{value:.2f}" for value in least),
                reach,
                f"{missed} of {len(joint.statics.checks)}",
            )
        )
    return head, rows


def check_rows(statics: Statics) -> list[tuple[tuple[str, ...], bool]]:
    """Return the cells of each check, and whether it is met."""
    return [(check_cells(check), check.met) for check in statics.checks]


def check_cells(check: Check) -> tuple[str, str, str, str]:
    """Return load case and name of a check, what is there and what is required."""
    bound = "-"
    if check.required is not None:
        bound = f"{'≥' if check.at_least else '≤'} {_value(check, check.required)}"
    return check.load_case, check.name, _value(check, check.value), bound


def verdict_of(statics: Statics) -> str:
    """Say how many checks are met."""
    count = len(statics.checks)
    missed = sum(not check.met for check in statics.checks)
    words = f"{missed} of {count} checks fail" if missed else f"all {count} checks are met"
    return f"{words} ({statics.criteria})"


def failed(statics: Statics, units: str) -> list[str]:
    """Say what is not met."""
    return [check.sentence.text(units) for check in statics.checks if not check.met]


def _value(check: Check, value: float | None) -> str:
    if value is None:
        return "-"
    of = {"resultant": " B", "compression": " f"}.get(check.name, "")
    return f"{value:.3f}{of}" if of else f"{value:.2f}"


def _acceleration(value: float) -> str:
    return f"{value:.4f} g" if math.isfinite(value) else "no acceleration"
