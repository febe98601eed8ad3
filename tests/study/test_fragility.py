"""Fragility curves: known answers come out, failures count, and what is said to hold with 90 % holds about so often."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scipy import optimize, stats

from heeltoe import InputError, run_study
from heeltoe.study.answers import fragility
from heeltoe.study.answers.answers import bands
from heeltoe.study.answers.hazard import annual
from heeltoe.study.answers.likelihood import Tally, fit, within, witnesses
from heeltoe.views.content.study import study_answer, study_sections
from heeltoe.views.figures.studies.all import study_figures
from shared.command import command
from shared.studies import BLOCK, DRAWN, GRID, study_file

MEDIAN, RECORD, OTHER = 0.5, 0.3, 0.25
LEVELS = np.linspace(0.1, 1.5, 15)
OPTIONS = {"confidence": 0.9}


def curve(limit, value, measure, strength, exceeds, event, **options):
    return fragility.curve(limit, value, measure, tally(strength, exceeds, event), **options)


def tally(strength, exceeds, event, pieces=1):
    seen = Tally()
    for here in np.array_split(np.arange(strength.size), pieces):
        seen.add(strength[here], exceeds[here], event[here])
    return seen


def capacities(seed, events, dams, record=RECORD, other=OTHER):
    """Return strength, whether each run exceeds, and its event: each dam through all strengths in each event."""
    random = np.random.default_rng(seed)
    capacity = MEDIAN * np.exp(
        record * random.standard_normal((events, 1, 1)) + other * random.standard_normal((events, dams, 1))
    )
    exceeds = (capacity <= LEVELS).astype(float)
    strength, event = np.broadcast_arrays(LEVELS, np.arange(events)[:, None, None])
    shape = exceeds.shape
    return np.broadcast_to(strength, shape).ravel(), exceeds.ravel(), np.broadcast_to(event, shape).ravel()


def test_a_known_curve_and_its_parts_come_out():
    fragility_curve = curve("residual_slip", 0.01, "pga", *capacities(12, 300, 20), **OPTIONS)
    assert fragility_curve.median == pytest.approx(MEDIAN, rel=0.04)
    assert fragility_curve.dispersion == pytest.approx(np.hypot(RECORD, OTHER), rel=0.05)
    assert fragility_curve.record == pytest.approx(RECORD, rel=0.08)
    assert fragility_curve.other == pytest.approx(OTHER, rel=0.05)
    assert fragility_curve.median_interval[0] < MEDIAN < fragility_curve.median_interval[1]
    assert fragility_curve.reached
    assert fragility_curve.probability(np.array([fragility_curve.median])) == pytest.approx(0.5)


def test_what_does_not_vary_within_an_event_is_of_the_records():
    fragility_curve = curve("residual_slip", 0.01, "pga", *capacities(2, 60, 4, other=0.0), **OPTIONS)
    assert fragility_curve.other == 0.0
    assert fragility_curve.record == fragility_curve.dispersion


def test_one_event_has_no_interval():
    strength, exceeds, event = capacities(3, 1, 50)
    fragility_curve = curve("residual_slip", 0.01, "pga", strength, exceeds, event, **OPTIONS)
    assert fragility_curve.median is not None
    assert fragility_curve.median_interval is None
    assert fragility_curve.interval_why == "one event does not show how events differ"
    assert fragility_curve.record is None


def test_the_fit_is_that_of_greatest_likelihood():
    strength, exceeds, event = capacities(4, 12, 3)
    seen = witnesses(strength, exceeds > 0.5, event)
    middle, dispersion = fit(seen, np.ones((1, seen.runs.size)))[0]

    def likelihood(m, d):
        p = stats.norm.cdf((np.log(strength) - m) / d)
        return np.sum(np.where(exceeds > 0.5, np.log(p), np.log1p(-p)))

    best = likelihood(middle, dispersion)
    for dm, dd in ((1e-4, 0.0), (-1e-4, 0.0), (0.0, 1e-4), (0.0, -1e-4)):
        assert likelihood(middle + dm, dispersion + dd) < best


def test_many_strengths_are_put_together_without_moving_the_curve():
    random = np.random.default_rng(5)
    strength = random.uniform(0.1, 1.5, 60_000)
    event = random.integers(0, 20, strength.size)
    exceeds = strength > MEDIAN * np.exp(0.4 * random.standard_normal(strength.size))
    together = witnesses(strength, exceeds, event)
    assert together.runs.size < 0.6 * strength.size
    assert together.runs.sum() == strength.size
    result = np.exp(fit(together, np.ones((1, together.runs.size)))[0, 0])
    # One event, none of it put together, in pieces that are few enough.
    alone = [fit(witnesses(strength[i::4], exceeds[i::4], event[i::4]), np.ones((1, 15_000)))[0, 0] for i in range(4)]
    assert result == pytest.approx(np.exp(np.mean(alone)), rel=2e-3)
    assert within(together, 0.5) == pytest.approx(0.4, rel=0.05)


def test_counting_part_by_part_gives_the_same_curve():
    random = np.random.default_rng(8)
    strength = np.exp(random.uniform(-2.0, 0.5, 90_000))
    event = random.integers(0, 20, strength.size)
    exceeds = (strength > MEDIAN * np.exp(0.4 * random.standard_normal(strength.size))).astype(float)
    whole, pieces = (tally(strength, exceeds, event, pieces).witnesses for pieces in (1, 13))
    assert whole.runs.size == pieces.runs.size < 0.5 * strength.size
    for name in ("event", "runs", "exceeding"):
        assert getattr(whole, name).tolist() == getattr(pieces, name).tolist()
    assert pieces.logarithm == pytest.approx(whole.logarithm, rel=1e-12, abs=1e-12)
    shares = curve("residual_slip", 0.01, "pga", strength, exceeds, event, **OPTIONS).shares
    assert len(shares) == 12
    middle, share = (np.array([getattr(one, name) for one in shares]) for name in ("strength", "share"))
    assert share == pytest.approx(stats.norm.cdf(np.log(middle / MEDIAN) / 0.4), abs=0.03)


def test_no_curve_where_none_can_be():
    strength, exceeds, event = capacities(6, 10, 2)
    none = curve("residual_slip", 0.01, "pga", strength, 0.0 * exceeds, event, **OPTIONS)
    assert none.median is None
    assert none.why == "no run exceeds it"
    all_ = curve("residual_slip", 0.01, "pga", strength, 0.0 * exceeds + 1.0, event, **OPTIONS)
    assert all_.why == "every run exceeds it"
    turned = curve("residual_slip", 0.01, "pga", strength, 1.0 - exceeds, event, **OPTIONS)
    assert turned.why == "stronger motions exceed it no more often"


def rows_of(*levels):
    """Return strength, whether runs exceed, and event, of levels (strength, runs, exceeding) of as many events each."""
    strength = np.concatenate([np.full(runs, float(at)) for at, runs, _ in levels])
    exceeds = np.concatenate([np.arange(runs) < hits for _, runs, hits in levels]).astype(float)
    return strength, exceeds, np.concatenate([np.arange(runs) % 4 for _, runs, _ in levels])


def exact(hits, runs, confidence):
    """The bounds of Clopper and Pearson as SciPy has them."""
    ends = stats.binomtest(hits, runs).proportion_ci(confidence, "exact")
    return pytest.approx((ends.low, ends.high), rel=1e-9, abs=1e-12)


def test_one_strength_has_a_share_with_exact_bounds_and_no_curve():
    """3 of 12: 25 % (5.5 to 57 %) by Clopper and Pearson, from SciPy's binomial test."""
    result = curve("residual_slip", 0.15, "pga", *rows_of((0.4, 12, 3)), confidence=0.95)
    assert (result.median, result.median_interval, result.dispersion) == (None, None, None)
    assert result.why == "a curve needs motions of three strengths, here there is one"
    (share,) = result.shares
    assert (share.strength, share.runs, share.exceeding, share.share) == (pytest.approx(0.4), 12, 3, 0.25)
    assert share.interval == exact(3, 12, 0.95)
    assert share.interval == pytest.approx((0.055, 0.572), abs=5e-4)
    assert result.gap == (None, None)
    assert share.fitted is None


@pytest.mark.parametrize(
    ("levels", "why", "gap"),
    [
        (((0.05, 6, 0), (1.5, 6, 6)), "a curve needs motions of three strengths, here there are two", (0.05, 1.5)),
        (((0.05, 6, 1), (1.5, 6, 4)), "a curve needs motions of three strengths, here there are two", (None, None)),
        (((0.1, 1, 0), (0.11, 1, 0), (0.12, 1, 0), (0.9, 1, 1), (0.91, 1, 1)), "the runs that exceed", (0.12, 0.9)),
        (((0.1, 6, 0), (0.3, 6, 3), (0.5, 6, 6)), "the runs that exceed", (0.1, 0.5)),
        (((0.1, 6, 0), (0.3, 6, 0), (0.5, 6, 2)), "the runs that exceed", (0.3, None)),
        (((0.1, 6, 0), (0.3, 6, 0), (0.5, 6, 0)), "no run exceeds it", (0.5, None)),
    ],
)
def test_without_three_strengths_or_overlap_there_is_a_gap_and_no_curve(levels, why, gap):
    """By hand: where the largest strength of a run that keeps the limit is not above the least of one that exceeds it,
    steeper curves are always as likely (Albert and Anderson 1984)."""
    result = curve("residual_slip", 0.15, "pga", *rows_of(*levels), **OPTIONS)
    assert (result.median, result.dispersion, result.fit) == (None, None, None)
    assert result.why.startswith(why)
    assert result.gap == tuple(None if end is None else pytest.approx(end) for end in gap)
    for share, (_, runs, hits) in zip(result.shares, levels, strict=True):
        assert share.interval == exact(hits, runs, 0.9)
        assert share.interval[1] > share.interval[0]
    if "overlap" in result.why:
        assert result.why.endswith("the estimate of the dispersion is zero")


def alike(levels, events):
    """Return runs of events that are all the same: nothing differs from event to event."""
    strength, exceeds, _ = rows_of(*levels)
    return np.tile(strength, events), np.tile(exceeds, events), np.repeat(np.arange(events), strength.size)


def profile(levels, events, median):
    """Return by how much the logarithm of the greatest likelihood falls where the median is given, by SciPy."""
    at, runs, hits = np.array(levels).T * np.array([[1.0], [events], [events]])

    def unlikely(middle, logarithm):
        z = (np.log(at) - middle) / np.exp(logarithm)
        return -np.sum(hits * stats.norm.logcdf(z) + (runs - hits) * stats.norm.logsf(z))

    def least(middle):
        found = optimize.minimize_scalar(lambda s: unlikely(middle, s), bounds=(-4.0, 12.0), method="bounded")
        return found.fun

    best = optimize.minimize(lambda x: unlikely(*x), [np.log(0.4), -1.0], method="Nelder-Mead", options={"xatol": 1e-9})
    return least(np.log(median)) - best.fun


def test_intervals_are_those_of_the_profile_likelihood():
    """Where events are all alike, runs are independent: the fall of the profile at the ends is by SciPy's optimizer."""
    levels = ((0.2, 10, 2), (0.4, 10, 5), (0.8, 10, 8))
    result = curve("residual_slip", 0.15, "pga", *alike(levels, 3), **OPTIONS)
    low, high = result.median_interval
    for end in (low, high):
        assert 2.0 * profile(levels, 3, end) == pytest.approx(stats.t.ppf(0.95, 2) ** 2, rel=5e-3)
    assert low < result.median < high
    assert result.interval_why == ""


def test_an_end_that_the_runs_do_not_give_is_none_and_said():
    """Runs that exceed at all strengths about alike: the likelihood of no rise at all, by SciPy, is within it."""
    levels = ((0.2, 10, 3), (0.4, 10, 3), (0.8, 10, 4))
    result = curve("residual_slip", 0.15, "pga", *alike(levels, 3), **OPTIONS)
    assert 2.0 * profile(levels, 3, 1e9) < stats.t.ppf(0.95, 2) ** 2
    assert result.median_interval == (None, None) or result.median_interval[1] is None
    assert result.median_interval[0] is None or result.median_interval[0] > 0.0
    assert result.dispersion_interval[0] > 0.0
    assert result.dispersion_interval[1] is None
    assert result.interval_why == "these runs do not show that stronger motions exceed it more often"
    low, high = result.within(np.array([0.1, 0.4, 2.0]))
    assert ((low < result.probability(np.array([0.1, 0.4, 2.0]))) & (low < high)).all()
    assert json.dumps(result.to_json(), allow_nan=False)


@pytest.mark.parametrize("hits", [(20, 46, 70, 82), (20, 60, 55, 82)])
def test_the_test_of_fit_of_independent_runs_is_that_of_the_table(hits):
    """With one event runs are independent, and p is that of chi-square with two degrees of freedom, by SciPy."""
    strength, exceeds, _ = rows_of(*zip((0.2, 0.4, 0.6, 0.8), (100,) * 4, hits, strict=True))
    result = curve("residual_slip", 0.15, "pga", strength, exceeds, np.zeros(400, dtype=int), **OPTIONS)
    expected = 100.0 * result.probability(np.array([0.2, 0.4, 0.6, 0.8]))
    chi_square = np.sum((hits - expected) ** 2 / (expected * (1.0 - expected / 100.0)))
    assert result.fit.chi_square == pytest.approx(chi_square, rel=1e-9)
    assert result.fit.p == pytest.approx(stats.chi2.sf(chi_square, 2), abs=0.08)
    assert result.fit.fits == (result.fit.p >= 0.05)


def test_a_curve_that_does_not_fit_says_so():
    """A share of the dams exceeds the limit at any strength: no lognormal curve begins with 12 %."""
    random = np.random.default_rng(9)
    strength, exceeds, event = capacities(10, 20, 20)
    weak = np.repeat(random.random(20 * 20) < 0.12, LEVELS.size)
    result = curve("residual_slip", 0.01, "pga", strength, np.maximum(exceeds, weak), event, **OPTIONS)
    assert not result.fit.fits
    assert result.fit.p < 0.05
    assert result.fit.share > result.fit.fitted + 0.03
    assert curve("residual_slip", 0.01, "pga", strength, exceeds, event, **OPTIONS).fit.fits


def test_dams_that_do_not_stand_are_a_part_of_their_own(tmp_path):
    text = DRAWN.replace("median = 0.4, dispersion = 0.2", "median = 0.06, dispersion = 0.6")
    case = BLOCK.replace("friction = 0.6", "friction = 0.6\ninclination = '2 deg'")
    study = run_study(study_file(tmp_path, text, case=case), tmp_path / "out")
    table = study.to_pandas()
    falls = int((table.groupby("sample").outcome.first() == "unstable").sum())
    assert 5 < falls < 55
    row = study.fragility[0]
    fallen = row["not_standing"]
    assert (fallen["count"], fallen["dams"], fallen["runs"]) == (falls, 60, falls)
    assert fallen["interval"] == exact(falls, 60, 0.9)
    # The others alone are behind the curve.
    stands = table[table.outcome != "unstable"]
    over = (stands.residual_slip_m.abs() > 0.001) | stands.outcome.isin(
        ["overturned", "lost", "large rotation", "keeps sliding"]
    )
    assert (row["runs"], row["exceeding"]) == (60 - falls, int(over.sum()))
    words = " ".join(repr(study_answer(study, "si")).split())
    assert words.index("do not stand before the earthquake") < words.index("Half of the dams exceed")
    assert f"{falls} of 60 dams ({100.0 * falls / 60:.1f} %" in words


def test_a_study_of_one_strength_says_shares_everywhere(tmp_path):
    text = DRAWN.replace('values = { from = "0.2 g", to = "2 g" }', 'values = ["0.7 g"]').replace('"pga"', '"sa"')
    text = text.replace('measure = "sa"\n', 'measure = "sa"\nperiod = "0.3 s"\n')
    text += '[hazard]\ncurve = [["0.1 g", 0.01], ["1 g", 0.001]]\n'
    study = run_study(study_file(tmp_path, text), tmp_path / "out")
    row = study.fragility[0]
    assert row["median"] is None
    assert [share["runs"] for share in row["shares"]] == [60]
    assert [one["annual_rate"] for one in study.hazard] == [None] * 3
    assert json.dumps(study.to_json(), allow_nan=False)
    share = row["shares"][0]
    words = " ".join(repr(study_sections(study, "si") + study_answer(study, "si")).split())
    assert "no curve: a curve needs motions of three strengths, here there is one" in words
    assert f"{100.0 * share['share']:.1f} %" in words
    axes = study_figures(study)["fragility"].axes[0]
    assert axes.get_legend().get_texts()[0].get_text().endswith(": no curve")
    assert "hazard" not in study_figures(study)


def made_up(seed):
    """Return what runs of a made-up study do, its hazard curve, and its true median and dispersion: 1 to 20 events, 1
    to 8 strengths, 1 to 12 dams, each through all strengths in each event or drawn anew, from none exceeding to all."""
    random = np.random.default_rng([1, seed])
    events, levels, dams = (int(random.integers(1, most)) for most in (21, 9, 13))
    record, other, median = random.uniform(0.0, 0.5), random.uniform(0.05, 0.5), np.exp(random.uniform(-3.0, 1.5))
    strength = np.sort(random.uniform(0.1, 1.5, levels))
    own = random.standard_normal((events, dams, 1 if random.random() < 0.5 else levels))
    exceeds = median * np.exp(record * random.standard_normal((events, 1, 1)) + other * own) <= strength
    at, event = (np.broadcast_to(x, exceeds.shape).ravel() for x in (strength, np.arange(events)[:, None, None]))
    points = int(random.integers(2, 7))
    hazard = {
        "strength": np.sort(np.exp(random.uniform(-4.0, 1.5, points))).tolist(),
        "annual_rate": np.sort(10.0 ** random.uniform(-9.0, 0.0, points))[::-1].tolist(),
    }
    return tally(at, exceeds.astype(float).ravel(), event), hazard, median, np.hypot(record, other)


def inside(value, ends):
    low, high = ends
    return (low is None or low <= value) and (high is None or value <= high)


# 200 studies with their tests of fit take some 5 s: no less shows what seldom happens.
@pytest.mark.parametrize("seeds", [range(50), pytest.param(range(50, 200), marks=pytest.mark.slow)], ids=len)
def test_no_random_study_has_an_interval_without_width_or_a_rate_above_the_hazard(seeds):
    curves = 0
    for seed in seeds:
        seen, hazard, _, _ = made_up(seed)
        result = fragility.curve("residual_slip", 0.1, "pga", seen, **OPTIONS)
        rates = annual(result, hazard, seen.witnesses, [str(event) for event in seen.events])
        json.dumps([result.to_json(), rates.to_json()], allow_nan=False)
        intervals = [share.interval for share in result.shares]
        intervals += [ends for ends in (result.median_interval, result.dispersion_interval) if ends]
        assert all(low is None or high is None or high > low * (1.0 + 1e-6) for low, high in intervals), seed
        if result.median is None:
            assert result.why
            assert rates["annual_rate"] is None
            continue
        curves += 1
        assert result.median_interval is not None or result.interval_why
        first = hazard["annual_rate"][0] * (1.0 + 1e-9)
        low, high = rates["annual_rate_bounds"]
        assert low == rates["annual_rate"] <= first
        assert low <= high <= first if high is not None else rates["bounds_why"]
        if rates["annual_rate_interval"] is not None:
            least, most = rates["annual_rate_interval"]
            assert least * (1.0 - 1e-9) <= low <= most * (1.0 + 1e-9)
            assert most <= first
            assert least < most or low == 0.0
    assert 0.3 < curves / len(seeds) < 0.7


@pytest.mark.slow
def test_intervals_of_random_studies_hold_about_as_often_as_they_say():
    held = []
    for seed in range(2000):
        seen, _, median, dispersion = made_up(seed)
        result = fragility.curve("residual_slip", 0.1, "pga", seen, **OPTIONS)
        if result.median_interval is not None:
            held.append([inside(median, result.median_interval), inside(dispersion, result.dispersion_interval)])
    share = np.mean(held, axis=0)
    assert len(held) > 600
    assert ((share > 0.85) & (share < 0.95)).all(), share


def test_a_median_beyond_the_motions_is_said():
    strength, exceeds, event = capacities(7, 40, 5)
    weak = strength < 0.35
    fragility_curve = curve("residual_slip", 0.01, "pga", strength[weak], exceeds[weak], event[weak], **OPTIONS)
    assert not fragility_curve.reached


def test_a_band_counts_what_is_not_known_as_the_worst():
    one = np.zeros(20, dtype=np.int64)
    (result,) = bands(lambda: [(one, np.repeat([1.0, 2.0], 10), np.array([*np.arange(1.0, 10.0), np.nan] * 2))])
    assert result["strength"] == pytest.approx([1.0, 2.0])
    assert result["runs"] == [10, 10]
    assert result["median"] == [5.0, 5.0]
    assert result["high"] == [9.0, 9.0]
    many, strength = np.zeros(1200, dtype=np.int64), np.linspace(1.0, 2.0, 1200)
    (drawn,) = bands(lambda: [(many, strength, strength**2)])
    assert len(drawn["runs"]) == 12
    assert sum(drawn["runs"]) == 1200
    assert drawn["median"] == pytest.approx(np.array(drawn["strength"]) ** 2, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("events", [21, 42])
def test_intervals_hold_about_as_often_as_they_say(events):
    # Of 100 trials chance makes three more or fewer: there are as many as tell 85 and 95 of 100 from 90.
    held, trials = np.zeros(2), 500
    for seed in range(trials):
        fragility_curve = curve("residual_slip", 0.01, "pga", *capacities([events, seed], events, 8), **OPTIONS)
        held += [
            fragility_curve.median_interval[0] <= MEDIAN <= fragility_curve.median_interval[1],
            fragility_curve.dispersion_interval[0] <= np.hypot(RECORD, OTHER) <= fragility_curve.dispersion_interval[1],
        ]
    # Neither too narrow nor too wide.
    assert (held >= 0.85 * trials).all(), held
    assert (held <= 0.95 * trials).all(), held


def test_the_command_says_what_the_study_found(tmp_path):
    file = study_file(tmp_path, DRAWN)
    process = command(
        "study", file, "--out", tmp_path / "out", "--json", tmp_path / "study.json", "--details", columns=80
    )
    assert process.returncode == 0, process.stderr
    assert "60 runs (60 dams; of 10 motions, one each)" in process.stderr
    for text in ("A block (study)", "residual slip: half stay below", "exceed", "median", "rotation 0.01 rad"):
        assert text in " ".join(process.stdout.split())
    assert max(len(line) for line in process.stdout.splitlines() if "wrote" not in line) <= 80
    assert (tmp_path / "study.json").read_text().count('"limit"') == 3
    assert "all runs are of rigid blocks" in " ".join(process.stdout.split())
    assert "all runs are of rigid blocks" in (tmp_path / "study.json").read_text()


def test_a_dry_run_says_what_there_would_be(tmp_path):
    process = command("study", study_file(tmp_path, GRID), "--dry-run", "--out", tmp_path / "out")
    assert process.returncode == 0
    assert "60 runs (6 dams x 5 motions x 2 strengths)" in process.stderr
    assert not (tmp_path / "out").exists()


def test_an_interrupted_command_says_how_to_go_on(tmp_path, monkeypatch):
    def stop(*args, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr("heeltoe.study.run.run._run", stop)
    process = command("study", study_file(tmp_path, GRID), "--out", tmp_path / "out")
    assert process.returncode == 130
    assert f"--out {tmp_path / 'out'} --resume" in process.stderr


def test_the_tables_of_an_opened_study(tmp_path):
    study = run_study(study_file(tmp_path, GRID), tmp_path / "out")
    frame = study.to_pandas()
    assert len(frame) == 60
    count, most = study.duckdb().execute("select count(*), max(abs(residual_slip_m)) from runs").fetchone()
    assert count == 60
    assert most == frame["residual_slip_m"].abs().max()
    cube = study.to_xarray()
    assert dict(cube.sizes) == {"crack.friction": 2, "crack.restitution": 3, "motion": 5, "strength": 2}
    one = frame.iloc[37]
    place = {name: one[name] for name in ("crack.friction", "crack.restitution", "motion")}
    there = cube["residual_slip_m"].sel(place).isel(strength=37 % 2)
    assert float(there) == one["residual_slip_m"]
    assert study.dataset.count_rows() == 60
    # All motions are scaled to these.
    assert study.strength("pga") == pytest.approx(np.tile([0.3 * 9.80665, 0.9 * 9.80665], 30))
    assert study.strength("arias")[1] == pytest.approx(9.0 * study.strength("arias")[0])
    with pytest.raises(InputError) as refused:
        study.strength("magnitude")
    assert refused.value.code == "not-a-choice"
    with pytest.raises(InputError) as refused:
        _ = study.fragility
    assert refused.value.code == "empty"
    assert study.bands()["rigid"]["runs"] == [30, 30]
    assert study.summary[0]["outcomes"] == {"ok": 60}
    drawn = run_study(study_file(tmp_path, DRAWN, "drawn.toml"), tmp_path / "drawn")
    with pytest.raises(InputError) as refused:
        drawn.to_xarray()
    assert refused.value.code == "study-no-answer"


def test_what_is_not_installed_is_said(tmp_path, monkeypatch):
    study = run_study(study_file(tmp_path, GRID), tmp_path / "out")
    for package, call in (("duckdb", study.duckdb), ("xarray", study.to_xarray), ("pandas", study.to_pandas)):
        with monkeypatch.context() as patch:
            patch.setitem(__import__("sys").modules, package, None)
            with pytest.raises(InputError, match="pip install"):
                call()


def test_what_a_field_that_varies_makes_suspicious_is_said(tmp_path):
    study = run_study(study_file(tmp_path, GRID.replace("[0.3, 0.5]", "[0.5, 3.0]")), tmp_path / "out")
    assert any("friction of 3 is higher" in text for text in study.manifest["warnings"])
