"""What the runs of a study say: summaries, curves over the strength of the motion, fragility."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from heeltoe.arrays import Floats
from heeltoe.errors import InputError
from heeltoe.result.contract import HEADLINES, JOINT_METER_M
from heeltoe.study.fragility import LIMITED, Curve, curve, exceeding

#: Shares of the runs that stay below the values of a summary; 16, 50 and 84 % are a deviation below the median of a
#: lognormal distribution, the median, and one above.
SHARES = (0.05, 0.16, 0.50, 0.84, 0.95)
_BAND = (0.16, 0.50, 0.84)
#: Strengths of a band where they are drawn, not listed: as many groups of runs, as large as each other.
_GROUPS = 12
_ALIKE = 1e-9
MODES = ("sliding", "slide_rocking", "drifting")


def summary(table: pa.Table) -> list[dict[str, Any]]:
    """Return for each model how its runs ended, how many slide at all, and how the headline numbers are distributed."""
    found = []
    for model in table["model"].unique().to_pylist():
        rows = table.filter(pc.equal(table["model"], model))
        outcome = np.array(rows["outcome"].to_pylist())
        names, counts = np.unique(outcome, return_counts=True)
        by_name = {each.key: _values(rows, each.key) for each in HEADLINES}
        slides = np.maximum(by_name["peak_slip_downstream_m"], -by_name["peak_slip_upstream_m"]) > JOINT_METER_M
        found.append(
            {
                "model": model,
                "runs": len(rows),
                "outcomes": dict(zip(names.tolist(), counts.tolist(), strict=True)),
                "share_that_slides": float(np.mean(slides)),
                "dominant_mode": _dominant(rows, slides),
                **{name: _distribution(values) for name, values in by_name.items()},
            }
        )
    return found


def bands(strength: Floats, demand: Floats) -> dict[str, list[float]]:
    """Return what 16, 50 and 84 % of the runs stay below at each strength, or over groups of about the same strength.

    Parameters
    ----------
    strength
        (n,) of the motion of each run.
    demand
        (n,) what it did to the dam; not a number where a run ended without a result, which counts as infinitely much:
        what is not known is not small.
    """
    group = groups(strength)
    found: dict[str, list[float]] = {"strength": [], "runs": [], "low": [], "median": [], "high": []}
    worst = np.where(np.isnan(demand), np.inf, demand)
    for place in np.unique(group).tolist():
        here = group == place
        values = np.quantile(worst[here], _BAND, method="inverted_cdf").tolist()
        found["strength"].append(float(np.exp(np.mean(np.log(strength[here])))))
        found["runs"].append(int(here.sum()))
        for name, value in zip(("low", "median", "high"), values, strict=True):
            found[name].append(value)
    return found


def groups(strength: Floats) -> NDArray[np.integer[Any]]:
    """Return which runs are about as strongly shaken as each other, (n,) numbers that grow with the strength."""
    # What differs by rounding is alike.
    levels, group = np.unique(np.rint(np.log(strength) / _ALIKE), return_inverse=True)
    if levels.size > 2 * _GROUPS:
        edges = np.quantile(strength, np.linspace(0.0, 1.0, _GROUPS + 1))
        group = np.clip(np.searchsorted(edges, strength, side="right") - 1, 0, _GROUPS - 1)
    return np.asarray(group)


def observed(strength: Floats, exceeds: Floats) -> tuple[list[float], list[float]]:
    """Return which share of the runs exceeds a limit at each strength, or over groups of about the same."""
    known = np.isfinite(exceeds)
    strength, exceeds = strength[known], exceeds[known]
    group = groups(strength)
    runs = np.bincount(group)
    there = runs > 0
    middle, share = (np.bincount(group, each)[there] / runs[there] for each in (np.log(strength), exceeds))
    return np.exp(middle).tolist(), share.tolist()


def fragility_of(table: pa.Table, strength: Floats, told: dict[str, Any]) -> list[tuple[str, Curve]]:
    """Return the curves that a study asks for, each with its model.

    Raises
    ------
    InputError
        Where the study asks for none.
    """
    asked = told["study"]["fragility"]
    if asked is None:
        raise InputError("study-no-fragility", "fragility")
    found = []
    for model in table["model"].unique().to_pylist():
        here = np.array(table["model"].to_pylist()) == model
        rows = table.filter(pa.array(here))
        outcome = np.array(rows["outcome"].to_pylist())
        _, event = np.unique(np.array(rows["event"].to_pylist()), return_inverse=True)
        for limit, values in asked["limits"].items():
            columns = {name: _values(rows, name) for name in LIMITED[limit]}
            for value in values:
                number = _number(value)
                fitted: Curve = curve(
                    *(limit, number, asked["measure"], strength[here], exceeding(columns, outcome, limit, number)),
                    event.astype(np.int64),
                    confidence=asked["confidence"],
                )
                found.append((model, fitted))
    return found


def _number(value: object) -> float:
    """Return a limit as the study keeps it: SI, with its unit where it has one."""
    return float(value) if isinstance(value, int | float) else float(str(value).split()[0])


def _values(rows: pa.Table, name: str) -> Floats:
    return np.asarray(rows[name].to_numpy(), dtype=np.float64)


def _distribution(values: Floats) -> dict[str, float | None]:
    fine = values[np.isfinite(values)]
    if not fine.size:
        return {"mean": None, "largest": None, **{f"{share:.0%}": None for share in SHARES}}
    below = np.quantile(fine, SHARES).tolist()
    largest = float(fine[np.abs(fine).argmax()])
    return {
        "mean": float(fine.mean()),
        "largest": largest,
        **{f"{share:.0%}": value for share, value in zip(SHARES, below, strict=True)},
    }


def _dominant(rows: pa.Table, slides: NDArray[np.bool_]) -> dict[str, float]:
    """Return of which share of the dams that slide each mode of motion made most of the slip."""
    if not slides.any():
        return {}
    slips = np.abs(np.column_stack([_values(rows, f"slip_{name}_m") for name in MODES]))[slides]
    most = np.bincount(np.nanargmax(np.nan_to_num(slips), axis=1), minlength=len(MODES)) / slides.sum()
    return dict(zip(MODES, most.tolist(), strict=True))
