"""Store of the runs of a study: parts of a table, each written whole as it is done, and the plan they belong to.

``study.json`` says which study it is, by a fingerprint of all that its results depend on, and
``runs/part-N-DIGEST.parquet`` holds a stretch of its runs. A part is there whole or not at all: what was killed, or ran
out of disk, goes on where it stopped. Its digest is that of the study, of the stretch and of all that is in the file: a
part that is damaged, in another's place or of another study is never read.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from heeltoe.base.atomic_files import check_directory, settle, written
from heeltoe.errors.error import InputError
from heeltoe.kernel.build import build_info
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.outcome import Outcome
from heeltoe.study.plan.plan import Pilot, Plan
from heeltoe.study.run.record import STUDY, VERSION, read_manifest, write_record
from heeltoe.warnings.notice import Notice

if TYPE_CHECKING:
    import pyarrow as pa


RUNS = "runs"
_PART = re.compile(r"part-(\d{8,})-[0-9a-f]{16}\.parquet")


@dataclass(frozen=True)
class Store:
    """The directory of a study.

    Attributes
    ----------
    directory
        Where it is.
    count
        How many runs there are.
    size
        How many of them a part has.
    fingerprint
        Fingerprint of the study.
    columns
        The types of the columns of its runs, by name.
    words
        Words that columns may hold, by name.
    """

    directory: Path
    count: int
    size: int
    fingerprint: str
    columns: Mapping[str, str]
    words: Mapping[str, frozenset[str]]
    _sound: dict[str, tuple[int, int]] = field(default_factory=dict, init=False, repr=False, compare=False)

    @classmethod
    def of(cls, directory: Path, record: Mapping[str, Any]) -> Store:
        """Return the store of a study, by its record."""
        words = {
            "model": record["study"]["model"],
            "event": record["events"],
            "motion": [motion["name"] for motion in record["motions"]],
            "outcome": [outcome.value for outcome in Outcome],
        }
        known = {name: frozenset(of_column) for name, of_column in words.items()}
        return cls(directory, record["count"], record["size"], record["fingerprint"], record["columns"], known)

    @property
    def parts(self) -> int:
        """How many parts make the whole."""
        return -(-self.count // self.size)

    @property
    def left(self) -> int:
        """How many parts are not there."""
        return self.parts - len(self.present())

    def stretch(self, part: int) -> tuple[int, int]:
        """Return the first run of a part, and the one after its last."""
        return part * self.size, min((part + 1) * self.size, self.count)

    def present(self) -> dict[int, list[Path]]:
        """Return the files of each part that is there, in the order of the parts; what else lies there is none."""
        found: dict[int, list[Path]] = {}
        for path in sorted((self.directory / RUNS).glob("part-*.parquet")):
            named = _PART.fullmatch(path.name)
            if named and int(named[1]) < self.parts:
                found.setdefault(int(named[1]), []).append(path)
        return dict(sorted(found.items()))

    def missing(self) -> list[int]:
        """Return the parts that are not there."""
        present = self.present()
        return [part for part in range(self.parts) if part not in present]

    def sound(self) -> dict[int, Path]:
        """Return the file of each part that is there, in the order of the parts.

        Raises
        ------
        InputError
            Where a file is not what was written there.
        """
        return {part: self._sound_one(part, paths) for part, paths in self.present().items()}

    def _sound_one(self, part: int, paths: list[Path]) -> Path:
        for path in paths:
            if self.is_sound(part, path):
                return path
        raise InputError("study-part", str(paths[0]))

    def is_sound(self, part: int, path: Path) -> bool:
        """Return whether a file is what was written of a part, to the last bit; one that changes is read again."""
        import pyarrow as pa

        try:
            state = path.stat()
            seen = (state.st_mtime_ns, state.st_size)
            if self._sound.get(path.name) == seen:
                return True
            content = path.read_bytes()
            if path.name != self._name(part, content) or not self._is_part(part, content):
                return False
        except (OSError, ValueError, KeyError, pa.ArrowException):
            return False
        self._sound[path.name] = seen
        return True

    def _is_part(self, part: int, content: bytes) -> bool:
        """Whether a table has the runs of a part: a stranger can make a digest, too."""
        import pyarrow as pa
        import pyarrow.compute as pc
        import pyarrow.parquet as pq

        start, stop = self.stretch(part)
        file = pq.ParquetFile(pa.BufferReader(content))
        schema = file.schema_arrow
        if {column.name: str(column.type) for column in schema} != dict(self.columns):
            return False
        if schema.names != list(self.columns) or file.metadata.num_rows != stop - start:
            return False
        filled = ["run", "sample", "reversed", "factor", "impacts", "slid_off", "undetermined"]
        table = file.read([*filled, *self.words, RESIDUAL_SLIP.key], use_threads=False)
        if any(table[name].null_count for name in (*filled, *self.words)):
            return False
        if not np.array_equal(table["run"].to_numpy(), np.arange(start, stop)):
            return False
        if any(not known.issuperset(pc.unique(table[name]).to_pylist()) for name, known in self.words.items()):
            return False
        with_result = pa.array([outcome.value for outcome in Outcome if outcome.has_result])
        result = pc.is_in(table["outcome"].cast(pa.string()), with_result)
        return not pc.any(pc.and_(result, pc.is_null(table[RESIDUAL_SLIP.key]))).as_py()

    def _name(self, part: int, content: bytes) -> str:
        digest = hashlib.sha256(f"{self.fingerprint} {self.stretch(part)}".encode())
        digest.update(content)
        return f"part-{part:08d}-{digest.hexdigest()[:16]}.parquet"

    def write(self, part: int, table: pa.Table) -> None:
        """Write a part.

        Raises
        ------
        InputError
            Where it cannot be written, as on a full disk; what is there stays.
        """
        import pyarrow as pa
        import pyarrow.parquet as pq

        whole = pa.BufferOutputStream()
        # Hardly a number comes twice: a dictionary of them takes time and room.
        words = [column.name for column in table.schema if pa.types.is_dictionary(column.type)]
        pq.write_table(table, whole, compression="zstd", use_dictionary=words)
        content = whole.getvalue().to_pybytes()
        path = self.directory / RUNS / self._name(part, content)
        with written(path, "--out", within=self.directory) as fresh:
            fresh.write_bytes(content)


def begin(plan: Plan, directory: Path, size: int, columns: Mapping[str, str], *, resume: bool) -> Store:
    """Make the directory of a study, or take up one that has been begun.

    Parameters
    ----------
    plan
        The study.
    directory
        Where; it is made if it is not there.
    size
        How many runs a part has, of a study that is new.
    columns
        The types of the columns of its runs, by name.
    resume
        Whether a study that has been begun there goes on.

    Raises
    ------
    InputError
        Where the directory cannot be used, holds another study, or one that is not to be gone on with.
    """
    check_directory(directory, "--out")
    if (directory / STUDY).exists():
        record = read_manifest(directory)
        if record["fingerprint"] != plan.fingerprint:
            raise InputError("study-other", "--out", directory, changed=_changed(record["inputs"], plan.inputs))
        if not resume:
            raise InputError("study-begun", "--out", directory)
        store = Store.of(directory, record)
        (directory / RUNS).mkdir(exist_ok=True)
        settle(directory / RUNS)
        _drop_damaged(store, record)
        return store
    # What stands there without a study is not ours, but for an empty folder, which says nothing.
    if (directory / RUNS).exists() and (not (directory / RUNS).is_dir() or any((directory / RUNS).iterdir())):
        raise InputError("not-ours", "--out", directory / RUNS)
    directory.mkdir(parents=True, exist_ok=True)
    # The study stands there before its runs: killed in between, it can be gone on with.
    record = _record(plan, size, columns)
    write_record(directory, record)
    (directory / RUNS).mkdir(exist_ok=True)
    return Store.of(directory, record)


def _drop_damaged(store: Store, record: dict[str, Any]) -> None:
    """Remove files that are not the part which they are called, or are it once more, so that it is computed anew, and
    say so in the study."""
    damaged, parts = list[Path](), 0
    for part, paths in store.present().items():
        sound = [path for path in paths if store.is_sound(part, path)]
        damaged += [path for path in paths if path not in sound[:1]]
        parts += not sound
    for path in damaged:
        path.unlink()
    if parts:
        record["warnings"] = [*record["warnings"], str(Notice("study-part-damaged", count=parts))]
        write_record(store.directory, record)


def _record(plan: Plan, size: int, columns: Mapping[str, str]) -> dict[str, Any]:
    """Return what a study is."""
    return {
        "version": VERSION,
        "title": plan.study.title,
        "fingerprint": plan.fingerprint,
        "count": plan.count,
        "size": size,
        "columns": dict(columns),
        "inputs": plan.inputs,
        "warnings": plan.warnings(),
        "events": list(plan.events),
        "motions": plan.motions_of_manifest(),
        "dams": None if plan.dams is None else list(plan.dams),
        "hazard": None if plan.hazard is None else plan.hazard.to_json(),
        "spectra": plan.spectra(),
        "pilot": None if plan.pilot is None else plan.pilot.to_json(),
        "crest": plan.crest,
        "joints": [
            {"place": place, "elevation_m": crack.elevation}
            for place, crack in enumerate(plan.case.cracks)
            if crack.bond is not None
        ],
        "study": plan.study.model_dump(mode="json"),
        "case": plan.case.model_dump(mode="json", exclude_unset=True),
        "build": build_info(),
    }


def keep_questions(directory: Path, plan: Plan) -> None:
    """Replace the stored questions to the runs, which do not change the runs."""
    record = read_manifest(directory)
    record |= {
        "title": plan.study.title,
        "study": plan.study.model_dump(mode="json"),
        "motions": plan.motions_of_manifest(),
        "hazard": None if plan.hazard is None else plan.hazard.to_json(),
        "spectra": plan.spectra(),
        "case": plan.case.model_dump(mode="json", exclude_unset=True),
    }
    write_record(directory, record)


def keep_seconds(directory: Path, seconds: Mapping[str, float]) -> None:
    """Add the measured seconds of some runs to the record of the study."""
    record = read_manifest(directory)
    before = record.get("seconds", {})
    record["seconds"] = before | {name: round(before.get(name, 0.0) + more, 3) for name, more in seconds.items()}
    write_record(directory, record)


def pilot_of(directory: Path) -> Pilot | None:
    """Return how fine the flexible runs of a study that has been begun are; None where that is not known yet."""
    pilot = read_manifest(directory)["pilot"]
    return None if pilot is None else Pilot.from_json(pilot)


def _changed(before: Mapping[str, Any], now: Mapping[str, Any]) -> str:
    """Say in which of its inputs a study differs."""
    names = [name for name in {**before, **now} if before.get(name) != now.get(name)]
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return ", ".join(names[:3]) + more if names else "its inputs"
