"""A study out of a stranger's folder, or off a bad disk: no number of it is another one in silence.

Right values are the runs before the damage. `study.json` of a stranger has a right checksum, as anyone can make one.
"""

from __future__ import annotations

import json
import shutil
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from heeltoe import open_study, run_study
from heeltoe.errors.error import InputError
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.study.run import record as records
from heeltoe.study.run.store import Store
from shared.command import command
from shared.studies import DRAWN, rows, study_file

DOORS = {
    "table": lambda study: study.to_table(),
    "batches": lambda study: list(study.batches()),
    "dataset": lambda study: study.dataset.to_table(),
    "duckdb": lambda study: study.duckdb().execute("select * from runs").fetchall(),
    "summary": lambda study: study.summary,
    "answers": lambda study: study.to_json(),
}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a study of 60 runs in three parts."""
    folder = tmp_path_factory.mktemp("made")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("heeltoe.study.run.run.MOST_OF_PART", 20)
        run_study(study_file(folder, DRAWN), folder / "out")
    return folder


@pytest.fixture
def out(made: Path, tmp_path: Path) -> Path:
    """A copy of its results."""
    return Path(shutil.copytree(made / "out", tmp_path / "out"))


def parts(out: Path) -> list[Path]:
    return sorted((out / "runs").glob("part-*.parquet"))


def forged(out: Path, part: int, table: pa.Table) -> None:
    """Put a table in the place of a part, under the name that it would have."""
    parts(out)[part].unlink()
    Store.of(out, records.read_manifest(out)).write(part, table)


def swapped(out: Path) -> None:
    first, second = parts(out)[:2]
    content = first.read_bytes()
    first.write_bytes(second.read_bytes())
    second.write_bytes(content)


def null_slip(table: pa.Table) -> pa.Table:
    place = table.schema.get_field_index("residual_slip_m")
    slips = [None, *table["residual_slip_m"].to_pylist()[1:]]
    return table.set_column(place, "residual_slip_m", pa.array(slips, pa.float64()))


def whole_slip(table: pa.Table) -> pa.Table:
    place = table.schema.get_field_index("residual_slip_m")
    return table.set_column(place, "residual_slip_m", pa.array(np.ones(len(table), dtype=np.int64)))


def foreign_word(table: pa.Table) -> pa.Table:
    words = pa.array(["gone"] * len(table)).dictionary_encode()
    return table.set_column(table.schema.get_field_index("outcome"), "outcome", words)


FORGED = {
    "another's place": lambda table: table.set_column(0, "run", pa.array(np.arange(len(table)))),
    "too few": lambda table: table.slice(1),
    "other columns": lambda table: table.drop_columns(["residual_slip_m"]),
    "other order": lambda table: table.select(table.column_names[::-1]),
    "other types": whole_slip,
    "a null slip": null_slip,
    "a foreign outcome": foreign_word,
}
DAMAGED = {
    "swapped": swapped,
    "one bit": lambda out: parts(out)[1].write_bytes(b"\x00" + parts(out)[1].read_bytes()[1:]),
    "another name": lambda out: parts(out)[1].rename(parts(out)[1].with_name(f"part-00000001-{'0' * 16}.parquet")),
    **{
        name: lambda out, change=change: forged(out, 1, change(pq.read_table(parts(out)[1])))
        for name, change in FORGED.items()
    },
}


@pytest.mark.parametrize("damage", DAMAGED)
def test_a_damaged_part_is_refused_by_every_door_and_computed_anew(made, out, damage):
    before = rows(open_study(made / "out"))
    opened = open_study(out)
    DAMAGED[damage](out)
    with pytest.raises(InputError) as refused:
        open_study(out)
    assert refused.value.code == "study-part"
    for look in DOORS.values():
        # One that was opened before looks again.
        with pytest.raises(InputError) as refused:
            look(StudyResults(opened.store, opened.manifest))
        assert refused.value.code == "study-part"
    again = run_study(made / "study.toml", out, resume=True)
    assert rows(again) == before
    assert len(parts(out)) == 3
    assert any("were damaged" in warning for warning in again.manifest["warnings"])


def test_what_else_lies_there_is_not_counted(made, out):
    """A part beyond the count, one without a digest, one that is there once more."""
    first = parts(out)[0]
    shutil.copy(first, first.with_name("part-00000009-" + first.name[14:]))
    shutil.copy(first, first.with_name("part-00000002.parquet"))
    shutil.copy(first, first.with_name("more.parquet"))
    before = rows(open_study(made / "out"))
    study = open_study(out)
    assert study.complete
    assert rows(study) == before
    assert study.dataset.count_rows() == 60
    assert study.duckdb().execute("select count(*) from runs").fetchone() == (60,)
    # A double that is not the part is not read, and goes as the study goes on.
    shutil.copy(first, first.with_name(f"part-00000000-{'0' * 16}.parquet"))
    assert open_study(out).duckdb().execute("select count(*) from runs").fetchone() == (60,)
    assert len(parts(run_study(made / "study.toml", out, resume=True).store.directory)) == 5


def test_a_study_without_runs_has_no_table(made, out):
    shutil.rmtree(out / "runs")
    study = open_study(out)
    assert not study.complete
    for look in (study.duckdb, lambda: study.dataset):
        with pytest.raises(InputError) as refused:
            look()
        assert refused.value.code == "study-no-runs"


def test_a_huge_study_that_has_hardly_begun_is_refused(made, out):
    """An array of the thousand million runs that are still to come would take 8 GB; they are said instead."""
    study = open_study(out)
    walk = replace(study.walk, store=replace(study.walk.store, count=10**9))
    for look in (lambda: walk.cube("residual_slip_m"), lambda: walk.worst("residual_slip")):
        with pytest.raises(InputError) as refused:
            look()
        assert refused.value.code == "study-left"
        assert "of 1,000,000,000" in str(refused.value)


HOSTILE = {
    "size of zero": {"size": 0},
    "size below zero": {"size": -1},
    "size in words": {"size": "x"},
    "count below zero": {"count": -5},
    "count of a million million": {"count": 10**12},
    "count of another study": {"count": 61},
    "no count": {"count": None},
    "fingerprint": {"fingerprint": "../../x"},
    "no motions": {"motions": []},
    "motions in words": {"motions": "all"},
    "events": {"events": ["none"]},
    "warnings": {"warnings": [1]},
    "study": {"study": []},
    "field of the study": {"study": {"case": "x", "method": "guess"}},
    "hazard": {"hazard": {"strength": [1.0], "annual_rate": [], "at": []}},
    "pilot": {"pilot": {"elements_across": -1}},
    "columns": {"columns": {"run": 1}},
    "a field more": {"more": 1},
    "joints": {"joints": [{"place": "x"}]},
    "build": {"build": None},
    "title": {"title": {"a": "b"}},
}


@pytest.mark.parametrize("change", HOSTILE)
def test_a_hostile_record_is_one_sentence(out, change):
    record = records.read_manifest(out)
    records.write_record(out, record | HOSTILE[change])
    with pytest.raises(InputError) as refused:
        open_study(out)
    assert refused.value.code == "source-unreadable"
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("text", ["", "[]", "null", "{}", '{"version": 6}', "[" * 100_000, "\udc80"])
def test_a_record_that_is_none_is_one_sentence(out, text):
    (out / "study.json").write_bytes(text.encode("utf-8", "surrogatepass"))
    with pytest.raises(InputError) as refused:
        open_study(out)
    assert refused.value.code == "source-unreadable"


def test_the_command_says_it_in_one_line(made, out):
    records.write_record(out, records.read_manifest(out) | {"size": 0})
    ended = command("study", "study.toml", "--out", out, "--resume", cwd=made)
    assert ended.returncode == 2
    assert ended.stderr.count("\n") == 1
    assert "size" in ended.stderr


def test_a_number_changed_in_the_record_is_refused(out):
    path = out / "study.json"
    record = json.loads(path.read_text())
    record["motions"][0]["measures"]["pga"] *= 1.5
    path.write_text(json.dumps(record))
    with pytest.raises(InputError) as refused:
        open_study(out)
    assert refused.value.code == "source-unreadable"


def flipped(made: Path, tmp_path: Path, count: int) -> None:
    """Flip one bit after another in the files of a study: it is refused, or every number is as it was."""
    out, random = tmp_path / "out", np.random.default_rng(3)
    shutil.copytree(made / "out", out)
    files = [out / "study.json", *parts(out)]
    whole = open_study(out)
    before, said = rows(whole), json.dumps(whole.to_json(), sort_keys=True)
    refusals = 0
    for _ in range(count):
        path = files[random.integers(len(files))]
        content = path.read_bytes()
        place, bit = int(random.integers(len(content))), int(random.integers(8))
        path.write_bytes(content[:place] + bytes([content[place] ^ 1 << bit]) + content[place + 1 :])
        with suppress(InputError):
            refusals += 1
            study = open_study(out)
            # All else that it says comes of these.
            assert study.manifest == whole.manifest
            assert rows(study) == before
            refusals -= 1
        path.write_bytes(content)
    # White space may change, and says nothing.
    assert refusals > 0.9 * count
    assert json.dumps(open_study(out).to_json(), sort_keys=True) == said


def test_flipped_bits_change_no_number_in_silence(made, tmp_path):
    flipped(made, tmp_path, 60)


@pytest.mark.slow
def test_1500_flipped_bits_change_no_number_in_silence(made, tmp_path):
    flipped(made, tmp_path, 1500)
