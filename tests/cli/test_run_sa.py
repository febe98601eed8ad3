"""One record, with its vertical component, scaled to a spectral acceleration; and a record of a suite with it."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scipy.signal import lsim

from heeltoe import read_case
from heeltoe.case.shaking import resolve_all
from heeltoe.models.flexible.surroundings.lowest_modes import first_period
from shared.command import command
from shared.dams import BASE

ACROSS, UP = "loma-prieta-1989-corralitos-000-nga", "loma-prieta-1989-corralitos-up-nga"
PAIR = f'motion={{file="{ACROSS}",pga="0.9 g",vertical={{file="{UP}"}}}}'
ONE_G = 9.81


def run(tmp_path, *options):
    """Run the rigid dam with a pair and return the JSON."""
    place = tmp_path / "run.json"
    reply = command("run", BASE, "--set", PAIR, *options, "--model", "rigid", "--json", place)
    assert reply.returncode == 0, reply.stderr
    return json.loads(place.read_text())


# The right value: an oscillator of 5 % damping, integrated by SciPy.
def test_a_pair_is_scaled_to_sa_by_one_factor(tmp_path):
    data = run(tmp_path, "--sa", "0.8g@0.3s")
    across, up, _ = resolve_all(read_case(BASE, [PAIR, {"motion.pga": None}]))
    omega = 2.0 * np.pi / 0.3
    oscillator = ([[0.0, 1.0], [-(omega**2), -0.1 * omega]], [[0.0], [-1.0]], [[1.0, 0.0]], [[0.0]])
    _, moved, _ = lsim(oscillator, across.acceleration, across.time)
    factor = 0.8 * ONE_G / (omega**2 * np.abs(moved).max())
    assert data["motion"]["pga_g"] * 9.80665 == pytest.approx(factor * across.pga, rel=2e-3)
    assert data["vertical_motion"]["pga_g"] * 9.80665 == pytest.approx(factor * up.pga, rel=2e-3)


def test_sa_without_a_period_is_at_the_first_one(tmp_path):
    data = run(tmp_path, "--sa", "0.5g", "--set", "flexible.elements_across=2")
    first = first_period(read_case(BASE, ["flexible.elements_across=2"]), "suite.period")
    assert f"at {first:.6g} s" in data["motion"]["processing"][-1]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--sa", "0.5g", "--pga", "0.3g"], "--sa: cannot stand beside"),
        (["--sa", "0.5g", "--set", "concrete.modulus=none"], "without which the dam has no period"),
        (["--sa", "0.5g@0s"], "--sa: 0s"),
        (["--sa", "much"], "--sa: "),
    ],
)
def test_sa_that_cannot_be_says_so(options, words):
    reply = command("run", BASE, *options, "--model", "rigid")
    assert reply.returncode == 2
    assert words in reply.stderr, reply.stderr


# The right value: the run of the case itself, which has the same pair.
def test_a_suite_takes_the_vertical_component_that_the_case_names(tmp_path):
    alone = run(tmp_path, "--pga", "0.9g")
    suite = run(tmp_path, "--pga", "0.9g", "--motions", ACROSS, "--vertical")
    (record,) = suite["suite"]["models"][0]["records"]
    slips = [abs(sign["residual_slip_m"]) for sign in alone["signs"]]
    assert max(slips) > 0.0
    assert record["residual_slip_m"] == max(slips)
    without = run(tmp_path, "--pga", "0.9g", "--motions", ACROSS)["suite"]["models"][0]["records"][0]
    assert without["residual_slip_m"] != record["residual_slip_m"]


def test_a_record_that_has_none_says_so(tmp_path):
    reply = command("run", BASE, "--motions", "elcentro-1940-180-nga", "--vertical", "--model", "rigid")
    assert reply.returncode == 2
    assert "has no vertical component beside it" in reply.stderr


def test_none_takes_a_field_out(tmp_path):
    short = run(tmp_path, "--set", "motion.duration=4 s", "--set", "analysis.silence=0 s")
    whole = run(tmp_path, "--set", "motion.duration=none", "--set", "analysis.silence=0 s")
    assert short["motion"]["duration_s"] == pytest.approx(4.0)
    assert whole["motion"]["duration_s"] == pytest.approx(39.98)
    assert read_case(BASE, ["reservoir=none", "tailwater=none"]).reservoir is None
    # A choice that has this word keeps it.
    assert read_case(BASE, ["uplift.pattern=none"]).uplift.pattern == "none"


def test_the_vertical_component_follows_each_scaling_step():
    step = 'motion.processing=[{step="scale-to-arias",intensity="1 m/s"},{step="taper"}]'
    plain = resolve_all(read_case(BASE, [PAIR, {"motion.pga": None}, 'motion.processing=[{step="taper"}]']))
    scaled = resolve_all(read_case(BASE, [PAIR, {"motion.pga": None}, step]))
    factors = [after.pga / before.pga for after, before in zip(scaled[:2], plain[:2], strict=True)]
    assert factors[1] == pytest.approx(factors[0], rel=1e-9) != 1.0
