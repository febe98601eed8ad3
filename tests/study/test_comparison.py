"""Both models side by side, and everything that a run writes."""

from __future__ import annotations

import json
import sys
from dataclasses import replace

import numpy as np
import pyarrow.parquet as pq
import pytest

from heeltoe import Comparison, InputError, compare, flexible, read_case, rigid
from heeltoe.result.write import json_text
from heeltoe.units.sentences import Sentence
from heeltoe.views.files.write import write_all
from shared.dams import BASE, FAST, HEIGHT


@pytest.fixture
def both(typical_both) -> Comparison:
    return typical_both


def slipping(both: Comparison, block: float, dam: float) -> Comparison:
    """The same with other residual slips [m]."""
    one, other = (
        replace(each, summary={**each.summary, "residual_slip_m": slip})
        for each, slip in ((both.rigid, block), (both.flexible, dam))
    )
    return replace(both, rigid=one, flexible=other)


def test_both_models_meet_the_same_motion(both):
    assert both.ok
    assert both.rigid.motion is both.flexible.motion
    assert both.rigid.residual_slip_m == rigid(read_case(BASE, FAST)).residual_slip_m
    assert both.flexible.residual_slip_m == flexible(read_case(BASE, FAST)).residual_slip_m
    assert set(both.seconds) == {"rigid", "flexible"}
    assert all(value > 0.0 for value in both.seconds.values())


def test_json(both):
    data = json.loads(json_text(both.to_json()))
    assert data["model"] == "both"
    assert data["title"] == "Typical dam cracked at its base"
    assert (data["rigid"]["model"], data["flexible"]["model"]) == ("rigid", "flexible")
    slips = [data[model]["residual_slip_m"] for model in ("flexible", "rigid")]
    assert data["ratio"]["residual_slip_m"] == pytest.approx(slips[0] / slips[1], rel=1e-12)
    # This rigid block does not rock: there is nothing to divide by.
    assert data["rigid"]["rocking_upstream_rad"] == 0.0
    assert data["ratio"]["rocking_upstream_rad"] is None


@pytest.mark.parametrize(
    ("block", "dam", "words"),
    [
        (0.036, 0.218, "slides 6.1 times as far"),
        (0.0, 0.100, "Only the flexible dam slides"),
        (0.034, 0.037, "They agree"),
        (0.1, -0.1, "opposite ways"),
        (0.2, 0.1, "slides only 0.5 times what"),
        (2.0, 0.001, "less than a hundredth"),
        (1e-5, 2e-4, "less than a millimetre"),
    ],
)
def test_what_the_difference_means(both, block, dam, words):
    assert words in slipping(both, block, dam).meaning()


def test_without_a_result_there_is_no_ratio(both):
    failed = replace(both, rigid=replace(both.rigid, outcome="paradox", advice=Sentence("stop")))
    assert not failed.ok
    assert "nothing to compare: no result to trust from the rigid model" in failed.meaning()
    assert set(failed.ratio().values()) == {None}


def test_a_case_without_motion():
    triangle = {"polygon": [["0 m", "0 m"], ["9 m", "0 m"], ["0 m", "9 m"]]}
    with pytest.raises(InputError) as refused:
        compare(read_case({"section": triangle, "crack": {"friction": 1.0}}))
    assert refused.value.code == "motion-missing"


def test_a_state_that_is_not_finite_is_null_in_json(both):
    blown = replace(
        both.flexible,
        outcome="blown up",
        advice=Sentence("x"),
        summary={**both.flexible.summary, "residual_slip_m": np.inf},
    )
    data = json.loads(json_text(replace(both, flexible=blown).to_json()), parse_constant=pytest.fail)
    assert data["flexible"]["residual_slip_m"] is None
    assert data["rigid"]["residual_slip_m"] is not None


def test_files_of_both(typical_written):
    directory, paths = typical_written
    written = {str(path.relative_to(directory)) for path in paths}
    assert written == {str(path.relative_to(directory)) for path in directory.rglob("*") if path.is_file()}
    assert written >= {
        "result.json",
        "comparison.png",
        "rigid/result.json",
        "rigid/events.parquet",
        "rigid/accelerations.png",
        "flexible/result.json",
        "flexible/histories.parquet",
        "flexible/crack.parquet",
        "flexible/crack.svg",
        "flexible/energy.png",
        "flexible/forces.png",
    }
    assert "flexible/events.parquet" not in written
    for place, model in (("", "both"), ("rigid/", "rigid"), ("flexible/", "flexible")):
        assert json.loads((directory / f"{place}result.json").read_text())["model"] == model


@pytest.mark.usefixtures("empty_figures")
def test_what_an_earlier_run_left_does_not_stay(both, tmp_path):
    (tmp_path / "rigid").mkdir()
    mine = [tmp_path / "notes.txt", tmp_path / "rigid" / "result.json"]
    for path in mine:
        path.write_text("mine")
    write_all(both.rigid, tmp_path)
    write_all(both.flexible, tmp_path, suffix=".csv")
    names = {path.name for path in tmp_path.iterdir()}
    assert not names & {"events.parquet", "histories.parquet", "accelerations.png", "accelerations.svg"}
    assert {"histories.csv", "crack.csv", "energy.png"} <= names
    assert [path.read_text() for path in mine] == ["mine", "mine"]


def test_a_failure_leaves_nothing_behind(both, tmp_path, monkeypatch):
    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("heeltoe.views.files.write.write_figures", fail)
    with pytest.raises(InputError, match="No space left") as refused:
        write_all(both, tmp_path)
    assert refused.value.code == "cannot-write"
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(InputError):
        write_all(both, tmp_path / "deep" / "er")
    assert list(tmp_path.iterdir()) == []


def test_without_the_package_for_vtk_nothing_is_written(both, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(InputError) as refused:
        write_all(both.flexible, tmp_path / "out", vtk=True)
    assert "meshio" in str(refused.value)
    assert list(tmp_path.iterdir()) == []


def test_the_crack_is_written_with_its_forces_and_statuses(both, typical_written):
    table = pq.read_table(typical_written[0] / "flexible" / "crack.parquet")
    record = both.flexible.crack
    frames, _, nodes = record.upper_position.shape
    assert table.num_rows == frames * nodes
    h = both.flexible.histories
    force = table["force_across_n"].to_numpy().reshape(frames, nodes)
    assert force[1:].sum(axis=1) == pytest.approx(h["normal_force_n"][1:], rel=1e-9)
    assert table["gap_m"].to_numpy().reshape(frames, nodes)[:, 0] == pytest.approx(h["gap_heel_m"], abs=1e-12)
    status = np.array(table["status"].to_pylist()).reshape(frames, nodes)
    assert {"open", "stick", "slip downstream"} <= set(status.ravel())
    assert np.mean(status != "open", axis=1) == pytest.approx(h["touching"])


@pytest.mark.parametrize(("contactors", "upper", "lower"), [(1, 5, 0), (2, 0, 7), (3, 5, 2), (4, 2, 7), (5, 5, 7)])
def test_statuses_belong_to_the_nodes_that_are_watched(contactors, upper, lower, tmp_path):
    changes = [f"flexible.contactors={contactors}", "flexible.elements_across_below=3", "motion.duration=0.2s"]
    response = flexible(read_case(HEIGHT, [*FAST, *changes]))
    write_all(response, tmp_path, figures=False)
    first = pq.read_table(tmp_path / "crack.parquet").slice(0, 12).to_pydict()
    assert first["side"] == ["upper"] * 5 + ["lower"] * 7
    watched = [status is not None for status in first["status"]]
    assert (sum(watched[:5]), sum(watched[5:])) == (upper, lower)
