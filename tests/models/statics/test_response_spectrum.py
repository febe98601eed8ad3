"""An earthquake by its response spectrum: the beam of the textbooks, time histories, and what the checks make of it."""

from __future__ import annotations

import json
import math
import random

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from heeltoe import InputError, en_1998, read_case, statics_of_sections, with_response_spectrum
from heeltoe.case.shaking import resolve
from heeltoe.models.flexible.surroundings.dam_modes import SectionForces, dam_modes
from heeltoe.motion.spectrum import rigid_share
from shared.command import command
from shared.dams import BLOCK, HEIGHT, example

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


def cantilever(root: float) -> tuple[float, float]:
    """Share of its mass in a mode of a cantilever, and the height of that push over its own."""
    at = np.linspace(0.0, 1.0, 20001)
    ratio = (np.cosh(root) + np.cos(root)) / (np.sinh(root) + np.sin(root))
    shape = np.cosh(root * at) - np.cos(root * at) - ratio * (np.sinh(root * at) - np.sin(root * at))
    mean, square, lever = (np.trapezoid(values, at) for values in (shape, shape**2, at * shape))
    return float(mean**2 / square), float(lever / mean)


def test_a_cantilever_by_hand():
    joints = with_response_spectrum(statics_of_sections(read_case(TOWER)), DESIGN)
    (joint,) = joints.joints
    mass, roots = 2.0 * 60.0 * 2400.0, (1.875104068711961, 4.694091132974175)
    (share, height), (second, its_height) = map(cantilever, roots)
    first_period, period = (
        2.0 * math.pi * 60.0**2 / root**2 * math.sqrt(2400.0 / (20e9 * 2.0**2 / 12.0)) for root in roots
    )
    acceleration, its = en_1998(0.02 * G, "B")([first_period, period])
    ground = 0.02 * G * 1.2
    # Both periods are longer than those of the plateau: neither mode follows the ground.
    shear = mass * math.hypot(share * acceleration, second * its, (1.0 - share - second) * ground)
    levers = (share * height * acceleration, second * its_height * its)
    moment = mass * 60.0 * math.hypot(*levers, (0.5 - share * height - second * its_height) * ground)
    result = joint.statics.response_spectrum
    assert result.period_s == pytest.approx(first_period, rel=0.005)
    assert result.damping_ratio == pytest.approx(0.05, rel=0.01)
    assert result.rigid_share == result.second_mode.rigid_share == 0.0
    assert result.second_mode.period_s == pytest.approx(period, rel=0.01)
    assert result.second_mode.damping_ratio == pytest.approx(0.05, rel=0.01)
    assert result.second_mode.push.horizontal_n == pytest.approx(mass * second * its, rel=0.01)
    downstream, upstream = (case for case in joint.statics.cases if case.name.startswith("response spectrum"))
    assert downstream.shear_force_n == pytest.approx(shear, rel=0.005)
    assert upstream.shear_force_n == pytest.approx(-shear, rel=0.005)
    assert result.push().moment == pytest.approx(-moment, rel=0.005)
    weight = mass * G
    assert downstream.normal_force_n == pytest.approx(weight, rel=1e-9)
    assert downstream.sliding_factor == pytest.approx(weight / shear, rel=0.005)
    assert downstream.resultant_from_heel_m == pytest.approx(1.0 + moment / weight, rel=0.005)


def test_the_share_that_follows_the_ground_by_hand():
    """EN 1998-1 on ground B: plateau from 0.15 to 0.5 s, twice and a half the ground's."""
    periods = np.geomspace(0.02, 4.0, 400)
    ordinates = en_1998(1.0, "B")(periods)
    # From 1 / 0.5 s to a third of it and two thirds of 50 Hz, above which nothing is looked at.
    for frequency, share in ((1.0, 0.0), (2.0, 0.0), (10.0, math.log(5.0) / math.log(17.0)), (34.0, 1.0), (50.0, 1.0)):
        assert rigid_share(periods, ordinates, 1.2, 1.0 / frequency) == pytest.approx(share, abs=0.01)
    assert rigid_share(periods, np.full(400, 1.2), 1.2, 1.0) == 1.0


def test_what_follows_the_ground_is_added():
    """A dam so stiff that all of it follows the ground is pushed as a rigid one is, not by a root of squares."""
    case = example("typical-base", COARSE, "concrete.modulus=2e4 GPa")
    demand = with_response_spectrum(statics_of_sections(case), "en1998:0.2 g,B").joints[0].statics.response_spectrum
    parts = (demand.first_mode, demand.second_mode.push, demand.static_correction)
    assert demand.rigid_share == demand.second_mode.rigid_share == 1.0
    assert demand.together.horizontal_n == pytest.approx(sum(part.horizontal_n for part in parts), rel=1e-12)


def test_a_stiff_dam_moves_with_the_ground():
    modes = dam_modes(example("typical-height", COARSE, "concrete.modulus=1e5 GPa"), "spectrum")
    case = example("typical-height", COARSE)
    block = with_response_spectrum(statics_of_sections(case.with_("statics.seismic_coefficient=0.1")), DESIGN)
    forces = next(c for c in block.joints[0].statics.cases if c.name == "pseudo-static downstream").forces
    pushed = sum(force.horizontal for force in forces if force.name in ("inertia", "hydrodynamic"))
    # Those of the block, but for the water's mass on elements.
    assert modes.rigid[0] == pytest.approx(pushed / (0.1 * case.gravity), rel=0.01)
    assert modes.first.period < 0.01


def dams_on_rigid_rock(count: int) -> list:
    """Return random dams before water that is a mass."""
    draw = random.Random(17)
    result = []
    for _ in range(count):
        height = draw.uniform(40.0, 140.0)
        result.append(
            read_case(
                {
                    "section": {
                        "height": f"{height} m",
                        "crest_width": f"{draw.uniform(5.0, 12.0)} m",
                        "base_width": f"{draw.uniform(0.65, 0.85) * height} m",
                    },
                    "concrete": {"modulus": f"{draw.uniform(15.0, 35.0)} GPa", "density": "2400 kg/m^3"},
                    "crack": {"elevation": f"{draw.choice((0.0, 0.0, 0.3)) * height} m", "friction": 1.0},
                    "reservoir": {"depth": f"{draw.uniform(0.7, 1.0) * height} m"},
                    "flexible": {"elements_across": 4},
                }
            )
        )
    return result


def made_to_order(count, request):
    return [{"file": f"synthetic:M6.5,20km,seed={seed + 1}"} for seed in range(count)]


def measured(count, request):
    paths = sorted(request.getfixturevalue("records").glob("ensemble/*"))
    return [{"file": str(path)} for path in paths[:: max(1, len(paths) // count)]]


def one_mode(demand) -> list[float]:
    """Return shear and moment by the first mode and a static correction, as a root of squares."""
    second, peak = demand.second_mode, demand.peak_ground_acceleration_m_s2
    result = []
    for name in ("horizontal_n", "moment_about_heel_nm"):
        rest = getattr(demand.static_correction, name)
        if second is not None:
            rest += getattr(second.push, name) * peak / second.pseudo_acceleration_m_s2
        result.append(math.hypot(getattr(demand.first_mode, name), rest))
    return result


# Shear and moment at the crack by the spectrum over the peaks of time histories: mean, and the least of all.
@pytest.mark.slow
@pytest.mark.parametrize("motions", [made_to_order, measured])
@pytest.mark.parametrize("where", ["rigid rock", "rock and sound"])
def test_time_histories_have_the_same_peaks_in_the_mean(motions, where, request):
    """Dams that are bonded, by the frequency domain, beside the spectrum."""
    dams = dams_on_rigid_rock(6) if where == "rigid rock" else [example("on-rock", COARSE)]
    ratios = []
    for case in dams:
        section = SectionForces.of(case, 6.0)
        step, count = 0.01, 4096
        frequencies = np.fft.rfftfreq(count, step)
        farthest = min(49.0, 6.0 * section.first)
        sampled = np.linspace(0.05, farthest, 300)
        answers = CubicSpline(sampled, [section.at(2.0 * np.pi * frequency) for frequency in sampled])
        transfer = np.where((frequencies > 0.05) & (frequencies < farthest), answers(frequencies).T, 0.0)
        for fields in motions(3 if len(dams) > 1 else 10, request):
            shaken = case.with_({"motion": fields})
            motion, _ = resolve(shaken.motion, shaken.gravity, shaken.base_directory)
            ground = np.interp(step * np.arange(count), motion.time, motion.acceleration, right=0.0)
            histories = np.fft.irfft(transfer * np.fft.rfft(ground), count)
            (joint,) = with_response_spectrum(statics_of_sections(shaken)).joints
            demand = joint.statics.response_spectrum
            push, alone = demand.together, one_mode(demand)
            by_spectrum = np.abs([push.horizontal_n, push.moment_about_heel_nm, *alone])
            ratios.append(by_spectrum / np.abs(histories[[0, 2, 0, 2]]).max(axis=1))
    assert len(ratios) >= 10
    print("mean, least, largest of shear and moment, then of one mode", where, motions.__name__)
    print(np.array([np.mean(ratios, axis=0), np.min(ratios, axis=0), np.max(ratios, axis=0)]).round(2))
    both, alone = np.split(np.array(ratios), 2, axis=1)
    assert np.mean(both, axis=0) == pytest.approx(1.0, abs=0.1)
    assert np.min(both) > 0.75
    assert np.min(both[:, 0]) > np.min(alone[:, 0])


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
    assert soft.period_s > 1.1 * rigid.period_s
    assert soft.damping_ratio > 1.5 * rigid.damping_ratio


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
    assert refused.value.code == "modulus-missing"
    with pytest.raises(InputError) as refused:
        with_response_spectrum(statics_of_sections(read_case(TOWER)), "motion")
    assert refused.value.code == "motion-missing"
    with pytest.raises(InputError) as refused:
        with_response_spectrum(read_case(TOWER), "motion")
    assert refused.value.code == "not-checks"


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
