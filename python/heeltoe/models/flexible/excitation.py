"""Whether sliding excites itself in a run, and what more damping makes of it."""

from __future__ import annotations

from dataclasses import replace

from heeltoe.kernel.dam import DamRun
from heeltoe.models.flexible.growth import Growth, growth_of
from heeltoe.models.flexible.law.worn import sliding_friction
from heeltoe.models.flexible.reduced import damped
from heeltoe.models.flexible.shaken import ShakenDam


def self_excitation(shaken: ShakenDam, run: DamRun) -> Growth | None:
    """Return how a vibration of the dam grows as it slides; None where it never slides, or has several cracks, of which
    any number may slide at once.

    Parameters
    ----------
    shaken
        The dam with its earthquake.
    run
        The run that is reported. Where the growth matters, the run is repeated at its step
        with twice the damping.
    """
    raw = run.summary
    sliding = raw["time_sliding"] + raw["time_slide_rocking"]
    if sliding <= 0.0 or len(shaken.dam.lines) > 1:
        return None
    rate, period = growth_of(shaken.dam, sliding_friction(shaken.case, 0, shaken.dam))
    found = Growth(rate, period, sliding, None)
    if not found.matters or run.outcome != "ok":
        return found
    other = replace(shaken, dam=damped(shaken.case, shaken.dam, 2.0))
    return replace(found, damped_slip=other.run(raw["end_time"] / raw["steps"]).summary["slip"])
