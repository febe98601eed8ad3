"""Evidence of an elastic dam that moves as a test says."""

from __future__ import annotations

from dataclasses import replace

from heeltoe.models.flexible.evidence.evidence import BUDGET, allowed, most_moved_by, worth_of
from heeltoe.result.contract import HEADLINES
from heeltoe.result.distribution import distribution_of
from heeltoe.result.numbers import EvidenceNumbers
from shared.responses import with_numbers


def scattered(response, runs):
    """Return an elastic response whose residual slip is one of `runs` [m], None of one without a result; their mean is
    uncertain by 3 mm, 2 mm of it as its standard error."""
    known = [slip for slip in runs if slip is not None]
    mean = sum(known) / len(known)
    evidence = response.evidence or evidence_of((0.001, 0.002, 0.003))
    worth = replace(
        evidence.residual_slip_m,
        value=mean,
        uncertainty=0.003,
        shaking=0.002,
        distribution=distribution_of(runs),
    )
    scales = [0.99 + 0.02 * place / (len(runs) - 1) for place in range(len(runs))]
    evidence = replace(
        evidence,
        residual_slip_m=worth,
        value_is="mean",
        converged=True,
        scales=scales,
        residual_slips_m=list(runs),
        failed=len(runs) - len(known),
    )
    return with_numbers(response, evidence=evidence, residual_slip_m=mean)


def scattered_below(response, runs):
    """Return an elastic response of two cracks alike, of which the second, that does not lead, scatters so."""
    known = with_numbers(response, evidence=evidence_of((0.001, 0.002, 0.003)))
    both = replace(known, cracks=known.cracks * 2, asked=1, beside=None)
    return replace(scattered(both, runs), asked=0)


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
