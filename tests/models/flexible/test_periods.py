"""Periods against beam theory, and among each other."""

from __future__ import annotations

import json
import math

import pytest
from rich.console import Console

from heeltoe import InputError, dam_periods
from heeltoe.views.terminal.dam import print_periods
from shared.dams import BASE, BLOCK, HEIGHT, example, plane_case

# Slender enough for Euler and Bernoulli: 2 m wide, 60 m high.
TOWER = {
    "section": {"polygon": [["0 m", "0 m"], ["2 m", "0 m"], ["2 m", "60 m"], ["0 m", "60 m"]]},
    "concrete": {"density": "2400 kg/m^3", "modulus": "20 GPa", "poisson": 0.0},
    "crack": {"friction": 1.0},
    "flexible": {"elements_across": 2},
}


def beam(number: float, height: float) -> float:
    """Period of a beam 2 m wide by its root of the frequency equation."""
    return 2.0 * math.pi * height**2 / number**2 * math.sqrt(2400.0 / (20e9 * 2.0**2 / 12.0))


def test_beams():
    periods = dam_periods(plane_case(TOWER), 2)
    assert periods.intact == pytest.approx([beam(1.87510, 60.0), beam(4.69409, 60.0)], rel=0.01)
    # Cut off at its base it is free at both ends.
    assert periods.above == pytest.approx([beam(4.73004, 60.0), beam(7.85320, 60.0)], rel=0.01)
    assert periods.below is None
    assert periods.intact_dry == periods.intact


def test_a_crack_in_the_middle():
    periods = dam_periods(plane_case({**TOWER, "crack": {"friction": 1.0, "elevation": "40 m"}}), 2)
    assert periods.intact == pytest.approx([beam(1.87510, 60.0), beam(4.69409, 60.0)], rel=0.01)
    assert periods.above[0] == pytest.approx(beam(4.73004, 20.0), rel=0.03)
    assert periods.below[0] == pytest.approx(beam(1.87510, 40.0), rel=0.01)


def test_water_makes_a_dam_slower():
    periods = dam_periods(plane_case(BASE, ["flexible.elements_across=3"]))
    assert all(wet > dry for wet, dry in zip(periods.intact, periods.intact_dry, strict=True))
    assert list(periods.intact) == sorted(periods.intact, reverse=True)
    assert len(periods.intact) == len(periods.above) == 5


def test_json_and_damping():
    case = plane_case(HEIGHT, ["flexible.elements_across=2"])
    periods = dam_periods(case, 3)
    data = json.loads(json.dumps(periods.to_json(), allow_nan=False))
    assert {len(values) for values in data["periods_s"].values()} == {3}
    mass, stiffness = data["rayleigh"]["mass_1_s"], data["rayleigh"]["stiffness_s"]
    for period in (periods.intact[0], periods.intact[2]):
        omega = 2.0 * math.pi / period
        assert mass / (2.0 * omega) + stiffness * omega / 2.0 == pytest.approx(0.05)
    modal = dam_periods(plane_case(HEIGHT, ["flexible.elements_across=2", "flexible.damping=modal"]), 1)
    assert modal.to_json()["rayleigh"] is None


@pytest.mark.parametrize("count", [0, -1, 51])
def test_counts_that_are_none(count):
    with pytest.raises(InputError) as refused:
        dam_periods(plane_case(TOWER), count)
    assert refused.value.code == "out-of-range"


def test_a_dam_without_a_modulus():
    with pytest.raises(InputError) as refused:
        dam_periods(plane_case(BLOCK))
    assert refused.value.code == "missing"


def test_compressible_water_counts_as_a_mass_and_the_screen_says_so(capsys):
    case = example("typical-height", "flexible.elements_across=3")
    still, sound = dam_periods(case), dam_periods(case.with_("reservoir.compressible=true"))
    assert sound.intact == still.intact
    assert sound.parts == still.parts
    assert not still.simplified
    print_periods(sound, Console())
    assert "The compressible water counts as a mass here" in capsys.readouterr().out


# Pine Flat, rigid rock, compressible water: 2.53 Hz (Samii and Lotfi 2007), 2.60 Hz (Gorai and Maity 2020).
@pytest.mark.slow
def test_pine_flat_amplifies_where_others_find_it():
    periods = dam_periods(example("pine-flat", "flexible.elements_across=8"), 1, response=True)
    curves = {(curve.rock, curve.water): curve.response for curve in periods.amplification.curves}
    assert list(curves) == [
        (rock, water) for rock in ("rigid", "elastic") for water in ("empty", "incompressible", "compressible")
    ]
    assert not periods.amplification.assumptions
    assert 2.45 < curves["rigid", "compressible"].resonance < 2.62
    # Without waves the peaks are those of the modes; the concrete's damping is theirs.
    for water, period in (("empty", periods.intact_dry[0]), ("incompressible", periods.intact[0])):
        response = curves["rigid", water]
        assert response.resonance == pytest.approx(1.0 / period, rel=0.01)
        assert response.damping == pytest.approx(0.05, rel=0.03)
    # Rock gives way, and takes waves.
    for water in ("empty", "incompressible", "compressible"):
        assert curves["elastic", water].resonance < curves["rigid", water].resonance
        assert curves["elastic", water].damping > 1.5 * curves["rigid", water].damping
    assert all(abs(response.amplification[0] - 1.0) < 1e-12 for response in curves.values())


@pytest.mark.slow
def test_response_says_what_it_assumes(capsys):
    case = example("typical-height", "flexible.elements_across=3")
    periods = dam_periods(case, 1, response=True)
    print_periods(periods, Console(width=200), units="us")
    screen = capsys.readouterr().out
    assert "elastic rock has the modulus of the concrete" in screen
    assert "The case has water without sound" in screen
    assert "effective damping" in screen
    data = json.loads(json.dumps(periods.to_json(), allow_nan=False))["response"]
    assert {len(curve["amplification"]) for curve in data["curves"]} == {len(data["frequency_hz"])}
    empty = dam_periods(case.with_({"reservoir": None}), 1, response=True).amplification
    assert [curve.water for curve in empty.curves] == ["empty", "empty"]


@pytest.mark.slow
def test_rock_counts_as_rigid_and_the_screen_says_so(capsys):
    case = example("typical-base", "flexible.elements_across=3")
    on_rock = dam_periods(case.with_("rock.modulus=20 GPa"))
    assert on_rock.intact == dam_periods(case).intact
    print_periods(on_rock, Console())
    assert "The rock counts as rigid here." in capsys.readouterr().out
