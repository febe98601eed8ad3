"""The elastic bodies: closed forms, patch test, both parts together, mirror images."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from heeltoe.errors.error import InputError
from heeltoe.mechanics import loads
from heeltoe.models.flexible.body.elastic import dam, dofs, principal, stresses
from heeltoe.models.flexible.mesh.checks import boundary_edges
from heeltoe.models.flexible.mesh.dam import dam_mesh
from shared.dams import RECTANGLE, TRIANGLE, TYPICAL
from shared.elastic import CONCRETE, G, bonded, built, deep, parts, resultant
from shared.meshes import flat
from shared.outlines import dams, make


def distorted(body):
    """Nodes with all that are inside moved about, midside nodes too, so that sides are curved."""
    corners = body.nodes[body.elements[:, :4]]
    reach = 0.03 * np.linalg.norm(corners[:, 2] - corners[:, 0], axis=1).min()
    moved = body.nodes + np.random.default_rng(7).uniform(-reach, reach, body.nodes.shape)
    held = np.unique(boundary_edges(body.elements))
    moved[held] = body.nodes[held]
    return moved


# Closed forms


def test_column_under_its_own_weight():
    # Stress -rho g (h - z), shortening rho g h^2 / (2 E); quadratic, so exact without Poisson's ratio.
    concrete = {"density": "2500 kg/m^3", "modulus": "30 GPa", "poisson": 0.0}
    _, _, one = built(RECTANGLE, bend=distorted, concrete=concrete)
    _, _, straight = built(RECTANGLE, concrete=concrete)
    load, height = 2500 * G, 12.0
    z = straight.upper.mesh.nodes[:, 1]
    exact = np.column_stack([0.0 * z, -load / 30e9 * (height * z - z * z / 2.0)])
    upper, lower, force = bonded(straight)
    assert upper.reshape(-1, 2) == pytest.approx(exact, abs=1e-15)
    assert lower.size == 0
    assert force.reshape(-1, 2).sum(axis=0) == pytest.approx([0.0, load * 8.0 * 12.0], abs=1e-5)
    result = stresses(straight.upper, upper)
    assert result == pytest.approx(np.column_stack([0.0 * z, -load * (height - z), 0.0 * z]), abs=1e-4)
    # On curved elements a quadratic is no longer exact, but close.
    bent, _, _ = bonded(one)
    z = one.upper.mesh.nodes[:, 1]
    assert bent[1::2] == pytest.approx(-load / 30e9 * (height * z - z * z / 2.0), rel=0.02, abs=1e-7)


@pytest.mark.parametrize(("elevation", "corners"), [(0.0, TRIANGLE), (60.0, TYPICAL), (30.0, TRIANGLE)])
def test_patch_of_distorted_elements(elevation, corners):
    # A linear field has the same stress everywhere, and no forces on nodes inside.
    _, _, one = built(corners, elevation, bend=distorted)
    for body in parts(one):
        x, z = body.mesh.nodes.T
        field = np.column_stack([1e-3 * x + 2e-3 * z, -0.5e-3 * x + 3e-3 * z])
        forces = (body.stiffness @ field.reshape(-1)).reshape(-1, 2)
        inside = np.setdiff1d(np.arange(len(x)), boundary_edges(body.mesh.elements))
        assert len(inside) > 20
        assert np.abs(forces[inside]).max() < 1e-9 * np.abs(forces).max()
        stress = np.array([1.0, 0.2, 0.0]) * 1e-3 + np.array([0.2, 1.0, 0.0]) * 3e-3 + [0.0, 0.0, 0.4 * 1.5e-3]
        stress *= 20e9 / (1 - 0.2**2)
        assert stresses(body, field.reshape(-1)) == pytest.approx(np.broadcast_to(stress, (len(x), 3)))


@pytest.mark.parametrize("elevation", [0.0, 60.0])
def test_rigid_motion_takes_no_force(elevation):
    _, section, one = built(TYPICAL, elevation, bend=distorted)
    for body in parts(one):
        x, z = (body.mesh.nodes - section.heel).T
        for motion in ([1.0 + 0 * x, 0 * x], [0 * x, 1.0 + 0 * x], [-z, x]):
            forces = body.stiffness @ np.column_stack(motion).reshape(-1)
            assert np.abs(forces).max() < 1e-12 * np.abs(body.stiffness.data).max() * 100.0


# Three Gauss points each way are exact on straight sides; on curved ones the moment of inertia is of a degree too high.
@pytest.mark.parametrize(("bend", "accuracy"), [(None, 1e-12), (distorted, 1e-6)])
@pytest.mark.parametrize("corners", [TYPICAL, TRIANGLE])
def test_mass_of_rigid_motion(corners, bend, accuracy):
    case, section, one = built(corners, bend=bend)
    mass, body = loads.concrete_mass(case), one.upper
    x, z = (body.mesh.nodes - section.centroid).T
    motions = [np.column_stack(motion).reshape(-1) for motion in ([1 + 0 * x, 0 * x], [0 * x, 1 + 0 * x], [-z, x])]
    result = np.array([[a @ (body.mass_concrete @ b) for b in motions] for a in motions])
    expected = np.diag([mass, mass, case.concrete.density * section.polar_inertia])
    assert result == pytest.approx(expected, rel=accuracy, abs=1e-9 * expected.max())
    assert result[:2, :2] == pytest.approx(expected[:2, :2], rel=1e-12, abs=1e-12 * mass)
    assert (body.mass - body.mass_concrete).nnz == 0


def test_symmetric_and_positive():
    _, _, one = built(TYPICAL, 60.0, reservoir=deep(80.0), flexible={"elements_across": 3})
    for body in parts(one):
        for matrix in (body.stiffness, body.mass, body.mass_concrete):
            assert abs(matrix - matrix.T).max() < 1e-12 * abs(matrix).max()
        assert np.linalg.eigvalsh(body.mass.toarray())[0] > 0.0
        # Three motions without strain, no more: full integration leaves no hourglass.
        energies = np.linalg.eigvalsh(body.stiffness.toarray())
        assert abs(energies[2]) < 1e-12 * energies[-1] < 1e-6 * energies[3]


def test_plane_strain_and_plane_stress():
    stretched = {}
    for plane in ("stress", "strain"):
        _, _, one = built(RECTANGLE, flexible={"plane": plane})
        x, z = one.upper.mesh.nodes.T
        stretched[plane] = stresses(one.upper, np.column_stack([1e-4 * x, 0.0 * z]).reshape(-1))[0]
    e, nu = 20e9, 0.2
    assert stretched["stress"] == pytest.approx([1e-4 * e / (1 - nu**2), 1e-4 * nu * e / (1 - nu**2), 0.0], abs=1e-6)
    lame = e / ((1 + nu) * (1 - 2 * nu))
    assert stretched["strain"] == pytest.approx([1e-4 * (1 - nu) * lame, 1e-4 * nu * lame, 0.0], abs=1e-6)


def test_stresses_of_many_moments():
    _, _, one = built(TYPICAL, reservoir=deep(90.0))
    upper, _, _ = bonded(one)
    many = stresses(one.upper, np.column_stack([upper, 2.0 * upper]))
    single = stresses(one.upper, upper)
    assert many.shape == (len(one.upper.mesh.nodes), 3, 2)
    assert many == pytest.approx(np.stack([single, 2.0 * single], axis=2))


def test_principal_stresses():
    # By hand (Mohr's circle): centre 10, radius 50; pure shear turns them by 45 degrees.
    stress = np.array([[50.0, -30.0, 30.0], [0.0, 0.0, -5.0], [-2.0, 7.0, 0.0]])
    major, minor, angle = principal(stress)
    assert major == pytest.approx([60.0, 5.0, 7.0])
    assert minor == pytest.approx([-40.0, -5.0, -2.0])
    assert angle == pytest.approx([math.atan2(3, 4) / 2, -math.pi / 4, math.pi / 2])
    for (xx, zz, xz), most, direction in zip(stress, major, angle, strict=True):
        c, s = math.cos(direction), math.sin(direction)
        assert c * c * xx + s * s * zz + 2 * s * c * xz == pytest.approx(most)
    assert principal(stress[:, :, None])[0].shape == (3, 1)


# Both parts together


def test_bonded_crack_carries_what_is_above_it():
    case, section, one = built(TYPICAL, 60.0, reservoir=deep(95.0), tailwater=deep(20.0))
    upper, lower, force = bonded(one)
    balance = sum(np.array([force.horizontal, force.vertical, force.moment]) for force in loads.static_forces(case))
    held = np.zeros(one.upper.load.size)
    held[dofs(one.upper.mesh.crack)] = force
    assert resultant(one.upper, held, section) == pytest.approx(-balance, rel=1e-7)
    assert upper[dofs(one.upper.mesh.crack)] == pytest.approx(lower[dofs(one.lower.mesh.crack)], abs=1e-15)
    assert not lower[dofs(one.lower.mesh.fixed)].any()
    # Nothing else holds the upper part.
    residual = one.upper.stiffness @ upper - one.upper.load - held
    assert np.abs(residual).max() < 1e-7 * np.abs(force).max()


def test_crack_that_is_bonded_is_no_crack():
    # Where the crack is decides on the mesh alone; what that does to the crest goes away with refinement.
    spread = []
    for across in (8, 16):
        crests = []
        for elevation in (0.0, 30.0, 90.0):
            options = {"reservoir": deep(95.0), "uplift": {"pattern": "none"}, "flexible": {"elements_across": across}}
            _, _, one = built(TYPICAL, elevation, **options)
            upper, _, _ = bonded(one)
            crests.append(upper[2 * one.upper.mesh.upstream[-1]])
        spread.append(np.ptp(crests) / np.mean(crests))
    assert spread[0] < 5e-3
    assert spread[1] < spread[0] / 2


def test_faces_that_do_not_match_node_by_node():
    common = {"reservoir": deep(95.0)}
    _, _, matching = built(TYPICAL, 60.0, flexible={"elements_across": 8}, **common)
    for above, below in ((8, 5), (5, 8), (8, 4)):
        options = {"elements_across": above, "elements_across_below": below}
        _, _, one = built(TYPICAL, 60.0, flexible=options, **common)
        upper, lower, force = bonded(one)
        expected, _, held = bonded(matching)
        crest = 2 * one.upper.mesh.upstream[-1], 2 * matching.upper.mesh.upstream[-1]
        assert upper[crest[0]] == pytest.approx(expected[crest[1]], rel=0.01)
        assert force.reshape(-1, 2).sum(axis=0) == pytest.approx(held.reshape(-1, 2).sum(axis=0), rel=1e-7)
        # The upper nodes lie on the lower face as it is bent: by its own quadratics.
        face = one.lower.mesh.crack
        x, moved = one.lower.mesh.nodes[face, 0], lower.reshape(-1, 2)[face]
        for node in one.upper.mesh.crack:
            where = one.upper.mesh.nodes[node, 0]
            edge = 2 * min(int((where - x[0]) / (x[2] - x[0])), below - 1)
            quadratic = np.polyfit(x[edge : edge + 3], moved[edge : edge + 3], 2)
            wanted = [np.polyval(quadratic[:, axis], where) for axis in (0, 1)]
            assert upper.reshape(-1, 2)[node] == pytest.approx(wanted, rel=1e-6, abs=1e-9)


def test_crack_nodes_off_the_middle_of_their_sides():
    # The tie finds its place on an edge whose midside node is not halfway: it must carry a linear motion unchanged.
    def off_middle(body):
        nodes = body.nodes.copy()
        nodes[body.crack[1::2], 0] += 0.1 * np.diff(nodes[body.crack[::2], 0])
        return nodes

    case = make(TYPICAL, 60.0, concrete=CONCRETE, flexible={"elements_across": 3, "elements_across_below": 4})
    mesh = dam_mesh(case)
    mesh.lower.nodes[:] = off_middle(mesh.lower)
    one = dam(case, mesh)
    free = np.setdiff1d(np.arange(mesh.lower.nodes.size), dofs(mesh.lower.fixed))
    field = (mesh.lower.nodes @ [[1.0, 3.0], [0.0, 0.0]] + [2.0, 0.5]).reshape(-1)
    loose = np.zeros(one.tie.shape[1] - free.size)
    tied = (one.tie @ np.concatenate([loose, field[free]]))[dofs(mesh.upper.crack)].reshape(-1, 2)
    x = mesh.upper.nodes[mesh.upper.crack, 0]
    assert tied == pytest.approx(np.column_stack([x + 2.0, 3.0 * x + 0.5]))


@settings(max_examples=10)
@given(dams(), st.integers(0, 9), st.floats(0.1, 1.0), st.floats(0.1, 1.0))
def test_mirror_image(corners, tenths, up, down):
    assume(not flat(corners))
    top = max(z for _, z in corners)
    options = {"elements_across": 2}
    water = deep(up * top), deep(down * top)
    one = built(corners, tenths / 10 * top, reservoir=water[0], tailwater=water[1], flexible=options)[2]
    mirrored = [(-x, z) for x, z in corners]
    two = built(mirrored, tenths / 10 * top, reservoir=water[1], tailwater=water[0], flexible=options)[2]
    moved, image = bonded(one), bonded(two)
    # A slender column bends so much more than it is strained that the last bit of its stiffness shows: by the fourth
    # power of its slenderness, 2e-11 at 12, 1e-9 at 48, 1.5e-7 at 150.
    faces = (one.upper.mesh.nodes[face, 0] for face in (one.upper.mesh.upstream, one.upper.mesh.downstream))
    slenderness = top / np.abs(np.subtract(*faces)).min()
    rounded = max(1e-7, 2e-14 * slenderness**4)
    assert image[2].reshape(-1, 2)[::-1] * [-1, 1] == pytest.approx(
        moved[2].reshape(-1, 2), abs=rounded * np.abs(moved[2]).max()
    )
    for face, other in (("upstream", "downstream"), ("downstream", "upstream")):
        result = image[0].reshape(-1, 2)[getattr(two.upper.mesh, face)] * [-1, 1]
        expected = moved[0].reshape(-1, 2)[getattr(one.upper.mesh, other)]
        assert result == pytest.approx(expected, abs=rounded * np.abs(moved[0]).max())


# Errors


def test_modulus_missing():
    with pytest.raises(
        InputError, match=r"concrete\.modulus: is required but missing; the flexible model needs it, for example"
    ):
        built(TYPICAL, concrete={})


@pytest.mark.parametrize("modulus", ["20 kPa", "1e8 GPa"])
def test_absurd_modulus(modulus):
    with pytest.raises(InputError, match=r"concrete\.modulus: .* is out of range; give a value from 1 MPa to 1e7 GPa"):
        built(TYPICAL, concrete={"modulus": modulus})


@pytest.mark.parametrize("modulus", ["1 MPa", "20000 GPa"])
def test_extreme_moduli_are_solved_alike(modulus):
    # Displacements go with 1/E, forces in the crack not at all.
    _, _, one = built(TYPICAL, 60.0, concrete=CONCRETE | {"modulus": modulus}, reservoir=deep(95.0))
    _, _, usual = built(TYPICAL, 60.0, reservoir=deep(95.0))
    factor = one.upper.elasticity[0, 0] / usual.upper.elasticity[0, 0]
    upper, _, force = bonded(one)
    expected, _, held = bonded(usual)
    assert upper * factor == pytest.approx(expected, rel=1e-6, abs=1e-9 * np.abs(expected).max())
    assert force == pytest.approx(held, rel=1e-6, abs=1e-6 * np.abs(held).max())


def test_bodies_are_not_changed():
    _, _, one = built(TYPICAL)
    with pytest.raises(dataclasses.FrozenInstanceError):
        one.upper.load = 0.0
