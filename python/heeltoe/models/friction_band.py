"""The band of a crack's friction: the cases that have the other frictions, and what a run of each comes to; without a
band what a little less friction does."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from heeltoe.case.crack.crack import FRICTION, Crack
from heeltoe.case.model import Case
from heeltoe.result.judge import LimitCheck
from heeltoe.result.numbers import BEST, FrictionBand, FrictionEffect, FrictionTrial, SignNumbers
from heeltoe.units.sentences import Sentence

#: By how much less friction a case without a band is tried, too.
LESS = 0.1


def with_less_friction(case: Case) -> Case | None:
    """Return the case with coefficients of friction less by :data:`LESS`; None where a law or a bond gives the
    strength, or so little is left."""
    cracks = [("crack", case.crack)]
    own = [(f"further_cracks[{place}]", crack) for place, crack in enumerate(case.further_cracks)]
    changes: dict[str, float] = {}
    for path, crack in (*cracks, *(item for item in own if not item[1].friction_is_inherited)):
        if crack.law is not None or crack.bond is not None:
            return None
        stated = {name: getattr(crack, name) for name in FRICTION if name != "law"}
        changes |= {f"{path}.{name}": round(value - LESS, 12) for name, value in stated.items() if value is not None}
    if min(changes.values()) <= 0.0 or any(crack.bond is not None for crack in case.further_cracks):
        return None
    return case.with_(changes)


def effect_of(own: float | None, less: SignNumbers) -> FrictionEffect:
    """Return what less friction does, beside a slip of the same runs with the friction of the case [m]."""
    slip = less.residual_slip_m
    change = None if own is None or slip is None else abs(slip) - abs(own)
    return FrictionEffect(friction_change=-LESS, outcome=less.outcome, residual_slip_m=slip, slip_change_m=change)


def frictions_of(case: Case) -> dict[str, Case]:
    """Return the cases with the other frictions of the band, without a band, by name."""
    band = case.crack.band
    if band is None:
        return {}
    nothing = {f"crack.{name}": None for name in (*FRICTION, "band")}

    def other(name: str) -> Case:
        fields = band.friction(name, case.crack.mu_static)
        return case.with_({**nothing, **{f"crack.{field}": value for field, value in fields.items()}})

    return {name: other(name) for name in band.names}


def worse(ways: Sequence[SignNumbers]) -> SignNumbers:
    """Return the worse sign of the motion with one friction: without a result, or where the dam slides farther."""
    return max(ways, key=lambda way: (way.limits_not_met, _reach(way.residual_slip_m)))


def judged_name(case: Case, ways: Mapping[str, SignNumbers]) -> str:
    """Return the name of the friction that the limits judge."""
    assert case.crack.band is not None
    if case.crack.band.judge != "worst":
        return case.crack.band.judge
    return max(ways, key=lambda name: _reach(ways[name].residual_slip_m))


def band_of(case: Case, ways: Mapping[str, SignNumbers], judged: str) -> FrictionBand:
    """Return what every friction comes to, the best estimate first."""
    crack = {BEST: case.crack, **{name: other.crack for name, other in frictions_of(case).items()}}
    trials = [
        FrictionTrial(
            name=name,
            friction=friction_words(crack[name]),
            outcome=way.outcome,
            residual_slip_m=way.residual_slip_m,
            opening_m=way.opening_m,
            limits_not_met=way.limits_not_met,
            judged=name == judged,
        )
        for name, way in ways.items()
    ]
    return FrictionBand(trials=trials)


def named(checks: Sequence[LimitCheck], friction: str) -> tuple[LimitCheck, ...]:
    """Return the limits with the friction that they judge, where that is not the best estimate."""
    return tuple(checks) if friction == BEST else tuple(replace(check, friction=friction) for check in checks)


def friction_words(crack: Crack) -> Sentence:
    """Say what the friction of a crack is."""
    law = crack.law
    if law is None and crack.mu_static != crack.mu_kinetic:
        return Sentence(f"friction of {crack.mu_static:g} at rest and {crack.mu_kinetic:g} sliding")
    if law is None:
        return Sentence(f"friction of {crack.mu_kinetic:g}")
    falls = f"friction that falls from {law.peak_friction or 0.0:g} to {law.residual_friction or 0.0:g}"
    if law.name == "slip weakening":
        return Sentence.of(f"{falls} within {{slip_m:.3g mm}} of slip", slip_m=law.slip)
    if law.name == "speed weakening":
        return Sentence.of(f"{falls} over {{speed_m_s:.3g m/s}}", speed_m_s=law.speed)
    return Sentence(f"friction by the law {law.name}")


def _reach(slip: float | None) -> float:
    return math.inf if slip is None else abs(slip)
