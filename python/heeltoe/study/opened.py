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

from heeltoe.arrays import Floats, Integers
from heeltoe.case.paths import quantity_of
from heeltoe.errors import InputError
from heeltoe.motion.intensity import at_factor
from heeltoe.result.contract import HEADLINES
from heeltoe.shown import Shown
from heeltoe.study.answers import MODES, bands, fragility_of, summary
from heeltoe.study.compared import compared
from heeltoe.study.fragility import LIMITED, Curve
from heeltoe.study.sensitivity import sobol_indices, tornado
from heeltoe.study.store import RUNS, Store, read_told
from heeltoe.units.parse import DIMENSIONS


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

    @property
    def fragility(self) -> list[dict[str, Any]]:
        """The curves that the study asks for.

        Raises
        ------
        InputError
            Where it asks for none.
        """
        return [{"model": model, **curve.to_json()} for model, curve in self.curves]

    @cached_property
    def curves(self) -> list[tuple[str, Curve]]:
        """The same with what can be asked of a curve, each with its model.

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
        strong, (names, model) = self.strength(measure, period), codes(table, "model")
        here = {name: model == place for place, name in enumerate(names)}
        return {name: bands(strong[each], values[each]) for name, each in here.items() if each.any()}

    def compared(self, demand: str = "residual_slip_m") -> dict[str, dict[str, Any]]:
        """Compare the measures of the strength of motions by how well they foretell a slip, for each model; see
        :func:`heeltoe.study.compared.compared`.

        Parameters
        ----------
        demand
            A slip of the table, which counts without sign.
        """
        table = self.to_table(["model", "event", demand])
        values = np.abs(np.asarray(table[demand].to_numpy(), dtype=np.float64))
        place, factor = self._motions
        motions = self.told["motions"]

        def of(kind: str, name: str) -> Floats:
            return np.array([each[kind][name] for each in motions], dtype=np.float64)[place]

        strengths = {name: np.asarray(at_factor(of("measures", name), name, factor)) for name in motions[0]["measures"]}
        traits = {name: of("traits", name) for name in motions[0].get("traits", ())}
        (names, model), (_, event) = codes(table, "model"), codes(table, "event")
        found = {}
        for number, name in enumerate(names):
            here = model == number
            measured = {key: each[here] for key, each in strengths.items()}
            found[name] = compared(
                measured, values[here], event[here], {key: each[here] for key, each in traits.items()}
            )
        return found

    def cube(self, name: str) -> Floats:
        """Return a number of all runs in an array of dams, motions of each, strengths of each motion, and models; not a
        number where a run has no such result."""
        found = np.full(self.store.count, np.nan)
        for batch in self.batches(["run", name]):
            found[batch["run"].to_numpy()] = batch[name].to_numpy(zero_copy_only=False)
        motions = len(self.told["motions"]) if self.every else 1
        return found.reshape(-1, motions, self.strengths or 1, len(self.told["study"]["model"]))

    def sensitivity(self, demand: str = "residual_slip_m") -> dict[str, dict[str, Any]]:
        """Return Sobol's indices of a number for each model, without its sign; see
        :func:`heeltoe.study.sensitivity.sobol_indices`. A dam that meets several motions counts by the mean.

        Raises
        ------
        InputError
            Where the study was not drawn for them.
        """
        study = self._asked("sensitivity")
        names = [*study["vary"], *([] if self.every else ["motion"]), *(["strength"] if self.strengths is None else [])]
        means = np.abs(self.cube(demand)).mean(axis=(1, 2)).reshape(-1, len(names) + 2, len(study["model"]))
        return {model: sobol_indices(means[:, :, place], names) for place, model in enumerate(study["model"])}

    def tornado(self, demand: str = "residual_slip_m") -> dict[str, dict[str, Any]]:
        """Return what each field by itself does to a number for each model, without its sign; see
        :func:`heeltoe.study.sensitivity.tornado`.

        Raises
        ------
        InputError
            Where the fields do not vary one at a time.
        """
        study = self._asked("one at a time")
        fields, first = [], 1
        for path, given in study["vary"].items():
            count = len(given) if isinstance(given, list) else given["count"]
            fields.append((path, self._written(path, given, range(first, first + count))))
            first += count
        values = np.abs(self.cube(demand))
        values = values.reshape(len(values), -1, len(study["model"]))
        return {model: tornado(values[:, :, place], fields) for place, model in enumerate(study["model"])}

    def _written(self, path: str, given: Any, dams: range) -> list[str]:
        """Return the values of a field as people write them."""
        if isinstance(given, list):
            return [str(each) for each in given]
        quantity = quantity_of(path)
        unit = DIMENSIONS[quantity].unit if quantity else ""
        table = self.to_table(["sample", path])
        at = dict(zip(table["sample"].to_pylist(), table[path].to_pylist(), strict=True))
        return [f"{at[dam]:.4g} {unit}".strip() if dam in at else "?" for dam in dams]

    def _asked(self, method: str) -> dict[str, Any]:
        study: dict[str, Any] = self.told["study"]
        if study["method"] != method:
            raise InputError("study-no-answer", "method", study["method"], method=method)
        return study

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
            "measures_compared": self.compared(),
            "sensitivity": self.sensitivity() if self.told["study"]["method"] == "sensitivity" else None,
            "one_at_a_time": self.tornado() if self.told["study"]["method"] == "one at a time" else None,
            "warnings": self.told["warnings"],
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
        known = ", ".join(self.told["motions"][0]["measures"])
        if any(name not in each["measures"] for each in self.told["motions"]):
            raise InputError("study-measure", "measure", name, known=known)
        place, factor = self._motions
        values = np.array([each["measures"][name] for each in self.told["motions"]])[place]
        return np.asarray(at_factor(values, name, factor), dtype=np.float64)

    @property
    def _motions(self) -> tuple[Integers, Floats]:
        """The place of each run's motion among those of the study, and its factor."""
        table = self.to_table(["motion", "reversed", "factor"])
        names, code = codes(table, "motion")
        places = {(each["name"], each["reversed"]): place for place, each in enumerate(self.told["motions"])}
        of = np.array([[places.get((name, turned), 0) for turned in (False, True)] for name in names], dtype=np.int64)
        turned = table["reversed"].to_numpy().astype(np.int64)
        return of.reshape(-1, 2)[code, turned], np.asarray(table["factor"].to_numpy(), dtype=np.float64)

    @property
    def every(self) -> bool:
        """Whether every dam meets every motion, or one each."""
        study = self.told["study"]
        chosen = study["motions"] and study["motions"]["every"]
        return study["method"] in ("grid", "one at a time") if chosen is None else bool(chosen)

    @property
    def strengths(self) -> int | None:
        """Through how many strengths each motion goes; None where each dam draws one."""
        motions = self.told["study"]["motions"]
        scale = motions and motions["scale"]
        if not scale:
            return 1
        return len(scale["values"]) if isinstance(scale["values"], list) else None


def codes(table: pa.Table, name: str) -> tuple[list[str], Integers]:
    """Return the words of a column, and the place of each row's among them."""
    column = table[name].unify_dictionaries().combine_chunks()
    if isinstance(column, pa.ChunkedArray):
        column = column.chunk(0) if column.num_chunks else pa.array([], pa.dictionary(pa.int32(), pa.string()))
    return column.dictionary.to_pylist(), np.asarray(column.indices.to_numpy(), dtype=np.int64)


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
