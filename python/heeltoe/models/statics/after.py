"""The static checks with what an earthquake leaves: the slip of a run, or a block that has overturned."""

from __future__ import annotations

from dataclasses import replace

from heeltoe.case.model import Case
from heeltoe.models.statics.model import Statics, statics
from heeltoe.plain import plain
from heeltoe.result.response import Response
from heeltoe.result.rest import comes_to_rest
from heeltoe.warnings import Notice


def statics_after(case: Case, *runs: Response) -> Statics:
    """Judge the stability of a case with what its earthquake has left.

    Parameters
    ----------
    case
        Of the runs; a slip of its own, ``statics.residual_slip``, goes before theirs.
    *runs
        One run, or several of the same earthquake, the better model first: the first that ended as it should says
        how far the block has slipped. Where none did, an overturned one counts, as nothing stands after that.
    """
    trusted = next((run for run in runs if run.outcome == "ok"), None)
    overturned = next((run for run in runs if run.outcome == "overturned"), None)
    beside = tuple(run.model for run in runs)
    if trusted is None and overturned is not None:
        return statics(case, overturned_about=overturned.overturned_about, beside=beside)
    if case.statics.residual_slip is not None:
        return statics(case, beside=beside)
    if trusted is None:
        model, outcome = runs[0].model, runs[0].outcome
        source = f"the {model} model ends {outcome!r}, zero is taken"
        found = statics(case, 0.0, slip_source=source, beside=beside)
        return replace(found, warnings=(Notice("slip-untold", model=model, outcome=outcome), *found.warnings))
    source = f"{trusted.model} model, {plain(trusted.motion.name)}, PGA {trusted.motion.pga / trusted.gravity:.4g} g"
    if not comes_to_rest(trusted):
        source += ", still moving when the run ends"
    return statics(case, trusted.residual_slip_m, slip_source=source, beside=beside)
