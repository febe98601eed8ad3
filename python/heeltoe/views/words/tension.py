"""The largest tension of an elastic dam in words."""

from __future__ import annotations

from heeltoe.result.numbers import Tension
from heeltoe.result.tension import place_phrase
from heeltoe.units.sentences import written


def tension_line(tension: Tension, units: str) -> str:
    """Say how large the largest tension is, where and when, and what the concrete bears."""
    text = written(
        "{stress_pa:.3g MPa} at {time_s:.2f s} {where}, {z_m:.3g m} up; ",
        units,
        stress_pa=tension.stress_pa,
        time_s=tension.time_s,
        where=place_phrase(tension),
        z_m=tension.z_m,
    )
    strength = tension.strength
    if strength is None:
        return text + "the case gives no concrete.tensile_strength to judge it by"
    return text + written(
        "{judged} the {dynamic_pa:.3g MPa} that the concrete bears in an earthquake, {static_pa:.3g MPa} without one",
        units,
        judged="MORE than" if strength.exceeds else "within",
        dynamic_pa=strength.dynamic_pa,
        static_pa=strength.static_pa,
    )


def tension_worth(tension: Tension, units: str) -> str:
    """Say how far from the crack it is read, and what another mesh makes of it."""
    text = written(
        "read {apart_m:.2g m} from the crack at least, as it has no bound there",
        units,
        apart_m=tension.read_from_crack_m,
    )
    mesh = tension.mesh
    if mesh is None:
        return f"{text}; compared with no other mesh"
    return text + written(
        "; {stress_pa:.3g MPa} with {across:d} elements along the crack",
        units,
        stress_pa=mesh.stress_pa,
        across=mesh.other_elements_across,
    )
