"""Uncertainty of a result: how far time step, mesh and one per cent of the shaking move it.

A result that is converged in its step may depend on the mesh, and one that is converged in both on the last per cent of
the shaking. Where friction flutters or a dam strikes and bounces, a single run is one of many equals, which say little
about step or mesh; their distribution does."""

from __future__ import annotations

import math

from heeltoe.case.model import Case
from heeltoe.models.flexible.body.reduced import FlexibleDam
from heeltoe.result.contract import HEADLINES, JOINT_METER_M
from heeltoe.result.numbers import Distribution, EvidenceNumbers, HeadlineWorth

#: By how much of its value a slip that is said to be converged may be uncertain, and at least by how much [m].
LIMIT, LEAST_M = 0.10, 10.0 * JOINT_METER_M
#: The uncertainty that is said is at least this part of the value; and of lengths at least this [m].
FLOOR, FLOOR_M = 0.03, 0.5 * JOINT_METER_M
#: The standard error of a mean that needs no further runs is at most this part of it.
ERROR_OF_MEAN = 0.03
#: So much all runs of a result may cost, in single ones with the elements of the case at the step of runs that scatter.
BUDGET = 40.0


#: Rock with less damping of its own is as good as without (docs/water-and-rock.md, "Rock without damping").
LEAST_ROCK_DAMPING = 0.001
#: What people call what moves a number.
MOVED_BY = {
    "step": "the time step",
    "mesh": "the mesh",
    "shaking": "the last per cent of the shaking",
    "surroundings": "how far rock and water reach, and up to which frequency",
}


def may_have_no_limit(case: Case, dam: FlexibleDam) -> bool:
    """Return whether slips may grow with each finer mesh: those of a dam cracked on rock without damping may, as
    sliding feeds the shortest waves along the crack (Adams, Journal of Applied Mechanics 62, 1995)."""
    # A part bonded to the rock slides on damped concrete.
    return case.foundation is not None and dam.rock is not None and case.foundation.damping < LEAST_ROCK_DAMPING


def allowed(slip: float) -> float:
    """Return the largest uncertainty of a slip that counts as converged [m]."""
    return max(LIMIT * abs(slip), LEAST_M)


def worth_of(
    value: float,
    run: float,
    step: float,
    mesh: float | None,
    shaking: float | None,
    surroundings: float | None = None,
    *,
    least: float = 0.0,
    spread: float | None = None,
    distribution: Distribution | None = None,
) -> HeadlineWorth:
    """Return the uncertainty of a number: its changes taken together, and never less than two meshes or two steps that
    agree by chance may hide, nor than `least` in the unit of the number. The changes of a mean, the number that has a
    `distribution`, are errors of independent samples, which add by their squares; those of a run add."""
    parts = [part or 0.0 for part in (step, mesh, shaking, surroundings)]
    moved = sum(parts) if distribution is None else math.hypot(*parts)
    return HeadlineWorth(
        value=value,
        run=run,
        uncertainty=max(moved, FLOOR * abs(value), least),
        step=step,
        mesh=mesh,
        shaking=shaking,
        surroundings=surroundings,
        spread=shaking if distribution is None else spread,
        distribution=distribution,
    )


def most_moved_by(worth: HeadlineWorth) -> str:
    """Return which of :data:`MOVED_BY` moves a number most."""
    return max(MOVED_BY, key=lambda name: worth[name] or 0.0)


def trusted(evidence: EvidenceNumbers) -> dict[str, float]:
    """Return the headline numbers to trust, by their names in the JSON."""
    return {headline.key: evidence[headline.key].value for headline in HEADLINES}
