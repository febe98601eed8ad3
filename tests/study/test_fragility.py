"""Fragility curves: known answers come out, failures count, and what is said to hold with 90 % holds about so often."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from heeltoe import InputError, run_study
from heeltoe.study.answers import fragility
from heeltoe.study.answers.answers import bands
from heeltoe.study.answers.fragility import observed
from heeltoe.study.answers.likelihood import Tally, fit, within, witnesses
from shared.command import command
from shared.studies import DRAWN, GRID, study_file

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
    middle, shares = observed(tally(strength, exceeds, event))
    assert len(middle) == 12
    assert shares == pytest.approx(stats.norm.cdf(np.log(np.array(middle) / MEDIAN) / 0.4), abs=0.03)


def test_no_curve_where_none_can_be():
    strength, exceeds, event = capacities(6, 10, 2)
    none = curve("residual_slip", 0.01, "pga", strength, 0.0 * exceeds, event, **OPTIONS)
    assert none.median is None
    assert none.why == "no run exceeds it"
    all_ = curve("residual_slip", 0.01, "pga", strength, 0.0 * exceeds + 1.0, event, **OPTIONS)
    assert all_.why == "every run exceeds it"
    turned = curve("residual_slip", 0.01, "pga", strength, 1.0 - exceeds, event, **OPTIONS)
    assert turned.why == "stronger motions exceed it no more often"


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
    assert refused.value.code == "study-measure"
    with pytest.raises(InputError) as refused:
        _ = study.fragility
    assert refused.value.code == "study-no-fragility"
    assert study.bands()["rigid"]["runs"] == [30, 30]
    assert study.summary[0]["outcomes"] == {"ok": 60}
    drawn = run_study(study_file(tmp_path, DRAWN, "drawn.toml"), tmp_path / "drawn")
    with pytest.raises(InputError) as refused:
        drawn.to_xarray()
    assert refused.value.code == "study-no-grid"


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
