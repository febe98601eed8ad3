"""Frames of the flexible model: they agree with each other, with the histories, and with geometry done by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pyarrow.csv as csv
import pytest

from heeltoe import flexible, read_case
from heeltoe.models.flexible.elastic import bonded_state
from heeltoe.models.flexible.history import CrackHistory, crack_table
from shared.shaken import EXAMPLES, shaken


@pytest.fixture(scope="module", params=EXAMPLES)
def response(request):
    return shaken(request.param)


def gap_by_hand(x, z, face):
    """Return the height of a point above a line of straight pieces, None beyond its ends."""
    for (x0, z0), (x1, z1) in zip(face.T, face.T[1:], strict=False):
        if x0 <= x <= x1:
            return z - (z0 + (z1 - z0) * (x - x0) / (x1 - x0))
    return None


def test_crack_positions_are_those_of_the_parts(response):
    record = response.crack
    bodies = record.dam.bodies
    assert len(record.faces) == len(bodies)
    assert np.ptp(record.upper_position[:, 0, 0]) > 0.01
    for part, (face, body) in enumerate(zip(record.faces, bodies, strict=True)):
        start = (body.mesh.nodes[body.mesh.crack] - record.dam.section.heel).T
        for frame in range(len(record.time)):
            moved = record.displacements(frame)[part][body.mesh.crack].T
            assert face[frame] - start == pytest.approx(moved, rel=0.0, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("modes", ["flexible.modes=10", "flexible.elements_across=4"])
def test_crack_positions_are_those_of_the_parts_for_long(name, modes):
    # The kernel carries positions and modes separately; rounding must not drive them apart.
    record = flexible(read_case(EXAMPLES[name], ["flexible.convergence_check=false", modes])).crack
    assert record.time[-1] > 29.9
    for part, (face, body) in enumerate(zip(record.faces, record.dam.bodies, strict=True)):
        start = (body.mesh.nodes[body.mesh.crack] - record.dam.section.heel).T
        moved = record.displacements(-1)[part][body.mesh.crack].T
        assert face[-1] - start == pytest.approx(moved, rel=0.0, abs=1e-9)


def test_the_first_frame_is_the_static_state(response):
    record = response.crack
    upper, lower, force = bonded_state(record.dam)
    assert record.time[0] == 0.0
    for found, static in zip(record.displacements(0), (upper, lower), strict=False):
        assert found.reshape(-1) == pytest.approx(static, rel=0.0, abs=1e-12)
    assert record.forces()[0] == pytest.approx(force.reshape(-1, 2).T)
    assert record.forces()[1:] == pytest.approx(record.force[1:])
    # Nothing was exerted before there was any time.
    assert not record.force[0].any()


def test_forces_add_up_to_the_histories(response):
    along, across = np.moveaxis(response.crack.force.sum(axis=2), 1, 0)
    assert across == pytest.approx(response.histories["normal_force_n"], rel=1e-9, abs=1e-3)
    assert along == pytest.approx(response.histories["friction_force_n"], rel=1e-9, abs=1e-3)


def test_gaps(response):
    record = response.crack
    gaps = record.node_gaps()
    assert record.gaps() == pytest.approx(gaps[0], nan_ok=True)
    if record.lower_position is None:
        assert gaps[0] == pytest.approx(record.upper_position[:, 1])
        return
    assert np.isnan(gaps[0]).any()
    assert np.isnan(gaps[1]).any()
    for frame in range(0, len(record.time), 7):
        upper, lower = (face[frame] for face in record.faces)
        for own, other, sign, found in ((upper, lower, 1.0, gaps[0]), (lower, upper, -1.0, gaps[1])):
            for (x, z), gap in zip(own.T, found[frame], strict=True):
                expected = gap_by_hand(x, z, other)
                if expected is None:
                    assert np.isnan(gap)
                else:
                    assert gap == pytest.approx(sign * expected, rel=0.0, abs=1e-12)


def test_deepest_penetration(response):
    record = response.crack
    depth = -min(np.nanmin(gaps) for gaps in record.node_gaps())
    assert record.deepest_penetration() == max(depth, 0.0)
    apart = replace(record, upper_position=record.upper_position + np.array([[0.0], [1.0]]))
    assert apart.deepest_penetration() == 0.0


@pytest.mark.parametrize("contactors", [1, 2, 3, 4, 5])
def test_statuses_belong_to_their_nodes(contactors):
    run = shaken("height", f"flexible.contactors={contactors}").crack
    record = replace(run, contactors=contactors)
    watched = {1: ("all", ""), 2: ("", "all"), 3: ("all", "ends"), 4: ("ends", "all"), 5: ("all", "all")}[contactors]
    absent = record.status_names().index("absent")
    for own, other, status, which in zip(record.faces, record.faces[::-1], record.node_status(), watched, strict=True):
        nodes = {"all": range(5), "ends": [0, 4], "": []}[which]
        assert (np.flatnonzero((status >= 0).all(axis=0)) == nodes).all()
        assert (status[:, np.setdiff1d(range(5), nodes)] == -1).all()
        # How far inside the ends of the other face; within a millimetre a status, that of the step before, may lag.
        inside = np.minimum(own[:, 0] - other[:, 0, :1], other[:, 0, -1:] - own[:, 0])[:, nodes]
        assert not (status[:, nodes] == absent)[inside > 1e-3].any()
        assert (status[:, nodes] == absent)[inside < -1e-3].all()
        assert not nodes or (inside < -1e-3).any()


def test_statuses_agree_with_gaps(response):
    record = response.crack
    names = record.status_names()
    status, gaps = record.node_status()[0], record.gaps()
    for name in ("stick", "slip downstream", "slip upstream"):
        closed = gaps[status == names.index(name)]
        assert closed.size
        # Contact on velocity level leaves a node that was struck a little inside the other face. A node that sticks
        # right at the end may be beyond it by a rounding error.
        assert np.nanmax(np.abs(closed)) < 1e-4
    assert (status[np.nan_to_num(gaps) > 1e-3] == names.index("open")).all()


def test_open_nodes_get_no_force():
    # On a rigid plane, where a node has no other's share of force; 1 mm cannot close and open between two frames.
    record = shaken("base").crack
    wide = record.gaps() > 1e-3
    open_for_long = wide[1:] & wide[:-1]
    assert open_for_long.sum() > 100
    assert not np.moveaxis(record.force, 1, 2)[1:][open_for_long].any()


def test_statuses_of_other_contactors_are_refused(response):
    record = response.crack
    if record.lower_position is None:
        # On a rigid plane all nodes are watched whatever was chosen.
        assert replace(record, contactors=5).node_status()[0] == pytest.approx(record.status)
        return
    with pytest.raises(ValueError, match="contactors 5 are 10 nodes, the record has 7"):
        replace(record, contactors=5).node_status()


def test_frame_at(response):
    record = response.crack
    assert record.frame_at(-1.0) == 0
    assert record.frame_at(99.0) == len(record.time) - 1
    assert record.time[record.frame_at(1.0)] == pytest.approx(1.0, abs=0.006)


def test_table(response):
    record: CrackHistory = response.crack
    table = crack_table(record)
    sides = ["upper", "lower"][: len(record.faces)]
    assert table.column_names == [
        *("time_s", "node", "x_m", "side", "along_m", "across_m"),
        *("force_along_n", "force_across_n", "gap_m", "status"),
    ]
    assert table.num_rows == len(record.time) * 5 * len(sides)
    rows = iter(table.to_pylist())
    force, gaps, statuses, names = record.forces(), record.node_gaps(), record.node_status(), record.status_names()
    for frame, time in enumerate(record.time):
        for place, side in enumerate(sides):
            mesh = record.dam.bodies[place].mesh
            for node in range(5):
                gap, status = gaps[place][frame, node], statuses[place][frame, node]
                assert next(rows) == {
                    "time_s": time,
                    "node": node,
                    "x_m": mesh.nodes[mesh.crack[node], 0],
                    "side": side,
                    "along_m": record.faces[place][frame, 0, node],
                    "across_m": record.faces[place][frame, 1, node],
                    "force_along_n": force[frame, 0, node] if side == "upper" else None,
                    "force_across_n": force[frame, 1, node] if side == "upper" else None,
                    "gap_m": None if np.isnan(gap) else gap,
                    "status": None if status < 0 else names[status],
                }
    assert (table["gap_m"].null_count > 0) == (len(sides) == 2)
    assert table["status"].null_count == (3 * len(record.time) if len(sides) == 2 else 0)


def test_table_as_text(response, tmp_path):
    table = crack_table(response.crack)
    csv.write_csv(table, tmp_path / "crack.csv")
    options = csv.ConvertOptions(strings_can_be_null=True)
    back = csv.read_csv(tmp_path / "crack.csv", convert_options=options)
    assert back.cast(table.schema).equals(table)
    assert b"nan" not in (tmp_path / "crack.csv").read_bytes().lower()
