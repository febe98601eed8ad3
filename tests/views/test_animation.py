"""Animations: what they show is what the response says."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shapely

from heeltoe import run
from heeltoe.case.at_crack import anchor_line
from heeltoe.case.dam import Reservoir
from heeltoe.result.histories import Histories
from heeltoe.views.animation import look
from heeltoe.views.animation.bodies import ACCURACY, Moments, rigid_parts
from heeltoe.views.animation.frames import STATUSES, automatic, build_scene, round_below, shaken_sign
from heeltoe.views.animation.page import page_data
from heeltoe.views.animation.picture import arrow_outlines, shore_of
from shared.dams import example
from shared.scenes import SMALL

BOTH = pytest.mark.parametrize("pair", ["rigid", "flexible"], indirect=True)


# What is shown


def test_moments_between_samples_are_found():
    moments = Moments.of(np.array([0.0, 1.0, 3.0]), np.array([0.0, 0.25, 2.0, 2.5, 3.0]))
    assert moments.between(np.array([0.0, 10.0, 30.0])) == pytest.approx([0.0, 2.5, 20.0, 25.0, 30.0])
    assert moments.nearest.tolist() == [0, 0, 2, 2, 2]


def test_a_block_keeps_slip_and_gaps_of_its_corners(block):
    case, response = block
    histories = response.histories
    scene = build_scene(case, response, histories["time_s"], 50.0)
    upper = scene.parts[0]
    heel, toe = upper.points[upper.crack]
    assert max(histories["gap_heel_m"].max(), histories["gap_toe_m"].max()) > 1e-4
    for frame in range(0, len(scene.times), 7):
        drawn = (upper.drawn(frame, 50.0)[upper.crack] - [heel, toe]) / 50.0
        assert drawn[0, 1] == pytest.approx(histories["gap_heel_m"][frame], abs=1e-12)
        assert drawn[1, 1] == pytest.approx(histories["gap_toe_m"][frame], abs=1e-12)
        standing = 0 if histories["gap_heel_m"][frame] <= histories["gap_toe_m"][frame] else 1
        assert drawn[standing, 0] == pytest.approx(histories["slip_m"][frame], abs=1e-12)


@pytest.mark.parametrize("angle", [-2.0, -1.2, 0.7, 1.5])
def test_an_overturned_block_keeps_its_shape_and_stands_on_its_corner(block, angle):
    case, response = block
    count, width = len(response.histories["time_s"]), response.crack_width_m
    rise = abs(np.sin(angle)) * width
    made = {
        "slip_m": np.linspace(0.0, 0.3, count),
        "rotation_rad": np.full(count, angle),
        "gap_heel_m": np.full(count, rise if angle < 0.0 else 0.0),
        "gap_toe_m": np.full(count, rise if angle > 0.0 else 0.0),
    }
    tilted = replace(response, outcome="overturned").with_crack(histories={**response.histories, **made})
    scene = build_scene(case, tilted, response.histories["time_s"], None)
    assert scene.exaggeration == 1.0
    assert scene.subtitle.endswith("; rigid model; overturned")
    assert look.exaggeration_text(scene.exaggeration) == "displacements drawn to scale"
    upper = scene.parts[0]
    drawn = upper.drawn(count - 1, 1.0)
    # A rotation of the corners about the one it stands on, moved along by the slip.
    corner = upper.points[0 if angle > 0.0 else 1]
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    assert drawn == pytest.approx((upper.points - corner) @ turn.T + corner + [0.3, 0.0], abs=1e-9)


def test_a_block_is_carried_by_all_blocks_below_it():
    case = example("two-cracks").with_({"further_cracks": [{"elevation": "50 m"}, {"elevation": "90 m"}]})
    slips = (0.01, 0.2, 3.0)
    still = dict.fromkeys(("gap_heel_m", "gap_toe_m", "rotation_rad"), np.zeros(2))
    histories = [Histories({**still, "slip_m": np.array([0.0, slip])}) for slip in slips]
    blocks = rigid_parts(case, histories, Moments.of(np.arange(2.0), np.arange(2.0)))
    assert len(blocks) == 3
    areas = []
    for place, part in enumerate(blocks):
        moved = part.drawn(1, 1.0) - part.points
        assert np.hypot(*moved.T) == pytest.approx(sum(slips[place:]))
        areas.append(shapely.Polygon(part.points[part.outline]).area)
    assert sum(areas) == pytest.approx(case.outline.area)


def test_an_elastic_dam_moves_as_its_record_says(elastic):
    case, response = elastic
    record = response.crack
    scene = build_scene(case, response, record.time, 10.0)
    largest = max(
        np.abs(displacement).max() for k in range(len(record.time)) for displacement in record.displacements(k)
    )
    assert scene.parts[0].amplitudes.shape[1] < record.modes[0].shape[1]
    for frame in range(0, len(record.time), 9):
        for part, body, moved in zip(scene.parts, record.dam.bodies, record.displacements(frame), strict=True):
            crack = (part.drawn(frame, 10.0) - part.points)[part.crack] / 10.0
            assert crack == pytest.approx(moved[body.mesh.crack], abs=1.1 * ACCURACY * largest)


def test_outlines_go_round_the_parts(block, elastic):
    inclined = example("typical-height", *SMALL, "crack.inclination=10 deg")
    for case, response in (block, elastic, (inclined, block[1])):
        scene = build_scene(case, response, np.array([0.0]), 1.0)
        areas = []
        for part in scene.parts:
            x, z = part.points[part.outline].T
            areas.append(0.5 * float(np.sum(x * np.roll(z, -1) - np.roll(x, -1) * z)))
            # No slivers: no two sides double back on each other.
            sides = np.diff(part.points[[*part.outline, *part.outline[:2]]], axis=0)
            sides /= np.hypot(*sides.T)[:, None]
            assert np.sum(sides[1:] * sides[:-1], axis=1).min() > -0.99
        # Counter-clockwise, together as large as the section.
        assert min(areas) > 0.0
        assert areas[0] == pytest.approx(case.cut.area)
        assert sum(areas) == pytest.approx(case.outline.area)
        upper, lower = scene.parts
        assert upper.points[upper.upstream[0]] == pytest.approx(case.cut.heel)
        assert upper.points[upper.downstream[0]] == pytest.approx(case.cut.toe)
        assert lower.points[lower.upstream[-1]] == pytest.approx(case.cut.heel)
        assert lower.points[lower.downstream[-1]] == pytest.approx(case.cut.toe)
        assert lower.points[lower.upstream[0], 1] == lower.points[lower.downstream[0], 1] == scene.base


def test_parts_do_not_visibly_run_into_each_other(elastic):
    case, response = elastic
    scene = build_scene(case, response, response.crack.time, None)
    bottom, top = scene.views[-1][2:]
    assert scene.exaggeration >= 2.0
    for frame in range(len(scene.times)):
        upper, lower = (part.drawn(frame, scene.exaggeration)[part.crack] for part in scene.parts)
        over = (upper[:, 0] >= lower[0, 0]) & (upper[:, 0] <= lower[-1, 0])
        gaps = upper[over, 1] - np.interp(upper[over, 0], lower[:, 0], lower[:, 1])
        # Three pixels of a picture of 600.
        assert gaps.min(initial=0.0) > -0.005 * (top - bottom)


def test_forces_of_a_block_add_up_to_the_histories(block):
    case, response = block
    histories = response.histories
    scene = build_scene(case, response, histories["time_s"], None)
    assert scene.force_unit == "MN/m"
    total = 1e6 * scene.forces.sum(axis=1)
    normal = histories["normal_force_heel_n"] + histories["normal_force_toe_n"]
    held = normal > 0.0
    assert total[:, 1] == pytest.approx(normal)
    assert total[held, 0] == pytest.approx(histories["friction_force_n"][held])


def test_stresses_of_an_elastic_crack_add_up_to_the_forces(elastic):
    case, response = elastic
    record = response.crack
    scene = build_scene(case, response, record.time, None)
    assert scene.force_unit == "MPa"
    # Simpson's rule by hand: two elements of half the crack each.
    lengths = record.dam.section.crack_width / 12.0 * np.array([1.0, 4.0, 2.0, 4.0, 1.0])
    for frame in (0, 30, -1):
        forces = 1e6 * scene.forces[frame] * lengths[:, None]
        assert forces == pytest.approx(record.forces()[frame].T, rel=1e-9, abs=1e-3)


def test_points_of_the_crack_say_what_they_do(block, elastic):
    case, response = block
    scene = build_scene(case, response, response.histories["time_s"], None)
    names = np.array(STATUSES)[scene.status]
    for frame, mode in enumerate(response.mode):
        corners = names[frame]
        if mode == "drift":
            assert (corners == "open").all()
        if mode == "rest":
            assert (corners == "stick").all()
        if mode.startswith("rock on heel"):
            assert corners.tolist() == ["stick", "open"]
    case, response = elastic
    scene = build_scene(case, response, response.crack.time, None)
    known = response.crack.status_names()
    watched = response.crack.node_status()[0]
    for k in np.ndindex(scene.status.shape):
        expected = known[watched[k]] if watched[k] >= 0 else "absent"
        assert (STATUSES[scene.status[k]] if scene.status[k] >= 0 else "absent") == expected


@pytest.mark.parametrize(("value", "expected"), [(1.0, 1.0), (1.99, 1.0), (2.0, 2.0), (49.0, 20.0), (0.06, 0.05)])
def test_round_numbers(value, expected):
    assert round_below(value) == pytest.approx(expected)


def test_the_exaggeration_fits_dam_and_crack():
    dam = SimpleNamespace(crest_elevation=100.0, base_elevation=0.0, crack_width=80.0)
    assert automatic(0.1, dam) == 50.0  # 8 m of 100 m are 80 times 0.1 m
    assert automatic(0.1, SimpleNamespace(**{**vars(dam), "crack_width": 8.0})) == 20.0
    assert automatic(30.0, dam) == 1.0
    assert automatic(0.0, dam) == 1.0


def test_water_above_the_crest_is_in_the_picture_and_goes_on_to_its_far_edge(block):
    case, response = block
    section = case.cut
    deep = 1.1 * (section.crest_elevation - section.base_elevation)
    case = case.model_copy(update={"reservoir": Reservoir.model_validate({"depth": f"{deep} m"})})
    scene = build_scene(case, response, response.histories["time_s"][:1], None)
    assert all(top > scene.water for *_, top in scene.views)
    upper = scene.parts[0]
    face, back = (upper.points[side] for side in (upper.upstream, upper.downstream))
    shore, end = shore_of(face, back[-1], scene.water)
    assert end == back[-1, 0]
    assert shore[-1].tolist() == [end, scene.water]
    assert shore_of(face, back[-1], face[-1, 1] - 1.0)[0] is face


def test_arrows_point_where_the_force_goes():
    outline = arrow_outlines(np.array([[5.0, 1.0], [0.0, 0.0]]), np.array([[0.0, 2.0], [0.0, 0.0]]), 0.1)
    # One arrow of eight corners; the force of zero has none.
    assert len(outline.vertices) == 8
    assert outline.vertices[3] == pytest.approx([5.0, 1.0])
    assert outline.vertices[:, 1].min() == pytest.approx(-1.0)
    assert len(arrow_outlines(np.zeros((1, 2)), np.zeros((1, 2)), 0.1).vertices) == 0


# The right ends are those of the drawing of the section: `anchor_line`; the head goes with the part above the crack.
def test_anchors_are_drawn_and_their_heads_move():
    case = example("anchored", "motion.duration=4s", "analysis.silence=0s")
    response = run(case, "rigid")
    scene = build_scene(case, response, response.histories["time_s"], 50.0)
    assert len(scene.anchors) == len(case.anchors) == 2
    rest = [part.points for part in scene.parts]
    now = [part.drawn(len(scene.times) - 1, 50.0) for part in scene.parts]
    for line, anchor in zip(scene.anchors, case.anchors, strict=True):
        head, foot = anchor_line(anchor, case.cut, 0.22 * (case.cut.crest_elevation - case.cut.base_elevation))
        assert line.drawn(rest, rest) == pytest.approx(np.array([foot, head]))
        moved = line.drawn(now, rest) - line.drawn(rest, rest)
        assert moved[0] == pytest.approx([0.0, 0.0])
        # The block slides along its crack and has not turned in the end.
        slid = 50.0 * abs(response.residual_slip_m)
        assert np.hypot(*moved[1]) == pytest.approx(slid, rel=1e-6)
    assert [list(line["foot"]) for line in page_data(scene, 1.0)["anchors"]] == [list(a.foot) for a in scene.anchors]


def test_the_subtitle_says_which_way_round_the_motion_is():
    case = example("typical-base", "motion.duration=3s", "analysis.silence=0s")
    assert "elcentro-1940-180-nga reversed, peak" in shown_subtitle(case.with_("motion.sign=reversed"))
    assert "elcentro-1940-180-nga as recorded, peak" in shown_subtitle(case.with_("motion.sign=recorded"))
    response = run(case, "rigid")
    worse = max(response.signs, key=lambda sign: abs(sign.residual_slip_m)).sign
    words = {"recorded": "as recorded", "reversed": "reversed"}[worse]
    assert f"elcentro-1940-180-nga {words}, peak" in shown_subtitle(case)
    assert shaken_sign(response) == f"the motion {words}, the worse of both signs"


def shown_subtitle(case):
    response = run(case, "rigid")
    return build_scene(case, response, response.histories["time_s"], 1.0).subtitle
