"""How often a year a limit is exceeded: against closed forms, against a plain integral, and in a study."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm, t

import heeltoe
from heeltoe.errors.error import InputError
from heeltoe.study.answers.confidence import knowledge_of
from heeltoe.study.answers.fragility import Curve, NotStanding
from heeltoe.study.answers.hazard import annual
from heeltoe.study.answers.likelihood import Witnesses, offsets
from heeltoe.study.plan.hazard_file import read_pairs
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
limits = {{ residual_slip = ["5 mm", "10 mm"] }}
[hazard]
{hazard}
"""
INLINE = 'curve = [["0.1 g", 0.02], ["0.5 g", 0.002], ["1 g", 0.0003], ["2 g", 0.00004]]\nat = "0.3 g"'


def curve(median, dispersion, knowledge=None, share=0.0):
    return Curve(
        limit="residual_slip",
        value=0.1,
        measure="pga",
        confidence=0.9,
        median=median,
        dispersion=dispersion,
        runs=100,
        exceeding=50,
        events=10,
        unknown=0,
        knowledge=knowledge,
        not_standing=NotStanding(count=round(100 * share), dams=100, runs=0, share=share, interval=None),
    )


def known(median, dispersion, runs, events=10):
    """Return what so many runs of each of some events, all alike, say of a curve, and the covariance of the logarithms
    of its median and its dispersion by Fisher's information."""
    strength = median * np.exp(dispersion * np.linspace(-2.0, 2.0, 9))
    z = np.log(strength / median) / dispersion
    at, event = np.tile(np.log(strength), events), np.repeat(np.arange(events), strength.size)
    share = norm.cdf(np.tile(z, events))
    seen = Witnesses(at, event, np.full(at.size, runs), runs * share)
    weight = runs * events * norm.pdf(z) ** 2 / (norm.cdf(z) * norm.sf(z))
    slopes = np.array([np.full(z.size, -1.0 / dispersion), -z])
    return knowledge_of(seen, math.log(median), dispersion), np.linalg.inv((slopes * weight) @ slopes.T)


def power_law(k0, k, strengths):
    return {"strength": list(strengths), "annual_rate": [k0 * x**-k for x in strengths]}


@pytest.mark.parametrize(("k0", "k", "median", "dispersion"), [(1e-4, 2.0, 3.0, 0.4), (2e-3, 3.3, 0.7, 0.25)])
@pytest.mark.parametrize("strengths", [(0.01, 500.0), (0.02, 2.0, 2.5, 900.0)])
def test_a_power_law_has_its_closed_form(k0, k, median, dispersion, strengths):
    rates = annual(curve(median, dispersion), power_law(k0, k, strengths))
    rate = k0 * median**-k * math.exp(k**2 * dispersion**2 / 2.0)
    assert rates["annual_rate"] == pytest.approx(rate, rel=1e-9)
    assert rates["annual_rate_bounds"] == [rates["annual_rate"], pytest.approx(rate, rel=1e-9)]
    assert rates["annual_probability"] == pytest.approx(1.0 - math.exp(-rate), rel=1e-9)
    assert rates["return_period_years"] == pytest.approx(1.0 / rate)
    assert rates["extrapolated"] == pytest.approx(0.0, abs=1e-4)
    assert sum(part["share"] for part in rates["contribution"]) == pytest.approx(1.0, abs=1e-4)


def test_beyond_the_ends_a_power_law_lies_within_its_bounds():
    """The closed form of Cornell and others has the ends, too; the hazard curve has the motions from 0.8 to 5 alone."""
    k0, k, median, dispersion = 1e-4, 2.0, 3.0, 0.4
    rates = annual(curve(median, dispersion), power_law(k0, k, (0.8, 5.0)))
    rate = k0 * median**-k * math.exp(k**2 * dispersion**2 / 2.0)
    low, high = rates["annual_rate_bounds"]
    assert low < rate < high
    inside = sum(part["share"] for part in rates["contribution"]) * rates["annual_rate"]
    assert low - inside == pytest.approx(norm.cdf(math.log(5.0 / median) / dispersion) * k0 * 5.0**-k, rel=1e-9)
    below = quad(
        lambda u: norm.cdf((u - math.log(median)) / dispersion) * k * k0 * math.exp(-k * u), -9.0, math.log(0.8)
    )[0]
    assert high - inside == pytest.approx(k0 * 5.0**-k + below, rel=1e-9)
    assert rates["extrapolated"] == pytest.approx((low - inside + below) / (low + below), rel=1e-9)


def plain_integral(fragility, strength, rate):
    """Return the integral of a curve over a hazard curve, stretch by stretch, by SciPy."""
    slopes = -np.diff(np.log(rate)) / np.diff(np.log(strength))
    return sum(
        quad(
            lambda u, k=k, x=x, h=h: (
                norm.cdf((u - math.log(fragility.median)) / fragility.dispersion) * k * h * (math.exp(u) / x) ** -k
            ),
            math.log(x),
            math.log(stop),
        )[0]
        for k, x, stop, h in zip(slopes, strength[:-1], strength[1:], rate[:-1], strict=True)
    )


def test_a_hazard_of_several_slopes_is_its_plain_integral():
    strength, rate = np.array([0.3, 0.8, 2.0, 6.0]), np.array([0.1, 0.02, 0.001, 0.00002])
    fragility = curve(1.4, 0.5)
    rates = annual(fragility, {"strength": strength.tolist(), "annual_rate": rate.tolist()})
    total = plain_integral(fragility, strength, rate) + norm.cdf(math.log(6.0 / 1.4) / 0.5) * 0.00002
    assert rates["annual_rate"] == pytest.approx(total, rel=1e-7)
    assert [row["probability"] for row in rates["at"]] == pytest.approx(fragility.probability(strength).tolist())


def test_motions_weaker_than_the_hazard_curve_are_not_counted_but_said():
    """1e-3 at 0.2 g, 6e-5 at 0.4 g, 3e-6 at 0.8 g, median 0.56 g, dispersion 0.8: 1.7e-4 a year within, by SciPy's
    integral; a curve that went on as it begins would make 3.0e-3, 94 % of it from beyond."""
    strength, rate = np.array([0.2, 0.4, 0.8]), np.array([1e-3, 6e-5, 3e-6])
    fragility = curve(0.56, 0.8)
    rates = annual(fragility, {"strength": strength.tolist(), "annual_rate": rate.tolist()})
    last = norm.cdf(math.log(0.8 / 0.56) / 0.8) * 3e-6
    assert rates["annual_rate"] == pytest.approx(plain_integral(fragility, strength, rate) + last, rel=1e-9)
    assert rates["annual_rate"] == pytest.approx(1.73e-4, rel=1e-3)
    assert rates["annual_rate_bounds"] == [rates["annual_rate"], None]
    assert "weaker motions than the hazard curve has" in rates["bounds_why"]
    assert rates["extrapolated"] == pytest.approx(0.94, abs=0.005)


@pytest.mark.parametrize(
    ("strength", "rate"),
    [
        ((0.2, 0.21, 1.0), (1e-2, 1e-3, 1e-4)),  # 2.2e74 a year where it goes on as it begins
        ((0.2, 0.2001, 1.0), (1e-2, 1e-8, 1e-9)),
        ((0.2, 0.2 * (1.0 + 1e-9), 1.0), (1e-2, 1e-30, 1e-31)),
        ((0.2, 0.8, 1.0), (1e-3, 1e-4, 0.999e-4)),
        ((1e-6, 1e6), (1e3, 1e-12)),
    ],
)
@pytest.mark.parametrize(("median", "dispersion"), [(0.56, 0.8), (0.25, 0.02), (30.0, 0.1), (1e-3, 2.0)])
def test_steep_and_flat_stretches_neither_overflow_nor_add_a_whole_rate(strength, rate, median, dispersion):
    """By hand between the least that can exceed and the most: P at either end of each stretch times its rate."""
    fragility = curve(median, dispersion)
    rates = annual(fragility, {"strength": list(strength), "annual_rate": list(rate)})
    chance, motions = fragility.probability(np.array(strength)), -np.diff([*rate, 0.0])
    least, most = np.sum(chance * motions), np.sum(np.append(chance[1:], chance[-1]) * motions)
    assert least * (1.0 - 1e-7) <= rates["annual_rate"] <= most * (1.0 + 1e-7)
    low, high = rates["annual_rate_bounds"]
    assert low <= rate[0] * (1.0 + 1e-9)
    assert high is None or low <= high <= rate[0] * (1.0 + 1e-9)
    assert 0.0 <= rates["extrapolated"] <= 1.0
    json.dumps(rates.to_json(), allow_nan=False)


def test_dams_that_do_not_stand_have_a_part_of_the_rate_of_their_own():
    """By hand: 5 % exceed in each of the 0.02 motions a year of the hazard curve, the others as without them."""
    hazard = power_law(2e-2 * 0.5**2.0, 2.0, (0.5, 1.0, 8.0))
    alone, both = annual(curve(2.0, 0.3), hazard), annual(curve(2.0, 0.3, share=0.05), hazard)
    assert hazard["annual_rate"][0] == pytest.approx(0.02)
    assert both["standing_rate"] == alone["annual_rate"] == alone["standing_rate"]
    assert both["not_standing_rate"] == pytest.approx(0.05 * 0.02)
    assert both["annual_rate"] == pytest.approx(0.001 + 0.95 * alone["annual_rate"], rel=1e-12)
    assert both["annual_rate_bounds"][1] == pytest.approx(0.001 + 0.95 * alone["annual_rate_bounds"][1], rel=1e-12)
    assert [point["probability"] for point in both["at"]] == pytest.approx(
        [0.05 + 0.95 * point["probability"] for point in alone["at"]]
    )
    made = sum(part["share"] for part in both["contribution"]) * both["annual_rate"]
    last = hazard["annual_rate"][-1]
    end = 0.05 + 0.95 * alone["at"][-1]["probability"]
    assert made + end * last == pytest.approx(both["annual_rate"], rel=1e-9)


@pytest.mark.parametrize(("k", "dispersion"), [(2.5, 0.3), (1.5, 0.6)])
def test_the_interval_of_a_power_law_is_that_of_its_exponent(k, dispersion):
    """With many runs to first order: the logarithm of the closed form goes by -k with that of the median and by
    k^2 dispersion^2 with that of the dispersion; their covariance is by Fisher's information."""
    knowledge, covariance = known(2.0, dispersion, 3e5)
    rates = annual(curve(2.0, dispersion, knowledge), power_law(1e-3, k, (1e-3, 1e4)))
    slopes = np.array([-k, (k * dispersion) ** 2])
    deviation = math.sqrt(slopes @ covariance @ slopes)
    low, high = rates["annual_rate_interval"]
    assert math.log(high / low) / 2.0 == pytest.approx(t.ppf(0.95, 9) * deviation, rel=5e-3)
    fractiles = rates["annual_probability_fractiles"]
    assert fractiles["50%"] == pytest.approx(rates["annual_probability"], rel=1e-12)
    made = [math.log(-math.log1p(-fractiles[name]) / rates["annual_rate"]) for name in ("5%", "16%", "84%", "95%")]
    expected = [deviation * t.ppf(share, 9) for share in (0.05, 0.16, 0.84, 0.95)]
    assert made == pytest.approx(expected, rel=2e-2)
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
    rates = annual(fragility, power_law(1e-3, k, (1e-3, 1e4)), known, ["a", "b", "c", "d"])
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
    assert points[1.0]["annual_rate"] == pytest.approx(1e-3, rel=1e-9)
    # The curve ends before.
    assert points[16.0]["annual_rate"] is None


def test_a_study_with_a_hazard_says_how_often_a_year(tmp_path):
    file = study_file(tmp_path, STUDY.format(hazard=INLINE), case=BLOCK)
    study = heeltoe.run_study(file, tmp_path / "out")
    assert [row["value"] for row in study.hazard] == [0.005, 0.01]
    assert [point["strength"] / 9.80665 for point in study.hazard[0]["at"]] == pytest.approx([0.1, 0.3, 0.5, 1.0, 2.0])
    weak, strong = study.hazard
    assert weak["annual_rate"] > strong["annual_rate"] > 0.0
    by_hand = annual(study.fragility[0], study.manifest["hazard"])
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
    assert "With the hazard of the site a residual slip of 5.0 mm is exceeded with" in " ".join(process.stdout.split())
    assert (tmp_path / "out/figures/hazard.png").is_file()
    assert "Annual probability" in (tmp_path / "out/report.html").read_text()


def test_a_limit_without_a_curve_has_no_rate(tmp_path):
    text = STUDY.format(hazard=INLINE).replace('"10 mm"', '"10 m"')
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
        ('file = "nowhere.csv"', "file-unreadable"),
        ('file = "bare.csv"', "hazard-header"),
        ('file = "words.csv"', "wrong-quantity"),
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


RATES = [0.02, 0.008, 0.002, 0.0009]
CSV = "{head}\n" + "".join(f"{x},{{{k}}}\n" for k, x in enumerate((0.05, 0.1, 0.2, 0.3)))
OPENQUAKE = """#,,,,,"generated_by='OpenQuake engine 3.24.1', kind='mean', investigation_time=50.0, imt='{imt}'"
lon,lat,depth,poe-0.0500000,poe-0.1000000,poe-0.2000000,poe-0.3000000,poe-2.0000000
10.00000,45.00000,0.00000,{},{},{},{},0.0
"""
NSHMP = {
    "response": {
        "metadata": {"imt": {"value": "PGA"}, "ylabel": "Annual Frequency of Exceedance"},
        "data": [{"component": "Total", "values": {"xs": [0.05, 0.1, 0.2, 0.3], "ys": RATES}}],
    }
}


def probabilities(years, factor=1.0):
    """Return what a Poisson process of the rates has in some years, by hand."""
    return [repr(factor * (1.0 - math.exp(-rate * years))) for rate in RATES]


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.csv", CSV.format(*RATES, head="pga [g],annual rate")),
        ("a.csv", CSV.format(*RATES, head="Ground Motion (g),AFE")),
        ("a.csv", CSV.format(*RATES, head="PGA (g), annual frequency of exceedance [1/yr]")),
        ("a.csv", CSV.format(*(1.0 / rate for rate in RATES), head="pga [g],return period [years]")),
        ("a.csv", CSV.format(*probabilities(50), head="pga [g], poe in 50 years")),
        ("a.csv", CSV.format(*probabilities(50, 100), head="PGA [g],probability in 50 years [%]")),
        ("a.csv", CSV.format(*probabilities(1), head="PGA [g],annual probability of exceedance")),
        ("a.csv", CSV.format(*RATES, head="pga [g],rate") + "2.0,0\n3.0,0\n"),
        ("a.csv", OPENQUAKE.format(*probabilities(50), imt="PGA")),
        ("a.json", json.dumps(NSHMP)),
        ("a.json", json.dumps({"response": {"hazardCurves": [NSHMP["response"]["metadata"] | NSHMP["response"]]}})),
    ],
)
def test_a_hazard_file_is_what_its_headings_say(tmp_path, name, content):
    (tmp_path / name).write_text(content, encoding="utf-8")
    found = read_pairs(tmp_path / name, "hazard.file", "acceleration", "pga", None)
    assert [text for text, _ in found] == ["0.05 g", "0.1 g", "0.2 g", "0.3 g"]
    assert [rate for _, rate in found] == pytest.approx(RATES, rel=1e-9)


# Made with functions of openquake.engine 3.26.2, openquake/risklib/scientific.py: `annual_frequency_of_exceedence` of
# the probabilities in so many years, and `probability_of_exceedance` of the rates in one year. Its logarithm of 1 - p
# rounds rates below 1e-10 a year, where the two differ by more than 1e-6. The first sites of its own 199 files of
# curves of PGA, PGV and SA in qa_tests_data were read so, too, with no other difference.
OQ_PROBABILITIES = [9.990000e-01, 6.321206e-01, 9.516258e-02, 9.950166e-03, 1.498876e-03, 2.000000e-08]
OQ_RATES = {
    50.0: [
        0.13815510557964272,
        0.020000002238311797,
        0.001999999956587993,
        0.00019999999493294267,
        3.000000876735831e-05,
        4.000000037894577e-10,
    ],
    1.0: [
        6.907755278982136,
        1.00000011191559,
        0.09999999782939964,
        0.009999999746647134,
        0.0015000004383679156,
        2.0000000189472886e-08,
    ],
    475.0: [
        0.01454264269259397,
        0.002105263393506505,
        0.0002105263112197887,
        2.1052631045572914e-05,
        3.1578956597219273e-06,
        4.2105263556785025e-11,
    ],
}
OQ_YEAR = {
    2.0: 0.8646647167633873,
    0.02: 0.019801326693244747,
    2e-3: 0.001998001332666921,
    1e-4: 9.999500016666385e-05,
    3e-7: 2.9999995498908305e-07,
}


@pytest.mark.parametrize("years", OQ_RATES)
def test_rates_are_those_of_openquake(tmp_path, years):
    head = f"#,,,,,\"generated_by='OpenQuake engine 3.26.2', kind='mean', investigation_time={years}, imt='PGA'\""
    levels = [0.05, 0.1, 0.2, 0.4, 0.8, 1.6]
    names = ",".join(f"poe-{level:.7f}" for level in levels)
    cells = ",".join(f"{probability:.6E}" for probability in OQ_PROBABILITIES)
    path = tmp_path / "hazard_curve-mean-PGA_1.csv"
    path.write_text(f"{head}\nlon,lat,depth,{names}\n10.00000,45.00000,0.00000,{cells}\n", encoding="utf-8")
    pairs = read_pairs(path, "hazard.file", "acceleration", "pga", None)
    assert [strength for strength, _ in pairs] == [f"{level} g" for level in levels]
    assert [rate for _, rate in pairs] == pytest.approx(OQ_RATES[years], rel=1e-6)


def test_no_probability_is_exceeded_in_no_time(tmp_path):
    path = tmp_path / "a.csv"
    head = "#,,,\"generated_by='OpenQuake engine 3.26.2', kind='mean', investigation_time=0, imt='PGA'\""
    path.write_text(f"{head}\nlon,lat,depth,poe-0.1,poe-0.2\n10,45,0,0.1,0.05\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"hazard\.file: 0 years is out of range"):
        read_pairs(path, "hazard.file", "acceleration", "pga", None)


@pytest.mark.parametrize("rate", OQ_YEAR)
def test_probabilities_in_a_year_are_those_of_openquake(rate):
    """A dam that exceeds its limit in every motion does so as often as there are motions."""
    hazard = {"strength": [1.0, 2.0], "annual_rate": [rate, 1e-3 * rate]}
    assert annual(curve(1e-6, 0.1), hazard)["annual_probability"] == pytest.approx(OQ_YEAR[rate], rel=1e-6)


def test_rates_of_nshmp_stay_as_they_are(tmp_path):
    """Its service returns annual rates, which no Poisson process turns into others."""
    (tmp_path / "a.json").write_text(json.dumps(NSHMP), encoding="utf-8")
    pairs = read_pairs(tmp_path / "a.json", "hazard.file", "acceleration", "pga", None)
    assert [rate for _, rate in pairs] == RATES
    percent = json.dumps(NSHMP).replace("Annual Frequency of Exceedance", "Probability of exceedance in 50 years")
    (tmp_path / "b.json").write_text(percent, encoding="utf-8")
    turned = read_pairs(tmp_path / "b.json", "hazard.file", "acceleration", "pga", None)
    assert [rate for _, rate in turned] == pytest.approx([-math.log1p(-rate) / 50.0 for rate in RATES], rel=1e-12)


@pytest.mark.parametrize(
    ("name", "content", "code"),
    [
        ("a.csv", CSV.format(*RATES, head="pga [g],exceedance"), "hazard-heading"),
        ("a.csv", CSV.format(*RATES, head="pga [g],probability"), "hazard-heading"),
        ("a.csv", CSV.format(*RATES, head="pga [g],rate in 50 years"), "hazard-heading"),
        ("a.csv", CSV.format(*RATES, head="pga [g],annual rate (x 10^-3)"), "hazard-heading"),
        ("a.csv", CSV.format(*RATES, head="pga [g],annual rate [%]"), "hazard-heading"),
        ("a.csv", CSV.format(*RATES, head="pga [g],rate [1/day]"), "hazard-heading"),
        ("a.csv", CSV.format(*RATES, head="pga [g],rate per 1000 years"), "hazard-heading"),
        ("a.csv", CSV.format(*RATES, head="pga [g],annual rate of occurrence"), "hazard-heading"),
        ("a.csv", CSV.format(*RATES, head="pga [g],probability of non-exceedance in 50 years"), "hazard-heading"),
        ("a.csv", CSV.format(2.3, 1.9, 1.3, 0.95, head="pga [g],log10 annual rate"), "heading-logarithm"),
        ("a.csv", CSV.format(2.3, 1.9, 1.3, 0.95, head="pga [g],ln(AFE)"), "heading-logarithm"),
        ("a.csv", CSV.format(*RATES, head="ln pga [g],annual rate"), "heading-logarithm"),
        ("a.csv", CSV.format(*RATES, head="acceleration at T = 0.2 s [g],annual rate"), "hazard-measure"),
        ("a.csv", CSV.format(*RATES, head="ground motion SA 1.0 s [g],annual rate"), "hazard-measure"),
        ("a.csv", CSV.format(*RATES, head="pga,annual rate"), "hazard-header"),
        ("a.csv", CSV.format(*RATES, head="SA(0.3 s) [g],annual rate"), "hazard-measure"),
        ("a.csv", CSV.format(*probabilities(50, 100), head="pga [g],poe in 50 years"), "out-of-range"),
        ("a.csv", OPENQUAKE.format(*probabilities(50), imt="SA(0.3)"), "hazard-measure"),
        ("a.csv", OPENQUAKE.format(*probabilities(50), imt="AvgSA(0.5)"), "hazard-measure"),
        ("a.csv", OPENQUAKE.format(*probabilities(50), imt="CAV"), "hazard-measure"),
        ("a.json", json.dumps(NSHMP).replace("PGA", "MMI"), "hazard-measure"),
        ("a.csv", OPENQUAKE.format(*probabilities(50), imt="PGA") + "11,45,0,0.5,0.4,0.3,0.2,0\n", "several"),
        ("a.json", '{"response": {}}', "file-unreadable"),
        ("a.json", "[" * 20_000, "file-unreadable"),
    ],
)
def test_a_hazard_file_that_says_something_else_is_refused(tmp_path, name, content, code):
    (tmp_path / name).write_text(content, encoding="utf-8")
    with pytest.raises(InputError) as refused:
        read_pairs(tmp_path / name, "hazard.file", "acceleration", "pga", None)
    assert refused.value.code == code


def test_a_curve_of_a_spectral_acceleration_has_a_period(tmp_path):
    (tmp_path / "a.csv").write_text(CSV.format(*RATES, head="SA(0.3 s) [g],annual rate"), encoding="utf-8")
    assert len(read_pairs(tmp_path / "a.csv", "hazard.file", "acceleration", "sa", 0.3)) == 4
    with pytest.raises(InputError, match=r"sa at 0\.5 s"):
        read_pairs(tmp_path / "a.csv", "hazard.file", "acceleration", "sa", 0.5)
