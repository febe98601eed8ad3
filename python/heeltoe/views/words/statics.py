"""The static checks in words and numbers."""

from __future__ import annotations

import math

from heeltoe.models.statics.checks import Check
from heeltoe.models.statics.model import Statics
from heeltoe.units.sentences import quantity


def basis(found: Statics, units: str) -> list[tuple[str, str]]:
    """Return labels and texts of what the checks rest on."""
    critical, water = found.critical_acceleration_g, found.critical_water_level_m
    lines = [("criteria", f"{found.criteria}, {found.structure} structure, {found.site_information} site information")]
    for kind in ("sliding", "rocking"):
        down, up = critical[f"{kind}_downstream"], critical[f"{kind}_upstream"]
        lines.append((f"{kind} starts at", f"{_acceleration(down)} downstream, {_acceleration(up)} upstream"))
    for key, label in (
        ("sliding", "sliding factor 1 at"),
        ("sliding_required", "sliding factor required at"),
        ("overturning", "overturns at"),
        ("flotation", "floats at"),
    ):
        level = water[key]
        depth = "none up to the crest" if level is None else f"{quantity(level, '.2f m', units)} of water"
        lines.append((label, depth))
    if found.slip_m is not None:
        lines.append(("residual slip", f"{quantity(found.slip_m, '.4f m', units)}: {found.slip_source}"))
    return lines


def check_rows(found: Statics) -> list[dict[str, object]]:
    """Return the checks, each with its cells and whether it is met."""
    return [{"cells": check_cells(check), "met": check.met} for check in found.checks]


def check_cells(check: Check) -> tuple[str, str, str, str]:
    """Return load case and name of a check, what is there and what is required."""
    bound = "-"
    if check.required is not None:
        bound = f"{'≥' if check.at_least else '≤'} {_value(check, check.required)}"
    return check.load_case, check.name, _value(check, check.value), bound


def verdict_of(found: Statics) -> str:
    """Say how many checks are met."""
    count = len(found.checks)
    missed = sum(not check.met for check in found.checks)
    said = f"{missed} of {count} checks fail" if missed else f"all {count} checks are met"
    return f"{said} ({found.criteria})"


def failed(found: Statics, units: str) -> list[str]:
    """Say what is not met."""
    return [check.sentence.text(units) for check in found.checks if not check.met]


def _value(check: Check, value: float | None) -> str:
    if value is None:
        return "-"
    of = {"resultant": " B", "compression": " f"}.get(check.name, "")
    return f"{value:.3f}{of}" if of else f"{value:.2f}"


def _acceleration(value: float) -> str:
    return f"{value:.4f} g" if math.isfinite(value) else "no acceleration"
