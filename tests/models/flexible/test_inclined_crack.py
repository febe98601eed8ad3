"""Inclined cracks in the flexible model: meshes, loads on both parts, statics, and the rigid limit."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from heeltoe import GroundMotion, InputError, flexible, rigid
from heeltoe.case.model import Case
from heeltoe.geometry.axes import along_and_across, places
from heeltoe.mechanics import loads
from heeltoe.mechanics.block import build_block
from heeltoe.models.flexible.body.elastic import dam, dofs
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.mesh.checks import check_elements, check_pieces
from heeltoe.models.flexible.mesh.dam import dam_mesh
from shared.dams import BASE, TYPICAL, on_rigid_plane, plane_case, polygon
from shared.elastic import CONCRETE, bonded, resultant
from shared.meshes import area, bodies, flat, on_polyline
from shared.outlines import dams

HEAVY = {
    "reservoir": {"depth": "95 m"},
    "tailwater": {"depth": "50 m"},
    "ice": {"force": "150 kN/m", "depth": "0.5 m"},
    "silt": {"depth": "55 m"},
    "anchors": [
        {"distance": "7 m", "prestress": "800 kN/m", "inclination": "10 deg"},
        {"distance": "31.3 m", "prestress": "500 kN/m", "inclination": "-25 deg", "axial_stiffness": "50 MN/m/m"},
    ],
}


def case_of(corners, elevation, degrees, **more):
    crack = {"elevation": f"{elevation!r} m", "inclination": f"{degrees!r} deg", "friction": 1.0}
    return on_rigid_plane(
        Case.model_validate({"section": polygon(corners), "crack": crack, "concrete": CONCRETE, **more})
    )


def built(corners, elevation, degrees, **more):
    case = case_of(corners, elevation, degrees, **more)
    section = case.cut
    mesh = dam_mesh(case)
    return case, section, mesh, dam(case, mesh)


def numbers(force):
    return np.array([force.horizontal, force.vertical, force.moment])


# Meshes


@settings(max_examples=30)
@given(dams(), st.integers(2, 8), st.floats(-30.0, 30.0), st.integers(2, 5), st.integers(1, 5))
def test_both_parts_follow_the_crack(corners, tenths, degrees, across, below):
    assume(not flat(corners))
    elevation = tenths / 10 * max(z for _, z in corners)
    options = {"elements_across": across, "elements_across_below": below}
    try:
        _, section, mesh, _ = built(corners, elevation, degrees, flexible=options)
    except InputError as error:
        if error.code in (
            "mesh-nothing",
            "mesh-wedge",
            "mesh-section",
            "mesh-thin",
            "crack-pieces",
            "crack-overhang",
            "out-of-range",
        ):
            return
        raise
    whole = case_of(corners, 0.0, 0.0).cut.area
    for body, wanted, name in zip(bodies(mesh), (section.area, whole - section.area), ("upper", "lower"), strict=True):
        check_elements(body.nodes, body.elements, name)
        check_pieces(body.nodes, body.elements, name)
        assert area(body) == pytest.approx(wanted, rel=1e-9)
        assert body.nodes[body.crack[[0, -1]]] == pytest.approx(np.array([section.heel, section.toe]))
        assert np.abs(places(body.nodes[body.crack], section)[:, 1]).max() < 1e-9 * section.crack_width
    size = 1e-9 * max(z for _, z in corners)
    assert np.all(on_polyline(mesh.upper.nodes[mesh.upper.upstream], section.upstream_face) < size)
    assert np.all(on_polyline(mesh.upper.nodes[mesh.upper.downstream], section.downstream_face) < size)


@pytest.mark.parametrize(
    ("elevation", "degrees", "code", "words"),
    [
        (0.0, 5.0, "mesh-nothing", "below the crack at its heel"),
        (10.0, -20.0, "mesh-nothing", "below the crack at its toe"),
        (97.0, 40.0, "mesh-nothing", "above the crack at its toe"),
        (0.1, 5.0, "mesh-wedge", "wedge"),
    ],
)
def test_what_cannot_be_meshed_is_refused(elevation, degrees, code, words):
    with pytest.raises(InputError, match=words) as caught:
        built(TYPICAL, elevation, degrees)
    assert caught.value.code == code


def test_a_base_that_slopes_is_a_rigid_plane():
    corners = ((0.0, 0.0), (80.0, 6.0), (8.0, 90.0), (8.0, 100.0), (0.0, 100.0))
    degrees = math.degrees(math.atan2(6.0, 80.0))
    case, section, mesh, one = built(corners, 0.0, degrees, reservoir={"depth": "90 m"})
    assert mesh.lower is None
    assert area(mesh.upper) == pytest.approx(section.area)
    _, _, force = bonded(one)
    assert force[::2].sum() == pytest.approx(-sum(f.horizontal for f in loads.static_forces(case)))


def test_a_level_crack_is_meshed_as_before():
    one = dam_mesh(case_of(TYPICAL, 40.0, 0.0))
    two = dam_mesh(case_of(TYPICAL, 40.0, 1e-6))
    for body, other in zip(bodies(one), bodies(two), strict=True):
        assert other.nodes == pytest.approx(body.nodes, abs=1e-5)
        assert (other.elements == body.elements).all()


@pytest.mark.parametrize("degrees", [11.0, -7.0])
def test_meshes_by_file_have_the_crack_that_the_case_has(degrees, tmp_path):
    meshio = pytest.importorskip("meshio")
    _, section, mesh, _ = built(TYPICAL, 40.0, degrees)
    names = {}
    for body, name in ((mesh.upper, "mesh_above"), (mesh.lower, "mesh_below")):
        path = tmp_path / f"{name}.vtu"
        # As a mesher with single precision writes it.
        points = np.column_stack([body.nodes.astype(np.float32), np.zeros(len(body.nodes))])
        meshio.write(path, meshio.Mesh(points.astype(float), [("quad8", body.elements)]))
        names[name] = str(path)
    _, _, result, one = built(TYPICAL, 40.0, degrees, flexible=names)
    for body, own in zip(bodies(result), bodies(mesh), strict=True):
        assert body.nodes[body.crack] == pytest.approx(own.nodes[own.crack], abs=1e-4)
        assert np.abs(places(body.nodes[body.crack], section)[:, 1]).max() < 1e-9
        assert body.nodes[body.crack[[0, -1]]] == pytest.approx(np.array([section.heel, section.toe]), abs=0.0)
    assert bonded(one)[2].size == 2 * mesh.upper.crack.size
    with pytest.raises(InputError) as caught:
        built(TYPICAL, 40.0, degrees + 1.0, flexible=names)
    assert caught.value.code == "mesh-crack"


# Loads


@pytest.mark.parametrize("degrees", [0.0, 12.0, -12.0])
@pytest.mark.parametrize("across", [2, 5])
def test_resultants_are_those_of_the_rigid_body(degrees, across):
    case, section, _, one = built(TYPICAL, 40.0, degrees, flexible={"elements_across": across}, **HEAVY)
    for reference in loads.static_forces(case):
        result = resultant(one.upper, one.upper.loads[reference.name], section)
        scale = np.abs(numbers(reference)).max()
        assert result == pytest.approx(numbers(reference), rel=1e-9, abs=1e-9 * scale), reference.name
    # On both parts together act the forces on the whole dam, and those in the crack cancel.
    whole = case_of(TYPICAL, 0.0, 0.0, **{k: v for k, v in HEAVY.items() if k != "anchors"})
    there = {force.name: force for force in loads.static_forces(whole)}
    for name in ("weight", "reservoir", "tailwater", "ice", "silt"):
        result = sum(resultant(body, body.loads[name], whole.cut) for body in (one.upper, one.lower))
        assert result == pytest.approx(numbers(there[name]), rel=1e-9, abs=1e-3), name
    for name in ("uplift", "anchors"):
        above, below = (resultant(body, body.loads[name], section) for body in (one.upper, one.lower))
        assert above == pytest.approx(-below, rel=1e-9, abs=1e-3)


def test_ice_and_silt_by_hand():
    # The ice at 60 m, below the crack, is the lower part's; the silt is a fluid of 360 kg/m3 on an upright face.
    water = {"reservoir": {"depth": "61 m"}, "ice": {"force": "100 kN/m", "depth": "1 m"}, "silt": {"depth": "30 m"}}
    _, section, _, one = built(TYPICAL, 70.0, 0.0, **water)
    assert not one.upper.loads["ice"].any()
    assert not one.upper.loads["silt"].any()
    ice, silt = (resultant(one.lower, one.lower.loads[name], section) for name in ("ice", "silt"))
    assert ice == pytest.approx([1e5, 0.0, 1e5 * 10.0])
    push = 360.0 * 9.80665 * 30.0**2 / 2.0
    assert silt == pytest.approx([push, 0.0, push * 60.0])


def test_silt_on_a_slope_by_hand():
    # Standing on a face that leans 1:4, it weighs 920 kg/m3 and pushes like 360 kg/m3.
    corners = ((0.0, 0.0), (50.0, 0.0), (30.0, 60.0), (15.0, 60.0))
    more = {"reservoir": {"depth": "50 m"}, "silt": {"depth": "40 m"}}
    _, section, _, one = built(corners, 0.0, 0.0, **more)
    force = resultant(one.upper, one.upper.loads["silt"], section)
    g = 9.80665
    assert force[:2] == pytest.approx([360.0 * g * 800.0, -920.0 * g * 40.0 * 10.0 / 2.0])


@pytest.mark.parametrize("degrees", [10.0, -10.0])
def test_the_bonded_crack_carries_the_static_loads(degrees):
    case, section, mesh, one = built(TYPICAL, 40.0, degrees, **HEAVY)
    _, _, force = bonded(one)
    held = np.zeros(one.upper.load.size)
    held[dofs(mesh.upper.crack)] = force
    horizontal, vertical, moment = resultant(one.upper, held, section)
    along, across = along_and_across(np.array([horizontal, vertical]), section)
    static = build_block(case).static
    assert [along, across, moment] == pytest.approx(-numbers(static), rel=1e-8)


def test_mirror_image():
    water = {"reservoir": {"depth": "70 m"}, "tailwater": {"depth": "55 m"}}
    other = {"reservoir": water["tailwater"], "tailwater": water["reservoir"]}
    corners = ((0.0, 0.0), (60.0, 0.0), (40.0, 80.0), (10.0, 80.0))
    _, section, _, one = built(corners, 30.0, 9.0, **water)
    image = [(-x, z) for x, z in corners]
    _, mirrored, _, two = built(image, section.toe[1], -9.0, **other)
    assert mirrored.crack_width == pytest.approx(section.crack_width)
    result, expected = bonded(two)[2].reshape(-1, 2)[::-1] * [-1, 1], bonded(one)[2].reshape(-1, 2)
    assert result == pytest.approx(expected, abs=1e-7 * np.abs(expected).max())


@pytest.mark.parametrize("elevation", [0.0, 20.0])
def test_water_that_follows_the_vertical_motion(elevation):
    # A ground that rises steadily at 0.3 g presses both waters 1.3 times as hard.
    def one(follows, gravity=1.0):
        water = {"follows_vertical_motion": follows, "density": f"{1000.0 * gravity} kg/m^3"}
        sides = {"reservoir": {"depth": "90 m", **water}, "tailwater": {"depth": "30 m", **water}}
        more = {"uplift": {"pattern": "none"}, "flexible": {"elements_across": 2}, **sides}
        return build_flexible_dam(case_of(TYPICAL, elevation, 0.0, **more))

    still, following, denser = one(False), one(True), one(False, 1.3)
    for place, part in enumerate(following.reduced):
        basis, bodies_ = following.modes[place].shapes, (still.bodies[place], denser.bodies[place])
        more = bodies_[1].load - bodies_[0].load
        expected = still.reduced[place].participation_vertical - basis.T @ more / (0.3 * 9.80665)
        assert part.participation_vertical == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.abs(expected).max())
        assert (part.participation_horizontal == still.reduced[place].participation_horizontal).all()


# Runs

TIME = np.linspace(0.0, 2.0, 401)
PULSES = GroundMotion("pulses", TIME, 6.0 * np.sin(2.0 * np.pi * TIME) * (TIME < 1.5))
SMALL = ["flexible.evidence=none", "motion.duration=2s", "reservoir.depth=60m", "crack.friction=0.5"]


def typical(degrees, *more):
    changes = [*SMALL, "crack.elevation=15m", f"crack.inclination={degrees}deg", *more]
    return plane_case(BASE, changes)


@pytest.mark.parametrize("degrees", [8.0, *(pytest.param(angle, marks=pytest.mark.slow) for angle in (0.0, -6.0))])
def test_a_stiff_dam_slides_as_the_rigid_block(degrees):
    case = typical(degrees, "concrete.modulus=1e5GPa", "flexible.elements_across=3", "flexible.time_step=2e-5s")
    elastic, block = flexible(case, PULSES), rigid(case, PULSES)
    assert abs(block.residual_slip_m) > 0.2
    assert elastic.residual_slip_m == pytest.approx(block.residual_slip_m, rel=0.02)
    assert elastic.energy.residual < 1e-9


def test_hardly_inclined_is_level():
    level, hardly = (flexible(typical(degrees, "flexible.elements_across=2"), PULSES) for degrees in (0.0, 1e-6))
    assert hardly.residual_slip_m == pytest.approx(level.residual_slip_m, rel=1e-5)
    assert abs(level.residual_slip_m) > 0.05


def test_frames_of_an_inclined_crack(tmp_path):
    response = flexible(typical(12.0, "flexible.elements_across=2"), PULSES)
    record = response.crack
    section = record.dam.section
    for part, (face, body) in enumerate(zip(record.faces, record.dam.bodies, strict=True)):
        start = places(body.mesh.nodes[body.mesh.crack], section).T
        moved = along_and_across(record.displacements(-1)[part][body.mesh.crack], section).T
        assert face[-1] - start == pytest.approx(moved, abs=1e-9)
    static = build_block(typical(12.0)).static
    along, across = record.forces()[0].sum(axis=1)
    assert [along, across] == pytest.approx([-static.horizontal, -static.vertical], rel=1e-8)
    assert response.histories["normal_force_n"][1:] == pytest.approx(record.force[1:, 1].sum(axis=1))
    # What is drawn of the crack has moved as the dam has.
    meshio = pytest.importorskip("meshio")
    from heeltoe.views.files.vtk import write_vtk_series

    write_vtk_series(record, tmp_path, frames=[-1])
    result = meshio.read(next(tmp_path.glob("crack-*.vtu"))).point_data["displacement"][:, :2]
    expected = [each[body.mesh.crack] for each, body in zip(record.displacements(-1), record.dam.bodies, strict=True)]
    assert result == pytest.approx(np.vstack(expected), abs=1e-9)
