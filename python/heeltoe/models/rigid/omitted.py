"""Effects that a rigid block leaves out: the vibration of the dam, and how much farther it slides by it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.mechanics.beam import Swing, swing_of
from heeltoe.models.rigid.criterion import FAR_M, LEAST_M, Fit, Likeness, fits
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.outcome import Outcome
from heeltoe.result.response import Response
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import AS_ELASTIC, Notice

#: Moduli that the concrete of dams usually has [Pa].
USUAL_MODULI = (15e9, 35e9)
#: Shaking that is amplified by less than this goes without a word where dams like it were not studied.
_NOTICED = 1.1
_SAME = 1.05


@dataclass(frozen=True)
class _Dam:
    """A case and the run of its block, before the vibration of the dam is computed."""

    block: Response
    gravity: float
    elevation: float
    height: float
    water: float
    damping: float
    friction: float
    unlike: str | None
    remedy: str


def omitted(case: Case, response: Response) -> tuple[Notice, ...]:
    """Return what the dam's own vibration would do in the motion of a block's run, for its modulus or for usual ones;
    nothing where the dam is so stiff and low that the motion hardly feels it."""
    modulus = case.concrete.modulus
    moduli = USUAL_MODULI if modulus is None else (modulus,)
    corners = [z for _, z in case.section.vertices()]
    dam = _Dam(
        block=response,
        gravity=case.gravity,
        elevation=case.crack.elevation,
        height=max(corners) - min(corners),
        water=0.0 if case.reservoir is None else case.reservoir.depth,
        damping=case.concrete.damping,
        friction=friction_at_rest(case, response),
        unlike=_unlike(case, response),
        remedy=_remedy(case),
    )
    swing = swing_of(case, response.motion, moduli)
    if swing is None:
        return ()
    like = _farther(dam, swing)
    strongest = max(swing.accelerations.max(), swing.at_crack.max())
    if like.kind == "unknown" and strongest <= _NOTICED * swing.peak:
        return ()
    return _swings(dam, swing, moduli), like


def friction_at_rest(case: Case, response: Response) -> float:
    """Return the friction of the crack before any slip; by a law, under its static loads."""
    law = response.friction_law
    return case.crack.apparent_friction if law is None else law.apparent_friction_before


def _swings(dam: _Dam, swing: Swing, moduli: tuple[float, ...]) -> Notice:
    """Say how the dam swings."""
    level: Sentence | str = ""
    if dam.elevation > 0.0:
        level = Sentence.of(
            "; at the crack, {elevation_m:g m} above the base, it shakes with about {peaks_g:.2g g|to}, {times:.2g|to} "
            "times the ground's peak",
            elevation_m=dam.elevation,
            peaks_g=_ends(swing.at_crack / dam.gravity),
            times=_ends(swing.at_crack / swing.peak),
        )
    return Notice(
        "rigid-block",
        moduli_pa=moduli,
        periods_s=_ends(swing.periods),
        accelerations_g=_ends(swing.accelerations / dam.gravity),
        times=_ends(swing.accelerations / swing.peak),
        level=level,
    )


def _farther(dam: _Dam, swing: Swing) -> Notice:
    """Say how much farther dams like it slide than their blocks."""
    mean_period = swing.mean_period
    why = dam.unlike or ("its motion jumps, and has no mean period" if mean_period is None else None)
    if why is not None or mean_period is None:
        return Notice("rigid-unlike-dam", "unknown", why=why, remedy=dam.remedy)
    likes = [_likeness(dam, swing, mean_period, place) for place in range(swing.periods.size)]
    regime = likes[0].regime
    elastic, numbers = fits()["flexible"][regime], [like.numbers() for like in likes]
    outside = next((beyond for inputs in numbers if (beyond := elastic.outside(inputs)) is not None), None)
    if outside is not None:
        return Notice("rigid-unlike-dam", "unknown", why=outside, remedy=dam.remedy)
    if regime == "holds":
        shares = [
            elastic.beyond(inputs, FAR_M / like.displacement) for inputs, like in zip(numbers, likes, strict=True)
        ]
        # No share of some hundred cases is known better than that.
        bounds = _ends(np.clip(shares, 0.01, 0.99))
        known: dict[str, Any] = {"least_m": LEAST_M, "far_m": FAR_M, "cases": elastic.cases}
        return Notice("rigid-unlike-dam", "holds", shares=bounds, remedy=dam.remedy, **known)
    chain: Sentence | str = ""
    if dam.elevation > 0.0:
        times = _band(fits()["decoupled"][regime], numbers)
        chain = Sentence.of(", the decoupled chain {times:g|to} times", times=times)
    share, cases = elastic.held_back["height" if dam.elevation > 0.0 else "base"]
    times = _band(elastic, numbers)
    return Notice("rigid-unlike-dam", "slides", times=times, chain=chain, share=share, cases=cases, remedy=dam.remedy)


def _likeness(dam: _Dam, swing: Swing, mean_period: float, place: int) -> Likeness:
    block = dam.block
    return Likeness(
        slip=abs(RESIDUAL_SLIP.of(block)),
        rotation=max(block.rocking_downstream_rad, block.rocking_upstream_rad),
        first_period=float(swing.periods[place]),
        mean_period=mean_period,
        peak=swing.peak,
        spectral=float(swing.accelerations[place]),
        crack=float(swing.at_crack[place]),
        critical=block.static.critical_acceleration_g.sliding * dam.gravity,
        level=dam.elevation / dam.height,
        water=dam.water / dam.height,
        damping=dam.damping,
        friction=dam.friction,
    )


def _remedy(case: Case) -> str:
    """Say how the dam of a case is run as an elastic one."""
    if case.crack.roughness is not None:
        known = "run it without crack.roughness, too"
        return known if case.concrete.modulus is not None else f"{known}, and with concrete.modulus"
    return "give concrete.modulus" if case.concrete.modulus is None else AS_ELASTIC


def _unlike(case: Case, response: Response) -> str | None:
    """Say what of a case or its run is not in the study at all."""
    reasons: dict[str, object] = {
        f"its block ended as {response.outcome}": response.outcome != Outcome.OK,
        "the ground moves vertically, too": response.vertical is not None,
        "the ground shakes it across the valley, too": response.cross is not None,
        "it has anchors": case.anchors,
        "its crack is inclined": case.crack.inclination,
        "it has several cracks": case.further_cracks,
        "its crack is rough": case.crack.roughness is not None,
        "its uplift changes while it is shaken": case.uplift.during_shaking != "constant",
    }
    return next((why for why, applies in reasons.items() if applies), None)


def _band(fit: Fit, numbers: list[dict[str, float]]) -> tuple[float, ...]:
    """Return the least and the largest of the bands, to two digits."""
    return tuple(float(f"{end:.2g}") for end in _ends(np.array([fit.band(number) for number in numbers])))


def _ends(values: Floats) -> tuple[float, ...]:
    """Return the least and the largest, or the largest alone where they are about the same."""
    low, high = float(values.min()), float(values.max())
    return (high,) if high <= _SAME * low else (low, high)
