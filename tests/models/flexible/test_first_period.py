"""The first period of a dam with its rock and its water, by which suites and single runs are scaled to Sa."""

from __future__ import annotations

import numpy as np
import pytest

import heeltoe
from heeltoe import dam_periods
from heeltoe.models.flexible.surroundings import lowest_modes
from heeltoe.models.flexible.surroundings.lowest_modes import first_period
from shared.dams import EXAMPLES, HEIGHT, example, plane_case

# A joint that holds, and half a second of a push: the dam rings.
RINGING = [
    "flexible.elements_across=2",
    "flexible.evidence=none",
    *("crack.bond.tensile_strength=20 MPa", "crack.bond.cohesion=20 MPa"),
    *("crack.bond.fracture_energy=1e5 N/m", "crack.bond.shear_energy=1e5 N/m"),
    {"motion": {"points": [["0 s", "0 g"], ["0.1 s", "0.05 g"], ["0.2 s", "0 g"], ["3 s", "0 g"]]}},
    "analysis.silence=0 s",
]


# Slow: steps of a dam on rock. The right value: the crest's own vibration in time, after a push; no frequency response
# in it. The first resonance of a damped dam lies within 1 % of that.
@pytest.mark.slow
def test_the_first_period_is_that_at_which_the_dam_rings():
    case = plane_case(EXAMPLES / "on-rock.toml", RINGING)
    table = heeltoe.run(case, "flexible", output_step=0.005).to_table()
    time, crest = (np.array(table[name]) for name in ("time_s", "crest_displacement_m"))
    crest = crest - crest[-100:].mean()
    at = np.flatnonzero((time[1:] > 0.4) & (crest[1:] * crest[:-1] < 0.0))[:7]
    crossings = time[at] - crest[at] * (time[at + 1] - time[at]) / (crest[at + 1] - crest[at])
    rings = (crossings[6] - crossings[0]) / 3.0
    # On rigid rock, before water without sound, it would be a fifth less.
    assert dam_periods(case, 1).intact[0] < 0.85 * rings
    assert first_period(case, "period") == pytest.approx(rings, rel=0.02)


def test_a_suite_is_scaled_at_the_period_on_the_rock_of_the_dam(monkeypatch):
    monkeypatch.setattr(lowest_modes, "first_period", lambda case, field: 0.5 if case.rock else 0.4)
    suite = heeltoe.run_suite(example("on-rock"), "elcentro-1940-180-nga", model="rigid", sa="0.5 g")
    assert suite.manifest["study"]["motions"]["scale"]["period"] == "0.5 s"


def test_without_rock_and_sound_it_is_that_of_the_first_mode():
    case = plane_case(HEIGHT, ["flexible.elements_across=2"])
    assert first_period(case, "period") == dam_periods(case, 1).intact[0]


@pytest.mark.slow
def test_two_cracks_have_one():
    case = example("two-cracks", "flexible.elements_across=2", "rock.modulus=20 GPa")
    assert first_period(case, "period") > dam_periods(case, 1).intact[0]
