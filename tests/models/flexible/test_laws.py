"""Laws that the whole model obeys, from the case to the response, with its own start and damping."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import GroundMotion, flexible, rigid
from shared.dams import plane_case, polygon

G = 9.80665
CORNERS = [(0.0, 0.0), (24.0, 0.0), (8.0, 20.0), (6.0, 30.0), (0.0, 30.0)]
TIME = np.linspace(0.0, 2.0, 401)
SHAKING = sum(np.sin(2.0 * np.pi * TIME / period + k) for k, period in enumerate((0.5, 0.37, 0.21)))
SHAKING *= 0.3 * G * np.sin(np.pi * TIME / 2.0) ** 2


def case(corners=CORNERS, modulus=20.0, friction=0.6, **blocks):
    blocks = {"reservoir": {"depth": "20 m"}, "crack": {"friction": friction}} | blocks
    return plane_case(
        {
            "section": polygon(corners),
            "concrete": {"modulus": f"{modulus} GPa"},
            "flexible": {"elements_across": 3, "evidence": "none"} | blocks.pop("flexible", {}),
            **{name: block for name, block in blocks.items() if block is not None},
        }
    )


def motion(factor=1.0, time=TIME):
    return GroundMotion.from_points(np.append(time, 1.5 * time[-1]), np.append(factor * SHAKING, 0.0))


def test_a_dam_that_hardly_gives_is_the_rigid_one():
    stiff = case(modulus=2e5, friction=0.3, reservoir={"depth": "16 m"}, flexible={"elements_across": 2})
    dam, block = flexible(stiff, motion()), rigid(stiff, motion())
    assert block.residual_slip_m > 0.05
    assert dam.residual_slip_m == pytest.approx(block.residual_slip_m, rel=1e-3)


def test_a_mirror_image_moves_the_other_way():
    mirrored = [(24.0 - x, z) for x, z in reversed(CORNERS)]
    one = flexible(case(flexible={"time_step": "0.2 ms"}), motion())
    water = {"reservoir": None, "tailwater": {"depth": "20 m", "compressible": False}}
    other = flexible(case(mirrored, flexible={"time_step": "0.2 ms"}, **water), motion(-1.0))
    assert one.residual_slip_m > 0.02
    assert other.residual_slip_m == pytest.approx(-one.residual_slip_m, rel=1e-6)
    assert other.opening_downstream_m == pytest.approx(one.opening_upstream_m, rel=1e-6)
    assert other.rocking_upstream_rad == pytest.approx(one.rocking_downstream_rad, rel=1e-6)
    assert other.damping_ratios == pytest.approx(one.damping_ratios, rel=1e-8)


@pytest.mark.parametrize("factor", [4.0])
def test_a_larger_dam_moves_as_much_more(factor):
    # Lengths and modulus times the factor, times and steps times its root, the same accelerations.
    larger = [(factor * x, factor * z) for x, z in CORNERS]
    one = flexible(case(flexible={"time_step": "0.2 ms"}), motion())
    options = {"time_step": f"{0.2 * factor**0.5} ms"}
    scaled = case(larger, 20.0 * factor, reservoir={"depth": f"{20.0 * factor} m"}, flexible=options)
    other = flexible(scaled, motion(time=TIME * factor**0.5))
    assert other.residual_slip_m == pytest.approx(factor * one.residual_slip_m, rel=1e-6)
    assert other.opening_upstream_m == pytest.approx(factor * one.opening_upstream_m, rel=1e-6)
    assert other.periods_s == pytest.approx([factor**0.5 * period for period in one.periods_s], rel=1e-8)
    # Energies per metre go with density, g and the cube of the lengths.
    assert other.energy.friction_j == pytest.approx(factor**3 * one.energy.friction_j, rel=1e-6)


@pytest.mark.parametrize("damping", ["relative", "stiffness"])
def test_friction_and_push_make_all_the_momentum(damping):
    # Neither choice holds a dam back that slides as a whole.
    step = 1e-3
    soft = case(modulus=2.0, flexible={"time_step": f"{step} s", "damping": damping})
    response = flexible(soft, motion(), output_step=step)
    part, body = response.crack.dam.reduced[0], response.crack.dam.upper
    velocity = np.gradient(response.crack.modes[0] @ part.participation_horizontal, step)[-2]
    mass = body.mass[::2, ::2].sum()
    pushed = body.load[::2].sum() * response.crack.time[-2]
    given = response.histories["friction_force_n"][1:-1].sum() * step
    shaken = mass * np.trapezoid(SHAKING, TIME)
    assert response.residual_slip_m > 0.02
    assert given == pytest.approx(shaken - pushed + velocity, abs=1e-6 * pushed)


@pytest.mark.parametrize("elevation", ["0 m", "12 m"])
def test_the_ledger_closes(elevation):
    response = flexible(case(crack={"friction": 0.6, "elevation": elevation}), motion())
    energy = response.energy
    assert abs(response.residual_slip_m) > 1e-3
    assert energy.residual < 1e-12
    losses = energy.friction_j + energy.impact_j + energy.damping_j + energy.numerical_j
    assert losses + energy.left_j == pytest.approx(energy.input_j, rel=1e-6)
    assert energy.gained_j < 1e-5 * energy.input_j
