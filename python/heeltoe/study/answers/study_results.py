"""The results of a study, complete or not, as the tables that people work with."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.blocks import plain_json
from heeltoe.base.display import Shown
from heeltoe.case.paths import quantity_of
from heeltoe.errors.error import STUDY_PACKAGES, InputError, package
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.outcome import Outcome
from heeltoe.study.answers.answers import bands, summary
from heeltoe.study.answers.comparison import Compared, compared
from heeltoe.study.answers.fragility import Curve, NotStanding, counted, curve, not_standing
from heeltoe.study.answers.hazard import AnnualRate, annual
from heeltoe.study.answers.likelihood import Tally
from heeltoe.study.answers.portfolio import Ranks, portfolio_of, ranks_table
from heeltoe.study.answers.sensitivity import Sobol, Tornado, sobol_indices, tornado
from heeltoe.study.answers.suite import SuiteAnswer, suite_of
from heeltoe.study.plan.file import untitled
from heeltoe.study.run.aggregate import SHAKEN, Walk
from heeltoe.study.run.record import read_manifest
from heeltoe.study.run.store import Store
from heeltoe.units.parse import DIMENSIONS


@dataclass(frozen=True, eq=False)
class StudyResults(Shown):
    """The results of a study.

    Attributes
    ----------
    store
        Where they are.
    manifest
        What the study is, as kept beside its runs.
    kept
        Whether its runs stay where they are; those of a suite without a directory go with the result.
    """

    store: Store
    manifest: dict[str, Any]
    kept: bool = True

    def __repr__(self) -> str:
        left = f", {self.store.left} of {self.store.parts} parts missing" if self.store.left else ""
        return f"<Study {self.title!r}: {self.store.count} runs in {self.store.directory}{left}>"

    @property
    def title(self) -> str:
        """Title of the study; by default the fields that it varies."""
        count = len({motion["name"] for motion in self.manifest["motions"]})
        dams = len(self.manifest["dams"] or ())
        return str(self.manifest["title"]) or untitled(self.manifest["study"], count, dams)

    @property
    def complete(self) -> bool:
        """Whether all runs are there."""
        return not self.store.left

    @property
    def dataset(self) -> Any:
        """All runs that are there, as a ``pyarrow.dataset.Dataset``: nothing is read yet."""
        import pyarrow.dataset as ds

        return ds.dataset(self._files(), format="parquet", exclude_invalid_files=False)

    def batches(self, columns: list[str] | None = None) -> Iterator[pa.RecordBatch]:
        """Walk through the runs in their order, a part at a time."""
        for path in self.store.sound().values():
            yield from pq.ParquetFile(path).read(columns).to_batches()

    def _files(self) -> list[str]:
        """Return the files of the runs that are there.

        Raises
        ------
        InputError
            Where there is none, or one is damaged.
        """
        files = [str(path) for path in self.store.sound().values()]
        if not files:
            raise InputError("study-no-runs", str(self.store.directory))
        return files

    def to_table(self, columns: list[str] | None = None) -> pa.Table:
        """Return the runs as an Arrow table, in their order."""
        table = pa.Table.from_batches(list(self.batches(columns)))
        return table.unify_dictionaries()

    def to_pandas(self, columns: list[str] | None = None) -> Any:
        """Return the runs as a ``pandas.DataFrame``."""
        with package("to_pandas", "pandas"):
            import pandas  # noqa: F401
        return self.to_table(columns).to_pandas()

    def duckdb(self) -> Any:
        """Return a DuckDB connection with the table ``runs``, which reads the files as it needs them."""
        with package("duckdb", "duckdb", STUDY_PACKAGES):
            import duckdb
        connection = duckdb.connect()
        files = ", ".join("'{}'".format(path.replace("'", "''")) for path in self._files())
        connection.execute(f"create view runs as select * from read_parquet([{files}])")
        return connection

    def to_xarray(self) -> Any:
        """Return the numbers of a grid as an ``xarray.Dataset``, with a dimension for each field that varies, for the
        motion, its factor and the model.

        Raises
        ------
        InputError
            Where the study is no grid.
        """
        method = "a table of dams" if self.manifest["dams"] else self.manifest["study"]["method"]
        if method != "grid":
            raise InputError("study-no-answer", "to_xarray", method, remedy="take to_pandas")
        with package("to_xarray", "xarray", STUDY_PACKAGES):
            import pandas  # noqa: F401
            import xarray  # noqa: F401
        table = self.to_pandas()
        table["motion"] = table["motion"].astype(str) + np.where(table["reversed"], ", turned round", "")
        along = [*self.manifest["study"]["vary"], "motion", *self._strength(table), "model"]
        kept = [name for name in along if table[name].nunique() > 1]
        return table.drop(columns=["run", "sample", "event", "reversed"]).set_index(kept).to_xarray()

    def _strength(self, table: Any) -> list[str]:
        motions = self.manifest["study"]["motions"]
        if motions is None or motions["scale"] is None:
            return []
        count = len(motions["scale"]["values"])
        table["strength"] = (table["run"] // len(self.manifest["study"]["model"])) % count
        return ["strength"]

    @cached_property
    def walk(self) -> Walk:
        """Walks through the runs, some at a time."""
        return Walk(self.store, self.manifest)

    @cached_property
    def outcomes(self) -> dict[str, int]:
        """How many runs ended how."""
        counts: Counter[str] = Counter()
        for runs in self.walk("outcome"):
            names, code = runs.words("outcome")
            counts.update(dict(zip(names, np.bincount(code, minlength=len(names)).tolist(), strict=True)))
        return dict(counts.most_common())

    @property
    def all_ok(self) -> bool:
        """Whether every run is there and has a result to trust."""
        return self.complete and all(Outcome(name).has_result for name in self.outcomes)

    @property
    def answered(self) -> bool:
        """Whether every run is there, and of each model some have a result: what the study asks for has an answer.

        Runs without a result are counted in every answer; some of them in a study of many dams are no failure of it."""
        known = [any(Outcome(name).has_result for name in row["outcomes"]) for row in self.summary]
        return self.complete and len(known) == len(self.walk.models) and all(known)

    @cached_property
    def summary(self) -> list[dict[str, Any]]:
        """For each model how its runs ended, how many slide, and how the headline numbers are distributed."""
        return summary(self.walk)

    @cached_property
    def suite(self) -> SuiteAnswer | None:
        """Results of a suite of records: each record by its worse sign, the numbers over all of them, and the limits;
        None where the study is no suite, or has runs to come."""
        return suite_of(self.walk) if self.complete else None

    @cached_property
    def hazard(self) -> list[AnnualRate] | None:
        """How often a year each limit of the fragility curves is exceeded, model by model; None where the study has no
        hazard curve."""
        hazard, names = self.manifest["hazard"], self.manifest["events"]
        if hazard is None:
            return None
        return [
            annual(curve, hazard, tally.witnesses, [names[place] for place in tally.events])
            for curve, tally in zip(self.fragility, self.counted.values(), strict=True)
        ]

    @cached_property
    def portfolio(self) -> list[Ranks] | None:
        """The dams of a table in the order of their ranks, model by model; None where the study has no table of dams,
        or has runs to come."""
        return portfolio_of(self.walk) if self.complete else None

    def portfolio_table(self) -> pa.Table:
        """Return the ranks of the dams of a table as an Arrow table, a row for each dam and model.

        Raises
        ------
        InputError
            Where the study has no table of dams.
        """
        if self.portfolio is None:
            raise InputError(
                "empty", "cases", "the study", what="table of dams", expected='one in its file: cases = "dams.csv"'
            )
        return ranks_table(self.portfolio)

    @property
    def limits_met(self) -> bool | None:
        """Whether a suite keeps all limits of the case, by every model; None where nothing says so."""
        checks = [] if self.suite is None else [check for row in self.suite.models for check in row.limits]
        return all(check.met for check in checks) if checks else None

    @cached_property
    def fragility(self) -> list[Curve]:
        """The curves that the study asks for, model by model.

        Raises
        ------
        InputError
            Where it asks for none.
        """
        settings = self.manifest["study"]["fragility"]
        return [
            replace(
                curve(
                    *(limit, value, settings["measure"], tally),
                    confidence=self.walk.confidence,
                    not_standing=self.not_standing[model],
                ),
                model=model,
            )
            for (model, limit, value), tally in self.counted.items()
        ]

    @cached_property
    def not_standing(self) -> dict[str, NotStanding]:
        """The dams that do not stand before they are shaken, by model; they are behind no curve."""
        return not_standing(self.walk, self.walk.confidence)

    @cached_property
    def counted(self) -> dict[tuple[str, str, float], Tally]:
        """How many runs exceed the limits of the curves at each strength, by model, limit and value.

        Raises
        ------
        InputError
            Where the study asks for no curve.
        """
        settings = self.manifest["study"]["fragility"]
        if settings is None:
            raise InputError(
                "empty", "fragility", "the study", what="fragility curves", expected="limits under [fragility]"
            )
        return counted(self.walk, settings)

    def bands(self, demand: str = RESIDUAL_SLIP.key, measure: str = "pga", period: str | float | None = None) -> Any:
        """Return what 16, 50 and 84 % of the runs of each model stay below, by the strength of the motion: incremental
        dynamic analysis where every motion goes through the same strengths.

        Parameters
        ----------
        demand
            A number of the table; slips count without sign.
        measure, period
            As :meth:`strength` takes them.
        """
        name, models = self.walk.measure(measure, period), self.walk.models

        def pairs() -> Iterator[tuple[Integers, Floats, Floats]]:
            for runs in self.walk("model", *SHAKEN, demand):
                yield runs.model, runs.strength(name), np.abs(runs.numbers(demand))

        pairs_of_model = zip(models, bands(pairs, len(models)), strict=True)
        return {model: band for model, band in pairs_of_model if band["runs"]}

    @cached_property
    def _compared(self) -> dict[str, Compared]:
        return compared(self.walk, RESIDUAL_SLIP.key)

    def compared(self, demand: str = RESIDUAL_SLIP.key) -> dict[str, Compared]:
        """Compare the measures of the strength of motions by how well they foretell a slip, for each model; see
        :meth:`heeltoe.study.answers.comparison.Comparison.found`.

        Parameters
        ----------
        demand
            A slip of the table, which counts without sign.
        """
        return self._compared if demand == RESIDUAL_SLIP.key else compared(self.walk, demand)

    def sensitivity(self, demand: str = RESIDUAL_SLIP.key) -> dict[str, Sobol]:
        """Return Sobol's indices of a number for each model, without its sign; see
        :func:`heeltoe.study.answers.sensitivity.sobol_indices`. A dam that meets several motions counts by the mean.

        Raises
        ------
        InputError
            Where the study was not drawn for them.
        """
        study = self._asked("sensitivity")
        names = [
            *study["vary"],
            *([] if self.walk.every else ["motion"]),
            *(["strength"] if self.walk.strengths is None else []),
        ]
        means = np.abs(self.walk.cube(demand)).mean(axis=(1, 2)).reshape(-1, len(names) + 2, len(study["model"]))
        return {model: sobol_indices(means[:, :, place], names) for place, model in enumerate(study["model"])}

    def tornado(self, demand: str = RESIDUAL_SLIP.key) -> dict[str, Tornado]:
        """Return what each field by itself does to a number for each model, without its sign; see
        :func:`heeltoe.study.answers.sensitivity.tornado`.

        Raises
        ------
        InputError
            Where the fields do not vary one at a time.
        """
        study = self._asked("one at a time")
        fields, first = [], 1
        for path, entry in study["vary"].items():
            count = len(entry) if isinstance(entry, list) else entry["count"]
            fields.append((path, self._written(path, entry, range(first, first + count))))
            first += count
        values = np.abs(self.walk.cube(demand))
        values = values.reshape(len(values), -1, len(study["model"]))
        return {model: tornado(values[:, :, place], fields) for place, model in enumerate(study["model"])}

    def _written(self, path: str, entry: Any, dams: range) -> list[str]:
        """Return the values of a field as people write them."""
        if isinstance(entry, list):
            return [str(value) for value in entry]
        quantity = quantity_of(path)
        unit = DIMENSIONS[quantity].unit if quantity else ""
        table = self.to_table(["sample", path])
        at = dict(zip(table["sample"].to_pylist(), table[path].to_pylist(), strict=True))
        return [f"{at[dam]:.4g} {unit}".strip() if dam in at else "?" for dam in dams]

    def _asked(self, method: str) -> dict[str, Any]:
        study: dict[str, Any] = self.manifest["study"]
        if study["method"] != method:
            raise InputError("study-no-answer", "method", study["method"], remedy=f'run one with method = "{method}"')
        return study

    def to_json(self) -> dict[str, Any]:
        """Return what the study says, without its runs."""
        method = self.manifest["study"]["method"]
        return {
            "title": self.title,
            "directory": str(self.store.directory) if self.kept else None,
            "runs": self.store.count,
            "complete": self.complete,
            "outcomes": self.outcomes,
            "summary": self.summary,
            "suite": plain_json(self.suite),
            "portfolio": plain_json(self.portfolio),
            "fragility": None if self.manifest["study"]["fragility"] is None else plain_json(self.fragility),
            "hazard": plain_json(self.hazard),
            "measures_compared": plain_json(self.compared()),
            "sensitivity": plain_json(self.sensitivity()) if method == "sensitivity" else None,
            "one_at_a_time": plain_json(self.tornado()) if method == "one at a time" else None,
            "warnings": self.manifest["warnings"],
            "pilot": self.manifest["pilot"],
            "seconds": self.manifest.get("seconds"),
            "study": self.manifest["study"],
            "build": self.manifest["build"],
        }

    def strength(self, name: str, period: str | float | None = None) -> np.ndarray[Any, Any]:
        """Return how strong the motion of each run is, by the name of a measure, SI; see
        :mod:`heeltoe.motion.intensity`. ``"sa"`` is that at a period which the study names.

        Raises
        ------
        InputError
            Where it is not known.
        """
        measure = self.walk.measure(name, period)
        return np.concatenate([np.zeros(0), *(runs.strength(measure) for runs in self.walk(*SHAKEN))])


def open_study(directory: str | PathLike[str]) -> StudyResults:
    """Open the results of a study, complete or not.

    Raises
    ------
    InputError
        Where there is none, or something of it is not what was written.
    """
    place = Path(directory)
    record = read_manifest(place)
    store = Store.of(place, record)
    store.sound()
    return StudyResults(store, record)
