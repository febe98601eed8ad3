"""A portfolio: the dams of a table, ranked by how probably they exceed a limit, then by how far they slip."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated

import numpy as np

from heeltoe.base.arrays import Floats, finite
from heeltoe.base.blocks import Block, Number
from heeltoe.study.answers.confidence import exact_bounds
from heeltoe.study.answers.suite import SHARES, below
from heeltoe.study.run.aggregate import Walk

if TYPE_CHECKING:
    import pyarrow as pa


class LimitValue(Block):
    """A limit by which dams are ranked."""

    limit: Annotated[str, Number("Name of the limit.")]
    value: Annotated[float, Number("The limit, in SI.")]


class RankedDam(Block):
    """A dam of a table, by its rank."""

    rank: Annotated[int, Number("Rank of the dam, from one.")]
    name: Annotated[str, Number("Name of the dam in the table.")]
    dam: Annotated[int, Number("Row of the dam in the table, from zero: `sample` of its runs.")]
    exceeds: Annotated[list[float], Number("Share of the motions in which each of `limits` is exceeded.")]
    exceeds_interval: Annotated[
        list[tuple[float, float]], Number("Exact bounds of these shares for independent motions.")
    ]
    residual_slip_m: Annotated[
        Mapping[str, float | None],
        Number("Residual slip over the motions, each by its worse sign; null where it is not finite.", "m"),
    ]


class Ranks(Block):
    """The dams of a table by their ranks, of one model."""

    model: Annotated[str, Number("Model of the dam.")]
    limits: Annotated[tuple[LimitValue, ...], Number("The limits by which dams are ranked.")]
    motions: Annotated[int, Number("How many motions there are, each counted at each of its strengths.")]
    dams: Annotated[tuple[RankedDam, ...], Number("The dams, the worst first.")]


def portfolio_of(walk: Walk) -> list[Ranks] | None:
    """Return the ranks of the dams of a table, model by model; None of a study without one.

    Each motion counts by its worse sign at each of its strengths. A run without a result counts as infinitely far, as
    one of a dam that fails does. One motion has a largest slip alone.
    """
    names: list[str] | None = walk.manifest.get("dams")
    if names is None:
        return None
    # Those of the curves, then those of the case.
    limits = list(dict.fromkeys([*walk.asked, *walk.limits.items()]))
    slips = _by_motion(walk, walk.worst("residual_slip"))
    demands = {limit: _by_motion(walk, walk.worst(limit)) for limit in {limit for limit, _ in limits}}
    return [
        Ranks(
            model=model,
            limits=tuple(LimitValue(limit=limit, value=value) for limit, value in limits),
            motions=slips.shape[1],
            dams=_ranked(
                names,
                slips[..., place],
                [np.mean(demands[limit][..., place] > value, axis=1) for limit, value in limits],
                walk.confidence,
            ),
        )
        for place, model in enumerate(walk.models)
    ]


def _by_motion(walk: Walk, cube: Floats) -> Floats:
    """Return numbers of runs by dam, by motion at each strength and by model, each motion by its worse sign; infinite
    where a run has no number."""
    size = np.nan_to_num(cube, nan=np.inf, posinf=np.inf)
    if size.shape[1] > 1:
        motions = [motion["name"] for motion in walk.manifest["motions"]]
        places = [[k for k, name in enumerate(motions) if name == motion] for motion in dict.fromkeys(motions)]
        size = np.stack([size[:, place].max(axis=1) for place in places], axis=1)
    return size.reshape(size.shape[0], -1, size.shape[-1])


def _ranked(names: list[str], slips: Floats, exceeds: list[Floats], confidence: float) -> tuple[RankedDam, ...]:
    """Return the dams of a model in the order of their ranks; `slips` is (dams, motions) [m]."""
    ordered = np.sort(slips, axis=1)
    with np.errstate(invalid="ignore"):
        numbers = {
            "mean": ordered.mean(axis=1),
            **{name: below(ordered, share) for name, share in SHARES.items()},
            "largest": ordered[:, -1],
        }
    # The last key is the first by which lexsort sorts: the first limit, then the others, then the slip.
    order = np.lexsort([-numbers["84%"], -numbers["mean"], *(-share for share in reversed(exceeds))])
    motions = slips.shape[1]
    return tuple(
        RankedDam(
            rank=rank + 1,
            name=names[dam],
            dam=dam,
            exceeds=[float(share[dam]) for share in exceeds],
            exceeds_interval=[
                exact_bounds(round(float(share[dam]) * motions), motions, confidence) for share in exceeds
            ],
            residual_slip_m={
                name: None if motions == 1 and name != "largest" else finite(float(column[dam]))
                for name, column in numbers.items()
            },
        )
        for rank, dam in enumerate(order.tolist())
    )


def ranks_table(portfolio: Sequence[Ranks]) -> pa.Table:
    """Return a portfolio as a table: rank, dam, model, the shares by ``P(limit > value)`` in SI, and the slips [m]."""
    import pyarrow as pa

    rows = []
    for row in portfolio:
        limits = [f"P({limit.limit} > {limit.value:g})" for limit in row.limits]
        for dam in row.dams:
            slips = {f"residual_slip_{name}_m": value for name, value in dam.residual_slip_m.items()}
            shares = dict(zip(limits, dam.exceeds, strict=True))
            rows.append({"rank": dam.rank, "name": dam.name, "model": row.model, **shares, **slips})
    return pa.Table.from_pylist(rows)
