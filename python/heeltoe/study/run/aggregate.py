"""The runs of a study walked through some at a time, words as numbers: memory does not grow with their count."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.errors.error import InputError
from heeltoe.motion.intensity import at_factor
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.crest import CREST_PEAKS
from heeltoe.result.judge import CREST_LIMITS, LIMITS, Judgement, judge
from heeltoe.study.plan.crack_columns import column_of
from heeltoe.units.parse import parse

# Not at run time: results can be explained without what writes them.
if TYPE_CHECKING:
    import pyarrow as pa

    from heeltoe.study.run.store import Store

#: Runs that are looked at together; bytes of columns that are kept once they have been read.
_TOGETHER, _KEPT = 65_536, 1 << 27
#: So many runs have a place each in memory although some are still to come.
_MOST_UNFINISHED = 10_000_000
#: Of intervals where the study file has no fragility, which would say it.
_CONFIDENCE = 0.9


@dataclass(frozen=True)
class Walk:
    """Walks through the runs of a study.

    Attributes
    ----------
    store
        Where they are.
    manifest
        What the study is.
    """

    store: Store
    manifest: Mapping[str, Any]
    _kept: dict[tuple[tuple[str, ...], str], pa.ChunkedArray] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def __call__(self, *columns: str) -> Iterator[Stretch]:
        """Walk through the runs that are there, in their order."""
        for parts in self._stretches():
            yield Stretch(self._read(parts, columns), self.manifest)

    def _read(self, parts: list[Path], columns: Sequence[str]) -> pa.Table:
        import pyarrow as pa

        place = tuple(path.name for path in parts)
        known = {name: self._kept[place, name] for name in columns if (place, name) in self._kept}
        missing = [name for name in columns if name not in known]
        if missing:
            fresh = _read(parts, missing)
            known |= dict(zip(missing, fresh.columns, strict=True))
            if sum(column.nbytes for column in self._kept.values()) + fresh.nbytes <= _KEPT:
                self._kept.update({(place, name): known[name] for name in missing})
        return pa.table({name: known[name] for name in columns})

    def _stretches(self) -> Iterator[list[Path]]:
        """Walk through the parts that are there, some together."""
        parts = list(self.store.sound().values())
        many = max(1, _TOGETHER // self.store.size)
        for start in range(0, len(parts), many):
            yield parts[start : start + many]

    @property
    def models(self) -> list[str]:
        """The models, in the order of their places."""
        return list(self.manifest["study"]["model"])

    @property
    def cracks(self) -> int:
        """How many cracks the dams have."""
        return 1 + len(self.manifest["case"].get("further_cracks", ()))

    @property
    def limits(self) -> dict[str, float]:
        """Limits of the base case by name, SI, accelerations in g."""
        limits = self.manifest["case"].get("limits") or {}
        absent = {*(() if self.crest else CREST_LIMITS), *(() if self.joints else ("cracked_length",))}
        known = {name: value for name, value in limits.items() if value is not None and name not in absent}
        return {name: self._number(value) for name, value in known.items()}

    @property
    def asked(self) -> list[tuple[str, float]]:
        """The limits of the curves with their values, in the same units."""
        settings = self.manifest["study"]["fragility"]
        limits = settings["limits"] if settings else {}
        return [(limit, self._number(value)) for limit, values in limits.items() for value in values]

    def _number(self, value: object) -> float:
        """Return a limit as the study keeps it: with its unit where it has one."""
        if isinstance(value, int | float):
            return float(value)
        number, *unit = str(value).split()
        if unit != ["m/s^2"]:
            return float(number)
        return float(number) / parse(self.manifest["case"].get("gravity", "1 g"), "acceleration", "gravity")

    def judging(self, limits: Iterable[str] = ()) -> list[str]:
        """Return the columns by which :meth:`Stretch.judged` judges runs by some limits."""
        names = sorted({RESIDUAL_SLIP.key, *(key for limit in limits for key in LIMITS[limit].keys)})
        return ["outcome", "slid_off", *names, *(column for name in names for column in self.of_cracks(name))]

    @property
    def crest(self) -> bool:
        """Whether the runs say how the crest moves."""
        return bool(self.manifest.get("crest"))

    @property
    def joints(self) -> list[dict[str, Any]]:
        """The bonded joints from the crest down: ``place`` among the cracks and ``elevation_m``."""
        return list(self.manifest.get("joints") or ())

    def of_cracks(self, name: str) -> list[str]:
        """Return the columns of a headline number at each of several cracks, from the crest down; none of one crack."""
        several = self.cracks > 1 and name not in CREST_PEAKS
        return [column_of(place, name) for place in range(self.cracks)] if several else []

    def measure(self, name: str, period: str | float | None = None) -> str:
        """Return what a measure of strength is called among those that are known of the motions.

        Raises
        ------
        InputError
            Where it is none of them.
        """
        if name == "sa" and period is not None:
            name = f"sa({float(str(period).split()[0]):g})"
        known = ", ".join(self.manifest["motions"][0]["measures"])
        if any(name not in motion["measures"] for motion in self.manifest["motions"]):
            raise InputError("not-a-choice", "measure", name, choices=f"one of {known}")
        return name

    @property
    def every(self) -> bool:
        """Whether every dam meets every motion, or one each."""
        study = self.manifest["study"]
        chosen = study["motions"] and study["motions"]["every"]
        return study["method"] in ("grid", "one at a time") if chosen is None else bool(chosen)

    @property
    def strengths(self) -> int | None:
        """Through how many strengths each motion goes; None where each dam draws one."""
        motions = self.manifest["study"]["motions"]
        scale = motions and motions["scale"]
        if not scale:
            return 1
        return len(scale["values"]) if isinstance(scale["values"], list) else None

    @property
    def confidence(self) -> float:
        """The probability of the intervals of curves and of shares."""
        settings = self.manifest["study"]["fragility"]
        return float(settings["confidence"]) if settings else _CONFIDENCE

    @property
    def dams(self) -> int:
        """How many dams the study has."""
        motions = len(self.manifest["motions"]) if self.every else 1
        return self.store.count // (motions * (self.strengths or 1) * len(self.models))

    @property
    def drawn(self) -> bool:
        """Whether the dams are drawn from those that there may be, one independent of the other."""
        return self.manifest["study"]["method"] in ("latin hypercube", "sobol")

    def cube(self, name: str) -> Floats:
        """Return a number of all runs in an array of dams, motions of each, strengths of each motion, and models; not a
        number where a run has no result."""
        return self._cube((runs.whole("run"), runs.numbers(name)) for runs in self("run", name))

    def worst(self, limit: str) -> Floats:
        """Return the size of a limited number, at the crack where it is largest; infinite for a dam that has failed."""
        judged = ((runs.whole("run"), runs.judged(self, {limit: 0.0})) for runs in self("run", *self.judging([limit])))
        return self._cube((run, judgement.worst(limit)) for run, judgement in judged)

    def _cube(self, columns: Iterable[tuple[Integers, Floats]]) -> Floats:
        if self.store.count > _MOST_UNFINISHED and (left := self.store.left):
            there = max(self.store.count - left * self.store.size, 0)
            raise InputError("study-left", str(self.store.directory), f"{there:,}", count=f"{self.store.count:,}")
        cube = np.full(self.store.count, np.nan)
        for run, values in columns:
            cube[run] = values
        motions = len(self.manifest["motions"]) if self.every else 1
        return cube.reshape(-1, motions, self.strengths or 1, len(self.models))


#: What tells the strength of a run.
SHAKEN = ("motion", "reversed", "factor")


@dataclass(frozen=True, eq=False)
class Stretch:
    """Some runs.

    Attributes
    ----------
    table
        The columns that were asked for.
    manifest
        What the study is.
    """

    table: pa.Table
    manifest: Mapping[str, Any]

    @property
    def model(self) -> Integers:
        """(n,) place among the models of the study."""
        return self._places("model", {name: place for place, name in enumerate(self.manifest["study"]["model"])})

    @property
    def event(self) -> Integers:
        """(n,) place among the events of the study."""
        return self._places("event", {name: place for place, name in enumerate(self.manifest["events"])})

    @cached_property
    def motion(self) -> Integers:
        """(n,) place among the motions of the study."""
        both = [
            {
                motion["name"]: place
                for place, motion in enumerate(self.manifest["motions"])
                if motion["reversed"] == turned
            }
            for turned in (False, True)
        ]
        ways = [self._places("motion", known) for known in both]
        return np.where(self.table["reversed"].to_numpy(), ways[1], ways[0])

    def strength(self, measure: str) -> Floats:
        """Return how strong the motion of each run is, (n,) SI, by the measure of :meth:`Walk.measure`."""
        values = np.array([motion["measures"][measure] for motion in self.manifest["motions"]], dtype=np.float64)
        return np.asarray(at_factor(values[self.motion], measure, self.numbers("factor")), dtype=np.float64)

    def numbers(self, name: str) -> Floats:
        """Return a column of numbers, (n,); not a number where a run has no number."""
        return np.asarray(self.table[name].to_numpy(), dtype=np.float64)

    def judged(self, walk: Walk, limits: Mapping[str, float]) -> Judgement:
        """Return the judgement of the runs by limits, see :meth:`Walk.judging`."""
        words, code = self.words("outcome")
        columns: dict[str, Any] = {"outcome": np.array(words, dtype=object)[code], "slid_off": self.table["slid_off"]}
        for name in walk.judging(limits)[2:]:
            if "]." not in name:
                places = walk.of_cracks(name) or [name]
                columns[name] = np.column_stack([self.numbers(column) for column in places])
        return judge(columns, limits)

    def whole(self, name: str) -> Integers:
        """Return a column of whole numbers, (n,)."""
        return np.asarray(self.table[name].to_numpy(), dtype=np.int64)

    def words(self, name: str) -> tuple[list[str], Integers]:
        """Return the words of a column, and the place of each run's among them."""
        import pyarrow as pa

        column = self.table[name].combine_chunks()
        if isinstance(column, pa.ChunkedArray):
            column = column.chunk(0) if column.num_chunks else pa.array([], pa.dictionary(pa.int32(), pa.string()))
        return column.dictionary.to_pylist(), np.asarray(column.indices.to_numpy(), dtype=np.int64)

    def _places(self, name: str, known: Mapping[str, int]) -> Integers:
        words, code = self.words(name)
        return np.array([known.get(word, 0) for word in words], dtype=np.int64)[code]


def _read(parts: list[Path], columns: list[str]) -> pa.Table:
    import pyarrow as pa
    import pyarrow.parquet as pq

    tables = [pq.ParquetFile(path).read(columns, use_threads=False) for path in parts]
    return pa.concat_tables(tables).unify_dictionaries().combine_chunks()
