"""The results of a study, complete or not, as the tables that people work with."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.dataset as ds

from heeltoe.errors import InputError
from heeltoe.motion.intensity import at_factor
from heeltoe.result.contract import HEADLINES
from heeltoe.shown import Shown
from heeltoe.study.answers import MODES, bands, fragility_of, summary
from heeltoe.study.fragility import LIMITED
from heeltoe.study.store import RUNS, Store, read_told


@dataclass(frozen=True, eq=False)
class Opened(Shown):
    """The results of a study.

    Attributes
    ----------
    store
        Where they are.
    told
        What the study is, as kept beside its runs.
    """

    store: Store
    told: dict[str, Any]

    def __repr__(self) -> str:
        left = "" if self.complete else f", {len(self.store.missing())} of {self.store.parts} parts missing"
        return f"<Study {self.title!r}: {self.store.count} runs in {self.store.directory}{left}>"

    @property
    def title(self) -> str:
        """Of the study."""
        return str(self.told["title"]) or "untitled study"

    @property
    def complete(self) -> bool:
        """Whether all runs are there."""
        return not self.store.missing()

    @property
    def dataset(self) -> ds.Dataset:
        """All runs that are there, as an Arrow dataset: nothing is read yet."""
        return ds.dataset(self.store.directory / RUNS, format="parquet", exclude_invalid_files=False)

    def batches(self, columns: list[str] | None = None) -> Iterator[pa.RecordBatch]:
        """Walk through the runs in their order, a part at a time."""
        for part in range(self.store.parts):
            if self.store.path(part).exists():
                yield from ds.dataset(self.store.path(part)).to_batches(columns=columns)

    def to_table(self, columns: list[str] | None = None) -> pa.Table:
        """Return the runs as an Arrow table, in their order."""
        found = pa.Table.from_batches(list(self.batches(columns)))
        return found.unify_dictionaries()

    def to_pandas(self, columns: list[str] | None = None) -> Any:
        """Return the runs as a ``pandas.DataFrame``."""
        try:
            import pandas  # noqa: F401
        except ImportError:
            raise InputError("pandas-package", "to_pandas") from None
        return self.to_table(columns).to_pandas()

    def duckdb(self) -> Any:
        """Return a DuckDB connection with the table ``runs``, which reads the files as it needs them."""
        try:
            import duckdb
        except ImportError:
            raise InputError("study-package", "duckdb", "duckdb") from None
        connection = duckdb.connect()
        files = str(self.store.directory / RUNS / "part-*.parquet").replace("'", "''")
        connection.execute(f"create view runs as select * from read_parquet('{files}')")
        return connection

    def to_xarray(self) -> Any:
        """Return the numbers of a grid as an ``xarray.Dataset``, with a dimension for each field that varies, for the
        motion, its factor and the model.

        Raises
        ------
        InputError
            Where the study is no grid.
        """
        if self.told["study"]["method"] != "grid":
            raise InputError("study-no-grid", "to_xarray", self.told["study"]["method"])
        try:
            import pandas  # noqa: F401
            import xarray  # noqa: F401
        except ImportError:
            raise InputError("study-package", "to_xarray", "xarray") from None
        table = self.to_pandas()
        table["motion"] = table["motion"].astype(str) + np.where(table["reversed"], ", turned round", "")
        along = [*self.told["study"]["vary"], "motion", *self._strength(table), "model"]
        kept = [name for name in along if table[name].nunique() > 1]
        return table.drop(columns=["run", "sample", "event", "reversed"]).set_index(kept).to_xarray()

    def _strength(self, table: Any) -> list[str]:
        motions = self.told["study"]["motions"]
        if motions is None or motions["scale"] is None:
            return []
        count = len(motions["scale"]["values"])
        table["strength"] = (table["run"] // len(self.told["study"]["model"])) % count
        return ["strength"]

    @cached_property
    def outcomes(self) -> dict[str, int]:
        """How many runs ended how."""
        found: Counter[str] = Counter()
        for batch in self.batches(["outcome"]):
            for each in pc.value_counts(batch["outcome"]).to_pylist():
                found[each["values"]] += each["counts"]
        return dict(found.most_common())

    @property
    def all_ok(self) -> bool:
        """Whether every run is there and has a result to trust."""
        return self.complete and set(self.outcomes) <= {"ok", "overturned"}

    @cached_property
    def summary(self) -> list[dict[str, Any]]:
        """For each model how its runs ended, how many slide, and how the headline numbers are distributed."""
        kept = ["model", "outcome", *(each.key for each in HEADLINES), *(f"slip_{mode}_m" for mode in MODES)]
        return summary(self.to_table(kept))

    @cached_property
    def fragility(self) -> list[dict[str, Any]]:
        """The curves that the study asks for.

        Raises
        ------
        InputError
            Where it asks for none.
        """
        asked = self.told["study"]["fragility"] or {"measure": "pga"}
        columns = {name for names in LIMITED.values() for name in names}
        table = self.to_table(["model", "outcome", "event", *sorted(columns)])
        return fragility_of(table, self.strength(asked["measure"], asked.get("period")), self.told)

    def bands(self, demand: str = "residual_slip_m", measure: str = "pga", period: str | float | None = None) -> Any:
        """Return what 16, 50 and 84 % of the runs of each model stay below, by the strength of the motion: incremental
        dynamic analysis where every motion goes through the same strengths.

        Parameters
        ----------
        demand
            A number of the table; slips count without sign.
        measure, period
            As :meth:`strength` takes them.
        """
        table = self.to_table(["model", demand])
        values = np.abs(np.asarray(table[demand].to_numpy(), dtype=np.float64))
        strong, model = self.strength(measure, period), np.array(table["model"].to_pylist())
        return {name: bands(strong[model == name], values[model == name]) for name in np.unique(model).tolist()}

    def to_json(self) -> dict[str, Any]:
        """Return what the study says, without its runs."""
        return {
            "title": self.title,
            "directory": str(self.store.directory),
            "runs": self.store.count,
            "complete": self.complete,
            "outcomes": self.outcomes,
            "summary": self.summary,
            "fragility": None if self.told["study"]["fragility"] is None else self.fragility,
            "pilot": self.told["pilot"],
            "study": self.told["study"],
            "build": self.told["build"],
        }

    def strength(self, name: str, period: str | float | None = None) -> np.ndarray[Any, Any]:
        """Return how strong the motion of each run is, by the name of a measure, SI; see
        :mod:`heeltoe.motion.intensity`. ``"sa"`` is that at a period which the study names.

        Raises
        ------
        InputError
            Where it is not known.
        """
        if name == "sa" and period is not None:
            name = f"sa({float(str(period).split()[0]):g})"
        by_motion = {(each["name"], each["reversed"]): each["measures"] for each in self.told["motions"]}
        if any(name not in each for each in by_motion.values()):
            known = ", ".join(next(iter(by_motion.values())))
            raise InputError("study-measure", "measure", name, known=known)
        table = self.to_table(["motion", "reversed", "factor"])
        motion, factor = table["motion"].to_pylist(), table["factor"].to_numpy()
        turned = table["reversed"].to_pylist()
        values = np.array([by_motion[key][name] for key in zip(motion, turned, strict=True)])
        return np.asarray(at_factor(values, name, factor), dtype=np.float64)


def open_study(directory: str | PathLike[str]) -> Opened:
    """Open the results of a study, complete or not.

    Raises
    ------
    InputError
        Where there is none.
    """
    place = Path(directory)
    told = read_told(place)
    return Opened(Store(place, told["count"], told["size"]), told)
