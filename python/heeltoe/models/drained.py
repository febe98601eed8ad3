"""An elastic dam whose drains close between the motions of a sequence: it is run again with the uplift that its slip
has left, which changes while the ground stands still."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

from heeltoe.case.crack.kinks import climbs
from heeltoe.case.model import Case
from heeltoe.mechanics.drains import close_by_slip, drainage_left
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import Part
from heeltoe.result.sequence import stages

if TYPE_CHECKING:
    from heeltoe.models.flexible.response import FlexibleResponse

# Water that rises faster than this shakes the dam by itself [s].
_FASTEST = 1.0


def follows_drains(case: Case, earthquake: Earthquake) -> bool:
    """Whether drains may close in a run of an elastic dam, and its uplift can change then."""
    there = bool(earthquake.shaking.begins) and close_by_slip(case) and not case.further_cracks
    # On steps the water that rises pushes along the crack, too, which the kernel does not know.
    there = there and not climbs(case.crack.kinks)
    return there and case.uplift.during_shaking == "constant" and case.flexible.contact == "coulomb"


def with_drains(
    case: Case, earthquake: Earthquake, run: Callable[[Case, Earthquake], FlexibleResponse]
) -> FlexibleResponse:
    """Run a dam until each motion of its sequence meets the uplift of the drains that the ones before have left; with
    evidence the last time alone."""
    quick = case.model_copy(update={"flexible": case.flexible.with_evidence("none")})
    parts = earthquake.motion.parts
    found, shares = run(quick, earthquake), [1.0]
    for number in range(1, len(parts)):
        left = list(stages(found, parts)) if found.summary else []
        if len(left) <= number:
            # It has ended before.
            break
        share = drainage_left(case, left[number - 1].residual_slip_m)
        shares.append(share)
        if share != shares[-2]:
            earthquake = replace(earthquake, drainage=schedule(parts, shares))
            found = run(quick, earthquake)
    if case.flexible.evidence != "none":
        found = run(case, earthquake)
    return replace(found, summary={**found.summary, "drainage_by_motion": shares}) if found.summary else found


def schedule(parts: Sequence[Part], shares: Sequence[float]) -> tuple[tuple[float, float, float], ...]:
    """Return from when to when the drainage changes [s] and what is left of it then, from what each motion finds."""
    met = zip(pairwise(parts), pairwise(shares), strict=False)
    return tuple(
        (min(first.ends, then.begins - _FASTEST), then.begins, share)
        for (first, then), (before, share) in met
        if share != before
    )
