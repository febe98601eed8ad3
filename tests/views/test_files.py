"""What `--out` writes: all that belongs to a result, all of it or nothing, and nothing of an earlier run beside it."""

from __future__ import annotations

import json
import sys

import numpy as np
import pyarrow.parquet as pq
import pytest

from heeltoe import InputError, Response, flexible, overturning_map, read_case, rigid
from heeltoe.base.atomic_files import LISTED, files
from heeltoe.result.write import json_text
from heeltoe.study.small.run_table import parse_axes, run_small
from heeltoe.views.files.write import write_all, write_overturning
from shared.dams import BLOCK, FAST, HEIGHT, KOYNA, SHORT, SLENDER, example, plane_case


@pytest.fixture
def both(typical_both) -> Response:
    return typical_both


@pytest.fixture(scope="module")
def block():
    return rigid(example("block"))


def contents(directory):
    """Return all files below a directory with what is in them, and all directories."""
    return {
        str(path.relative_to(directory)): path.read_bytes() if path.is_file() else None for path in directory.rglob("*")
    }


def names(directory):
    """Return all files below a directory but the list of them."""
    return {str(path.relative_to(directory)) for path in directory.rglob("*") if path.is_file()} - {LISTED}


def failing(*_, **__):
    raise OSError(28, "No space left on device")


@pytest.mark.slow
def test_files_of_both(typical_written):
    directory, paths = typical_written
    written = {str(path.relative_to(directory)) for path in paths}
    assert written == names(directory) == set(files(directory))
    assert written >= {
        "result.json",
        "comparison.png",
        "rigid/result.json",
        "rigid/events.parquet",
        "rigid/accelerations.png",
        "histories.parquet",
        "crack.parquet",
        "crack.svg",
        "energy.png",
        "forces.png",
    }
    assert "events.parquet" not in written
    for place, model in (("", "flexible"), ("rigid/", "rigid")):
        assert json.loads((directory / f"{place}result.json").read_text())["model"] == model


def test_the_json_is_that_of_the_result(typical_written, both):
    for place, result in (("", both), ("rigid/", both.beside)):
        text = (typical_written[0] / f"{place}result.json").read_text(encoding="utf-8")
        assert text == json_text(result.to_json()) + "\n"


@pytest.mark.usefixtures("empty_figures")
def test_what_an_earlier_run_left_does_not_stay(both, typical_elastic, tmp_path):
    (tmp_path / "rigid").mkdir()
    mine = [tmp_path / name for name in ("notes.txt", "report.pdf", "events.csv", "rigid/result.json")]
    for path in mine:
        path.write_text("mine")
    write_all(both.beside, tmp_path)
    write_all(typical_elastic, tmp_path, suffix=".csv")
    keys = names(tmp_path)
    assert not keys & {"events.parquet", "histories.parquet", "accelerations.png", "accelerations.svg"}
    assert {"histories.csv", "crack.csv", "energy.png"} <= keys
    assert [path.read_text() for path in mine] == ["mine"] * len(mine)


def test_kinds_of_results_replace_each_other(both, typical_elastic, block, tmp_path):
    """Whatever was written last into a directory is alone there."""
    grid = run_small(BLOCK, [], parse_axes(["crack.friction=0.2,0.3"]), rigid)
    results = {"block": block, "both": both, "grid": grid, "elastic": typical_elastic}
    for name in ("block", "both", "grid", "elastic", "both", "block"):
        alone, after = ({*write_all(results[name], tmp_path / place, figures={})} for place in (name, "all"))
        expected = {path.relative_to(tmp_path / name) for path in alone}
        assert {path.relative_to(tmp_path / "all") for path in after} == expected
        assert names(tmp_path / "all") == set(map(str, expected))
    assert not (tmp_path / "all" / "rigid").exists()


def test_files_of_a_table_of_runs(tmp_path):
    grid = run_small(KOYNA, SHORT, parse_axes(["crack.friction=0.1,1.0"]), rigid)
    paths = write_all(grid, tmp_path, KOYNA)
    assert {path.name for path in paths} == {"result.json", "table.csv", "table.parquet", "slips.png", "slips.svg"}
    assert pq.read_table(tmp_path / "table.parquet").to_pylist() == grid.rows()
    assert json.loads((tmp_path / "result.json").read_text())["runs"][0]["outcome"] == "unstable"


def test_a_run_that_never_started_has_no_histories(tmp_path):
    response = rigid(example("block", "crack.friction=0.01", "crack.inclination=10 deg"))
    assert response.outcome == "unstable"
    assert [path.name for path in write_all(response, tmp_path)] == ["result.json"]


def test_tables_in_either_form(both, tmp_path):
    for suffix in (".csv", ".parquet"):
        write_all(both, tmp_path, suffix=suffix, figures={})
        keys = names(tmp_path)
        tables = {f"rigid/histories{suffix}", f"rigid/events{suffix}", f"histories{suffix}"}
        assert keys == tables | {"result.json", "rigid/result.json", f"crack{suffix}"}
    rows = len(both.histories["time_s"])
    assert pq.read_table(tmp_path / "histories.parquet").num_rows == rows


@pytest.mark.usefixtures("no_figures")
@pytest.mark.parametrize(
    "stage",
    [
        "views.files.write.write_json",
        "views.files.write.write_table",
        "views.figures.write.save_all",
        "models.flexible.result.history.crack_table",
        "base.atomic_files._publish",
    ],
)
def test_a_failure_at_any_stage_leaves_what_was_there(stage, both, block, tmp_path, monkeypatch):
    write_all(block, tmp_path / "old", figures={})
    (tmp_path / "old" / "notes.txt").write_text("mine")
    before = contents(tmp_path)
    monkeypatch.setattr(f"heeltoe.{stage}", failing)
    for place in ("old", "deep/er"):
        with pytest.raises(InputError, match=r"cannot be written \(No space left on device\)") as refused:
            write_all(both, tmp_path / place)
        assert refused.value.code == "cannot-write"
        assert contents(tmp_path) == before


@pytest.mark.parametrize("error", [KeyboardInterrupt, ZeroDivisionError])
def test_an_interrupted_run_leaves_nothing_behind(error, block, tmp_path, monkeypatch):
    def interrupted(*_, **__):
        raise error

    monkeypatch.setattr("heeltoe.views.figures.write.save_all", interrupted)
    with pytest.raises(error):
        write_all(block, tmp_path / "new" / "place")
    assert contents(tmp_path) == {}


def test_units_that_nobody_knows_leave_nothing_behind(block, tmp_path):
    with pytest.raises(InputError) as refused:
        write_all(block, tmp_path / "new", units="cubits")
    assert refused.value.code == "not-a-choice"
    assert contents(tmp_path) == {}


def test_a_file_is_no_directory(block, tmp_path):
    (tmp_path / "file").write_text("mine")
    for place in ("file", "file/below"):
        with pytest.raises(InputError) as refused:
            write_all(block, tmp_path / place)
        assert refused.value.code == "cannot-write"
    assert contents(tmp_path) == {"file": b"mine"}


def test_a_map_of_overturning_goes_beside_a_run(block, tmp_path, monkeypatch):
    write_all(block, tmp_path, figures={})
    before = contents(tmp_path)
    overturning = overturning_map(read_case(SLENDER), count=3)
    paths = write_overturning(overturning, tmp_path)
    assert [path.name for path in paths] == ["overturning.csv", "overturning.png", "overturning.svg"]
    after = contents(tmp_path)
    assert before.items() - after.items() == {(LISTED, before[LISTED])}
    assert after.keys() - before.keys() == {path.name for path in paths}
    assert len(paths[0].read_text().splitlines()) == 1 + 3 * 3
    monkeypatch.setattr("heeltoe.views.figures.write.save_all", failing)
    for place in (tmp_path, tmp_path / "new"):
        with pytest.raises(InputError, match="No space left"):
            write_overturning(overturning, place)
        assert contents(tmp_path) == after


def test_vtk_files_of_an_earlier_run_go(both, tmp_path):
    folder = tmp_path / "vtk"
    folder.mkdir()
    (folder / "notes.vtu").write_text("mine")
    paths = write_all(both, tmp_path, vtk=True, figures={})
    # Of hundreds of files the two that list the others are named.
    assert [path.name for path in paths if path.parent == folder] == ["crack.pvd", "dam.pvd"]
    assert len(list(folder.iterdir())) > 100
    write_all(both, tmp_path, figures={})
    assert [path.name for path in folder.iterdir()] == ["notes.vtu"]


def test_without_the_package_for_vtk_nothing_is_written(both, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(InputError) as refused:
        write_all(both, tmp_path / "out", vtk=True)
    assert "meshio" in str(refused.value)
    assert list(tmp_path.iterdir()) == []


def test_the_crack_is_written_with_its_forces_and_statuses(both, typical_written):
    table = pq.read_table(typical_written[0] / "crack.parquet")
    record = both.crack
    frames, _, nodes = record.upper_position.shape
    assert table.num_rows == frames * nodes
    h = both.histories
    force = table["force_across_n"].to_numpy().reshape(frames, nodes)
    assert force[1:].sum(axis=1) == pytest.approx(h["normal_force_n"][1:], rel=1e-9)
    assert table["gap_m"].to_numpy().reshape(frames, nodes)[:, 0] == pytest.approx(h["gap_heel_m"], abs=1e-12)
    status = np.array(table["status"].to_pylist()).reshape(frames, nodes)
    assert {"open", "stick", "slip downstream"} <= set(status.ravel())
    assert np.mean(status != "open", axis=1) == pytest.approx(h["touching"])


@pytest.mark.parametrize(("contactors", "upper", "lower"), [(1, 5, 0), (2, 0, 7), (3, 5, 2), (4, 2, 7), (5, 5, 7)])
def test_statuses_belong_to_the_nodes_that_are_watched(contactors, upper, lower, tmp_path):
    changes = [f"flexible.contactors={contactors}", "flexible.elements_across_below=3", "motion.duration=0.2s"]
    response = flexible(plane_case(HEIGHT, [*FAST, *changes]))
    write_all(response, tmp_path, figures={})
    first = pq.read_table(tmp_path / "crack.parquet").slice(0, 12).to_pydict()
    assert first["side"] == ["upper"] * 5 + ["lower"] * 7
    watched = [status is not None for status in first["status"]]
    assert (sum(watched[:5]), sum(watched[5:])) == (upper, lower)
