"""The motion of the crack: the recurrence against closed forms, the attached mass against beam theory."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from heeltoe import GroundMotion, InputError, build_block, response_spectrum
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.decoupled.chain import Chain, attached_mass, bonded_chain, chain, face_shares, plane_fit
from heeltoe.models.decoupled.crack_motion import STRAIGHT, accelerations, crack_motion
from heeltoe.models.flexible.body.elastic import dofs
from heeltoe.models.flexible.body.modes import intact_periods
from heeltoe.models.flexible.mesh.dam import dam_mesh
from heeltoe.motion.earthquake import Earthquake
from shared.dams import BASE, KOYNA, example, plane_case

COARSE = "flexible.elements_across=3"
# Slender enough for Euler and Bernoulli: 2 m wide, 60 m high, cracked at 40 m.
TOWER = {
    "section": {"polygon": [["0 m", "0 m"], ["2 m", "0 m"], ["2 m", "60 m"], ["0 m", "60 m"]]},
    "concrete": {"density": "2400 kg/m^3", "modulus": "20 GPa", "poisson": 0.0},
    "crack": {"friction": 1.0, "elevation": "40 m"},
    "flexible": {"elements_across": 2},
}


def oscillator(period: float, damping: float) -> Chain:
    """One mode, in which the crack moves as the oscillator does."""
    return Chain(np.array([2.0 * math.pi / period]), np.array([[1.0, 0.0]]), np.array([[1.0], [0.0], [0.0]]), damping)


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.7])
def test_a_step_and_a_ramp(damping):
    w = 2.0 * math.pi / 0.3
    wd, fade = w * math.sqrt(1.0 - damping**2), damping * w
    one = oscillator(0.3, damping)
    # A constant acceleration from the start: q'' = -a exp(-dwt) (cos - dw/wd sin), in one piece and in many.
    for time in (np.array([0.0, 2.0]), np.array([0.0, 0.013, 0.5, 0.51, 2.0])):
        t, crack, ground = accelerations(one, Shaking(time, np.full(time.size, 3.0)), 1e-2)
        swing = np.exp(-fade * t) * (np.cos(wd * t) - fade / wd * np.sin(wd * t))
        assert crack[0] == pytest.approx(3.0 - 3.0 * swing, abs=1e-12)
        assert ground[0] == pytest.approx(3.0, rel=1e-15)
        assert np.all(crack[1:] == 0.0)
    # A ramp: q'' = -r exp(-dwt) sin(wd t) / wd.
    t, crack, _ = accelerations(one, Shaking(np.array([0.0, 0.7, 1.0]), np.array([0.0, 1.4, 2.0])), 1e-2)
    assert crack[0] == pytest.approx(2.0 * t - 2.0 * np.exp(-fade * t) * np.sin(wd * t) / wd, abs=1e-12)


def test_a_jump_is_there_twice_and_acts_at_once():
    one = oscillator(0.3, 0.05)
    time, push = np.array([0.0, 0.5, 0.5, 1.0]), np.array([0.0, 0.0, 2.0, 2.0])
    t, crack, ground = accelerations(one, Shaking(time, push), 0.01)
    assert np.flatnonzero(np.diff(t) == 0.0).tolist() == [50]
    assert (ground[0, 50], ground[0, 51]) == (0.0, 2.0)
    # The oscillator cannot follow at once: its total acceleration starts from zero.
    assert crack[0, 51] == pytest.approx(0.0, abs=1e-12)
    _, same, _ = accelerations(one, Shaking(np.array([0.0, 0.5]), np.array([2.0, 2.0])), 0.01)
    assert crack[0, 51:] == pytest.approx(same[0], abs=1e-12)


def test_several_modes_both_ways_against_a_general_solver():
    rng = np.random.default_rng(1)
    w = np.array([9.0, 25.0, 61.0])
    several = Chain(w, rng.standard_normal((3, 2)), rng.standard_normal((3, 3)), 0.05)
    time = np.cumsum(np.concatenate([[0.0], rng.uniform(0.005, 0.05, 60)]))
    across, up = rng.standard_normal((2, time.size))

    def slope(t, state):
        load = -several.participation @ [np.interp(t, time, across), np.interp(t, time, up)]
        return np.concatenate([state[3:], load - 0.1 * w * state[3:] - w**2 * state[:3]])

    t, crack, ground = accelerations(several, Shaking(time, across, up), 0.004)
    result = solve_ivp(
        slope, (0.0, time[-1]), np.zeros(6), t_eval=t[t <= time[-1]], rtol=1e-9, atol=1e-12, max_step=2e-3
    )
    swing = np.array([slope(moment, state)[3:] for moment, state in zip(result.t, result.y.T, strict=True)]).T
    expected = several.shapes @ swing
    expected[:2] += ground
    assert crack == pytest.approx(expected, abs=2e-5)


def test_an_oscillator_is_one_of_the_response_spectrum():
    rng = np.random.default_rng(2)
    motion = GroundMotion.from_points(np.arange(400) * 0.02, np.cumsum(rng.standard_normal(400)) * 0.1)
    result, straightness = crack_motion(oscillator(0.2, 0.05), Earthquake(motion, None, motion.duration))
    spectrum = response_spectrum(motion, [0.2], 0.05)
    assert result.horizontal.pga == pytest.approx(float(spectrum.total_acceleration[0]), rel=1e-3)
    assert 0.0 < straightness <= STRAIGHT
    assert result.step == pytest.approx(5e-4)


def test_the_transfer_function_is_what_a_steady_vibration_does():
    one = oscillator(0.25, 0.05)
    period = 0.4
    time = np.arange(0.0, 40.0, 1e-3)
    _, crack, _ = accelerations(one, Shaking(time, np.sin(2.0 * math.pi * time / period)), 1.0)
    assert np.abs(crack[0, -2000:]).max() == pytest.approx(float(one.transfer(np.array([period]))[0]), rel=1e-4)
    # The closed form of a damped oscillator.
    r, d = 0.25 / period, 0.05
    expected = math.sqrt((1.0 + (2 * d * r) ** 2) / ((1.0 - r**2) ** 2 + (2 * d * r) ** 2))
    assert one.transfer(np.array([period])) == pytest.approx([expected], rel=1e-12)


def test_a_rigid_motion_of_the_face_is_taken_for_what_it_is():
    case = plane_case(KOYNA, ["flexible.elements_across=5"])
    section = case.cut
    mesh = dam_mesh(case).lower
    x, z = mesh.nodes.T
    moved = np.empty(mesh.nodes.size)
    middle = section.crack_width / 2.0
    moved[::2], moved[1::2] = 0.3 - 0.01 * (z - 66.5), -0.2 + 0.01 * (x - middle)
    fit = plane_fit(mesh)
    assert fit @ moved == pytest.approx([0.3, -0.2, 0.01], rel=1e-12)
    # Only the face counts, and a bulge of it is no rotation.
    assert set(np.unique(fit.nonzero()[1])) <= set(dofs(mesh.crack))
    bulge = np.zeros(mesh.nodes.size)
    bulge[1::2] = (x - middle) ** 2
    assert (fit @ bulge)[[0, 2]] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert (fit @ bulge)[1] == pytest.approx(section.crack_width**2 / 12.0, rel=1e-9)


@pytest.mark.parametrize("inclination", ["0 deg", "15 deg"])
def test_a_mass_on_the_crack_is_spread_evenly(inclination):
    case = plane_case(KOYNA, ["flexible.elements_across=5", f"crack.inclination={inclination}"])
    mesh = dam_mesh(case).lower
    shares = face_shares(mesh)
    along = mesh.nodes[mesh.crack] - mesh.nodes[mesh.crack[0]]
    s = np.hypot(*along.T) / np.hypot(*along[-1])
    # Of fields up to quadratic ones the integrals are exact.
    for a, b in ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)):
        assert s**a @ shares @ s**b == pytest.approx(1.0 / (a + b + 1), rel=1e-9)
    assert shares == pytest.approx(shares.T, abs=1e-15)


def test_the_mass_on_the_crack_is_that_of_the_concrete_above():
    def first_period(*more):
        return chain(plane_case(KOYNA, ["flexible.elements_across=3", *more])).periods[0]

    on_crack, dry = "decoupled.upper_part=mass on the crack", "reservoir.depth=0m"
    light = first_period(on_crack, dry)
    # A dam of twice the density swings in the root of two times the period.
    assert first_period(on_crack, dry, "concrete.density=5286 kg/m^3") == pytest.approx(math.sqrt(2.0) * light)
    # Without lever arm and inertia it swings faster; no virtual water of the part above comes with it.
    assert first_period(dry) > 1.1 * light
    above = "flexible.virtual_mass=thesis"
    assert first_period(on_crack, above) == pytest.approx(light, rel=1e-9)
    assert first_period(above) > 1.02 * first_period(dry)


def test_the_attached_mass_has_the_energy_of_the_block():
    case = plane_case(KOYNA)
    block = build_block(case)
    mass = attached_mass(case, block)
    motion = np.array([0.7, -0.4, 0.02])
    # The block's reference point, from the middle of the crack.
    x, z = block.heel_distance - block.width / 2.0, block.height
    y, up, turn = motion[0] - z * motion[2], motion[1] + x * motion[2], motion[2]
    energy = block.mass_horizontal * y**2 + block.mass_vertical * up**2 + block.inertia * turn**2
    assert motion @ mass @ motion == pytest.approx(energy, rel=1e-12)
    assert mass[0, 0] - mass[1, 1] == pytest.approx(block.water.mass)


def test_a_tower_that_carries_a_block():
    """Euler and Bernoulli's cantilever of 40 m with a rigid block of 20 m on its end."""
    rigidity, line, length = 20e9 * 2.0**3 / 12.0, 2400.0 * 2.0, 40.0
    top, arm, inertia = line * 20.0, 10.0, line * 20.0 * (20.0**2 + 2.0**2) / 12.0

    def determinant(w: float) -> float:
        k = (line * w**2 / rigidity) ** 0.25
        a = k * length
        c, s, ch, sh = math.cos(a), math.sin(a), math.cosh(a), math.sinh(a)
        # Deflection, slope, bending and its change of cosh - cos and of sinh - sin at the end.
        shapes = [
            (ch - c, k * (sh + s), k**2 * (ch + c), k**3 * (sh - s)),
            (sh - s, k * (ch - c), k**2 * (sh + s), k**3 * (ch + c)),
        ]
        moment, shear = (
            [
                rigidity * bend - w**2 * ((inertia + top * arm**2) * slope + top * arm * place)
                for place, slope, bend, _ in shapes
            ],
            [rigidity * change + w**2 * top * (place + arm * slope) for place, slope, _, change in shapes],
        )
        return moment[0] * shear[1] - moment[1] * shear[0]

    periods = chain(plane_case(TOWER)).periods
    for place, (low, high) in enumerate(((0.5, 5.0), (5.0, 20.0))):
        assert periods[place] == pytest.approx(2.0 * math.pi / brentq(determinant, low, high), rel=0.01)
    # As long as that of the whole tower, a little less for the rigid top.
    assert 0.9 < periods[0] / bonded_chain(plane_case(TOWER)).periods[0] < 1.0


def test_the_whole_dam_is_that_of_the_flexible_model():
    # With the damping of the thesis the flexible dam has the even elements of the chain, too; periods have no damping.
    case = plane_case(KOYNA, [COARSE, "flexible.damping=thesis"])
    from heeltoe import build_flexible_dam

    assert bonded_chain(case).periods[:5] == pytest.approx(intact_periods(build_flexible_dam(case), 5), rel=1e-9)


def test_a_stiff_dam_hands_on_the_motion_of_the_ground():
    rng = np.random.default_rng(3)
    motion = GroundMotion.from_points(np.arange(100) * 0.02, rng.standard_normal(100))
    up = GroundMotion.from_points(np.arange(150) * 0.015, rng.standard_normal(150))
    stiff = chain(plane_case(KOYNA, [COARSE, "concrete.modulus=1e15 Pa"]))
    # All its modes are faster than anything in an accelerogram.
    assert stiff.omega.size == 0
    result, straightness = crack_motion(stiff, Earthquake(motion, up, 2.0))
    assert straightness < 1e-12
    for each, source in ((result.horizontal, motion), (result.vertical, up)):
        # Up to where the first of them ends, which is a jump to zero.
        moments = np.linspace(0.0, 1.97, 77)
        expected = np.interp(moments, source.time, source.acceleration)
        assert np.interp(moments, each.time, each.acceleration) == pytest.approx(expected, abs=1e-12)
    assert np.all(result.rotation.acceleration == 0.0)
    firm = chain(plane_case(KOYNA, [COARSE, "concrete.modulus=3.1e13 Pa"]))
    soft = chain(plane_case(KOYNA, [COARSE]))
    assert firm.periods[0] == pytest.approx(soft.periods[0] / math.sqrt(1000.0), rel=1e-6)
    assert firm.transfer(np.array([1.0])) == pytest.approx([1.0], abs=1e-3)


def test_the_motion_turned_round_turns_the_crack_round():
    case = plane_case(KOYNA, [COARSE])
    rng = np.random.default_rng(4)
    motion = GroundMotion.from_points(np.arange(200) * 0.01, rng.standard_normal(200))
    plain, _ = crack_motion(chain(case), Earthquake(motion, None, 3.0))
    turned, _ = crack_motion(chain(case), Earthquake(motion.reversed(), None, 3.0))
    for name in ("horizontal", "vertical", "rotation"):
        one, other = getattr(plain, name), getattr(turned, name)
        assert np.all(one.acceleration == -other.acceleration)
        assert one.duration == 3.0
    # The ground has stopped at 1.99 s, and the dam still vibrates.
    late = plain.horizontal.time > 2.0
    assert np.abs(plain.horizontal.acceleration[late]).max() > 0.01 * plain.horizontal.pga


def test_a_crack_at_the_base_has_nothing_below():
    for build in (chain, bonded_chain):
        with pytest.raises(InputError) as refused:
            build(plane_case(BASE))
        assert refused.value.code == "crack-at-base"
    with pytest.raises(InputError) as refused:
        chain(plane_case({**TOWER, "concrete": {"density": "2400 kg/m^3"}}))
    assert refused.value.code == "missing"


def test_the_chain_takes_compressible_water_as_a_mass():
    case = example("typical-height")
    sound = case.with_("reservoir.compressible=true")
    assert chain(sound).periods.tolist() == chain(case).periods.tolist()
    assert bonded_chain(sound).periods.tolist() == bonded_chain(case).periods.tolist()
    dry = case.with_({"reservoir": None})
    assert chain(dry).periods[0] < 0.9 * chain(case).periods[0]
