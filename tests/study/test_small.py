"""A table of runs: every combination of some values, each run the one a user could make by hand."""

from __future__ import annotations

import json

import pytest

from heeltoe import InputError, read_case, rigid
from heeltoe.result.write import json_text
from heeltoe.study.small.run_table import MOST, parse_axes, run_small
from shared.dams import BLOCK, KOYNA, SHORT, TRIANGLE, polygon

VERTICAL = ["motion.vertical.file=elcentro-1940-up-nga"]
# Variations of each kind, and the changes that the second of their runs has.
KINDS = {
    "numbers": (KOYNA, "crack.friction=0.9,1.1", ["crack.friction=1.1"]),
    "quantities": (KOYNA, "reservoir.depth=85 m,280ft", ["reservoir.depth=280 ft"]),
    "words": (KOYNA, "uplift.pattern=none,triangular", ["uplift.pattern=triangular"]),
    "truth": (KOYNA, "motion.reverse=false,true", ["motion.reverse=true"]),
    "motions": (KOYNA, "motion.file=elcentro-1940-180-nga,pacoima-1971-164-nga", ["motion.file=pacoima-1971-164-nga"]),
    "blocks in blocks": (KOYNA, "motion.vertical.pga=0.1 g,0.3 g", [*VERTICAL, "motion.vertical.pga=0.3 g"]),
    "blocks that were not there": (KOYNA, "ice.force=50 kN/m,150 kN/m", ["ice.force=150 kN/m"]),
    "options of the run": (KOYNA, "analysis.rotation=small,p-delta", ["analysis.rotation=p-delta"]),
}


def grid(path, texts, changes=(), run=rigid, **options):
    return run_small(path, changes, parse_axes(texts), run, **options)


@pytest.mark.parametrize("kind", KINDS)
def test_each_run_is_the_one_by_hand(kind):
    path, text, changes = KINDS[kind]
    common = [*SHORT, *(VERTICAL if "vertical" in text else [])]
    table = grid(path, [text], common)
    by_hand = rigid(read_case(path, [*SHORT, *changes]))
    assert len(table.responses) == 2
    assert table.responses[1].to_json()["residual_slip_m"] == by_hand.residual_slip_m
    assert table.responses[0].residual_slip_m != table.responses[1].residual_slip_m


def test_every_combination_the_last_varies_fastest():
    table = grid(BLOCK, ["crack.friction = 0.2 , 0.3", "motion.reverse=true,false", "gravity=9.81 m/s^2"])
    assert (table.axes[0].path, table.axes[0].values) == ("crack.friction", ("0.2", "0.3"))
    assert table.cells == (
        ("0.2", "true", "9.81 m/s^2"),
        ("0.2", "false", "9.81 m/s^2"),
        ("0.3", "true", "9.81 m/s^2"),
        ("0.3", "false", "9.81 m/s^2"),
    )
    # Pushed the other way, a block slides the other way.
    slips = [item.residual_slip_m for item in table.responses]
    assert slips[0] == pytest.approx(-slips[1], rel=1e-12)
    assert slips[2] == pytest.approx(-slips[3], rel=1e-12)


def test_what_varies_wins_over_what_is_set():
    (response,) = grid(BLOCK, ["crack.friction=0.3"], ["crack.friction=0.2"]).responses
    assert response.residual_slip_m == rigid(read_case(BLOCK, ["crack.friction=0.3"])).residual_slip_m


def test_a_value_may_hold_an_equals_sign():
    (axis,) = parse_axes(["title=a=b,c"])
    assert (axis.path, axis.values) == ("title", ("a=b", "c"))


def test_what_varies_may_be_spread_as_in_a_study_file():
    table = grid(KOYNA, ['reservoir.depth={ from = "80 m", to = "100 m", count = 3 }'], SHORT)
    assert table.cells == (("80 m",), ("90 m",), ("100 m",))
    assert (
        table.responses[1].residual_slip_m == rigid(read_case(KOYNA, [*SHORT, "reservoir.depth=90 m"])).residual_slip_m
    )
    (axis,) = parse_axes(['crack.friction={distribution="lognormal",median=1,dispersion=0.2,count=3}'])
    assert axis.values == ("0.824083", "1", "1.21347")  # exp(0.2 z), z a sixth from either end


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("crack.friction={from=0.8,to=1.2}", "study-count"),
        ("crack.friction={from=0.8,count=3}", "option-missing"),
        ("crack.friction={from=1.2,to=0.8,count=3}", "out-of-range"),
        ("crack.friction={from=0.8", "wrong-quantity"),
        ("uplift.pattern={from=0.8,to=1.2,count=3}", "study-not-a-number"),
        ("crack.friction={from=1,to=1.0000000001,count=3}", "listed-twice"),
    ],
)
def test_spreads_that_are_none(text, code):
    with pytest.raises(InputError) as refused:
        parse_axes([text])
    assert refused.value.code == code


def test_the_table_has_the_numbers_of_the_runs():
    grid_table = grid(KOYNA, ["crack.friction=0.1,1.0"], SHORT)
    table = grid_table.to_table().to_pylist()
    assert table == grid_table.rows()
    first, *_, last = table[0]
    assert (first, last) == ("crack.friction", "outcome")
    response, row = grid_table.responses[1], table[1]
    for name in (
        "residual_slip_m",
        "peak_slip_downstream_m",
        "rocking_upstream_rad",
        "opening_downstream_m",
        "impacts",
    ):
        assert row[name] == response.summary[name], name
    assert sum(row[f"slip_{name}_m"] for name in ("sliding", "slide_rocking", "drifting")) == pytest.approx(
        row["residual_slip_m"], abs=1e-12
    )
    # Whatever is not the name of the run has no number without a result.
    assert {value for name, value in table[0].items() if name not in ("crack.friction", "outcome")} == {None}


def test_json():
    table = grid(KOYNA, ["crack.friction=0.1,1.0", "motion.reverse=true"], SHORT)
    data = json.loads(json_text(table.to_json()), parse_constant=pytest.fail)
    assert data["model"] == "rigid"
    assert data["varied"] == {"crack.friction": ["0.1", "1.0"], "motion.reverse": ["true"]}
    assert [run["varied"] for run in data["runs"]] == [
        {"crack.friction": "0.1", "motion.reverse": "true"},
        {"crack.friction": "1.0", "motion.reverse": "true"},
    ]
    one = json.loads(json_text(table.responses[1].to_json()))
    assert {**one, "varied": data["runs"][1]["varied"]} == data["runs"][1]
    assert data["build"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("crack.friction=0.9,eleven", "wrong-quantity"),
        ("crack.friction=0.9,12", "out-of-range"),
        ("reservoir.depth=90 m,90", "unit-missing"),
        ("reservoir.depth=90 m,220 m", "above-other"),
        ("uplift.pattern=none,some", "not-a-choice"),
        ("crack.frictoin=0.9,1.0", "unknown-field"),
        ("crack=1,2", "wrong-type"),
        # A list has commas of its own, so it cannot vary.
        ('uplift.points=[[0,"90 m"],[1,"0 m"]]', "wrong-type"),
    ],
)
def test_all_cases_are_read_before_the_first_one_runs(text, code):
    ran = []
    with pytest.raises(InputError) as refused:
        grid(KOYNA, [text], SHORT, ran.append)
    assert refused.value.code == code
    assert not ran


def test_one_says_how_far_it_is():
    message = []
    grid(BLOCK, ["crack.friction=0.2,0.3,0.4"], progress=lambda done, of: message.append((done, of)))
    assert message == [(0, 3), (1, 3), (2, 3)]


def test_the_fields_themselves_can_vary():
    pulse = {"points": [["0 s", "0.8 g"], ["0.4 s", "0 g"]]}
    fields = {"section": polygon(TRIANGLE), "crack": {"friction": 0.5}, "motion": pulse}
    table = grid(fields, ["crack.friction=0.5,0.6"])
    assert abs(table.responses[0].residual_slip_m) > abs(table.responses[1].residual_slip_m) > 0.0
    assert fields["crack"] == {"friction": 0.5}


def test_as_many_as_a_table_holds():
    assert len(parse_axes([f"crack.friction={','.join(map(str, range(MOST)))}"])[0].values) == MOST
    assert parse_axes([]) == ()


def test_a_run_without_a_result_has_its_row():
    grid = run_small(KOYNA, SHORT, parse_axes(["crack.friction=0.1,1.0"]), rigid)
    rows = grid.rows()
    assert [row["outcome"] for row in rows] == ["unstable", "ok"]
    assert rows[0]["residual_slip_m"] is None
    assert rows[1]["residual_slip_m"] is not None
    # What has no result is seen in the exit code, too.
    assert not grid.ok
    assert (grid.model, grid.title) == ("rigid", "Koyna Dam cracked at 66.5 m")
    assert not run_small(KOYNA, SHORT, parse_axes(["crack.friction=0.1"]), rigid).ok


@pytest.mark.parametrize(
    ("texts", "code"),
    [
        (["crack.friction"], "wrong-quantity"),
        (["crack.friction="], "wrong-quantity"),
        (["=1,2"], "wrong-quantity"),
        (["crack.friction=1,,2"], "wrong-quantity"),
        (["crack.friction=1", "crack.friction=2"], "listed-twice"),
        (["crack.friction=1,1"], "listed-twice"),
        ([f"crack.friction={','.join(map(str, range(MOST + 1)))}"], "too-many"),
    ],
)
def test_variations_that_are_none(texts, code):
    with pytest.raises(InputError) as refused:
        parse_axes(texts)
    assert refused.value.code == code
