"""An earthquake by its response spectrum: the beam of the textbooks, time histories, and what the checks make of it."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from heeltoe import InputError, en_1998, read_case, statics_of_sections, with_response_spectrum
from heeltoe.case.shaking import resolve
from heeltoe.models.flexible.surroundings.lowest_modes import SectionForces, lowest_modes
from heeltoe.study.small.response_spectrum import _spectrum_of
from shared.command import command
from shared.dams import BLOCK, HEIGHT, example, plane_case

# Slender enough for Euler and Bernoulli: 2 m wide, 60 m high.
TOWER = {
    "section": {"polygon": [["0 m", "0 m"], ["2 m", "0 m"], ["2 m", "60 m"], ["0 m", "60 m"]]},
    "concrete": {"density": "2400 kg/m^3", "modulus": "20 GPa", "poisson": 0.0},
    "crack": {"friction": 1.0},
    "flexible": {"elements_across": 2},
}
COARSE = "flexible.elements_across=4"
DESIGN = "en1998:0.02 g,B"
G = 9.80665


# Roots of the frequency equation of a cantilever.
ROOTS = (1.875104068711961, 4.694091132974175)


def cantilever(root: float) -> tuple[float, float]:
    """Share of its mass in a mode of a cantilever, and the height of that push over its own."""
    at = np.linspace(0.0, 1.0, 20001)
    ratio = (np.cosh(root) + np.cos(root)) / (np.sinh(root) + np.sin(root))
    shape = np.cosh(root * at) - np.cos(root * at) - ratio * (np.sinh(root * at) - np.sin(root * at))
    mean, square, lever = (np.trapezoid(values, at) for values in (shape, shape**2, at * shape))
    return float(mean**2 / square), float(lever / mean)


@pytest.mark.parametrize("modulus", [20e9, 2e12])
def test_a_cantilever_by_hand(modulus):
    """Both modes of Euler and Bernoulli; both slow, then both partly going with the ground."""
    case = plane_case(TOWER).with_(f"concrete.modulus={modulus} Pa")
    (joint,) = with_response_spectrum(statics_of_sections(case), DESIGN).joints
    mass, ground = 2.0 * 60.0 * 2400.0, 0.02 * G * 1.2
    periods = [2.0 * math.pi * 60.0**2 / root**2 * math.sqrt(2400.0 / (modulus * 2.0**2 / 12.0)) for root in ROOTS]
    accelerations = en_1998(0.02 * G, "B")(periods)
    # Largest acceleration and velocity of that spectrum meet at 0.5 s; (2 + 2 * 33) / 3 Hz.
    with_ground = [min(1.0, max(0.0, math.log(0.5 / period) / math.log(34.0 / 3.0))) for period in periods]
    pushes = []
    for length in (False, True):
        parts = [share * (60.0 * height if length else 1.0) for share, height in map(cantilever, ROOTS)]
        whole = 30.0 if length else 1.0
        moved = [mass * part * acceleration for part, acceleration in zip(parts, accelerations, strict=True)]
        summed = mass * ground * (whole - sum(parts)) + np.dot(moved, with_ground)
        pushes.append(math.hypot(summed, *np.array(moved) * np.sqrt(1.0 - np.square(with_ground))))
    shear, moment = pushes
    result = joint.statics.response_spectrum
    for mode, period, share in zip((result.first_mode, result.second_mode), periods, with_ground, strict=True):
        # Shear takes its part of the second period.
        assert mode.period_s == pytest.approx(period, rel=0.005 if mode is result.first_mode else 0.015)
        assert mode.damping_ratio == pytest.approx(0.05, rel=0.03)
        assert mode.rigid_share == pytest.approx(share, abs=0.01)
    downstream, upstream = (case for case in joint.statics.cases if case.name.startswith("response spectrum"))
    assert downstream.shear_force_n == pytest.approx(shear, rel=0.01)
    assert upstream.shear_force_n == pytest.approx(-downstream.shear_force_n, rel=1e-9)
    assert result.push().moment == pytest.approx(-moment, rel=0.01)
    weight = mass * G
    assert downstream.normal_force_n == pytest.approx(weight, rel=1e-9)
    assert downstream.sliding_factor == pytest.approx(weight / shear, rel=0.01)
    if modulus == 20e9:
        assert downstream.resultant_from_heel_m == pytest.approx(1.0 + moment / weight, rel=0.01)


def test_a_stiff_dam_moves_with_the_ground():
    modes = lowest_modes(example("typical-height", COARSE, "concrete.modulus=1e5 GPa"), "spectrum")
    case = example("typical-height", COARSE)
    block = with_response_spectrum(statics_of_sections(case.with_("statics.seismic_coefficient=0.1")), DESIGN)
    forces = next(c for c in block.joints[0].statics.cases if c.name == "pseudo-static downstream").forces
    pushed = sum(force.horizontal for force in forces if force.name in ("inertia", "hydrodynamic"))
    # Those of the block, but for the water's mass on elements.
    assert modes.rigid[0] == pytest.approx(pushed / (0.1 * case.gravity), rel=0.01)
    assert modes.first.period < 0.01


def made_to_order(request):
    return [f"synthetic:M6.5,20km,seed={seed + 1}" for seed in range(10)]


def measured(request):
    return [str(path) for path in sorted(request.getfixturevalue("records").glob("ensemble/*"))[::3]]


@pytest.mark.slow
@pytest.mark.parametrize("motions", [made_to_order, measured])
@pytest.mark.parametrize(("dam", "crack"), [("on-rock", "0 m"), ("typical-base", "0 m"), ("typical-height", "20 m")])
def test_time_histories_have_the_same_peaks_in_the_mean(dam, crack, motions, request):
    """Ten motions and more on a dam, bonded, by the frequency domain, beside the spectrum: on rock before water with
    sound, on rigid rock, cracked above its base."""
    case = example(dam, COARSE, f"crack.elevation={crack}")
    section = SectionForces.of(case, 6.0)
    step, count = 0.02, 2048
    frequencies = np.fft.rfftfreq(count, step)
    sampled = np.linspace(0.05, 15.0, 200)
    answers = CubicSpline(sampled, [section.at(2.0 * np.pi * frequency) for frequency in sampled])
    transfer = np.where((frequencies > 0.05) & (frequencies < 15.0), answers(frequencies).T, 0.0)
    ratios = []
    for file in motions(request):
        shaken = case.with_(f'motion.file="{file}"')
        motion, _ = resolve(shaken.motion, shaken.gravity, shaken.base_directory)
        ground = np.interp(step * np.arange(count), motion.time, motion.acceleration, right=0.0)
        histories = np.fft.irfft(transfer * np.fft.rfft(ground), count)
        push = with_response_spectrum(statics_of_sections(shaken)).joints[0].statics.response_spectrum.push()
        ratios.append(np.abs([push.horizontal, push.moment]) / np.abs(histories[[0, 2]]).max(axis=1))
    assert len(ratios) >= 10
    assert np.mean(ratios, axis=0) == pytest.approx(1.0, abs=0.1)
    assert np.min(np.mean(ratios, axis=0)) > 0.94


def test_checks_stand_before_what_comes_after():
    case = example("typical-height", COARSE, "statics.residual_slip=0.01m")
    judged = statics_of_sections(case)
    joints = with_response_spectrum(judged, "motion")
    before, after = judged.joints[0].statics, joints.joints[0].statics
    names = [load_case.name for load_case in after.cases]
    assert names == ["usual", "response spectrum downstream", "response spectrum upstream", "post-seismic"]
    order = list(dict.fromkeys(check.load_case for check in after.checks))
    assert order == names
    assert [check for check in after.checks if not check.load_case.startswith("response")] == list(before.checks)
    # The motion is that of the case, whose spectrum stands at the first period for that dam's damping.
    demand = after.response_spectrum
    motion, _ = resolve(case.motion, case.gravity, case.base_directory)
    assert demand.peak_ground_acceleration_m_s2 == pytest.approx(motion.pga)
    assert demand.spectrum == motion.name
    # What the block does not read, the elastic dam does.
    unread = [dict(notice.quantities)["fields"] for notice in before.warnings if notice.code == "fields-unused"]
    assert "concrete.modulus" in unread[0]
    assert not any("concrete.modulus" in str(notice) for notice in after.warnings)
    assert (
        json.loads(json.dumps(after.to_json(), allow_nan=False))["response_spectrum"]["together"]["horizontal_n"] > 0.0
    )


def test_rock_and_water_change_what_is_asked():
    dam = example("typical-base", COARSE)
    rigid, soft = (
        with_response_spectrum(statics_of_sections(case), "motion").joints[0].statics.response_spectrum
        for case in (dam, dam.with_("rock.modulus=20 GPa"))
    )
    assert soft.first_mode.period_s > 1.1 * rigid.first_mode.period_s
    assert soft.first_mode.damping_ratio > 1.5 * rigid.first_mode.damping_ratio


@pytest.mark.parametrize(
    ("changes", "spectrum", "code", "field"),
    [
        (["concrete.damping=0.6"], DESIGN, "no-first-mode", "spectrum"),
        ([], "en1999:0.3 g,B", "target-form", "spectrum"),
    ],
)
def test_what_has_no_spectrum_is_refused(changes, spectrum, code, field):
    judged = statics_of_sections(example("typical-height", COARSE, *changes))
    with pytest.raises(InputError) as refused:
        with_response_spectrum(judged, spectrum)
    assert (refused.value.code, refused.value.field) == (code, field)


def test_a_dam_without_a_modulus_or_a_motion_is_refused():
    with pytest.raises(InputError) as refused:
        with_response_spectrum(statics_of_sections(read_case(BLOCK)), DESIGN)
    assert refused.value.code == "missing"
    with pytest.raises(InputError) as refused:
        with_response_spectrum(statics_of_sections(plane_case(TOWER)), "motion")
    assert refused.value.code == "motion-missing"
    with pytest.raises(InputError) as refused:
        with_response_spectrum(plane_case(TOWER), "motion")
    assert refused.value.code == "wrong-kind"


@pytest.mark.slow
def test_from_the_command_line(tmp_path):
    options = ("--slip", "0.1m", "--set", COARSE, "--spectrum", DESIGN)
    process = command("statics", HEIGHT, *options, "--json", "-", "--out", tmp_path)
    assert process.returncode == 0, process.stderr
    data = json.loads(process.stdout)
    assert data["response_spectrum"]["spectrum"].startswith("EN 1998-1")
    assert (tmp_path / "forces-response-spectrum-downstream.png").exists()
    table = command("statics", HEIGHT, *options, "--vary", "crack.friction=0.8,1.0", "--json", "-")
    assert all(run["response_spectrum"] is not None for run in json.loads(table.stdout)["runs"])


@pytest.mark.parametrize("rows", ["0.02 0.5\n0.030303030303030304 0.5\n", "0.0 0.2\n0.01 0.3\n5 0.1\n"])
def test_short_and_falling_tables_have_a_share(rows, tmp_path):
    """A table that ends before any oscillator is slow has no frequency above which its modes go with the ground."""
    path = tmp_path / "spectrum.csv"
    path.write_text("period [s],Sa [g]\n" + rows.replace(" ", ","))
    spectrum = _spectrum_of(example("typical-base"), str(path), "spectrum")
    assert 0.0 <= spectrum.rigid_share(0.025) <= 1.0
    assert 0.0 <= spectrum.rigid_share(1.0 / 33.0) <= 1.0
