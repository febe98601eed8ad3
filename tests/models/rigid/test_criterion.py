"""How much farther dams slide than their blocks: the numbers in the package are those of the study beside it."""

from __future__ import annotations

import json
import math
import runpy
from importlib.resources import files

import pyarrow.parquet as pq
import pytest

from heeltoe.models.rigid.criterion import FAR_M, LEAST_M, SHARE, Fit, fits
from shared.dams import EXAMPLES

STUDY = EXAMPLES / "studies" / "rigid-or-flexible"


@pytest.fixture(scope="module")
def program():
    """What the program that fits consists of."""
    return runpy.run_path(str(STUDY / "fit_criterion.py"))


def test_the_numbers_shipped_are_those_of_the_study(program):
    shipped = json.loads(files("heeltoe.models.rigid").joinpath("criterion.json").read_text(encoding="utf-8"))
    result = program["all_fits"]()
    for model, by_regime in shipped.items():
        for regime, answer in by_regime.items():
            again = result[model].pop(regime)
            for name in ("constant", "slopes", "spread", "widening", "quantiles"):
                assert again.pop(name) == pytest.approx(answer.pop(name), abs=1.1e-4)
            assert again == answer
    assert all(not by_regime for by_regime in result.values())


def test_numbers_and_figure_go_where_the_user_says(program, tmp_path, capsys):
    shipped = files("heeltoe.models.rigid").joinpath("criterion.json")
    before = shipped.read_bytes()
    program["main"](tmp_path / "fit")
    assert {path.name for path in (tmp_path / "fit").iterdir()} == {"criterion.json", "rigid-or-flexible.png"}
    assert shipped.read_bytes() == before
    assert "margin" in capsys.readouterr().out


def test_neither_dams_nor_earthquakes_of_one_half_are_in_the_other():
    table = pq.read_table(STUDY / "runs.parquet")
    assert table.num_rows > 1000
    halves = {name: table.filter([item == name for item in table["half"].to_pylist()]) for name in ("fit", "check")}
    for name in ("dam", "event", "motion"):
        assert not set(halves["fit"][name].to_pylist()) & set(halves["check"][name].to_pylist())


@pytest.mark.parametrize("regime", ["slides", "holds"])
def test_the_band_holds_on_what_was_held_back(program, regime):
    """About as it says: nearer than 10 % with a few hundred dams."""
    fit = fits()["flexible"][regime]
    held = program["inside_ranges"](fit, [row for row in program["rows"]("flexible", regime) if row.held_back])
    assert len(held) > 200
    assert program["covered"](fit, held) == pytest.approx(SHARE, abs=0.1)
    # Without the regressors it would not.
    blind = Fit(0.0, {"period": 0.0}, 1.0, 0.0, (0.0, 1e-9), fit.ranges, fit.cases, {})
    assert program["covered"](blind, held) < 0.1


def test_what_is_said_of_blocks_that_hold_is_so_of_those_held_back(program):
    """More dams slide far where more are said to, and few where few are."""
    parts = program["foretold"](fits()["flexible"]["holds"])
    did = [part[3] for part in parts]
    assert did == sorted(did)
    assert did[0] < 0.1
    assert did[-1] > 0.9


def test_a_line_says_what_it_is():
    # Half of what is studied is above, half below; twice as far with each doubling of the number.
    quantiles = (-math.log(4.0), 0.0, math.log(4.0))
    fit = Fit(math.log(3.0), {"period": 1.0}, 1.0, 0.0, quantiles, {"period": (0.1, 2.0)}, 7, {})
    numbers = {"period": 2.0}
    assert fit.band(numbers, 0.5) == pytest.approx((3.0, 12.0))
    assert fit.beyond(numbers, 6.0) == pytest.approx(0.5)
    assert fit.beyond(numbers, 12.0) == pytest.approx(0.25)
    assert fit.beyond(numbers, 1e3) == 0.0
    assert fit.outside(numbers) is None
    assert (
        str(fit.outside({"period": 2.5})) == "first period over the mean period of the motion is 2.5, studied 0.1 to 2"
    )
    assert fit.outside({"period": math.nan}) is not None


def test_a_number_on_the_limit_of_the_study_is_inside_and_one_beyond_it_shows():
    fit = Fit(0.0, {"friction": 1.0}, 1.0, 0.0, (0.0, 1.0), {"friction": (0.6, 1.2)}, 7, {})
    assert fit.outside({"friction": 1.2 * (1.0 + 1e-15)}) is None
    assert str(fit.outside({"friction": 1.203})) == "coefficient of friction is 1.203, studied 0.6 to 1.2"


def test_a_block_that_slides_far_is_less_wrong():
    fit = fits()["flexible"]["slides"]
    numbers = {"slip": 0.1, "amplification": 1.0, "period": 0.5}
    near, far = fit.band(numbers), fit.band(numbers | {"slip": 100.0})
    assert near[0] > 2.0 * far[0]
    assert near[1] > 2.0 * far[1]
    assert LEAST_M < FAR_M
