"""Modes: closed forms, the periods of Zhu (2004), rigid motion, and bases with modes left out."""

import math

import numpy as np
import pytest
import scipy.linalg

from heeltoe import flexible
from heeltoe.models.flexible.body.elastic import dofs
from heeltoe.models.flexible.body.modes import (
    ENOUGH,
    Basis,
    enough_modes,
    error_frequency,
    intact_periods,
    part_periods,
    rayleigh,
    reduce,
)
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from shared.dams import BASE, TYPICAL, plane_case
from shared.elastic import bonded, built, deep, parts

KOYNA = [(0.0, 0.0), (70.2, 0.0), (20.36, 66.5), (14.8, 103.0), (0.0, 103.0)]
TRIANGLE = [(0.0, 0.0), (97.536, 0.0), (0.0, 121.92)]


def concrete(density, modulus, poisson):
    return {"density": f"{density} kg/m^3", "modulus": f"{modulus} GPa", "poisson": poisson}


# Closed forms


def column(height, across):
    corners = [(0.0, 0.0), (1.0, 0.0), (1.0, height), (0.0, height)]
    return built(corners, concrete=concrete(2500, 25, 0.0), flexible={"elements_across": across})[2]


def test_slender_cantilever():
    # Euler and Bernoulli: omega = (lambda / L)^2 sqrt(E I / (rho A)); a slenderness of 60 leaves shear 0.1 % at most.
    length = 60.0
    periods = intact_periods(column(length, 1), 2)
    for period, factor in zip(periods, (1.875104, 4.694091), strict=True):
        omega = (factor / length) ** 2 * math.sqrt(25e9 / 12 / 2500)
        assert period == pytest.approx(2 * math.pi / omega, rel=5e-3)
    assert periods[0] == pytest.approx(2 * math.pi * length**2 / 1.875104**2 / math.sqrt(25e9 / 12 / 2500), rel=1e-3)


def test_free_bar():
    # Axial vibration of a bar free at both ends: omega = n pi c / L; without Poisson's ratio it is one-dimensional.
    one = column(12.0, 2)
    modes = reduce(one.upper)
    speed = math.sqrt(25e9 / 2500)
    x, z = one.upper.mesh.nodes.T
    for n in (1, 2):
        shape = np.zeros(2 * len(x))
        shape[1::2] = np.cos(n * math.pi * z / 12.0)
        # The mode that looks like it: axial and bending modes are mixed in the list.
        share = (modes.shapes.T @ (one.upper.mass @ shape)) ** 2 / (shape @ (one.upper.mass @ shape))
        assert share.max() > 0.999
        assert math.sqrt(modes.omega_squared[share.argmax()]) == pytest.approx(n * math.pi * speed / 12.0, rel=2e-3)


@pytest.mark.parametrize(
    ("corners", "material", "published"),
    [
        (TYPICAL, concrete(2650, 20, 0.143), [0.2842, 0.1292, 0.1052, 0.0768, 0.0521]),
        (TRIANGLE, concrete(2430, 27.61, 0.0), [0.2620, 0.1126, 0.1008]),
        (KOYNA, concrete(2643, 31.027, 0.2), [0.3254, 0.1218, 0.0925, 0.0627, 0.0413]),
    ],
)
@pytest.mark.parametrize(("across", "accuracy"), [(4, 0.025), (8, 0.01)])
def test_periods_of_zhu(corners, material, published, across, accuracy):
    # They are those of the dam alone: with its virtual water the first is about a third longer.
    top = max(z for _, z in corners)
    _, _, one = built(corners, concrete=material, reservoir=deep(top), flexible={"elements_across": across})
    assert intact_periods(one, len(published), water=False) == pytest.approx(published, rel=accuracy)
    assert 1.2 < intact_periods(one, 1)[0] / published[0] < 1.45


def test_bonded_crack_leaves_the_periods():
    whole = intact_periods(built(TYPICAL, reservoir=deep(95.0))[2])
    cracked = intact_periods(built(TYPICAL, 60.0, reservoir=deep(95.0))[2])
    options = {"elements_across": 8, "elements_across_below": 5}
    unlike = intact_periods(built(TYPICAL, 60.0, reservoir=deep(95.0), flexible=options)[2])
    # Against meshes four times as fine, the first four are off by 0.2 % at most, the fifth by 0.5 %.
    for other in (cracked, unlike):
        assert other[:4] == pytest.approx(whole[:4], rel=3e-3)
        assert other[4] == pytest.approx(whole[4], rel=7e-3)


def test_mirror_image():
    one = built(TYPICAL, 60.0)[2]
    two = built([(-x, z) for x, z in TYPICAL], 60.0)[2]
    assert intact_periods(two) == pytest.approx(intact_periods(one), rel=1e-9)
    for body, image in zip(parts(one), parts(two), strict=True):
        assert part_periods(reduce(image), 20) == pytest.approx(part_periods(reduce(body), 20), rel=1e-7)


def test_fewer_periods_where_the_mesh_has_no_more():
    _, _, one = built([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], flexible={"elements_across": 1})
    assert len(intact_periods(one, 50)) == 10
    assert len(part_periods(reduce(one.upper), 50)) == 13


def test_rayleigh():
    mass, stiffness = rayleigh(0.3, 0.1, 0.05)
    for period in (0.3, 0.1):
        omega = 2 * math.pi / period
        assert (mass / omega + stiffness * omega) / 2 == pytest.approx(0.05)


# Bases


@pytest.fixture(scope="module")
def cracked():
    return built(TYPICAL, 60.0, reservoir=deep(95.0))[2]


def check_basis(body, modes):
    """Diagonal in mass and stiffness, in order, and rigid motion exact."""
    shapes, squares = modes.shapes, modes.omega_squared
    assert np.abs(shapes.T @ (body.mass @ shapes) - np.eye(len(squares))).max() < 1e-11
    assert np.abs(shapes.T @ (body.stiffness @ shapes) - np.diag(squares)).max() < 1e-11 * squares[-1]
    assert np.all(np.diff(squares) >= 0.0)
    assert np.all(squares[: modes.rigid] == 0.0)
    assert not shapes[dofs(body.mesh.fixed)].any()
    assert modes.rigid == (0 if body.mesh.fixed.size else 3)
    if not modes.rigid:
        return
    # Every rigid motion is a sum of the first three, and they take no force.
    x, z = body.mesh.nodes.T
    for motion in ([1 + 0 * x, 0 * x], [0 * x, 1 + 0 * x], [-z, x]):
        field = np.column_stack(motion).reshape(-1)
        rigid = shapes[:, :3]
        assert rigid @ (rigid.T @ (body.mass @ field)) == pytest.approx(field, rel=1e-9, abs=1e-9 * np.abs(field).max())


@pytest.mark.parametrize("keep", [None, 4, 40])
def test_basis(cracked, keep):
    for body in parts(cracked):
        modes = reduce(body, keep)
        check_basis(body, modes)
        free = body.load.size - 2 * body.mesh.fixed.size
        assert modes.total == free
        if keep is None:
            assert (modes.kept, modes.truncated, len(modes.omega_squared)) == (free, False, free)
        else:
            # Unit forces on the crack, the static loads, and, where the base shakes, two accelerations.
            extra = 2 * body.mesh.crack.size + (1 if modes.rigid else 3)
            assert (modes.kept, modes.truncated) == (modes.rigid + keep, True)
            assert len(modes.omega_squared) == modes.kept + extra


@pytest.mark.parametrize("keep", [4, 40])
def test_basis_with_modes_left_out(cracked, keep):
    states = bonded(cracked)
    for body, static in zip(parts(cracked), states[:2], strict=True):
        whole, part = reduce(body), reduce(body, keep)
        assert part.omega_squared[: part.kept] == pytest.approx(whole.omega_squared[: part.kept], rel=1e-9)
        # The static flexibility of the crack; of a free body that of its deformation alone.
        crack = dofs(body.mesh.crack)
        flexibility = [
            m.shapes[crack, m.rigid :] @ (m.shapes[crack, m.rigid :] / m.omega_squared[m.rigid :]).T
            for m in (whole, part)
        ]
        assert flexibility[1] == pytest.approx(flexibility[0], rel=1e-8, abs=1e-8 * np.abs(flexibility[0]).max())
        # The state before the earthquake is in the space.
        again = part.shapes @ (part.shapes.T @ (body.mass @ static))
        assert again == pytest.approx(static, abs=1e-7 * np.abs(static).max())


def test_static_flexibility_against_a_direct_solution(cracked):
    for body in parts(cracked):
        modes = reduce(body, 20)
        crack = dofs(body.mesh.crack)
        free = np.setdiff1d(np.arange(body.load.size), dofs(body.mesh.fixed))
        # The held part exactly; the free one with a small shift that makes it regular.
        shift = 1e-3 * modes.omega_squared[3] if modes.rigid else 0.0
        operator = (body.stiffness + shift * body.mass)[free][:, free].toarray()
        unit = np.zeros((body.load.size, crack.size))
        unit[crack, np.arange(crack.size)] = 1.0
        direct = unit[free].T @ scipy.linalg.solve(operator, unit[free], assume_a="pos")
        result = modes.shapes[crack] @ (modes.shapes[crack] / (modes.omega_squared + shift)).T
        assert result == pytest.approx(direct, abs=1e-8 * np.abs(direct).max())


def test_residual_error(cracked):
    circular = error_frequency(2.0 * np.pi / intact_periods(cracked, 1)[0])
    for body in parts(cracked):
        assert Basis.of(body).error(reduce(body), circular) == 0.0
        modes, whole = reduce(body, 12), reduce(body)
        assert modes.truncated
        # By its definition, from all modes.
        crack, square = dofs(body.mesh.crack), circular**2
        result, exact = (m.shapes[crack] @ (m.shapes[crack] / (m.omega_squared + square)).T for m in (modes, whole))
        expected = scipy.linalg.eigvalsh(exact - result, exact)[-1]
        assert Basis.of(body).error(modes, circular) == pytest.approx(expected, rel=1e-4)
        # Without the static shapes some patterns of forces meet a crack that does not give at all.
        bare = type(modes)(
            modes.omega_squared[: modes.kept],
            modes.shapes[:, : modes.kept],
            modes.rigid,
            modes.kept,
            modes.total,
            modes.truncated,
        )
        assert Basis.of(body).error(bare, circular) > 0.9


def test_all_modes_where_as_many_are_asked_for(cracked):
    body = cracked.lower
    assert not reduce(body, body.load.size).truncated
    extra = 2 * body.mesh.crack.size + 3
    total = body.load.size - 2 * body.mesh.fixed.size
    assert not reduce(body, total - extra).truncated
    assert reduce(body, total - extra - 1).truncated


def test_meshes_keep_as_many_of_the_lowest_modes_as_the_crack_needs():
    dam = built(TYPICAL, reservoir=deep(95.0), flexible={"elements_across": 12})[2]
    circular = error_frequency(2.0 * np.pi / intact_periods(dam, 1)[0])
    modes, error = enough_modes(Basis.of(dam.upper), circular)
    assert (modes.kept, modes.truncated) == (53, True)
    assert 0.0 < error == Basis.of(dam.upper).error(modes, circular) < ENOUGH
    check_basis(dam.upper, modes)


def test_weight_alone_adds_no_shape_to_the_accelerations():
    # The static load of a dry dam is its weight: the same as a vertical acceleration, which is there already.
    body = built(TYPICAL, 60.0)[2].lower
    modes = reduce(body, 10)
    check_basis(body, modes)
    assert len(modes.omega_squared) == modes.kept + 2 * body.mesh.crack.size + 2


@pytest.mark.parametrize("keep", [None, 4])
def test_slender_body(keep):
    # Its lowest frequency is so far below its highest that rounding mixes rigid motion into the shapes.
    body = column(60.0, 1).upper
    modes = reduce(body, keep)
    check_basis(body, modes)
    crack, whole = dofs(body.mesh.crack), reduce(body)
    flexibility = [m.shapes[crack, 3:] @ (m.shapes[crack, 3:] / m.omega_squared[3:]).T for m in (whole, modes)]
    assert flexibility[1] == pytest.approx(flexibility[0], abs=1e-8 * np.abs(flexibility[0]).max())


def test_same_result_every_time(cracked):
    once, again = reduce(cracked.upper, 20), reduce(cracked.upper, 20)
    assert np.array_equal(once.omega_squared, again.omega_squared)
    assert np.array_equal(once.shapes, again.shapes)


def test_few_modes_show_in_the_error_and_in_a_warning():
    """What 12 modes lose of the typical dam is seen; 25 are too few; by itself the program takes enough."""
    changes = ["motion.duration=1s", "flexible.evidence=none"]
    errors = [build_flexible_dam(plane_case(BASE, [f"flexible.modes={keep}"])).basis_error for keep in (12, 25, 50)]
    assert errors[0] > 0.1
    assert errors == sorted(errors, reverse=True)
    assert errors[2] < ENOUGH < errors[1]
    few = flexible(plane_case(BASE, [*changes, "flexible.modes=12"]))
    assert "modes-few" in [notice.code for notice in few.warnings]
    enough = flexible(plane_case(BASE, changes))
    assert "modes-few" not in [notice.code for notice in enough.warnings]
    assert enough.mesh["modes"][0] < 0.2 * build_flexible_dam(plane_case(BASE, ["flexible.modes=10000"])).modes[0].total
