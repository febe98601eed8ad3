"""A portfolio: the dams of a table, ranked by how probably they exceed a limit, then by how far they slip."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyarrow as pa

from heeltoe.base.arrays import Floats, finite
from heeltoe.study.answers.confidence import exact_bounds
from heeltoe.study.answers.suite import below
from heeltoe.study.run.aggregate import Walk

_SHARES = {"median": 0.50, "84%": 0.84}


def portfolio_of(walk: Walk) -> list[dict[str, Any]] | None:
    """Return the ranks of the dams of a table, model by model; None of a study without one.

    Each motion counts by its worse sign at each of its strengths. A run without a result counts as infinitely far, as
    one of a dam that fails does.

    Returns
    -------
    list
        Of each model the count of its ``motions``, each at each of its strengths, and its ``dams``, the worst first:
        ``name``, ``rank`` from one, ``exceeds`` with the share of the motions in which each limit is exceeded, by
        ``limit value``, with its exact bounds for independent motions, ``exceeds_interval``, and mean, median, 84 % and
        largest of the residual slip [m], None where they are not finite. One motion has a largest alone.
    """
    names: list[str] | None = walk.manifest.get("dams")
    if names is None:
        return None
    # Those of the curves, then those of the case.
    limits = list(dict.fromkeys([*walk.asked, *walk.limits.items()]))
    slips = _by_motion(walk, walk.worst("residual_slip"))
    demands = {limit: _by_motion(walk, walk.worst(limit)) for limit in {limit for limit, _ in limits}}
    return [
        {
            "model": model,
            "limits": [{"limit": limit, "value": value} for limit, value in limits],
            "motions": slips.shape[1],
            "dams": _ranked(
                names,
                slips[..., place],
                [np.mean(demands[limit][..., place] > value, axis=1) for limit, value in limits],
                walk.confidence,
            ),
        }
        for place, model in enumerate(walk.models)
    ]


def _by_motion(walk: Walk, cube: Floats) -> Floats:
    """Return numbers of runs by dam, by motion at each strength and by model, each motion by its worse sign; infinite
    where a run has none."""
    size = np.nan_to_num(cube, nan=np.inf, posinf=np.inf)
    if size.shape[1] > 1:
        motions = [motion["name"] for motion in walk.manifest["motions"]]
        places = [[k for k, name in enumerate(motions) if name == motion] for motion in dict.fromkeys(motions)]
        size = np.stack([size[:, place].max(axis=1) for place in places], axis=1)
    return size.reshape(size.shape[0], -1, size.shape[-1])


def _ranked(names: list[str], slips: Floats, exceeds: list[Floats], confidence: float) -> list[dict[str, Any]]:
    """Return the dams of a model in the order of their ranks; `slips` is (dams, motions) [m]."""
    ordered = np.sort(slips, axis=1)
    with np.errstate(invalid="ignore"):
        numbers = {
            "mean": ordered.mean(axis=1),
            **{name: below(ordered, share) for name, share in _SHARES.items()},
            "largest": ordered[:, -1],
        }
    # The last key is the first by which lexsort sorts: the first limit, then the others, then the slip.
    order = np.lexsort([-numbers["84%"], -numbers["mean"], *(-share for share in reversed(exceeds))])
    return [
        {
            "rank": rank + 1,
            "name": names[dam],
            "dam": dam,
            "exceeds": [float(share[dam]) for share in exceeds],
            "exceeds_interval": [_bounds(float(share[dam]), slips.shape[1], confidence) for share in exceeds],
            "residual_slip_m": {
                name: None if slips.shape[1] == 1 and name != "largest" else finite(float(column[dam]))
                for name, column in numbers.items()
            },
        }
        for rank, dam in enumerate(order.tolist())
    ]


def _bounds(share: float, motions: int, confidence: float) -> list[float]:
    return list(exact_bounds(round(share * motions), motions, confidence))


def ranks_table(portfolio: list[dict[str, Any]]) -> pa.Table:
    """Return a portfolio as a table: rank, dam, model, the shares by ``P(limit > value)`` in SI, and the slips [m]."""
    rows = []
    for row in portfolio:
        limits = [f"P({limit['limit']} > {limit['value']:g})" for limit in row["limits"]]
        for dam in row["dams"]:
            slips = {f"residual_slip_{name}_m": value for name, value in dam["residual_slip_m"].items()}
            shares = dict(zip(limits, dam["exceeds"], strict=True))
            rows.append({"rank": dam["rank"], "name": dam["name"], "model": row["model"], **shares, **slips})
    return pa.Table.from_pylist(rows)
