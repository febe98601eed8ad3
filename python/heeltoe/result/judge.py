"""The one judge of results: which limits runs meet, which dams have failed, which crack and which sign govern.

A run is one row, a study has n; every number is a column by its JSON name, of shape (n,) or, of several cracks, (n,
cracks) from the crest down.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.blocks import Block, Number
from heeltoe.result.contract import CRACKED, JOINT_METER_M, OPENINGS, PEAKS, RESIDUAL_SLIP, ROTATIONS, WIDTH
from heeltoe.result.crest import ACCELERATION, CREST_PEAKS, DISPLACEMENT
from heeltoe.result.distribution import JUDGED, ROUNDING
from heeltoe.result.histories import GAPS, ROTATION, SLIP
from heeltoe.result.outcome import Outcome

Flags = NDArray[np.bool_]


class Limit(NamedTuple):
    """A limit: what people call it, which numbers it limits, without signs, the column of the histories that goes as
    far, and their unit."""

    label: str
    keys: tuple[str, ...]
    column: str
    unit: str = "m"


#: Everything that a case or a study can limit. `opening` stands in studies alone.
LIMITS = {
    "residual_slip": Limit(RESIDUAL_SLIP.label, (RESIDUAL_SLIP.key,), SLIP),
    "peak_slip": Limit("peak slip", PEAKS, SLIP),
    "opening": Limit("opening at either face", tuple(item.key for item in OPENINGS), ""),
    **{
        item.key.removesuffix("_m"): Limit(item.label, (item.key,), column)
        for item, column in zip(OPENINGS, GAPS, strict=True)
    },
    "cracked_length": Limit("cracked length", (CRACKED,), CRACKED),
    "rotation": Limit("rotation", ROTATIONS, ROTATION, "rad"),
    "crest_displacement": Limit("crest displacement", CREST_PEAKS[:1], DISPLACEMENT),
    "crest_acceleration": Limit("crest acceleration", CREST_PEAKS[1:], ACCELERATION, "g"),
}
#: Those of the crest, which some models do not know.
CREST_LIMITS = ("crest_displacement", "crest_acceleration")


class LimitCheck(Block):
    """Comparison of a result with the user's limit."""

    name: Annotated[str, Number("Field of limits in the case.")]
    value: Annotated[
        float | None,
        Number(
            "Size of the result in `unit`: where single runs scatter, the one that 84 % of them keep to; null of a dam "
            "that has failed without a result."
        ),
    ]
    allowed: Annotated[float, Number("How much the case allows, in `unit`.")]
    failed: Annotated[
        bool, Number("Whether the dam has failed, as its outcome says or by sliding off: no limit is met then.")
    ]
    uncertainty: Annotated[
        float, Number("How far the result may be off by its evidence, in `unit`; zero where there is none.")
    ] = 0.0
    elevation_m: Annotated[
        float | None,
        Number(
            "Elevation of the crack that has this result, where there are several; each bonded joint has its own.",
            "m",
            optional=True,
        ),
    ] = None

    exceeding: Annotated[
        float | None,
        Number(
            "Share of the runs with the shaking varied by up to 1 % that exceed the limit, where single runs scatter.",
            optional=True,
        ),
    ] = None

    friction: Annotated[
        str | None,
        Number("The friction of the band that has this result, where it is not the best estimate.", optional=True),
    ] = None

    @property
    def unit(self) -> Annotated[str, Number("In what result and limit are counted: m, rad or g.")]:
        """In what it is counted."""
        return LIMITS[self.name].unit

    @property
    def utilisation(
        self,
    ) -> Annotated[float | None, Number("The result over its limit; null without a limit or without a result.")]:
        """Ratio of the result to its limit."""
        return self.value / self.allowed if self.allowed and self.value is not None else None

    @property
    def label(self) -> str:
        """Name of the result in words."""
        return LIMITS[self.name].label

    @property
    def met(self) -> Annotated[bool, Number("Whether the dam holds, and the result is within the limit.")]:
        """Whether the limit is kept."""
        # The value knows nothing of runs without a result.
        many = self.exceeding is not None and self.exceeding > 1.0 - JUDGED + ROUNDING
        return not (self.failed or many) and self.value is not None and self.value <= self.allowed

    @property
    def certain(
        self,
    ) -> Annotated[bool, Number("Whether that is so wherever within its uncertainty the result lies.")]:
        """Whether the uncertainty leaves no doubt."""
        return (
            self.failed
            or self.value is None
            or abs(self.value - self.allowed) > self.uncertainty
            or not self.uncertainty
        )


class Judged(NamedTuple):
    """One row: whether it has a result, whether the dam has failed and slid off, how bad that is (the larger the
    worse), which crack governs, and whether each limit is met, None where the run does not say."""

    outcome: Outcome
    has_result: bool
    failed: bool
    slid_off: bool
    badness: tuple[int, int, float]
    governing_crack: int
    met: Mapping[str, bool | None]


@dataclass(frozen=True, eq=False)
class Judgement:
    """The judgement of n runs.

    Attributes
    ----------
    outcome
        (n,) how they ended.
    columns
        Their numbers by JSON name, (n, cracks), of a dam as a whole (n, 1).
    limits
        Allowed values by the name of the limit, SI, accelerations in g.
    """

    outcome: NDArray[Any]
    columns: Mapping[str, Floats]
    limits: Mapping[str, float]

    def __len__(self) -> int:
        return self.outcome.size

    @cached_property
    def has_result(self) -> Flags:
        """(n,) whether the numbers are those of a dam."""
        return self._by_outcome(lambda outcome: outcome.has_result)

    @cached_property
    def slid_off(self) -> Flags:
        """(n,) whether the part above slides farther than its crack is wide, so that nothing is left below it."""
        if "slid_off" in self.columns:
            return np.asarray(self.columns["slid_off"][:, 0] != 0.0)
        if WIDTH not in self.columns or not set(PEAKS) <= self.columns.keys():
            return np.zeros(len(self), dtype=bool)
        known = self._by_outcome(lambda outcome: outcome in (Outcome.OK, Outcome.LOST, Outcome.LARGE_ROTATION))
        down, up = (self.columns[key] for key in PEAKS)
        return np.asarray(known & slides_off(down, up, self.columns[WIDTH]).any(axis=1))

    @cached_property
    def failed(self) -> Flags:
        """(n,) whether the dam has failed: it meets no limit and exceeds every limit."""
        return self._by_outcome(lambda outcome: outcome.failed) | self.slid_off

    @cached_property
    def governing_crack(self) -> Integers:
        """(n,) which of several cracks slips most, or the lowest one where none slips as far as a joint meter shows."""
        slips = np.nan_to_num(np.abs(self.columns[RESIDUAL_SLIP.key]))
        most = slips.argmax(axis=1)
        return np.asarray(np.where(slips.max(axis=1) >= JOINT_METER_M, most, slips.shape[1] - 1), dtype=np.int64)

    def size(self, limit: str) -> Floats:
        """Return (n, cracks) the size of the quantity that a limit bounds; not a number without a result."""
        keys = (limit,) if limit in self.columns else LIMITS[limit].keys
        sizes = np.max([np.abs(self.columns[key]) for key in keys], axis=0)
        return np.where(self.has_result[:, None], sizes, np.nan)

    def worst(self, limit: str) -> Floats:
        """Return (n,) that of the crack that has most of it: infinite of a dam that has failed."""
        return np.where(self.failed, np.inf, self.size(limit).max(axis=1))

    def known(self, limit: str) -> bool:
        """Whether the runs have what a limit limits."""
        return all(key in self.columns for key in LIMITS[limit].keys)

    def exceeds(self, limit: str, value: float) -> Floats:
        """Return (n,) whether a value is exceeded: 1, 0, or not a number where the run does not say."""
        worst = self.worst(limit)
        return np.where(np.isnan(worst), np.nan, (worst > value).astype(np.float64))

    @cached_property
    def not_met(self) -> Mapping[str, Floats]:
        """(n,) for each limit that the runs know whether it is not met: 1, 0, or not a number."""
        return {name: self.exceeds(name, value) for name, value in self.limits.items() if self.known(name)}

    def badness(self, row: int = 0) -> tuple[int, int, float]:
        """Return the sort key for the worse of two runs: outcome, number of limits exceeded, and slip, infinite where
        it is not known."""
        outcome = self.outcome[row]
        severity = 2 if self.failed[row] else outcome.severity
        slip = float(self.size("residual_slip")[row].max())
        count = sum(int(exceeds[row] == 1.0) for exceeds in self.not_met.values())
        return severity, count, math.inf if math.isnan(slip) else slip

    def __getitem__(self, row: int) -> Judged:
        """Return the judgement of one run."""
        if not 0 <= row < len(self):
            raise IndexError(row)
        unmet = {name: float(exceeds[row]) for name, exceeds in self.not_met.items()}
        return Judged(
            self.outcome[row],
            bool(self.has_result[row]),
            bool(self.failed[row]),
            bool(self.slid_off[row]),
            self.badness(row),
            int(self.governing_crack[row]),
            {name: None if math.isnan(value) else not value for name, value in unmet.items()},
        )

    def _by_outcome(self, says: Callable[[Outcome], bool]) -> Flags:
        flags = {outcome: says(outcome) for outcome in set(self.outcome.tolist())}
        return np.array([flags[outcome] for outcome in self.outcome.tolist()], dtype=bool)


_ROWS = {outcome: outcome for outcome in Outcome}


def judge(columns: Mapping[str, Any], limits: Mapping[str, float]) -> Judgement:
    """Judge n >= 1 runs.

    Parameters
    ----------
    columns
        ``outcome``, (n,) words, and numbers by their JSON names, (n,) or (n, cracks): those that the limits limit,
        the residual slip, and ``crack_width_m`` with the peak slips or ``slid_off``. A column by the name of a limit
        is judged instead of the numbers that it limits.
    limits
        Allowed values by the name of the limit, SI, accelerations in g.
    """
    outcome = np.array([_ROWS[word] for word in np.asarray(columns["outcome"], dtype=object).tolist()], dtype=object)
    numbers = {
        name: np.asarray(column, dtype=np.float64).reshape(outcome.size, -1)
        for name, column in columns.items()
        if name != "outcome"
    }
    return Judgement(outcome, numbers, limits)


def slides_off(downstream: Floats | float, upstream: Floats | float, width: Floats | float) -> Flags:
    """Return whether parts slide farther than their cracks are wide, so that nothing is left below them; the largest
    slips downstream are positive, those upstream negative [m]."""
    return np.asarray(np.maximum(downstream, np.negative(upstream)) > width)


def leading_crack(slips_m: Sequence[float]) -> int:
    """Return which of several cracks governs; `slips_m` are the residual slips from the crest down [m]."""
    # The order of the cracks in the file says nothing: one dam may be written in several ways.
    return int(judge({"outcome": ["ok"], RESIDUAL_SLIP.key: [slips_m]}, {}).governing_crack[0])
