"""The largest tension of an elastic dam in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from heeltoe.result.tension import place_said
from heeltoe.units.sentences import written


def tension_line(found: Mapping[str, Any], units: str) -> str:
    """Say how large the largest tension is, where and when, and what the concrete bears."""
    text = written(
        "{stress_pa:.3g MPa} at {time_s:.2f s} {where}, {z_m:.3g m} up; ",
        units,
        stress_pa=found["stress_pa"],
        time_s=found["time_s"],
        where=place_said(found),
        z_m=found["z_m"],
    )
    strength = found["strength"]
    if strength is None:
        return text + "the case gives no concrete.tensile_strength to judge it by"
    return text + written(
        "{judged} the {dynamic_pa:.3g MPa} that the concrete bears in an earthquake, {static_pa:.3g MPa} without one",
        units,
        judged="MORE than" if strength["exceeds"] else "within",
        **{name: strength[name] for name in ("dynamic_pa", "static_pa")},
    )


def tension_worth(found: Mapping[str, Any], units: str) -> str:
    """Say how far from the crack it is read, and what another mesh makes of it."""
    text = written(
        "read {apart_m:.2g m} from the crack at least, as it has no bound there",
        units,
        apart_m=found["read_from_crack_m"],
    )
    mesh = found["mesh"]
    if mesh is None:
        return f"{text}; compared with no other mesh"
    return text + written(
        "; {stress_pa:.3g MPa} with {across:d} elements along the crack",
        units,
        stress_pa=mesh["stress_pa"],
        across=mesh["other_elements_across"],
    )
