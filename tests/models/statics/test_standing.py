"""The warning of a run whose usual loads open the crack, water following."""

import json
import tomllib

import pytest

from heeltoe import build_block, read_case, statics
from heeltoe.mechanics.block import static_state
from heeltoe.models.statics.standing import standing_warnings
from shared.command import command

MASONRY = {
    "section": {
        "polygon": [
            ["-3 m", "0 m"],
            ["20 m", "0 m"],
            ["5 m", "26 m"],
            ["5 m", "30 m"],
            ["1 m", "30 m"],
            ["0 m", "22 m"],
        ]
    },
    "concrete": {"density": "2300 kg/m^3", "modulus": "20 GPa"},
    "crack": {"friction": 1.5},
    "reservoir": {"depth": "28 m"},
    "motion": {
        "points": [["0 s", "0 g"], ["0.1 s", "-0.1 g"], ["0.3 s", "0.05 g"], ["0.4 s", "0 g"]],
        "duration": "0.4 s",
    },
    "flexible": {"elements_across": 2, "evidence": "none"},
}


def said(case):
    return standing_warnings(case, static_state(build_block(case)))


def masonry(**changes):
    return read_case({**MASONRY, **changes})


def test_nothing_is_said_where_the_crack_stays_closed():
    assert said(masonry(reservoir={"depth": "20 m"})) == ()
    # Nothing follows where no water is.
    assert said(masonry(uplift={"pattern": "none"})) == ()


def test_part_of_the_crack_is_open_before_the_earthquake():
    (warning,) = map(str, said(masonry()))
    assert "open 0.42 m of the crack from its heel, 1.8 % of its width" in warning
    # 28 m of head, where the triangle falls by 28 * 0.418 / 23 m: half of it on what is open, half on the rest.
    lifts = 9.80665 * 28.0 * 0.41803 / 2.0
    assert f"{lifts:.4g} kN/m more" in warning
    (warning,) = said(masonry())
    assert f"open {0.41803 / 0.3048:.2f} ft of the crack" in warning.text("us")
    assert f"{1e3 * lifts / 4448.2216152605 * 0.3048:.4g} kip/ft more" in warning.text("us")


@pytest.mark.parametrize("units", ["si", "us"])
@pytest.mark.parametrize(
    "changes",
    [
        {"reservoir": {"depth": "28.6 m"}},
        {"concrete": {"density": "2100 kg/m^3"}, "uplift": {"pattern": "cut-off", "extent": 0.7, "intensity": 0.9}},
        {
            "concrete": {"density": "2100 kg/m^3"},
            "reservoir": {"depth": "29 m"},
            "uplift": {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 0.5},
        },
    ],
)
def test_the_profile_it_gives_has_the_water_of_the_static_check(changes, units):
    case = masonry(**changes)
    (warning,) = said(case)
    # It is meant to be copied, in whichever units the rest is told.
    given = warning.text(units).split("points = ")[1].removesuffix(" and intensity = 1")
    points = tomllib.loads(f"points = {given}")["points"]
    followed = masonry(**{**changes, "uplift": {"pattern": "profile", "points": points}})
    assert statics(followed).cases[0].normal_force_n == pytest.approx(statics(case).cases[0].normal_force_n, rel=1e-3)
    assert said(followed) == ()


THROUGH = {"concrete": {"density": "2000 kg/m^3", "modulus": "20 GPa"}, "reservoir": {"depth": "29.5 m"}}


@pytest.mark.parametrize("model", ["rigid", "flexible", "both"])
def test_a_run_says_that_the_crack_opens_through(model, tmp_path):
    path = tmp_path / "dam.json"
    path.write_text(json.dumps({**MASONRY, **THROUGH}))
    assert statics(read_case(path)).cases[0].outcome == "cracks through"
    result = command("run", path, "--model", model, "--json", "-")
    data = json.loads(result.stdout)
    for item in (data["beside"], data) if model == "both" else (data,):
        (warning,) = [warning for warning in item["warnings"] if warning["code"] == "crack-opens-through"]
        assert warning["severity"] == "grave"


def test_a_table_of_runs_says_it_of_the_runs_it_belongs_to(tmp_path):
    path = tmp_path / "dam.json"
    path.write_text(json.dumps(MASONRY))
    runs = json.loads(
        command("run", path, "--model", "rigid", "--vary", "reservoir.depth=20 m,28 m", "--json", "-").stdout
    )["runs"]
    assert [any(item["code"] == "crack-opens" for item in run["warnings"]) for run in runs] == [False, True]
