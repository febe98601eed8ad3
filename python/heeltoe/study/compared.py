"""Measures of the strength of motions compared: how well each foretells the slip, and what it leaves unsaid.

Efficiency and sufficiency after Luco and Cornell (2007), on a straight line through the logarithms.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy import stats

from heeltoe.arrays import Floats, Integers
from heeltoe.result.contract import JOINT_METER_M

#: Fewer runs, or events, make no line.
_LEAST = 3


def compared(
    strengths: Mapping[str, Floats], demand: Floats, event: Integers, traits: Mapping[str, Floats]
) -> dict[str, Any]:
    """Compare measures by the runs that slide more than a joint meter reads.

    Parameters
    ----------
    strengths
        (n,) of the motion of each run, by measure.
    demand
        (n,) slip of each run [m], without sign; not a number where a run has no result.
    event
        (n,) which runs belong together.
    traits
        (n,) what else is known of the motion of each run, by name; not a number where it is not known.

    Returns
    -------
    dict
        ``runs`` behind the lines; ``at_rest`` and ``unknown``, left out; ``measures``, the most efficient first, each
        with its ``efficiency`` (standard deviation of the logarithm of the slip about the line), the ``slope`` of the
        line, and its ``sufficiency``: for each trait slope and p-value of what the line leaves over. Runs of one event
        are no independent witnesses: that is held against the trait event by event, by their means.
    """
    slides = demand > JOINT_METER_M  # not a number is not
    unknown = int(np.isnan(demand).sum())
    count = int(slides.sum())
    told = {"runs": count, "at_rest": demand.size - count - unknown, "unknown": unknown}
    if count < _LEAST:
        return {**told, "measures": []}
    logarithm = np.log(demand[slides])
    _, which = np.unique(event[slides], return_inverse=True)
    events = {name: _means(values[slides], which) for name, values in traits.items()}
    found = []
    for name, strength in strengths.items():
        x = np.log(strength[slides])
        x -= x.mean()
        varies = float(x.std()) > 1e-9
        slope = float(x @ logarithm / (x @ x)) if varies else None
        left = logarithm - logarithm.mean() - (slope or 0.0) * x
        over = _means(left, which)
        found.append(
            {
                "measure": name,
                "efficiency": float(np.sqrt(left @ left / (count - (2 if varies else 1)))),
                "slope": slope,
                "sufficiency": {trait: _line(values, over) for trait, values in events.items()},
            }
        )
    return {**told, "measures": sorted(found, key=lambda each: float(str(each["efficiency"])))}


def _means(values: Floats, which: Integers) -> Floats:
    return np.asarray(np.bincount(which, values) / np.bincount(which), dtype=np.float64)


def _line(trait: Floats, over: Floats) -> dict[str, float] | None:
    """Return slope and p-value of a line; None where too few events tell of one."""
    known = np.isfinite(trait)
    if known.sum() < _LEAST or np.ptp(trait[known]) <= 1e-9:
        return None
    line = stats.linregress(trait[known], over[known])
    return {"slope": float(line.slope), "p": float(line.pvalue), "events": int(known.sum())}
