"""Answers of a study: measures of strength compared, what the slip depends on; known answers and small studies."""

import json

import numpy as np
import pytest
from scipy.stats import qmc

from heeltoe import InputError, read_study, run_study
from heeltoe.study.answers.comparison import Comparison
from heeltoe.study.answers.sensitivity import sobol_indices, tornado
from shared.studies import DRAWN, GRID, study_file


def compared(strengths, demand, event, traits, pieces=1):
    """Compare measures, the runs taken in at once or in pieces."""
    result = Comparison(int(event.max()) + 1)
    for here in np.array_split(np.arange(demand.size), pieces):
        result.add(
            {name: each[here] for name, each in strengths.items()},
            demand[here],
            event[here],
            {name: each[here] for name, each in traits.items()},
        )
    return result.found()


def saltelli(function, dimensions, count):
    points = qmc.Sobol(2 * dimensions, rng=np.random.default_rng(1)).random(count)
    one, other = points[:, :dimensions], points[:, dimensions:]
    columns = [function(one), function(other)]
    for place in range(dimensions):
        mixed = one.copy()
        mixed[:, place] = other[:, place]
        columns.append(function(mixed))
    return np.column_stack(columns)


def ishigami(points):
    x = np.pi * (2.0 * points - 1.0)
    return np.sin(x[:, 0]) + 7.0 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def test_the_indices_of_ishigami_are_the_exact_ones():
    indices = sobol_indices(saltelli(ishigami, 3, 4096), ("x1", "x2", "x3"))
    assert (indices["rows"], indices["left_out"]) == (4096, 0)
    # With a = 7 and b = 0.1 (Ishigami and Homma 1990).
    exact = {"x1": (0.3139, 0.5576), "x2": (0.4424, 0.4424), "x3": (0.0, 0.2437)}
    assert [index["name"] for index in indices["indices"]] == ["x1", "x2", "x3"]
    for item in indices["indices"]:
        for kind, value in zip(("first", "total"), exact[item["name"]], strict=True):
            assert item[kind] == pytest.approx(value, abs=0.015)
            low, high = item[f"{kind}_interval"]
            assert low < value < high
            assert high - low < 0.1


def test_rows_with_a_failure_are_left_out_whole():
    values = saltelli(lambda x: 3.0 * x[:, 0] + x[:, 1], 2, 1024)
    values[5, 3] = np.nan
    indices = sobol_indices(values, ("much", "little"))
    assert (indices["rows"], indices["left_out"]) == (1023, 1)
    assert [index["first"] for index in indices["indices"]] == pytest.approx([0.9, 0.1], abs=0.02)


def test_what_does_not_vary_has_no_indices():
    assert sobol_indices(np.ones((8, 4)), ("a", "b"))["indices"] == []


def test_a_tornado_holds_like_against_like():
    values = np.array([[1.0, 2.0, 9.0], [1.0, 2.0, np.nan], [4.0, 5.0, 9.0], [0.5, 1.5, 9.0]])
    result = tornado(values, [("little", ["a"]), ("much", ["b", "c"])])
    assert (result["motions"], result["left_out"], result["base"]) == (2, 1, 1.5)
    assert [(field["name"], field["span"]) for field in result["fields"]] == [("much", 3.5), ("little", 0.0)]


def test_the_measure_that_makes_the_slip_is_the_most_efficient():
    random = np.random.default_rng(3)
    event = np.repeat(np.arange(40), 25)
    period = np.exp(0.5 * random.standard_normal(40))[event]
    good = np.exp(random.standard_normal(event.size))
    # The other measure does not know of the period, on which the slip hangs.
    other = good / period**2
    demand = 0.01 * good**1.5 * np.exp(0.3 * random.standard_normal(event.size))
    demand[:10] = np.nan
    demand[10:30] = 5e-5
    result = compared({"other": other, "good": good}, demand, event, {"period": np.log(period)})
    first, second = result["measures"]
    pieces = compared({"other": other, "good": good}, demand, event, {"period": np.log(period)}, pieces=7)
    assert pieces["measures"][0]["efficiency"] == pytest.approx(first["efficiency"], rel=1e-12)
    assert pieces["measures"][1]["sufficiency"]["period"]["p"] == pytest.approx(
        second["sufficiency"]["period"]["p"], rel=1e-9
    )
    assert result["unknown"] == 10
    assert result["at_rest"] == 20 + int((demand[30:] <= 1e-4).sum())
    assert (first["measure"], second["measure"]) == ("good", "other")
    assert first["efficiency"] == pytest.approx(0.3, abs=0.02)
    assert first["slope"] == pytest.approx(1.5, abs=0.05)
    assert first["sufficiency"]["period"]["p"] > 0.05
    assert second["sufficiency"]["period"]["p"] < 1e-6
    assert second["sufficiency"]["period"]["slope"] > 1.0


def test_a_strength_that_does_not_vary_has_the_scatter_of_the_slip():
    demand = np.array([0.01, 0.02, 0.04])
    result = compared({"pga": np.ones(3)}, demand, np.arange(3), {})["measures"][0]
    assert result["slope"] is None
    assert result["efficiency"] == pytest.approx(np.log(demand).std(ddof=1))


def test_the_indices_of_a_study(tmp_path):
    text = DRAWN.replace('"latin hypercube"\nsamples = 60', '"sensitivity"\nsamples = 32')
    study = run_study(study_file(tmp_path, text), tmp_path / "out")
    rigid = study.sensitivity()["rigid"]
    names = {index["name"] for index in rigid["indices"]}
    assert names == {"crack.friction", "concrete.density", "crack.restitution", "motion", "strength"}
    assert (rigid["rows"], rigid["left_out"]) == (32, 0)
    # The same rows by hand, from the table.
    slip = np.abs(study.to_table(["residual_slip_m"])["residual_slip_m"].to_numpy()).reshape(32, 7)
    again = sobol_indices(slip, [*study.manifest["study"]["vary"], "motion", "strength"])
    assert again == rigid
    json.dumps(study.to_json(), allow_nan=False)
    with pytest.raises(InputError, match="method: a study by sensitivity does not compute this"):
        study.tornado()


def test_the_tornado_of_a_study(tmp_path):
    text = GRID.replace('"case.toml"\n', '"case.toml"\nmethod = "one at a time"\n', 1)
    study = run_study(study_file(tmp_path, text), tmp_path / "out")
    rigid = study.tornado()["rigid"]
    assert {field["name"]: [end["value"] for end in field["values"]] for field in rigid["fields"]} == {
        "crack.friction": ["0.3", "0.5"],
        "crack.restitution": ["0.2", "0.5", "0.8"],
    }
    runs = study.to_table(["sample", "residual_slip_m"]).to_pylist()
    mean = np.mean([abs(run["residual_slip_m"]) for run in runs if run["sample"] == 1])
    assert rigid["fields"][0]["values"][0]["demand"] == pytest.approx(mean)


def test_magnitude_and_distance_of_events_are_looked_at(tmp_path):
    events = "".join(
        f'[[motions.events]]\nhorizontal = "quakes/quake-{name}.txt"\nmagnitude = {size}\ndistance = "{far} km"\n'
        for name, size, far in (("a-000", 6.0, 10), ("b-000", 6.5, 20), ("c-180", 7.0, 40))
    )
    scale = '[motions.scale]\nvalues = ["0.6 g", "0.9 g"]\n'
    text = f'case = "case.toml"\n[vary]\n"crack.friction" = [0.2, 0.3]\n{events}{scale}'
    file = study_file(tmp_path, text)
    assert read_study(file).motions.events[2].distance == 40e3
    rigid = run_study(file, tmp_path / "out").compared()["rigid"]
    assert len(rigid["measures"]) == 6
    for measure in rigid["measures"]:
        assert measure["sufficiency"]["magnitude"]["events"] == 3
        assert 0.0 <= measure["sufficiency"]["distance_m"]["p"] <= 1.0
