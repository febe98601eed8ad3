"""VTK files: read back they are the history; they are written whole or not at all."""

from __future__ import annotations

import sys
from dataclasses import replace
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest

from heeltoe import InputError
from heeltoe.models.flexible.body.elastic import principal
from heeltoe.views.files.vtk import write_vtk_series
from shared.shaken import EXAMPLES, shaken


@pytest.fixture(scope="module", params=EXAMPLES)
def history(request):
    return shaken(request.param, output_step=0.005).crack


@pytest.fixture(scope="module")
def series(history, tmp_path_factory):
    """Frames and what was read back of them: grids of the dam and of the crack."""
    directory = tmp_path_factory.mktemp("vtk") / "new" / "series"
    frames = [0, 3, 100, 250, len(history.time) - 1]
    assert write_vtk_series(history, directory, frames=frames) == directory / "dam.pvd"
    return frames, read(directory, "dam"), read(directory, "crack")


def listed(path):
    """Return times and files of a collection."""
    root = ElementTree.parse(path).getroot()
    assert (root.tag, root.get("type")) == ("VTKFile", "Collection")
    sets = root.findall("Collection/DataSet")
    return [float(item.get("timestep")) for item in sets], [path.parent / item.get("file") for item in sets]


def read(directory, name):
    return [meshio.read(path) for path in listed(directory / f"{name}.pvd")[1]]


def flat(vectors):
    """Return vectors of space that lie in the plane as those of the plane."""
    assert vectors.shape[1] == 3
    assert not vectors[:, 2].any()
    return vectors[:, :2]


def test_grids_are_the_meshes(history, series):
    meshes = [body.mesh for body in history.dam.bodies]
    for grid in series[1]:
        assert flat(grid.points) == pytest.approx(np.vstack([mesh.nodes for mesh in meshes]), abs=0.0)
        (block,) = grid.cells
        assert block.type == "quad8"
        # Corners counter-clockwise, each midside node between its two corners, as VTK wants them.
        corners = flat(grid.points)[block.data[:, :4]]
        sides = np.roll(corners, -1, axis=1) - corners
        following = np.roll(sides, -1, axis=1)
        assert (sides[..., 0] * following[..., 1] > sides[..., 1] * following[..., 0]).all()
        middles = flat(grid.points)[block.data[:, 4:]]
        assert middles == pytest.approx(corners + sides / 2.0, abs=1e-9)
        places = grid.points[block.data].reshape(len(block.data), 8, 3)
        for part, mesh in enumerate(meshes):
            own = grid.cell_data["part"][0] == part
            assert flat(places[own].reshape(-1, 3)) == pytest.approx(mesh.nodes[mesh.elements].reshape(-1, 2), abs=0.0)
        assert np.unique(grid.cell_data["part"][0]).tolist() == list(range(len(meshes)))


def test_grids_hold_the_state(history, series):
    for frame, grid in zip(*series[:2], strict=True):
        data = grid.point_data
        assert set(data) == {"displacement", "sxx", "szz", "sxz", "principal_major", "principal_minor"}
        assert np.array_equal(flat(data["displacement"]), np.vstack(history.displacements(frame)))
        stress = np.vstack(history.stresses(frame))
        assert np.array_equal(np.column_stack([data["sxx"], data["szz"], data["sxz"]]), stress)
        major, minor, _ = principal(stress)
        assert np.array_equal(data["principal_major"], major)
        assert np.array_equal(data["principal_minor"], minor)
        # The trace does not depend on the axes, nor does the determinant.
        assert major + minor == pytest.approx(stress[:, 0] + stress[:, 1], rel=1e-9, abs=1.0)


def test_crack(history, series):
    counts = [face.shape[2] for face in history.faces]
    for frame, grid in zip(series[0], series[2], strict=True):
        vertices, lines = grid.cells
        assert (vertices.type, lines.type) == ("vertex", "line")
        assert vertices.data.tolist() == [[node] for node in range(sum(counts))]
        # One line of pieces for each face, from the heel on.
        assert len(lines.data) == sum(counts) - len(counts)
        along = grid.points[lines.data, 0]
        assert (along[:, 1] > along[:, 0]).all()
        parts = grid.cell_data["part"]
        assert parts[0].tolist() == np.repeat(range(len(counts)), counts).tolist()
        assert np.array_equal(parts[0][lines.data[:, 0]], parts[1])
        assert np.array_equal(parts[0][lines.data[:, 1]], parts[1])
        data = grid.point_data
        now = flat(grid.points + data["displacement"]) - history.dam.section.heel
        assert now == pytest.approx(np.hstack([face[frame] for face in history.faces]).T, rel=0.0, abs=1e-12)
        force = flat(data["force"])
        assert np.array_equal(force[: counts[0]], history.forces()[frame].T)
        assert not force[counts[0] :].any()
        assert np.array_equal(data["gap"], np.hstack([gap[frame] for gap in history.node_gaps()]), equal_nan=True)
        assert np.array_equal(data["status"], np.hstack([status[frame] for status in history.node_status()]))
        assert data["status"].dtype.kind == "i"


def test_both_series_deform_alike(history, series):
    nodes = np.concatenate(
        [
            body.mesh.crack + first
            for body, first in zip(history.dam.bodies, (0, len(history.dam.bodies[0].mesh.nodes)), strict=False)
        ]
    )
    for dam, crack in zip(*series[1:], strict=True):
        deformed = [grid.points + grid.point_data["displacement"] for grid in (dam, crack)]
        assert deformed[1] == pytest.approx(deformed[0][nodes], rel=0.0, abs=1e-9)


def test_about_two_hundred_frames_without_a_choice(history, tmp_path):
    assert len(history.time) > 300
    write_vtk_series(history, tmp_path)
    for name in ("dam", "crack"):
        times, files = listed(tmp_path / f"{name}.pvd")
        assert len(times) == len(set(files)) == 200
        assert times[0] == 0.0
        assert times[-1] == history.time[-1]
        assert set(times) <= set(history.time)
        assert np.ptp(np.diff(times)) < 1.01 * history.time[1]
        assert sorted(files) == files == sorted(tmp_path.glob(f"{name}-*.vtu"))
    # The bound of the docstring, with room for what grids take whatever their size.
    nodes = sum(len(body.mesh.nodes) for body in history.dam.bodies)
    assert sum(path.stat().st_size for path in tmp_path.iterdir()) < 200 * (100 * nodes + 6000)


def test_all_frames_of_a_short_run(history, tmp_path):
    first = replace(
        history,
        time=history.time[:1],
        upper_position=history.upper_position[:1],
        lower_position=None if history.lower_position is None else history.lower_position[:1],
        force=history.force[:1],
        status=history.status[:1],
        modes=tuple(mode[:1] for mode in history.modes),
    )
    write_vtk_series(first, tmp_path)
    assert sorted(path.name for path in tmp_path.glob("[!.]*")) == ["crack-0.vtu", "crack.pvd", "dam-0.vtu", "dam.pvd"]


def test_chosen_frames_come_once_and_in_order(history, tmp_path):
    write_vtk_series(history, tmp_path, frames=[-1, 7, 0, 7])
    times, files = listed(tmp_path / "dam.pvd")
    assert times == [history.time[0], history.time[7], history.time[-1]]
    assert files[1].name == "dam-007.vtu"
    with pytest.raises(IndexError):
        write_vtk_series(history, tmp_path, frames=[len(history.time)])


def test_an_earlier_series_is_replaced(history, tmp_path):
    (tmp_path / "dam-notes.txt").write_text("mine")
    write_vtk_series(history, tmp_path, frames=range(5))
    write_vtk_series(history, tmp_path, frames=[0, 9])
    assert sorted(path.name for path in tmp_path.glob("[!.]*")) == [
        *("crack-000.vtu", "crack-009.vtu", "crack.pvd"),
        *("dam-000.vtu", "dam-009.vtu", "dam-notes.txt", "dam.pvd"),
    ]


def test_a_failure_leaves_what_was_there(history, tmp_path, monkeypatch):
    write_vtk_series(history, tmp_path, frames=[0, 1])
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    plain, calls = meshio.write, []

    def full(path, *rest, **options):
        calls.append(path)
        if len(calls) == 4:
            raise OSError(28, "No space left on device")
        plain(path, *rest, **options)

    monkeypatch.setattr(meshio, "write", full)
    with pytest.raises(InputError, match=r"cannot be written \(No space left on device\); give a place where") as error:
        write_vtk_series(history, tmp_path, frames=[3, 4, 5])
    assert error.value.code == "cannot-write"
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_no_place_to_write(history, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match=r"directory: .*file cannot be written \(.*\)") as error:
        write_vtk_series(history, tmp_path / "file")
    assert error.value.code == "cannot-write"
    with pytest.raises(InputError, match="cannot be written"):
        write_vtk_series(history, tmp_path / "file" / "vtk")


def test_missing_package(history, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(InputError, match=r"pip install meshio"):
        write_vtk_series(history, tmp_path / "vtk")
    assert not (tmp_path / "vtk").exists()
