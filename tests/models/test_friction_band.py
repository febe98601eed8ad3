"""A band of the friction: a run for each, and the limits judge the one that is named."""

from __future__ import annotations

import pytest

from heeltoe import InputError, run, run_suite
from shared.command import command
from shared.dams import ROOT, example
from shared.studies import earthquakes

QUICK = (
    "flexible.elements_across=4",
    "flexible.modes=12",
    "flexible.evidence=none",
    "motion.duration=6s",
    "rock=rigid",
)
BAND = {
    "low": 0.8,
    "high": 1.2,
    "slip_weakening": {"residual_friction": 0.8, "slip": "20 mm"},
    "speed_weakening": {"residual_friction": 0.85, "speed": "0.05 m/s"},
}
#: The other frictions as cases of their own, by hand.
ALONE = {
    "low": {"crack.friction": 0.8},
    "high": {"crack.friction": 1.2},
    "slip_weakening": {
        "crack.friction": None,
        "crack.law": {"name": "slip weakening", "peak_friction": 1.0, "residual_friction": 0.8, "slip": "20 mm"},
    },
    "speed_weakening": {
        "crack.friction": None,
        "crack.law": {"name": "speed weakening", "peak_friction": 1.0, "residual_friction": 0.85, "speed": "0.05 m/s"},
    },
}


@pytest.mark.parametrize("model", ["rigid", pytest.param("flexible", marks=pytest.mark.slow)])
def test_every_friction_of_a_band_is_the_run_of_its_own_case(model):
    case = example("typical-base", *QUICK)
    band = run(case.with_({"crack.band": BAND}), model).friction_band
    assert [trial.name for trial in band.trials] == ["best", *BAND]
    assert band.judged.name == "best"
    alone = {"best": case, **{name: case.with_(changes) for name, changes in ALONE.items()}}
    for trial in band.trials:
        assert trial.residual_slip_m == run(alone[trial.name], model).residual_slip_m


def test_the_limits_judge_the_friction_that_is_named():
    case = example("typical-base", *QUICK, "limits.residual_slip=500mm")
    low = run(case.with_({"crack.friction": 0.8}), "rigid")
    best = run(case, "rigid")
    assert best.limits[0].met != low.limits[0].met
    for judge, name in (("low", "low"), ("best", "best"), ("worst", "low")):
        judged = run(case.with_({"crack.band": {"low": 0.8, "high": 1.2, "judge": judge}}), "rigid")
        assert judged.residual_slip_m == best.residual_slip_m
        expected = low if name == "low" else best
        assert judged.limits[0].value == expected.limits[0].value
        assert judged.limits[0].friction == (None if name == "best" else name)
        assert judged.friction_band.judged.name == name


def test_verdict_json_and_terminal_have_a_line_for_each(tmp_path):
    case = example("typical-base", *QUICK, "limits.residual_slip=100mm")
    response = run(case.with_({"crack.band": {**BAND, "judge": "low"}}), "rigid")
    data = response.to_json()
    assert "With a friction of 0.8 it slides" in data["verdict"]
    assert "within 20 mm of slip it slides" in data["verdict"]
    assert "The limits judge a friction of 0.8" in data["verdict"]
    assert len(data["friction_band"]["trials"]) == 5
    reply = command(
        "run",
        ROOT / "examples" / "typical-base.toml",
        *("--model", "rigid", "--set", "motion.duration=6s", "--set", "crack.band.low=0.8", "--report"),
        cwd=tmp_path,
    )
    assert reply.returncode == 0, reply.stderr
    assert "friction of 0.8: slides" in reply.stdout
    page = next(tmp_path.rglob("report.html")).read_text(encoding="utf-8")
    assert "friction of 0.8" in page


def test_a_suite_that_would_judge_another_friction_than_it_runs_is_refused(tmp_path):
    records = earthquakes(tmp_path / "records")
    case = example("typical-base", *QUICK, "limits.residual_slip=100mm").with_({"crack.band": {"low": 0.8}})
    assert run_suite(case, records, model="rigid").suite.models[0].limits
    with pytest.raises(InputError, match=r'crack\.band\.judge: "worst" judges a single run'):
        run_suite(case.with_({"crack.band.judge": "worst"}), records, model="rigid")


def test_without_a_band_nothing_is_added():
    assert run(example("typical-base", *QUICK), "rigid").friction_band is None
    assert "friction_band" not in run(example("typical-base", *QUICK), "rigid").to_json()


@pytest.mark.parametrize(
    ("band", "words"),
    [
        ({"low": 1.2, "high": 0.8}, "is more than the highest"),
        ({"low": 0.8, "judge": "high"}, 'the band has no "high"'),
        ({"judge": "best"}, "low, high or a fall"),
        ({"low": 1.1}, "is more than the friction of the crack, 1"),
        ({"high": 0.9}, "is less than the friction of the crack, 1"),
        ({"slip_weakening": {"residual_friction": 1.1, "slip": "20 mm"}}, "is more than the friction of the crack, 1"),
    ],
)
def test_a_band_that_is_none_is_refused(band, words):
    with pytest.raises(InputError, match=words):
        example("typical-base").with_({"crack.band": band})


def test_a_fall_beside_a_law_is_refused():
    changes = {**ALONE["slip_weakening"], "crack.band": {"speed_weakening": BAND["speed_weakening"]}}
    with pytest.raises(InputError, match="which falls by itself"):
        example("typical-base").with_(changes)
