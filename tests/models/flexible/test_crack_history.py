"""Frames of the flexible model: they agree with each other, with the histories, and with geometry done by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pyarrow.csv as csv
import pytest

from heeltoe import flexible
from heeltoe.models.flexible.body.elastic import dofs
from heeltoe.models.flexible.result.history import CrackHistory, crack_table
from shared.dams import plane_case
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
    history = response.crack
    bodies = history.dam.bodies
    assert len(history.faces) == len(bodies)
    assert np.ptp(history.upper_position[:, 0, 0]) > 0.01
    for part, (face, body) in enumerate(zip(history.faces, bodies, strict=True)):
        start = (body.mesh.nodes[body.mesh.crack] - history.dam.section.heel).T
        for frame in range(len(history.time)):
            moved = history.displacements(frame)[part][body.mesh.crack].T
            assert face[frame] - start == pytest.approx(moved, rel=0.0, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("modes", ["flexible.modes=10", "flexible.elements_across=4"])
def test_crack_positions_are_those_of_the_parts_for_long(name, modes):
    # The kernel carries positions and modes separately; rounding must not drive them apart.
    history = flexible(plane_case(EXAMPLES[name], ["flexible.evidence=none", modes])).crack
    assert history.time[-1] > 29.9
    for part, (face, body) in enumerate(zip(history.faces, history.dam.bodies, strict=True)):
        start = (body.mesh.nodes[body.mesh.crack] - history.dam.section.heel).T
        moved = history.displacements(-1)[part][body.mesh.crack].T
        assert face[-1] - start == pytest.approx(moved, rel=0.0, abs=1e-9)


def test_the_last_frame_is_the_end_of_the_run():
    # Two seconds are no whole number of frames 0.03 s apart.
    response = shaken("base", "flexible.evidence=none", output_step=0.03)
    time = response.crack.time
    assert time[-1] == response.end_time_s == response.histories["time_s"][-1]
    assert 0.0 < time[-1] - time[-2] < time[1]
    assert response.histories["slip_m"][-1] == response.residual_slip_m
    assert response.crack.forces().shape[0] == time.size


def test_the_first_frame_is_the_static_state(response):
    history = response.crack
    assert history.time[0] == 0.0
    force = history.forces()[0]
    for place, (result, body) in enumerate(zip(history.displacements(0), history.dam.bodies, strict=True)):
        # The forces of the crack and the loads stretch the part so far.
        total = body.load.copy()
        crack = dofs(body.mesh.crack)
        if place == 0:
            total[crack] += force.T.reshape(-1)
        held = [*dofs(body.mesh.fixed), *(crack if place == 1 else ())]
        inner = np.setdiff1d(np.arange(total.size), np.array(held, dtype=int))
        strain = body.stiffness @ result.reshape(-1)
        assert strain[inner] == pytest.approx(total[inner], rel=0.0, abs=1e-6 * np.abs(force).max())
    assert history.forces()[1:] == pytest.approx(history.force[1:])
    # Nothing was exerted before there was any time.
    assert not history.force[0].any()


def test_forces_add_up_to_the_histories(response):
    along, across = np.moveaxis(response.crack.force.sum(axis=2), 1, 0)
    assert across == pytest.approx(response.histories["normal_force_n"], rel=1e-9, abs=1e-3)
    assert along == pytest.approx(response.histories["friction_force_n"], rel=1e-9, abs=1e-3)


def test_gaps(response):
    history = response.crack
    gaps = history.node_gaps()
    assert history.gaps() == pytest.approx(gaps[0], nan_ok=True)
    if history.lower_position is None:
        assert gaps[0] == pytest.approx(history.upper_position[:, 1])
        return
    assert np.isnan(gaps[0]).any()
    assert np.isnan(gaps[1]).any()
    for frame in range(0, len(history.time), 7):
        upper, lower = (face[frame] for face in history.faces)
        for own, other, sign, result in ((upper, lower, 1.0, gaps[0]), (lower, upper, -1.0, gaps[1])):
            for (x, z), gap in zip(own.T, result[frame], strict=True):
                expected = gap_by_hand(x, z, other)
                if expected is None:
                    assert np.isnan(gap)
                else:
                    assert gap == pytest.approx(sign * expected, rel=0.0, abs=1e-12)


def test_deepest_penetration(response):
    history = response.crack
    depth = -min(np.nanmin(gaps) for gaps in history.node_gaps())
    assert history.deepest_penetration() == max(depth, 0.0)
    apart = replace(history, upper_position=history.upper_position + np.array([[0.0], [1.0]]))
    assert apart.deepest_penetration() == 0.0


@pytest.mark.parametrize("contactors", [1, 2, 3, 4, 5])
def test_statuses_belong_to_their_nodes(contactors):
    run = shaken("height", f"flexible.contactors={contactors}").crack
    history = replace(run, contactors=contactors)
    watched = {1: ("all", ""), 2: ("", "all"), 3: ("all", "ends"), 4: ("ends", "all"), 5: ("all", "all")}[contactors]
    absent = history.status_names().index("absent")
    for own, other, status, which in zip(
        history.faces, history.faces[::-1], history.node_status(), watched, strict=True
    ):
        nodes = {"all": range(5), "ends": [0, 4], "": []}[which]
        assert (np.flatnonzero((status >= 0).all(axis=0)) == nodes).all()
        assert (status[:, np.setdiff1d(range(5), nodes)] == -1).all()
        # How far inside the ends of the other face; within a millimetre a status, that of the step before, may lag.
        inside = np.minimum(own[:, 0] - other[:, 0, :1], other[:, 0, -1:] - own[:, 0])[:, nodes]
        assert not (status[:, nodes] == absent)[inside > 1e-3].any()
        assert (status[:, nodes] == absent)[inside < -1e-3].all()
        assert not nodes or (inside < -1e-3).any()


def test_statuses_agree_with_gaps(response):
    history = response.crack
    names = history.status_names()
    status, gaps = history.node_status()[0], history.gaps()
    way = response.summary["time_step_s"] * response.summary["largest_impact_velocity_m_s"]
    for name in ("stick", "slip downstream", "slip upstream"):
        closed = gaps[status == names.index(name)]
        assert closed.size
        # Contact on velocity level leaves a node within a step's way of where it struck. A node that sticks right at
        # the end may be beyond it by a rounding error.
        assert np.nanmax(np.abs(closed)) <= way < 1e-3
    assert (status[np.nan_to_num(gaps) > 1e-3] == names.index("open")).all()


def test_open_nodes_get_no_force():
    # On a rigid plane, where a node has no other's share of force; 1 mm cannot close and open between two frames that
    # are 1 ms apart.
    history = shaken("base", output_step=1e-3).crack
    wide = history.gaps() > 1e-3
    open_for_long = wide[1:] & wide[:-1]
    assert open_for_long.sum() > 100
    assert not np.moveaxis(history.force, 1, 2)[1:][open_for_long].any()


def test_statuses_of_other_contactors_are_refused(response):
    history = response.crack
    if history.lower_position is None:
        # On a rigid plane all nodes are watched whatever was chosen.
        assert replace(history, contactors=5).node_status()[0] == pytest.approx(history.status)
        return
    with pytest.raises(ValueError, match="contactors 5 are 10 nodes, the history has 7"):
        replace(history, contactors=5).node_status()


def test_frame_at(response):
    history = response.crack
    assert history.frame_at(-1.0) == 0
    assert history.frame_at(99.0) == len(history.time) - 1
    assert history.time[history.frame_at(1.0)] == pytest.approx(1.0, abs=0.006)


def test_table(response):
    history: CrackHistory = response.crack
    table = crack_table(history)
    sides = ["upper", "lower"][: len(history.faces)]
    assert table.column_names == [
        *("time_s", "node", "x_m", "side", "along_m", "across_m"),
        *("force_along_n", "force_across_n", "gap_m", "status"),
    ]
    assert table.num_rows == len(history.time) * 5 * len(sides)
    rows = iter(table.to_pylist())
    force, gaps, statuses, names = history.forces(), history.node_gaps(), history.node_status(), history.status_names()
    for frame, time in enumerate(history.time):
        for place, side in enumerate(sides):
            mesh = history.dam.bodies[place].mesh
            for node in range(5):
                gap, status = gaps[place][frame, node], statuses[place][frame, node]
                assert next(rows) == {
                    "time_s": time,
                    "node": node,
                    "x_m": mesh.nodes[mesh.crack[node], 0],
                    "side": side,
                    "along_m": history.faces[place][frame, 0, node],
                    "across_m": history.faces[place][frame, 1, node],
                    "force_along_n": force[frame, 0, node] if side == "upper" else None,
                    "force_across_n": force[frame, 1, node] if side == "upper" else None,
                    "gap_m": None if np.isnan(gap) else gap,
                    "status": None if status < 0 else names[status],
                }
    assert (table["gap_m"].null_count > 0) == (len(sides) == 2)
    assert table["status"].null_count == (3 * len(history.time) if len(sides) == 2 else 0)


def test_table_as_text(response, tmp_path):
    table = crack_table(response.crack)
    csv.write_csv(table, tmp_path / "crack.csv")
    options = csv.ConvertOptions(strings_can_be_null=True)
    back = csv.read_csv(tmp_path / "crack.csv", convert_options=options)
    assert back.cast(table.schema).equals(table)
    assert b"nan" not in (tmp_path / "crack.csv").read_bytes().lower()
