"""What elastic parts take, measured beside what is estimated before; ``pytest -s`` prints both."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest

from heeltoe import InputError
from heeltoe.models.flexible.body import bonded
from heeltoe.models.flexible.body.cost import building, part_of, parts_of, wave_bodies
from heeltoe.models.flexible.body.reduced import _build
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.run.expected import analysing, running
from heeltoe.models.run import cost_of, earthquake
from heeltoe.study.small.analysis import analyse
from shared.dams import example


def factor(measured, estimated):
    return max(measured / estimated, estimated / measured)


@pytest.mark.parametrize("name", ["typical-base", "typical-height"])
@pytest.mark.parametrize("across", [4, 8, 16])
def test_the_parts_are_as_expected(name, across):
    case = example(name, f"flexible.elements_across={across}")
    dam = _build(case)
    for part, body, modes in zip(parts_of(case), dam.bodies, dam.modes, strict=True):
        assert factor(body.mesh.nodes.size, part.freedoms) < 1.6
        # Some modes more where the crack asks for them.
        assert factor(modes.omega_squared.size, replace(part, freedoms=body.mesh.nodes.size).modes) < 1.3
    meshed = building([part_of(case, body.mesh.crack.size, body.mesh.nodes.size) for body in dam.bodies])
    assert factor(meshed.seconds, building(parts_of(case)).seconds) < 1.6


@pytest.mark.slow
@pytest.mark.parametrize("name", ["typical-base", "typical-height"])
@pytest.mark.parametrize("across", [8, 16, 32])
def test_time(name, across):
    """Other work on the machine, and its make, are in the factor."""
    case = example(name, f"flexible.elements_across={across}", "motion.duration=6s", "flexible.evidence=none")
    bonded._KEPT.clear()
    begun = time.process_time()
    dam = _build(case)
    built = time.process_time()
    shaken = ShakenDam(case, dam, earthquake(case).shaking)
    shaken.run(shaken.first_step(), 0.01)
    ran = time.process_time()
    for said, measured, estimated in (
        ("building", built - begun, building(parts_of(case)).seconds),
        ("running", ran - built, running(case, 6.0, 0.01).seconds),
    ):
        print(f"{name}, {across} across, {said}: {measured:.2f} s, estimated {estimated:.2f} s")
        assert factor(measured, estimated) < 6.0


def test_silence_and_spread_are_counted():
    case = example("typical-base", "flexible.evidence=none", "motion.duration=20s")
    alone = analysing(case, 20.0, 0.01).seconds - building(parts_of(case)).seconds
    with_silence = analysing(case, 20.0, 0.01, silence=10.0).seconds - building(parts_of(case)).seconds
    # To the end of the motion, through all of the silence, and the one that counts, which ends somewhere between.
    assert with_silence == pytest.approx(alone * (20.0 + 30.0 + 22.5) / 20.0, rel=1e-6)
    spread = analysing(case, 20.0, 0.01, spread=11).seconds - building(parts_of(case)).seconds
    assert spread == pytest.approx(12.0 * alone, rel=1e-6)


def test_a_spread_that_takes_too_long_is_refused_before_anything_runs(monkeypatch):
    case = example("typical-base", "flexible.evidence=none", "flexible.elements_across=2", "motion.duration=1s")
    few, many = (cost_of(case, "flexible", spread=runs).seconds for runs in (11, 1000))
    limited = case.with_({"analysis.time_limit": f"{(few + many) / 2.0} s"})
    monkeypatch.setattr("heeltoe.study.small.analysis.run", lambda *given, **named: pytest.fail("it ran"))
    with pytest.raises(InputError) as refused:
        analyse(limited, "flexible", spread=1000)
    assert (refused.value.code, refused.value.field) == ("too-costly", "--spread")


WATER, ROCK = {"reservoir.compressible": True}, {"rock.modulus": "20 GPa"}
BOND = {"tensile_strength": "0.5 MPa", "cohesion": "1 MPa", "fracture_energy": "100 N/m", "shear_energy": "500 N/m"}


@pytest.mark.parametrize("changes", [WATER, ROCK, {"crack.bond": BOND}, WATER | {"crack.bond": BOND}])
@pytest.mark.parametrize("across", [4, pytest.param(16, marks=pytest.mark.slow)])
def test_water_with_sound_rock_and_bonds_are_counted(changes, across):
    """A step takes up to thirty times as long with them; other work on the machine is in the factor."""
    bare = example("typical-base", f"flexible.elements_across={across}", "motion.duration=3s", "flexible.evidence=none")
    case = bare.with_(changes)
    bonded._KEPT.clear()
    begun = time.process_time()
    shaken = ShakenDam(case, _build(case), earthquake(case).shaking)
    shaken.run(shaken.first_step(), 0.01)
    measured = time.process_time() - begun
    estimated = building(parts_of(case), wave_bodies(case)) + running(case, 3.0, 0.01)
    print(f"{across} across, {changes.keys()}: {measured:.2f} s, estimated {estimated.seconds:.2f} s")
    assert factor(measured, estimated.seconds) < 6.0
    assert estimated.seconds > 1.5 * (building(parts_of(bare)) + running(bare, 3.0, 0.01)).seconds
