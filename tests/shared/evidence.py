"""Evidence of an elastic dam that moves as a test says."""

from __future__ import annotations

from heeltoe.models.flexible.evidence.evidence import BUDGET, allowed, most_moved_by, worth_of
from heeltoe.result.contract import HEADLINES
from heeltoe.result.numbers import EvidenceNumbers


def evidence_of(moved, *, scatters=False, failed=0):
    """Return the evidence of a slip of 0.1 m that step, mesh and shaking move so far [m]."""
    slip = worth_of(0.1, 0.1, *moved)
    others = dict.fromkeys((headline.key for headline in HEADLINES), slip)
    return EvidenceNumbers(
        asked="full",
        converged=slip.uncertainty <= allowed(0.1) and not failed,
        value_is="mean" if scatters else "run",
        moved_most_by=most_moved_by(slip),
        allowed_m=allowed(0.1),
        time_step_s=1e-4,
        other_time_step_s=2e-4,
        elements_across=8,
        other_elements_across=4,
        third_elements_across=None,
        scales=[1.0, 0.99],
        residual_slips_m=[0.1, 0.1],
        failed=failed,
        runs=8,
        work=4.0,
        budget=BUDGET,
        budget_spent=False,
        **others,
    )
