"""Damping of the flexible model: the ratios that are said, against matrices on the nodes and against free vibration."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import scipy.linalg

from heeltoe import InputError
from heeltoe.kernel.dam import CrackedDam, only_crack
from heeltoe.models.flexible.body.elastic import dofs, side_by_side
from heeltoe.models.flexible.body.modes import lowest
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from shared.dams import plane_case

CHOICES = ["relative", "stiffness", "modal", "deformation", "thesis"]


def dam(elevation=0.0, friction=5.0, **options):
    """A small dam without uplift, whose crack holds under its weight."""
    fields = {
        "section": {"polygon": [["0 m", "0 m"], ["16 m", "0 m"], ["6 m", "20 m"], ["0 m", "20 m"]]},
        "concrete": {"density": "2400 kg/m^3", "modulus": "2 GPa", "poisson": 0.2},
        "crack": {"friction": friction, "elevation": f"{elevation} m"},
        "reservoir": {"depth": "12 m"},
        "uplift": {"pattern": "none"},
        "flexible": {"elements_across": 2, **options},
    }
    return build_flexible_dam(plane_case(fields))


def in_modes(one):
    """The damping of a dam as one matrix in the modes of both parts."""
    coefficients = np.concatenate([part.damping_sticking for part in one.reduced])
    rows = np.hstack([part.dampers for part in one.reduced])
    return np.diag(coefficients) + rows.T @ (one.damping.signs[:, None] * rows)


def bonded(one, count=5):
    """Circular frequencies and shapes on all nodes of the intact dam."""
    tie = one.tie
    mass = side_by_side(one, "mass")
    squares, shapes = lowest(tie.T @ side_by_side(one, "stiffness") @ tie, tie.T @ mass @ tie, count, 0.0)
    return np.sqrt(squares), tie @ shapes


def on_nodes(one, damped="mass"):
    """`relative` damping on the nodes: R is the rigid motion of the upper part fitted to the slip along the crack."""
    mass, stiffness = (side_by_side(one, name).toarray() for name in (damped, "stiffness"))
    size, upper = len(mass), one.upper
    count = upper.mesh.nodes.size

    def plane(nodes):
        values = np.zeros((2 * len(nodes), 3))
        values[::2, 0] = values[1::2, 1] = 1.0
        values[::2, 2], values[1::2, 2] = -nodes[:, 1], nodes[:, 0]
        return values

    fits = np.zeros((3, size))
    for body, first, sign in zip(one.bodies, (0, count), (1.0, -1.0), strict=False):
        nodes = body.mesh.nodes[body.mesh.crack]
        # Simpson's rule: what quadratic edges integrate to.
        weight = np.zeros(len(nodes))
        for start in range(0, len(nodes) - 2, 2):
            weight[start : start + 3] += np.array([1.0, 4.0, 1.0]) * np.linalg.norm(nodes[start + 2] - nodes[start])
        root = np.sqrt(np.repeat(weight, 2))
        fits[:, first + dofs(body.mesh.crack)] = sign * np.linalg.pinv(root[:, None] * plane(nodes)) * root
    rigid = np.zeros((size, 3))
    rigid[:count] = plane(upper.mesh.nodes)
    left = np.eye(size) - rigid @ fits
    a0, a1 = one.damping.coefficients
    return a0 * left.T @ mass @ left + a1 * stiffness


@pytest.mark.parametrize("elevation", [0.0, 8.0])
def test_relative_damping_is_that_of_the_matrices_on_the_nodes(elevation):
    one = dam(elevation)
    shapes = scipy.linalg.block_diag(*(basis.shapes for basis in one.modes))
    expected = shapes.T @ on_nodes(one) @ shapes
    assert in_modes(one) == pytest.approx(expected, abs=1e-8 * np.abs(expected).max())


@pytest.mark.parametrize("elevation", [0.0, 8.0])
def test_the_mass_term_may_leave_the_water_out(elevation):
    wet, dry = dam(elevation), dam(elevation, damping_on_water=False)
    shapes = scipy.linalg.block_diag(*(basis.shapes for basis in dry.modes))
    expected = shapes.T @ on_nodes(dry, "mass_concrete") @ shapes
    assert in_modes(dry) == pytest.approx(expected, abs=1e-8 * np.abs(expected).max())
    # The first and third mode have their ratio all the same, the others another one.
    assert dry.damping.ratios[[0, 2]] == pytest.approx(0.05, rel=1e-6)
    assert np.abs(dry.damping.ratios - wet.damping.ratios).max() > 1e-3


def test_only_relative_damping_may_leave_the_water_out():
    with pytest.raises(InputError, match="damping_on_water"):
        dam(damping="modal", damping_on_water=False)


@pytest.mark.parametrize("elevation", [0.0, 8.0])
def test_the_ratios_of_relative_damping_are_rayleighs(elevation):
    one = dam(elevation)
    a0, a1 = one.damping.coefficients
    omega = bonded(one)[0]
    assert one.damping.ratios == pytest.approx((a0 / omega + a1 * omega) / 2.0, rel=1e-6)
    assert one.damping.ratios[[0, 2]] == pytest.approx(0.05, rel=1e-6)


def test_the_ratios_of_the_other_choices():
    assert dam(damping="modal").damping.ratios == pytest.approx(0.05, rel=1e-6)
    assert dam(8.0, damping="modal").damping.ratios == pytest.approx(0.05, rel=1e-6)
    stiffness = dam(damping="stiffness")
    assert stiffness.damping.ratios == pytest.approx(0.05 * stiffness.periods[0] / stiffness.periods, rel=1e-6)
    assert dam(damping="thesis").damping.ratios[[0, 2]] == pytest.approx(0.05, rel=1e-6)
    # What was called 5 % of deformation is far less: most of the first mode is motion of the part as a rigid body.
    assert dam(damping="deformation").damping.ratios[0] < 0.025


def decay(one, number):
    """The damping ratio that a free vibration of the stuck dam shows in one of its modes."""
    omega, shapes = bonded(one, 6)
    h = 2.0 * np.pi / omega[5] / 100.0
    steps = 6000
    # A soft push at the mode's own frequency, then silence.
    t = h * np.arange(steps)
    wanted = omega[number]
    length = 3.0 * 2.0 * np.pi / wanted
    a = np.where(t < length, 0.01 * np.sin(wanted * t), 0.0)
    response = one.kernel.run(np.column_stack([a, 0.0 * a]), h, 0.5, stride=1)
    state = [table - table[0] for table in response.modes if table.size]
    moved = side_by_side(one, "mass") @ shapes[:, number]
    places = np.split(moved, [one.upper.load.size])
    y = sum(q @ (basis.shapes.T @ piece) for q, basis, piece in zip(state, one.modes, places, strict=False))
    # Nothing slipped or opened on the way.
    assert np.ptp(response.frames.slip) < 1e-5
    y = y[int(1.05 * length / h) :]
    peaks = np.flatnonzero((y[1:-1] > y[:-2]) & (y[1:-1] >= y[2:]) & (y[1:-1] > 1e-3 * y.max())) + 1
    curve = np.log(y[peaks])
    loss = -np.polyfit(np.arange(len(peaks)), curve, 1)[0]
    return loss / np.hypot(2.0 * np.pi, loss)


@pytest.mark.parametrize("choice", ["relative", "modal", "stiffness"])
@pytest.mark.parametrize("elevation", [0.0, 8.0])
def test_a_free_vibration_decays_at_the_ratio_said(choice, elevation):
    one = dam(elevation, damping=choice)
    for number in (0, 2):
        assert decay(one, number) == pytest.approx(one.damping.ratios[number], rel=0.02)


@pytest.mark.parametrize("choice", ["relative", "stiffness", "modal", "deformation"])
@pytest.mark.parametrize("elevation", [0.0, 8.0])
def test_sliding_as_a_whole_is_not_damped(choice, elevation):
    one = dam(elevation, damping=choice)
    rigid = np.zeros((in_modes(one).shape[0], 3))
    rigid[:3] = np.eye(3)
    assert in_modes(one) @ rigid == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("elevation", [0.0, 8.0])
@pytest.mark.parametrize("choice", ["relative", "modal", "on concrete"])
def test_dashpots_step_as_the_full_matrix_does(choice, elevation):
    """The same dam in the eigenmodes of nothing: a step of the kernel against one with full matrices, crack open."""
    dry = choice == "on concrete"
    one = dam(elevation, damping="relative" if dry else choice, damping_on_water=not dry)
    up = np.array([[0.0, -30.0]] * 40)  # the ground falls away and the part above flies
    h, theta = 2e-3, 0.6
    response = one.kernel.run(up, h, theta, stride=1)
    opened = int(np.argmax(response.frames.touching == 0.0)) + 1
    assert 0 < opened < 20
    q = np.hstack([table for table in response.modes if table.size])
    square = np.concatenate([part.omega_squared for part in one.reduced])
    force = np.concatenate([part.load + 30.0 * part.participation_vertical for part in one.reduced])
    c = in_modes(one)
    # From two frames the velocity is known but for one number; three steps fix all.
    operator = np.eye(len(square)) + theta * h * c + np.diag((theta * h) ** 2 * square)

    def step(x, v):
        right = v + h * force - h * (square * (x + h * theta * (1.0 - theta) * v) + (1.0 - theta) * c @ v)
        new = np.linalg.solve(operator, right)
        return x + h * (theta * new + (1.0 - theta) * v), new

    # Find the velocity at a frame from the next: linear, so two trials per mode are one solve.
    x0, x1 = q[opened], q[opened + 1]
    base = step(x0, np.zeros_like(x0))[0]
    slope = np.column_stack([step(0.0 * x0, e)[0] - step(0.0 * x0, 0.0 * e)[0] for e in np.eye(len(x0))])
    x, v = x0, np.linalg.solve(slope, x1 - base)
    for frame in range(opened + 1, opened + 15):
        x, v = step(x, v)
        assert x == pytest.approx(q[frame], abs=1e-9 * np.abs(q).max())


def test_energy_closes_with_dashpots():
    one = dam(8.0, friction=0.6)
    t = 1e-3 * np.arange(800)
    a = np.column_stack([6.0 * np.sin(30.0 * t), 3.0 * np.sin(47.0 * t)])
    row = one.kernel.run(a, 1e-3, 0.52).summary
    assert abs(row.slip) > 1e-3
    assert row.energy_damping > 0.0
    assert row.energy_residual < 1e-11


def test_parts_must_agree_in_their_dashpots():
    one = dam(8.0)
    lower = dataclasses.replace(
        one.reduced[1], dampers=np.empty((0, one.reduced[1].load.size)), damper_signs=np.empty(0)
    )
    parts = one.reduced[0], lower
    with pytest.raises(ValueError, match="dashpot"):
        CrackedDam(parts, only_crack(parts, (0.6, 0.6)), 3)


def test_the_penalty_method_wants_a_damping_without_dashpots():
    with pytest.raises(InputError, match="damping"):
        dam(contact="idce")
    dam(contact="idce", damping="thesis")
