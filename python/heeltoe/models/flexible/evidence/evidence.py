"""What a result is worth: by how much time step, mesh and one per cent of the shaking move it.

A result that is converged in its step may depend on the mesh, and one that is converged in both on the last per cent of
the shaking. Where friction flutters or a dam strikes and bounces, a single run is one of many equals, which say little
about step or mesh; their mean does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from heeltoe.models.flexible.evidence.trials import SCALES
from heeltoe.result.contract import JOINT_METER_M
from heeltoe.result.numbers import EvidenceNumbers, HeadlineWorth

#: By how much of its value a slip that is said to be converged may be uncertain, and at least by how much [m].
LIMIT, LEAST_M = 0.10, 10.0 * JOINT_METER_M
#: The uncertainty that is said is at least this part of the value; and of lengths at least this [m].
FLOOR, FLOOR_M = 0.03, 0.5 * JOINT_METER_M
#: So much all runs of a result may cost, in single ones with the elements of the case at the first step.
BUDGET = 20.0


#: What people call what moves a number.
MOVED_BY = {
    "step": "the time step",
    "mesh": "the mesh",
    "shaking": "the last per cent of the shaking",
    "surroundings": "how far rock and water reach",
}


def allowed(slip: float) -> float:
    """Return how uncertain a slip may be that is said to be converged [m]."""
    return max(LIMIT * abs(slip), LEAST_M)


@dataclass(frozen=True)
class Worth:
    """What a headline number is worth, in its unit.

    Attributes
    ----------
    value
        The number to trust: that of the run, or the mean of the runs with the shaking varied.
    run
        That of the run.
    step, mesh
        By how much another step and another mesh move it; None where that was not asked, or there is none.
    shaking
        Standard deviation of the runs with the shaking varied by up to 1 %; None as well.
    least
        Less than this is never said, in the unit of the number.
    surroundings
        By how much rock and water with sound that reach farther move it; None where there are none.
    """

    value: float
    run: float
    step: float
    mesh: float | None
    shaking: float | None
    least: float = 0.0
    surroundings: float | None = None

    @property
    def _parts(self) -> dict[str, float]:
        return {name: getattr(self, name) or 0.0 for name in MOVED_BY}

    @property
    def uncertainty(self) -> float:
        """All together, and never less than what two meshes or two steps that agree by chance may hide."""
        return max(sum(self._parts.values()), FLOOR * abs(self.value), self.least)

    @property
    def most(self) -> str:
        """Which of them moves it most."""
        return max(MOVED_BY, key=lambda name: self._parts[name])

    def numbers(self) -> HeadlineWorth:
        """Return what the result says of it."""
        return HeadlineWorth(
            value=self.value,
            run=self.run,
            uncertainty=self.uncertainty,
            step=self.step,
            mesh=self.mesh,
            shaking=self.shaking,
            surroundings=self.surroundings,
        )


@dataclass(frozen=True)
class Evidence:
    """What a result is worth, and what that has cost.

    Attributes
    ----------
    asked
        ``"step"``: half the step alone; ``"full"``: the next mesh, the shaking and the extent of rock and water, too.
    mean
        Whether the numbers to trust are means over the runs with the shaking varied, as single runs scatter.
    worth
        Of each headline number.
    cracked
        Of the cracked length of a bonded joint; None of a crack.
    time_step, other_step
        Of the run that is reported, and of the one beside it [s].
    across, other_across
        Elements along its crack, and along that of the mesh beside it; None where there is none.
    third_across
        The same of a third mesh, by which two that agree by chance are found out; None where there is none.
    failed
        How many of the runs with the shaking varied end without a result.
    slips
        Their residual slips [m], in the order of :data:`SCALES`.
    runs, work
        How many there were, and what they have cost, in the measure of :data:`BUDGET`.
    spent
        Whether the budget ended the refinement.
    """

    asked: Literal["step", "full"]
    mean: bool
    worth: dict[str, Worth]
    cracked: Worth | None
    time_step: float
    other_step: float
    across: int
    other_across: int | None
    third_across: int | None
    failed: int
    slips: tuple[float, ...]
    runs: int
    work: float
    spent: bool

    @property
    def slip(self) -> Worth:
        """What the residual slip is worth."""
        return self.worth["residual_slip_m"]

    @property
    def allowed(self) -> float:
        """How uncertain a slip may be that is said to be converged [m]."""
        return allowed(self.slip.value)

    @property
    def converged(self) -> bool:
        """Whether the residual slip is certain enough."""
        return self.slip.uncertainty <= self.allowed and not self.failed

    def values(self) -> dict[str, float]:
        """Return the headline numbers to trust, by their names in the JSON."""
        return {name: worth.value for name, worth in self.worth.items()}

    def numbers(self) -> EvidenceNumbers:
        """Return what the result says of it."""
        return EvidenceNumbers(
            asked=self.asked,
            converged=self.converged,
            value_is="mean" if self.mean else "run",
            moved_most_by=self.slip.most,
            allowed_m=self.allowed,
            time_step_s=self.time_step,
            other_time_step_s=self.other_step,
            elements_across=self.across,
            other_elements_across=self.other_across,
            third_elements_across=self.third_across,
            scales=list(SCALES) if self.slips else [],
            residual_slips_m=list(self.slips),
            failed=self.failed,
            runs=self.runs,
            work=self.work,
            budget=BUDGET,
            budget_spent=self.spent,
            cracked_length_m=None if self.cracked is None else self.cracked.numbers(),
            **{name: worth.numbers() for name, worth in self.worth.items()},
        )
