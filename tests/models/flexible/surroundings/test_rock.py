"""Rock with waves against the half-plane in closed form, and its limits."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse.linalg import splu

from heeltoe.models.flexible.surroundings.rock import ENOUGH, RockMaterial, full_rock, reduced_rock, smooth_tractions
from shared.exact_rock import strip_compliance

HALF = 40.0
X = np.linspace(-HALF, HALF, 17)
BASE = np.column_stack([X, 0.0 * X])
ROCK = RockMaterial(20e9, 0.33, 2650.0)


@pytest.fixture(scope="module")
def full():
    return full_rock(BASE, ROCK, highest=40.0)


@pytest.fixture(scope="module")
def coarse():
    return full_rock(BASE, ROCK)


@pytest.fixture(scope="module")
def larger():
    reach = {"highest": 22.5, "extent": 150.0}
    return full_rock(BASE, ROCK, **reach), reduced_rock(BASE, ROCK, **reach)


@pytest.fixture(scope="module")
def reduced():
    return reduced_rock(BASE, ROCK)


@pytest.mark.parametrize(
    "ratio", [0.1, 0.5, 6.0, *(pytest.param(ratio, marks=pytest.mark.slow) for ratio in (0.25, 1.0, 1.5, 3.0))]
)
def test_strip_on_the_half_plane(full, ratio):
    """All elements, and the losses of the reference, which are the same at all frequencies."""
    omega = ratio * ROCK.shear_speed / HALF
    forces = np.zeros((full.mass.shape[0], 2), dtype=complex)
    tractions = smooth_tractions(BASE)[:, :2]
    forces[full.base] = tractions
    operator = full.stiffness * (1.0 + 0.04j) + 1j * omega * full.damping_radiation - omega**2 * full.mass
    moved = splu(operator.tocsc()).solve(forces)[full.base]
    vertical, horizontal = strip_compliance(ratio, ROCK.poisson, 0.02)
    assert abs(tractions[:, 0] @ moved[:, 0] * ROCK.shear - horizontal) < 0.03 * abs(horizontal)
    assert abs(tractions[:, 1] @ moved[:, 1] * ROCK.shear - vertical) < 0.03 * abs(vertical)


def test_table_of_the_half_plane():
    """The closed form beside figures that another program of this project has given."""
    vertical, horizontal = strip_compliance(1.0, 0.33, 0.02)
    assert vertical == pytest.approx(0.10221 - 0.26326j, abs=2e-4)
    assert horizontal == pytest.approx(0.23285 - 0.30403j, abs=2e-4)


@pytest.fixture(scope="module")
def soft():
    material = replace(ROCK, modulus=10e9)
    return full_rock(BASE, material), reduced_rock(BASE, material)


# From far below all modes of a dam, past the lowest modes of all elements, to the highest frequency; the answers are
# worst at 13.5 to 14.5 and 20 to 22 Hz.
@pytest.mark.parametrize("frequency", [0.05, 0.2, 0.3, 0.5, 1.0, 2.0, 4.0, 7.0, 10.0, 12.5, 13.7, 14.3, 15.0])
def test_few_unknowns_answer_as_all_do(coarse, reduced, frequency):
    _answers_as(coarse, reduced, frequency)


@pytest.mark.parametrize("frequency", [0.2, 0.3, 0.4, 0.55, 1.0, 6.0, 14.0, 20.0, 20.9, 22.4])
def test_a_larger_box_answers_far_below_all_modes_of_a_dam(frequency, larger):
    """Its own modes are there: few unknowns that were not chosen there err by a fifth."""
    _answers_as(*larger, frequency)


@pytest.mark.parametrize("frequency", [0.2, 0.3, 0.55, 1.0, 6.0, 12.5, 13.7, 14.3])
def test_rock_of_half_the_modulus_answers_as_well(frequency, soft):
    _answers_as(*soft, frequency)


@pytest.mark.slow
def test_soft_rock_has_as_many_shapes_as_it_needs():
    assert reduced_rock(BASE, RockMaterial(3e9, 0.33, 2650.0)).error <= ENOUGH


def test_each_node_keeps_its_static_flexibility(coarse, reduced):
    full = coarse
    unit = np.zeros((full.mass.shape[0], full.base.size))
    unit[full.base] = np.eye(full.base.size)
    exact = splu(full.stiffness.tocsc()).solve(unit)[full.base]
    assert reduced.compliance(0.0, np.eye(full.base.size)).real == pytest.approx(
        exact, rel=1e-6, abs=1e-8 * exact.max()
    )


def test_rock_that_is_not_the_same_on_both_sides_answers_alike(reduced):
    """Nodes that are no mirror of each other leave one problem, not two of half its size."""
    uneven = BASE + np.column_stack([1e-3 * HALF * np.cos(np.pi * X / (2.0 * HALF)), 0.0 * X])
    whole = reduced_rock(uneven, ROCK)
    assert whole.error <= ENOUGH
    for frequency in (0.0, 2.0, 9.0):
        omega = 2.0 * np.pi * frequency
        one, other = (
            tractions.T @ rock.compliance(omega, tractions)
            for rock, tractions in ((reduced, smooth_tractions(BASE)), (whole, smooth_tractions(uneven)))
        )
        size = np.sqrt(np.abs(np.diag(one)))
        assert np.abs((one - other) / np.outer(size, size)).max() < 0.02


def test_a_base_tied_to_fewer_nodes_is_that_of_a_coarser_mesh(reduced):
    fewer = BASE[::2]
    tied, own = reduced.followed(BASE, fewer), reduced_rock(fewer, ROCK)
    assert tied.omega_squared.size == reduced.omega_squared.size - 2 * (len(BASE) - len(fewer))
    assert np.linalg.eigvalsh(tied.damping)[0] > -1e-9 * np.abs(tied.damping).max()
    unit = np.eye(2 * len(fewer))
    assert tied.compliance(0.0, unit) == pytest.approx(own.compliance(0.0, unit), rel=1e-6, abs=1e-17)
    tractions = smooth_tractions(fewer)[:, :4]
    for frequency in (1.0, 4.0, 11.0):
        one, other = (tractions.T @ rock.compliance(2.0 * np.pi * frequency, tractions) for rock in (tied, own))
        assert np.abs(one - other).max() < 0.02 * np.abs(other).max()


def test_rock_takes_and_never_gives(reduced):
    assert reduced.damping == pytest.approx(reduced.damping_material + reduced.damping_radiation)
    assert np.linalg.eigvalsh(reduced.damping)[0] > -1e-9 * np.abs(reduced.damping).max()
    for frequency in (0.3, 1.0, 3.0, 8.0, 20.0, 60.0):
        omega = 2.0 * np.pi * frequency
        mobility = 1j * omega * reduced.compliance(omega, np.eye(2 * len(BASE)))
        assert np.linalg.eigvalsh((mobility + mobility.conj().T) / 2.0)[0] > -1e-9 * np.abs(mobility).max()


@pytest.mark.slow
def test_larger_box_answers_the_same(full):
    larger = full_rock(BASE, ROCK, highest=40.0, extent=150.0)
    tractions = smooth_tractions(BASE)[:, :2]
    for frequency in (1.0, 3.0, 10.0):
        answers = []
        for rock in (full, larger):
            forces = np.zeros((rock.mass.shape[0], 2))
            forces[rock.base] = tractions
            moved = rock.body.response(2j * np.pi * frequency, forces)[rock.base]
            answers.append(np.array([tractions[:, axis] @ moved[:, axis] for axis in (0, 1)]))
        assert np.abs(answers[0] - answers[1]).max() < 0.02 * np.abs(answers[1]).max()


def test_stiff_rock_stands_still(reduced):
    stiff = reduced_rock(BASE, RockMaterial(20e12, 0.33, 2650.0))
    omega = 2.0 * np.pi * 3.0
    force = smooth_tractions(BASE)[:, :2]
    assert np.abs(stiff.compliance(omega, force)).max() < 4e-3 * np.abs(reduced.compliance(omega, force)).max()


def test_rock_without_mass_has_no_waves():
    material = RockMaterial(20e9, 0.33, 2650.0, radiation=False, massless=True)
    rock = reduced_rock(BASE, material, extent=8.0)
    assert not rock.damping.any()
    static = rock.compliance(0.0, np.eye(2 * len(BASE)))
    moving = rock.compliance(2.0 * np.pi * 15.0, np.eye(2 * len(BASE)))
    assert moving == pytest.approx(static, rel=1e-3, abs=1e-4 * np.abs(static).max())


def test_materials_own_damping_is_the_ratio_at_its_frequency():
    material = RockMaterial(20e9, 0.33, 2650.0, damping=0.03, damping_frequency=4.0, radiation=False, massless=True)
    rock = reduced_rock(BASE, material, extent=8.0)
    answer = smooth_tractions(BASE)[:, 0] @ rock.compliance(2.0 * np.pi * 4.0, smooth_tractions(BASE)[:, 0])
    assert -answer.imag / answer.real == pytest.approx(2.0 * 0.03, rel=0.02)


def test_speeds_of_waves():
    assert ROCK.shear_speed == pytest.approx(np.sqrt(20e9 / 2.66 / 2650.0))
    assert ROCK.pressure_speed / ROCK.shear_speed == pytest.approx(np.sqrt(2.0 * 0.67 / 0.34))


def test_stiffer_rock_has_the_same_shapes(coarse, reduced):
    """All equations of the rock scale: stiffness with the modulus and what leaves with its root, in the finite elements
    of rock of that modulus too, which carry waves up to a frequency that goes with the root; and those answer alike."""
    factor = 2.0
    full = full_rock(BASE, replace(ROCK, modulus=factor * ROCK.modulus), highest=math.sqrt(factor) * 15.0)
    pairs = ((full.stiffness, coarse.stiffness, factor), (full.mass, coarse.mass, 1.0))
    leaving = (full.damping_radiation, coarse.damping_radiation, math.sqrt(factor))
    for matrix, other, by in (*pairs, leaving):
        assert abs(matrix - by * other).max() <= 1e-12 * abs(matrix).max()
    _answers_as(full, reduced.stiffer(factor), math.sqrt(factor) * 11.0)


def _answers_as(full, reduced, frequency):
    """No answer is farther off than the reduction may leave and has found, although it has looked elsewhere."""
    omega = 2.0 * np.pi * frequency
    tractions = smooth_tractions(BASE)
    forces = np.zeros((full.mass.shape[0], tractions.shape[1]))
    forces[full.base] = tractions
    exact = tractions.T @ full.body.response(1j * omega, forces)[full.base]
    off = tractions.T @ reduced.compliance(omega, tractions) - exact
    size = np.sqrt(np.abs(np.diag(exact)))
    assert np.abs(off / np.outer(size, size)).max() <= reduced.error <= ENOUGH
