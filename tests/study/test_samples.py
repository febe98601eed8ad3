"""What is drawn: as evenly as the method promises, from the distributions that were asked for, and the same dam by the
same number whatever was drawn before."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from heeltoe import read_case
from heeltoe.case.distribution import Distribution
from heeltoe.study.plan import samples as module
from heeltoe.study.plan.axes import axis_of
from heeltoe.study.plan.file import read_study
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.plan.samples import Samples
from shared.dams import BLOCK
from shared.studies import DRAWN, study_file

PATHS = ("crack.friction", "crack.restitution", "uplift.intensity")


def axes():
    case = read_case(BLOCK)
    return [axis_of(path, Distribution(**{"from": 0.1, "to": 0.9}), case, drawn=True) for path in PATHS]


def shares(found, count):
    values, beside = found.at(np.arange(count))
    return np.column_stack([*((column - 0.1) / 0.8 for column in values.values()), beside])


def test_a_latin_hypercube_has_one_dam_in_each_stretch():
    fractions = shares(Samples(axes(), "latin hypercube", 50, 3, more=1), 50)
    assert (np.sort((fractions * 50).astype(int), axis=0) == np.arange(50)[:, None]).all()


def test_a_hypercube_of_several_pieces_is_one_in_each(monkeypatch):
    monkeypatch.setattr(module, "BLOCK", 16)
    fractions = shares(Samples(axes(), "latin hypercube", 48, 3), 48)
    for start in (0, 16, 32):
        piece = fractions[start : start + 16]
        assert (np.sort((piece * 16).astype(int), axis=0) == np.arange(16)[:, None]).all()
    assert not (fractions[:16] == fractions[16:32]).any()


@pytest.mark.parametrize("method", ["latin hypercube", "sobol", "sensitivity"])
def test_a_dam_is_the_same_whatever_was_drawn_before(method, monkeypatch):
    monkeypatch.setattr(module, "BLOCK", 16)
    one = Samples(axes(), method, 64, 5, more=1)
    count = one.count
    whole = shares(one, count)
    for numbers in (np.arange(20, 45), np.array([61, 3, 17]), np.array([count - 1])):
        values, beside = Samples(axes(), method, 64, 5, more=1).at(numbers)
        result = np.column_stack([*((column - 0.1) / 0.8 for column in values.values()), beside])
        assert (result == whole[numbers]).all()


def test_another_seed_draws_other_dams():
    one, other = (shares(Samples(axes(), "latin hypercube", 40, seed), 40) for seed in (1, 2))
    assert not (one == other).any()


def test_sobol_is_more_even_than_chance():
    fractions = shares(Samples(axes(), "sobol", 256, 1), 256)
    assert stats.qmc.discrepancy(fractions) < 0.2 * stats.qmc.discrepancy(np.random.default_rng(1).random((256, 3)))


def test_the_scheme_of_the_sensitivity_indices_exchanges_one_coordinate_at_a_time():
    result = shares(Samples(axes(), "sensitivity", 8, 1), 8 * 5).reshape(8, 5, 3)
    one, other = result[:, 0], result[:, 1]
    assert not (one == other).any()
    for coordinate in range(3):
        row = result[:, 2 + coordinate]
        assert (row[:, coordinate] == other[:, coordinate]).all()
        rest = [item for item in range(3) if item != coordinate]
        assert (row[:, rest] == one[:, rest]).all()


LAWS = {
    "uniform": ({"from": 0.2, "to": 0.6}, stats.uniform(0.2, 0.4)),
    "normal": ({"distribution": "normal", "mean": 0.5, "std": "5 %"}, stats.norm(0.5, 0.05)),
    "cut normal": (
        {"distribution": "normal", "mean": 0.5, "std": 0.1, "lower": 0.4, "upper": 0.55},
        stats.truncnorm(-1.0, 0.5, 0.5, 0.1),
    ),
    "lognormal": ({"distribution": "lognormal", "median": 0.4, "dispersion": 0.2}, stats.lognorm(0.2, scale=0.4)),
    "triangular": ({"distribution": "triangular", "from": 0.2, "mode": 0.3, "to": 0.8}, stats.triang(1 / 6, 0.2, 0.6)),
}


@pytest.mark.parametrize("name", LAWS)
def test_what_is_drawn_is_distributed_as_asked_for(name):
    given, law = LAWS[name]
    axis = axis_of("uplift.intensity", Distribution(**given), read_case(BLOCK), drawn=True)
    values, _ = Samples([axis], "latin hypercube", 4000, 1).at(np.arange(4000))
    drawn = values["uplift.intensity"]
    # A hypercube of so many dams leaves less than chance would.
    assert stats.kstest(drawn, law.cdf).statistic < 1e-3


def test_a_cut_lognormal_distribution_ends_where_it_is_cut():
    given = {"distribution": "lognormal", "median": 0.4, "dispersion": 0.5, "lower": 0.3, "upper": 0.5}
    axis = axis_of("uplift.intensity", Distribution(**given), read_case(BLOCK), drawn=True)
    values, _ = Samples([axis], "latin hypercube", 1000, 1).at(np.arange(1000))
    assert 0.3 <= values["uplift.intensity"].min() < 0.3005
    assert 0.4995 < values["uplift.intensity"].max() <= 0.5


def test_correlated_fields_have_the_rank_correlation_and_keep_their_distributions():
    pairs = [("crack.friction", "uplift.intensity", 0.7), ("crack.friction", "crack.restitution", -0.4)]
    values, _ = Samples(axes(), "sobol", 4096, 1, correlation=pairs).at(np.arange(4096))
    for first, second, wanted in pairs:
        assert stats.spearmanr(values[first], values[second]).statistic == pytest.approx(wanted, abs=0.005)
    for column in values.values():
        assert stats.kstest(column, stats.uniform(0.1, 0.8).cdf).statistic < 0.01


def test_words_are_drawn_evenly():
    axis = axis_of("uplift.pattern", ("none", "triangular"), read_case(BLOCK), drawn=True)
    values, _ = Samples([axis], "latin hypercube", 100, 1).at(np.arange(100))
    assert (values["uplift.pattern"] == "none").sum() == 50


def test_motions_are_drawn_evenly_and_strengths_by_their_measure(tmp_path):
    plan = plan_of(read_study(study_file(tmp_path, DRAWN)))
    runs = plan.runs(0, plan.count)
    # Five horizontal components, both ways round.
    assert (np.bincount(runs.motion) == 6).all()
    for number in range(plan.count):
        shake = plan.shakes[runs.motion[number]]
        assert runs.factor[number] * shake.reference == pytest.approx(runs.strength[number])
    assert runs.strength.min() > 0.2 * 9.80665
    assert runs.strength.max() < 2.0 * 9.80665


def test_a_pair_keeps_the_ratio_of_its_components(tmp_path):
    files = 'files = ["quakes/quake-a-000.txt", "quakes/quake-a-090.txt"]\npairs = true'
    text = DRAWN.replace('folder = "quakes"', files)
    plan = plan_of(read_study(study_file(tmp_path, text)))
    assert plan.events == ("quake-a",)
    assert len({shake.reference for shake in plan.shakes}) == 1


def test_what_a_distribution_says_is_that_of_the_law_before_it_is_cut():
    """As docs/studies.md has it: a normal law that is cut at k standard deviations on both sides keeps 1 - 2 k phi(k) /
    (2 Phi(k) - 1) of its variance, and one that is cut below at -k has its mean phi(k) / Phi(k) higher."""
    cut = Distribution(distribution="normal", mean=1.0, std=0.2, lower=0.7, upper=1.3)
    law = axis_of("crack.friction", cut, read_case(BLOCK), drawn=True).law
    k = 1.5
    left = 1.0 - 2.0 * k * stats.norm.pdf(k) / (2.0 * stats.norm.cdf(k) - 1.0)
    assert law.std() == pytest.approx(0.2 * np.sqrt(left), rel=1e-6) == pytest.approx(0.149, abs=5e-4)
    one_side = Distribution(distribution="normal", mean=1.0, std=0.2, lower=0.9)
    law = axis_of("crack.friction", one_side, read_case(BLOCK), drawn=True).law
    higher = 0.2 * stats.norm.pdf(0.5) / stats.norm.cdf(0.5)
    assert law.mean() == pytest.approx(1.0 + higher) == pytest.approx(1.10, abs=5e-3)
    assert law.std() == pytest.approx(0.139, abs=5e-4)
