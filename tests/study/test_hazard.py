"""How often a year a limit is exceeded: against closed forms, against a plain integral, and in a study."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

import heeltoe
from heeltoe.errors.error import InputError
from heeltoe.study.answers.fragility import Curve
from heeltoe.study.answers.hazard import annual
from heeltoe.study.answers.likelihood import Witnesses, offsets
from shared.command import command
from shared.studies import BLOCK, study_file

STUDY = """
case = "case.toml"
[vary]
"crack.friction" = {{ distribution = "lognormal", median = 0.5, dispersion = 0.2, count = 5 }}
[motions]
folder = "quakes"
scale = {{ measure = "pga", values = ["0.4 g", "0.7 g", "1.1 g", "1.7 g"] }}
[fragility]
limits = {{ residual_slip = ["20 mm", "100 mm"] }}
[hazard]
{hazard}
"""
INLINE = 'curve = [["0.1 g", 0.02], ["0.5 g", 0.002], ["1 g", 0.0003], ["2 g", 0.00004]]\nat = "0.3 g"'


def curve(median, dispersion, covariance=None, events=10):
    return Curve(
        *("residual_slip", 0.1, "pga", 0.9, median, dispersion, None, None, None, None),
        runs=100,
        exceeding=50,
        events=events,
        unknown=0,
        covariance=covariance,
    )


def power_law(k0, k, strengths):
    return {"strength": list(strengths), "annual_rate": [k0 * x**-k for x in strengths]}


@pytest.mark.parametrize(("k0", "k", "median", "dispersion"), [(1e-4, 2.0, 3.0, 0.4), (2e-3, 3.3, 0.7, 0.25)])
@pytest.mark.parametrize("strengths", [(0.5, 5.0), (1.0, 2.0, 2.5, 9.0)])
def test_a_power_law_has_its_closed_form(k0, k, median, dispersion, strengths):
    rates = annual(curve(median, dispersion), power_law(k0, k, strengths))
    rate = k0 * median**-k * math.exp(k**2 * dispersion**2 / 2.0)
    assert rates["annual_rate"] == pytest.approx(rate, rel=1e-12)
    assert rates["annual_probability"] == pytest.approx(1.0 - math.exp(-rate), rel=1e-9)
    assert rates["return_period_years"] == pytest.approx(1.0 / rate)
    shares = sum(part["share"] for part in rates["contribution"])
    assert shares + rates["extrapolated"] == pytest.approx(1.0, rel=1e-12)
    ends = [math.log(strengths[0]), math.log(strengths[-1])]
    made = quad(lambda u: norm.cdf((u - math.log(median)) / dispersion) * k * k0 * math.exp(-k * u), *ends)[0]
    assert shares == pytest.approx(made / rate, rel=1e-7)


def test_a_hazard_of_several_slopes_is_its_plain_integral():
    strength, rate = np.array([0.3, 0.8, 2.0, 6.0]), np.array([0.1, 0.02, 0.001, 0.00002])
    fragility = curve(1.4, 0.5)
    rates = annual(fragility, {"strength": strength.tolist(), "annual_rate": rate.tolist()})
    slopes = -np.diff(np.log(rate)) / np.diff(np.log(strength))
    total = 0.0
    bounds = [math.log(1e-4), *np.log(strength[1:-1]), math.log(1e4)]
    for k, low, high, x, h in zip(slopes, bounds[:-1], bounds[1:], strength, rate, strict=False):
        total += quad(
            lambda u, k=k, x=x, h=h: norm.cdf((u - math.log(1.4)) / 0.5) * k * h * (math.exp(u) / x) ** -k, low, high
        )[0]
    assert rates["annual_rate"] == pytest.approx(total, rel=1e-7)
    assert [row["probability"] for row in rates["at"]] == pytest.approx(fragility.probability(strength).tolist())


def test_the_interval_of_a_power_law_is_that_of_its_exponent():
    k, dispersion, deviation = 2.5, 0.3, 0.1
    rates = annual(curve(2.0, dispersion, (deviation**2, 0.0, 0.0)), power_law(1e-3, k, (0.5, 8.0)))
    from scipy.stats import t

    reach = t.ppf(0.95, 9) * k * deviation
    low, high = rates["annual_rate_interval"]
    assert math.log(high / low) / 2.0 == pytest.approx(reach, rel=1e-6)
    # An uncertain dispersion counts by k^2 dispersion^2.
    rates = annual(curve(2.0, dispersion, (0.0, 0.0, deviation**2)), power_law(1e-3, k, (0.5, 8.0)))
    low, high = rates["annual_rate_interval"]
    assert math.log(high / low) / 2.0 == pytest.approx(t.ppf(0.95, 9) * (k * dispersion) ** 2 * deviation, rel=1e-3)


def test_the_fractiles_of_a_power_law_lie_as_those_of_its_median():
    k, deviation = 2.5, 0.1
    answer = annual(curve(2.0, 0.3, (deviation**2, 0.0, 0.0)), power_law(1e-3, k, (0.5, 8.0)))
    fractiles = answer["annual_probability_fractiles"]
    assert fractiles["50%"] == pytest.approx(answer["annual_probability"], rel=1e-12)
    from scipy.stats import t

    rates = [-math.log1p(-fractiles[name]) for name in ("5%", "16%", "84%", "95%")]
    expected = [k * deviation * t.ppf(share, 9) for share in (0.05, 0.16, 0.84, 0.95)]
    assert [math.log(rate / answer["annual_rate"]) for rate in rates] == pytest.approx(expected, rel=1e-6)
    assert annual(curve(2.0, 0.3), power_law(1e-3, k, (0.5, 8.0)))["annual_probability_fractiles"] is None


def test_the_shares_of_events_go_by_the_powers_of_their_medians():
    """Where runs are many each event has its own curve, whose rate under a power law is a closed form."""
    medians, within, k = np.array([0.5, 1.0, 1.6, 3.0]), 0.25, 2.5
    strength = np.geomspace(0.1, 12.0, 25)
    runs = np.full(strength.size * medians.size, 1e6)
    event = np.repeat(np.arange(medians.size), strength.size)
    logarithm = np.tile(np.log(strength), medians.size)
    chance = norm.cdf((logarithm - np.log(medians)[event]) / within)
    known = Witnesses(logarithm, event, runs, runs * chance)
    between = float(np.log(medians).std())
    fragility = replace(curve(1.2, math.hypot(between, within)), record=between, other=within)
    rates = annual(fragility, power_law(1e-3, k, (0.5, 8.0)), known, ["a", "b", "c", "d"])
    rows = {row["event"]: row for row in rates["by_event"]}
    assert list(rows) == ["a", "b", "c", "d"]
    expected = medians**-k / np.sum(medians**-k)
    assert [rows[name]["share"] for name in "abcd"] == pytest.approx(expected.tolist(), rel=1e-3)
    assert [rows[name]["median"] for name in "abcd"] == pytest.approx(medians.tolist(), rel=1e-3)
    assert sum(row["annual_rate"] for row in rows.values()) == pytest.approx(rates["annual_rate"], rel=1e-12)


def test_events_of_which_nothing_is_known_share_alike():
    """Without runs that tell them apart every event is as all are, and their mixture is the curve itself."""
    event = np.arange(5)
    known = Witnesses(np.zeros(5), event, np.full(5, 1e-12), np.zeros(5))
    fragility = replace(curve(2.0, 0.5), record=0.4, other=0.3)
    places, chance = offsets(known, 2.0, 0.4, 0.3)
    mixed = [float(np.sum(chance[0] * norm.cdf((math.log(x / 2.0) - places[0]) / 0.3))) for x in (1.0, 2.0, 5.0)]
    assert mixed == pytest.approx(fragility.probability(np.array([1.0, 2.0, 5.0])).tolist(), abs=1e-6)
    rates = annual(fragility, power_law(1e-3, 2.0, (0.5, 8.0)), known, list("abcde"))
    assert [row["share"] for row in rates["by_event"]] == pytest.approx([0.2] * 5, rel=1e-9)
    assert annual(curve(2.0, 0.5), power_law(1e-3, 2.0, (0.5, 8.0)), known, list("abcde"))["by_event"] == []


def test_an_event_whose_runs_all_exceed_or_none_has_a_share_all_the_same():
    strength = np.array([0.5, 1.0, 2.0])
    event = np.repeat(np.arange(3), 3)
    exceeding = np.array([0, 4, 8, 8, 8, 8, 0, 0, 0], dtype=np.float64)
    known = Witnesses(np.tile(np.log(strength), 3), event, np.full(9, 8.0), exceeding)
    fragility = replace(curve(1.0, 0.7), record=0.6, other=math.sqrt(0.7**2 - 0.6**2))
    rows = annual(fragility, power_law(1e-3, 2.0, (0.5, 8.0)), known, ["half", "all", "none"])["by_event"]
    assert [row["event"] for row in rows] == ["all", "half", "none"]
    assert 0.0 < rows[2]["share"] < 0.1
    assert rows[0]["share"] < 1.0


def test_a_strength_that_is_asked_of_has_its_probability_and_its_rate():
    hazard = power_law(1e-3, 2.0, (0.5, 2.0, 8.0)) | {"at": [1.0, 16.0]}
    points = {point["strength"]: point for point in annual(curve(1.0, 0.3), hazard)["at"]}
    assert list(points) == [0.5, 1.0, 2.0, 8.0, 16.0]
    assert points[1.0]["probability"] == pytest.approx(0.5)
    for strength in (1.0, 16.0):
        assert points[strength]["annual_rate"] == pytest.approx(1e-3 * strength**-2.0, rel=1e-9)


def test_a_study_with_a_hazard_says_how_often_a_year(tmp_path):
    file = study_file(tmp_path, STUDY.format(hazard=INLINE), case=BLOCK)
    study = heeltoe.run_study(file, tmp_path / "out")
    assert [row["value"] for row in study.hazard] == [0.02, 0.1]
    assert [point["strength"] / 9.80665 for point in study.hazard[0]["at"]] == pytest.approx([0.1, 0.3, 0.5, 1.0, 2.0])
    weak, strong = study.hazard
    assert weak["annual_rate"] > strong["annual_rate"] > 0.0
    by_hand = annual(study.curves[0][1], study.manifest["hazard"])
    assert weak["annual_rate"] == by_hand["annual_rate"]
    assert {row["event"] for row in weak["by_event"]} == set(study.manifest["events"])
    assert sum(row["share"] for row in weak["by_event"]) == pytest.approx(1.0, rel=1e-12)
    assert study.manifest["hazard"]["strength"][1] == pytest.approx(0.5 * study.manifest["hazard"]["strength"][2])
    assert json.loads(json.dumps(study.to_json(), allow_nan=False))
    # Another hazard is another question to the same runs.
    (tmp_path / "hazard.csv").write_text("pga [g], annual rate\n0.1, 0.04\n0.5, 0.004\n1, 0.0006\n2, 0.00008\n")
    file.write_text(STUDY.format(hazard='file = "hazard.csv"'))
    again = heeltoe.run_study(file, tmp_path / "out", resume=True)
    assert again.hazard[0]["annual_rate"] == pytest.approx(2.0 * weak["annual_rate"], rel=1e-9)


@pytest.mark.slow
def test_the_command_says_it_and_draws_it(tmp_path):
    study_file(tmp_path, STUDY.format(hazard=INLINE), case=BLOCK)
    process = command("study", "study.toml", "--out", "out", "--report", cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    assert "With the hazard of the site a residual slip of 20.0 mm is exceeded with" in " ".join(process.stdout.split())
    assert (tmp_path / "out/figures/hazard.png").is_file()
    assert "Annual probability" in (tmp_path / "out/report.html").read_text()


def test_a_limit_without_a_curve_has_no_rate(tmp_path):
    text = STUDY.format(hazard=INLINE).replace('"100 mm"', '"100 m"')
    study = heeltoe.run_study(study_file(tmp_path, text, case=BLOCK), tmp_path / "out")
    assert study.hazard[1]["annual_rate"] is None
    assert study.hazard[1]["why"] == "no run exceeds it"


@pytest.mark.parametrize(
    ("hazard", "code"),
    [
        ("", "missing-field"),
        (f'{INLINE}\nfile = "hazard.csv"', "fields-conflict"),
        ('curve = [["0.2 g", 0.01], ["0.1 g", 0.001]]', "hazard-order"),
        ('curve = [["0.1 g", 0.001], ["0.2 g", 0.01]]', "hazard-rates"),
        ('file = "nowhere.csv"', "hazard-unreadable"),
        ('file = "bare.csv"', "hazard-header"),
        ('file = "words.csv"', "hazard-row"),
    ],
)
def test_what_is_wrong_with_a_hazard_is_said(tmp_path, hazard, code):
    (tmp_path / "bare.csv").write_text("0.1, 0.01\n0.2, 0.001\n")
    (tmp_path / "words.csv").write_text("pga [g], rate\n0.1, often\n0.2, 0.001\n")
    with pytest.raises(InputError) as error:
        heeltoe.run_study(study_file(tmp_path, STUDY.format(hazard=hazard), case=BLOCK), tmp_path / "out")
    assert error.value.code == code


def test_a_hazard_needs_limits(tmp_path):
    text = f'case = "case.toml"\n[hazard]\n{INLINE}\n'
    with pytest.raises(InputError) as error:
        heeltoe.run_study(study_file(tmp_path, text, case=BLOCK), tmp_path / "out")
    assert error.value.code == "needs-other"
