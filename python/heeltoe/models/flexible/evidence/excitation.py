"""Whether sliding excites itself in a run, and what more damping makes of it."""

from __future__ import annotations

from dataclasses import replace

from heeltoe.base.blas import one_blas_thread
from heeltoe.kernel.dam import DamRun
from heeltoe.models.flexible.body.reduced import build_flexible_dam, damped
from heeltoe.models.flexible.evidence.growth import Growth, growth_of
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.run.slip_history import sliding_friction

#: Of more cracks only the one that leads is looked at, as the only one: the sets and ways of all are too many.
_FEW = 3


@one_blas_thread()
def self_excitation(shaken: ShakenDam, run: DamRun, leads: int = 0) -> Growth | None:
    """Return how a vibration of the dam grows as it slides; None where it never slides. Of several cracks that slide,
    the fastest growth counts of all of them sliding at once and of one by itself while the others stick; of many, of
    the one that leads by itself.

    Parameters
    ----------
    shaken
        The dam with its earthquake.
    run
        The run that is reported. Where the growth matters, the run is repeated at its step
        with twice the damping.
    leads
        Place of the crack of whose slip is told.
    """
    times = [raw.time_sliding + raw.time_slide_rocking for raw in run.summaries]
    sliding = [place for place, time in enumerate(times) if time > 0.0]
    if not sliding:
        return None
    alone = shaken.case.single_crack_cases
    friction = [sliding_friction(case, place, shaken.dam) for place, case in enumerate(alone)]
    if len(alone) > _FEW:
        # A crack that sticks is none.
        place = leads if leads in sliding else max(sliding, key=times.__getitem__)
        rate, period = growth_of(build_flexible_dam(alone[place]), [friction[place]])
    else:
        sets = {frozenset(sliding), *(frozenset([place]) for place in sliding)}
        rate, period = max(
            growth_of(shaken.dam, [value if place in moving else None for place, value in enumerate(friction)])
            for moving in sets
        )
    growth = Growth(rate, period, max(times), None)
    if not growth.matters or run.outcome != "ok":
        return growth
    raw = run.summaries[leads]
    other = replace(shaken, dam=damped(shaken.case, shaken.dam, 2.0))
    return replace(growth, damped_slip=other.run(raw.end_time / raw.steps).summaries[leads].slip)
