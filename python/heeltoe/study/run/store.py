"""Where a study keeps its runs: parts of a table, each written whole as it is done, and what they belong to.

``study.json`` says which study it is, by a fingerprint of all that its results depend on, and ``runs/part-N.parquet``
holds a stretch of its runs. A part is there whole or not at all, so that what was killed, or ran out of disk, goes on
where it stopped.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from heeltoe.base.atomic_files import check_directory, settle, write_text, written
from heeltoe.errors.error import InputError
from heeltoe.result.write import build_info, json_text
from heeltoe.study.plan.plan import Pilot, Plan
from heeltoe.warnings.notice import Notice

STUDY, RUNS = "study.json", "runs"
#: Of the layout of a directory; another one cannot be read.
_VERSION = 5


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
    """

    directory: Path
    count: int
    size: int

    @property
    def parts(self) -> int:
        """How many parts make the whole."""
        return -(-self.count // self.size)

    def path(self, part: int) -> Path:
        """Return where a part is."""
        return self.directory / RUNS / f"part-{part:08d}.parquet"

    def stretch(self, part: int) -> tuple[int, int]:
        """Return the first run of a part, and the one after its last."""
        return part * self.size, min((part + 1) * self.size, self.count)

    def missing(self) -> list[int]:
        """Return the parts that are not there."""
        names = {path.name for path in (self.directory / RUNS).glob("part-*.parquet")}
        return [part for part in range(self.parts) if self.path(part).name not in names]

    def is_whole(self, part: int) -> bool:
        """Return whether a part that is there can be read, and has all of its runs."""
        start, stop = self.stretch(part)
        try:
            return bool(pq.read_table(self.path(part)).num_rows == stop - start)
        except (OSError, pa.ArrowException):
            return False

    def write(self, part: int, table: pa.Table) -> None:
        """Write a part.

        Raises
        ------
        InputError
            Where it cannot be written, as on a full disk; what is there stays.
        """
        with written(self.path(part), "--out", within=self.directory) as fresh:
            pq.write_table(table, fresh, compression="zstd")


def begin(plan: Plan, directory: Path, size: int, *, resume: bool) -> Store:
    """Make the directory of a study, or take up one that has been begun.

    Parameters
    ----------
    plan
        The study.
    directory
        Where; it is made if it is not there.
    size
        How many runs a part has, of a study that is new.
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
        store = Store(directory, record["count"], record["size"])
        (directory / RUNS).mkdir(exist_ok=True)
        settle(directory / RUNS)
        _drop_damaged(store, record)
        return store
    # What stands there without a study is not ours, but for an empty folder, which says nothing.
    if (directory / RUNS).exists() and (not (directory / RUNS).is_dir() or any((directory / RUNS).iterdir())):
        raise InputError("not-ours", "--out", directory / RUNS)
    directory.mkdir(parents=True, exist_ok=True)
    store = Store(directory, plan.count, size)
    # The study stands there before its runs: killed in between, it can be gone on with.
    keep(store, plan)
    (directory / RUNS).mkdir(exist_ok=True)
    return store


def _drop_damaged(store: Store, record: dict[str, Any]) -> None:
    """Remove parts that cannot be read, or lack runs, so that they are computed anew, and say so in the study."""
    lost = set(store.missing())
    damaged = [part for part in range(store.parts) if part not in lost and not store.is_whole(part)]
    if not damaged:
        return
    for part in damaged:
        store.path(part).unlink()
    notice = str(Notice("study-part-damaged", count=len(damaged)))
    record["warnings"] = [*record["warnings"], notice]
    _write_record(store.directory, record)


def keep(store: Store, plan: Plan) -> None:
    """Write what a study is."""
    record = {
        "version": _VERSION,
        "title": plan.study.title,
        "fingerprint": plan.fingerprint,
        "count": store.count,
        "size": store.size,
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
    _write_record(store.directory, record)


def keep_questions(directory: Path, plan: Plan) -> None:
    """Put what is asked of the runs, on which they do not hang, in the place of what was asked before."""
    record = read_manifest(directory)
    record |= {
        "title": plan.study.title,
        "study": plan.study.model_dump(mode="json"),
        "motions": plan.motions_of_manifest(),
        "hazard": None if plan.hazard is None else plan.hazard.to_json(),
        "spectra": plan.spectra(),
        "case": plan.case.model_dump(mode="json", exclude_unset=True),
    }
    _write_record(directory, record)


def keep_seconds(directory: Path, seconds: Mapping[str, float]) -> None:
    """Add to what a study is how long what of its runs took."""
    record = read_manifest(directory)
    before = record.get("seconds", {})
    record["seconds"] = before | {name: round(before.get(name, 0.0) + more, 3) for name, more in seconds.items()}
    _write_record(directory, record)


def _write_record(directory: Path, record: Mapping[str, Any]) -> None:
    write_text(directory / STUDY, json_text(record), "--out", within=directory)


def pilot_of(directory: Path) -> Pilot | None:
    """Return how fine the flexible runs of a study that has been begun are; None where that is not known yet."""
    pilot = read_manifest(directory)["pilot"]
    return None if pilot is None else Pilot.from_json(pilot)


def read_manifest(directory: Path) -> dict[str, Any]:
    """Return what a study's directory says that it is.

    Raises
    ------
    InputError
        Where there is no study.
    """
    path = directory / STUDY
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        if record["version"] != _VERSION:
            raise InputError("study-version", str(path), record["version"])
        return dict(record)
    except FileNotFoundError:
        raise InputError("study-not-there", str(directory)) from None
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise InputError("study-unreadable", str(path), reason=type(error).__name__) from None


def _changed(before: Mapping[str, Any], now: Mapping[str, Any]) -> str:
    """Say in which of its inputs a study differs."""
    names = [name for name in {**before, **now} if before.get(name) != now.get(name)]
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return ", ".join(names[:3]) + more if names else "its inputs"
