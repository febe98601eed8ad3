"""Answers from the runs of a study: summaries, curves over the strength of the motion, modes of motion. All of it walks
through the runs and holds none of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.result.contract import HEADLINES, JOINT_METER_M, PEAKS, RESIDUAL_SLIP, SLIPS_BY_MODE
from heeltoe.result.crest import CREST_PEAKS
from heeltoe.result.numbers import SlipByMode
from heeltoe.study.answers.fragility import not_met
from heeltoe.study.plan.crack_columns import column_of, columns_of_cracks
from heeltoe.study.plan.rank_correlation import quantiles
from heeltoe.study.run.aggregate import SHAKEN, Stretch, Walk

#: Shares of the runs that stay below the values of a summary; 16, 50 and 84 % are a deviation below the median of a
#: lognormal distribution, the median, and one above.
SHARES = (0.05, 0.16, 0.50, 0.84, 0.95)
_BAND = (0.16, 0.50, 0.84)
#: Strengths of a band where they are drawn, not listed: as many groups of runs, as large as each other.
_GROUPS = 12
_ALIKE = 1e-9
MODES = SlipByMode.names()
#: Largest slips, by which a run is said to slide at all.


def summary(walk: Walk) -> list[dict[str, Any]]:
    """Return for each model how its runs ended, how many slide at all, and how the headline numbers are distributed;
    of several cracks those of each under `cracks`, from the crest down."""
    own = [*(headline.key for headline in HEADLINES), *(CREST_PEAKS if walk.crest else ())]
    keys, models = [*own, *columns_of_cracks(walk.cracks)], walk.models
    places = len(models)
    total = np.zeros((places, len(keys)))
    known = np.zeros((places, len(keys)), dtype=np.int64)
    largest = np.zeros((places, len(keys)))
    slid, off, undetermined = (np.zeros(places, dtype=np.int64) for _ in range(3))
    by_mode = np.zeros((places, len(MODES)), dtype=np.int64)
    outcomes: list[Counter[str]] = [Counter() for _ in models]
    for runs in walk("model", "outcome", "slid_off", "undetermined", *keys, *SLIPS_BY_MODE):
        model, (names, code) = runs.model, runs.words("outcome")
        slides, mode = sliding(runs), dominant(runs)
        for place in range(places):
            here = model == place
            ended = np.bincount(code[here], minlength=len(names)).tolist()
            outcomes[place].update({name: count for name, count in zip(names, ended, strict=True) if count})
            off[place] += np.count_nonzero(runs.table["slid_off"].to_numpy() & here)
            undetermined[place] += np.count_nonzero(runs.table["undetermined"].to_numpy() & here)
            slid[place] += np.count_nonzero(slides & here)
            by_mode[place] += np.bincount(mode[slides & here], minlength=len(MODES))
            for column, key in enumerate(keys):
                values = runs.numbers(key)[here]
                fine = values[np.isfinite(values)]
                total[place, column] += fine.sum()
                known[place, column] += fine.size
                far = float(fine[np.abs(fine).argmax()]) if fine.size else 0.0
                largest[place, column] = max(largest[place, column], far, key=abs)
    below, broken = _below(walk, keys).tolist(), not_met(walk)

    def distributions(place: int) -> Iterator[tuple[str, dict[str, float | None]]]:
        for column, key in enumerate(keys):
            count = int(known[place, column])
            yield key, _distribution(count, total[place, column], largest[place, column], below[place][column])

    return [
        {
            "model": name,
            "runs": outcomes[place].total(),
            "outcomes": dict(sorted(outcomes[place].items())),
            "share_that_slides": float(slid[place] / outcomes[place].total()),
            "slid_off": int(off[place]),
            "undetermined": int(undetermined[place]),
            "limits_not_met": broken[name],
            "dominant_mode": _shares(by_mode[place], int(slid[place])),
            **_by_crack(dict(distributions(place)), own, walk.cracks),
        }
        for place, name in enumerate(models)
        if outcomes[place]
    ]


def _shares(by_mode: Integers, slid: int) -> dict[str, float]:
    return dict(zip(MODES, (by_mode / slid).tolist(), strict=True)) if slid else {}


def _by_crack(quantile_rows: Mapping[str, Any], of_dam: Sequence[str], cracks: int) -> dict[str, Any]:
    """Return distributions by name, those `of_dam` with those of each of several cracks in a list."""
    names = [headline.key for headline in HEADLINES]
    own = {name: quantile_rows[name] for name in of_dam}
    if cracks == 1:
        return own
    return own | {
        "cracks": [{name: quantile_rows[column_of(place, name)] for name in names} for place in range(cracks)]
    }


def sliding(runs: Stretch) -> NDArray[np.bool_]:
    """Return which runs slide more than a joint meter reads."""
    downstream, upstream = (runs.numbers(name) for name in PEAKS)
    return np.asarray(np.maximum(downstream, -upstream) > JOINT_METER_M)


def dominant(runs: Stretch) -> Integers:
    """Return which mode of motion makes most of the slip, (n,) its place in :data:`MODES`."""
    slips = [np.nan_to_num(np.abs(runs.numbers(name))) for name in SLIPS_BY_MODE]
    return np.asarray(np.argmax(slips, axis=0), dtype=np.int64)


def _below(walk: Walk, keys: Sequence[str]) -> Floats:
    """Return what :data:`SHARES` of the runs of each model stay below, (models, numbers, shares)."""

    def numbers() -> Iterable[tuple[Integers, Floats]]:
        for runs in walk("model", *keys):
            model = runs.model
            for column, key in enumerate(keys):
                values = runs.numbers(key)
                fine = np.isfinite(values)
                yield model[fine] * len(keys) + column, values[fine]

    shares = quantiles(numbers, len(walk.models) * len(keys), SHARES)
    return shares.reshape(len(walk.models), len(keys), len(SHARES))


def _distribution(count: int, total: float, largest: float, below: Sequence[float]) -> dict[str, float | None]:
    names = [f"{share:.0%}" for share in SHARES]
    if not count:
        return {"mean": None, "largest": None, **dict.fromkeys(names)}
    return {"mean": float(total / count), "largest": float(largest), **dict(zip(names, below, strict=True))}


@dataclass(frozen=True, eq=False)
class Groups:
    """Runs that are about as strongly shaken as each other.

    Attributes
    ----------
    ends
        Of labels of the strengths where there are few of them, else of the strengths themselves.
    few
        Which of the two.
    """

    ends: Floats
    few: bool

    @property
    def count(self) -> int:
        """How many groups."""
        return self.ends.size if self.few else _GROUPS

    def of(self, strength: Floats) -> Integers:
        """Return the group of each strength; they grow with it."""
        if self.few:
            return np.searchsorted(self.ends, _label(strength))
        return np.clip(np.searchsorted(self.ends, strength, side="right") - 1, 0, _GROUPS - 1)


def groups(strengths: Callable[[], Iterable[Floats]]) -> Groups:
    """Return the groups of runs; each strength is one where there are few, else there are some of equal size."""
    levels = np.zeros(0)
    for strength in strengths():
        levels = np.union1d(levels, _label(strength))
        if levels.size > 2 * _GROUPS:
            break
    else:
        return Groups(levels, few=True)

    def numbers() -> Iterable[tuple[Integers, Floats]]:
        return ((np.zeros(strength.size, dtype=np.int64), strength) for strength in strengths())

    return Groups(quantiles(numbers, 1, np.linspace(0.0, 1.0, _GROUPS + 1).tolist())[0], few=False)


def _label(strength: Floats) -> Floats:
    # What differs by rounding is alike.
    return np.asarray(np.rint(np.log(strength) / _ALIKE), dtype=np.float64)


#: Model, strength and demand of some runs after others.
Pairs = Callable[[], Iterable[tuple[Integers, Floats, Floats]]]


def bands(pairs: Pairs, models: int = 1) -> list[dict[str, list[float]]]:
    """Return for each model what 16, 50 and 84 % of the runs stay below at each strength, or over groups of about the
    same strength.

    Parameters
    ----------
    pairs
        Called several times, walks through the place of the model of each run, (n,), the strength of its motion, and
        what that did to the dam; not a number where a run ended without a result, which counts as infinitely much: what
        is not known is not small.
    models
        How many there are.
    """
    group = groups(lambda: (strength for _, strength, _ in pairs()))
    cells = models * group.count
    runs, logarithms = np.zeros(cells, dtype=np.int64), np.zeros(cells)
    for model, strength, _ in pairs():
        cell = model * group.count + group.of(strength)
        runs += np.bincount(cell, minlength=cells)
        logarithms += np.bincount(cell, np.log(strength), cells)

    def numbers() -> Iterable[tuple[Integers, Floats]]:
        for model, strength, demand in pairs():
            yield model * group.count + group.of(strength), np.where(np.isnan(demand), np.inf, demand)

    values = quantiles(numbers, cells, _BAND, between=False)
    bands = []
    for place in range(models):
        here = np.flatnonzero((np.arange(cells) // group.count == place) & (runs > 0))
        band = {"strength": np.exp(logarithms[here] / runs[here]).tolist(), "runs": runs[here].tolist()}
        bands.append({**band, **dict(zip(("low", "median", "high"), values[here].T.tolist(), strict=True))})
    return bands


def modes(walk: Walk, measure: str) -> tuple[Floats, Integers]:
    """Return the strength of each group of runs about as strongly shaken as each other, (groups,), and how many of them
    slide mostly by each mode of motion, (models, groups, modes)."""

    def strengths() -> Iterable[Floats]:
        return (runs.strength(measure) for runs in walk(*SHAKEN))

    group = groups(strengths)
    shape = (len(walk.models), group.count, len(MODES))
    counts = np.zeros(int(np.prod(shape)), dtype=np.int64)
    runs_of, logarithms = np.zeros(group.count), np.zeros(group.count)
    for runs in walk("model", *SHAKEN, *PEAKS, *SLIPS_BY_MODE):
        strength = runs.strength(measure)
        of = group.of(strength)
        runs_of += np.bincount(of, minlength=group.count)
        logarithms += np.bincount(of, np.log(strength), group.count)
        cell = np.ravel_multi_index((runs.model, of, dominant(runs)), shape)
        counts += np.bincount(cell[sliding(runs)], minlength=counts.size)
    return np.exp(logarithms / np.maximum(runs_of, 1.0)), counts.reshape(shape)


def farther(walk: Walk, than: Floats) -> tuple[Integers, Integers]:
    """Return the number of runs of each model that slide farther than given slips, either way, (models, than), and of
    those with a residual slip, (models,)."""
    models = len(walk.models)
    counts = np.zeros((models, than.size + 1), dtype=np.int64)
    for runs in walk("model", RESIDUAL_SLIP.key):
        slip = np.abs(runs.numbers(RESIDUAL_SLIP.key))
        fine = np.isfinite(slip)
        place = np.searchsorted(than, slip[fine], side="left")
        cell = runs.model[fine] * (than.size + 1) + place
        counts += np.bincount(cell, minlength=counts.size).reshape(counts.shape)
    return counts[:, ::-1].cumsum(axis=1)[:, ::-1][:, 1:], counts.sum(axis=1)
