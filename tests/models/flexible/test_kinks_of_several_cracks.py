"""Several cracks that are not straight: their lines, each alone where the other is bonded, mirror, and what is told."""

from __future__ import annotations

import copy

import numpy as np
import pytest

from heeltoe import InputError, flexible, rigid
from heeltoe.geometry.axes import places
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from shared.dams import plane_case
from shared.two_cracks import DAM, bonded, shaken

STEP, TOOTH = [["20 m", "0 m"], ["23 m", "1.5 m"]], [["2 m", "-0.4 m"], ["4 m", "0.3 m"]]


def dam(lower=STEP, upper=TOOTH, **blocks):
    """Return the dam with a crack at a height and one at its neck, both with corners."""
    fields = copy.deepcopy(DAM) | {
        "crack": {"elevation": "20 m", "friction": 0.7, "kinks": lower},
        "further_cracks": [{"elevation": "90 m", "friction": 0.8, "kinks": upper}],
    }
    return plane_case(fields | blocks)


def test_both_faces_of_each_crack_follow_its_line():
    case = dam()
    built = build_flexible_dam(case)
    for place, alone in enumerate(case.single_crack_cases):
        upper, lower = built.bodies[place].mesh, built.bodies[place + 1].mesh
        faces = upper.nodes[upper.faces[-1]], lower.nodes[lower.faces[0]]
        np.testing.assert_allclose(*faces, rtol=0.0, atol=1e-9)
        line = places(faces[0], alone.cut)
        corners = np.array([(0.0, 0.0), *alone.crack.kinks, (alone.cut.crack_width, 0.0)])
        np.testing.assert_allclose(line[:, 1], np.interp(line[:, 0], *corners.T), rtol=0.0, atol=1e-9)
        for corner in corners:
            assert np.hypot(*(line - corner).T).min() < 1e-9
    total = sum(body.loads["weight"].sum() for body in built.bodies)
    assert total == pytest.approx(-case.concrete.density * 9.80665 * case.outline.area, rel=1e-9)


def test_kinks_of_no_height_are_none():
    flat = dam(lower=[["20 m", "0 m"]], upper=[["2 m", "0 m"]])
    for one, other in zip(shaken(flat).all_frames, shaken(dam(lower=[], upper=[])).all_frames, strict=True):
        assert one.slip.tobytes() == other.slip.tobytes()


def test_the_neck_alone_where_the_other_crack_is_bonded():
    # The part below is drawn over to the other crack's line, so that its mesh is another one than the whole dam's.
    case = dam(lower=[])
    two, alone = shaken(bonded(case, 20.0)), shaken(case.single_crack_cases[0])
    largest = np.abs(alone.frames.slip).max()
    assert largest > 1e-3
    assert np.abs(two.all_frames[1].slip).max() < 1e-8
    # Rows of elements lie elsewhere below.
    assert two.all_frames[0].slip == pytest.approx(alone.frames.slip, abs=0.1 * largest)


def test_contact_is_met_and_the_ledger_closes():
    run = shaken(dam(flexible={"elements_across": 4, "evidence": "none"}))
    for summary in run.summaries:
        assert summary.contact_residual < 1e-9
        assert summary.energy_residual < 1e-12
        assert summary.energy_gained < 1e-9 * summary.energy_turnover
    straight = shaken(dam([], [], flexible={"elements_across": 4, "evidence": "none"}))
    assert abs(run.summaries[1].slip) < abs(straight.summaries[1].slip)


def test_a_mirrored_dam_slides_the_other_way():
    case = dam(flexible={"elements_across": 4, "evidence": "none"})
    widths = [single_crack_case.cut.crack_width for single_crack_case in case.single_crack_cases]
    polygon = [[f"{-x!r} m", f"{z!r} m"] for x, z in np.array(case.section.vertices()).tolist()[::-1]]

    def turned(kinks, width):
        return [[f"{width - x!r} m", f"{z!r} m"] for x, z in kinks[::-1]]

    image = case.with_(
        {
            "section": {**dict.fromkeys(case.section.model_fields_set), "polygon": polygon},
            "crack.kinks": turned(case.crack.kinks, widths[1]),
            "further_cracks[0].kinks": turned(case.further_cracks[0].kinks, widths[0]),
            "reservoir": None,
            "tailwater": {"depth": "100 m", "compressible": False},
            "motion.reverse": True,
        }
    )
    for one, other in zip(shaken(case).all_frames, shaken(image).all_frames, strict=True):
        assert one.slip == pytest.approx(-other.slip, abs=1e-6)


def test_laws_and_anchors_go_with_them():
    weak = {"name": "slip weakening", "peak_friction": 0.7, "residual_friction": 0.5, "slip": "20 mm"}
    case = dam(flexible={"elements_across": 4, "evidence": "none"}).with_({"crack.law": weak})
    anchor = {"head_x": "3 m", "head_elevation": "99 m", "foot_x": "6 m", "foot_elevation": "5 m"}
    bare, held = flexible(case), flexible(case.with_({"anchors": [anchor | {"prestress": "10 MN/m"}]}))
    assert [crack["anchors"][0]["peak_tension_n"] for crack in held.cracks] == [1e7, 1e7]
    assert abs(held.residual_slip_m) < abs(bare.residual_slip_m)
    assert bare.cracks[1]["friction_law"]["slip_path_m"] > 0.0


def test_two_rigid_blocks_refuse_kinks_by_name():
    with pytest.raises(InputError, match=r"further_cracks\[0\]\.kinks: .*does not support kinks"):
        rigid(dam(lower=[]))
