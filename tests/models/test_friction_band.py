"""A band of the friction: a run for each, and the limits judge the one that is named."""

from __future__ import annotations

import json
import math
import tomllib

import pytest
from pydantic import ValidationError

from heeltoe import InputError, read_case, run, run_suite
from heeltoe.case.fields_file import read_fields
from heeltoe.case.model import Case, problems
from heeltoe.case.read import case_schema
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
    # The other frictions of an elastic dam take four times its step: docs/friction.md says less than 1 %.
    for trial in band.trials:
        near = 0.0 if model == "rigid" or trial.name == "best" else 0.01
        assert trial.residual_slip_m == pytest.approx(run(alone[trial.name], model).residual_slip_m, rel=near, abs=0.0)


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
    assert "less friction" not in reply.stdout
    page = next(tmp_path.rglob("report.html")).read_text(encoding="utf-8")
    assert "friction of 0.8" in page


def test_a_suite_that_would_judge_another_friction_than_it_runs_is_refused(tmp_path):
    records = earthquakes(tmp_path / "records")
    case = example("typical-base", *QUICK, "limits.residual_slip=100mm").with_({"crack.band": {"low": 0.8}})
    assert run_suite(case, records, model="rigid").suite.models[0].limits
    with pytest.raises(InputError, match=r'crack\.band\.judge: "worst" judges a single run'):
        run_suite(case.with_({"crack.band.judge": "worst"}), records, model="rigid")


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_without_a_band_the_answer_says_what_less_friction_does(model):
    case = example("typical-base", *QUICK, "flexible.evidence=step")
    if model == "rigid":
        case = case.with_("concrete.modulus=none", "rock=none")
    response = run(case)
    assert response.model == model
    assert response.friction_band is None
    assert "friction_band" not in response.to_json()
    less = run(case.with_("crack.friction=0.9"), model)
    governing = next(way.sign for way in response.signs if way.governs)
    own, other = (next(way.residual_slip_m for way in one.signs if way.sign == governing) for one in (response, less))
    effect = response.friction_effect
    assert effect.residual_slip_m == pytest.approx(other, rel=0.0 if model == "rigid" else 0.01)
    assert effect.slip_change_m == pytest.approx(abs(other) - abs(own), rel=0.02)
    assert response.to_json()["friction_effect"]["friction_change"] == -0.1


def test_laws_bonds_and_no_evidence_have_no_run_with_less_friction():
    case = example("typical-base", *QUICK)
    assert run(case).friction_effect is None  # no evidence is wanted
    block = case.with_("concrete.modulus=none", "rock=none")
    assert run(block).friction_effect is not None
    assert run(block, "rigid").friction_effect is None
    assert run(block.with_(ALONE["slip_weakening"])).friction_effect is None
    assert run(block.with_({"crack.friction": 0.1})).friction_effect is None


@pytest.mark.parametrize(
    ("band", "words"),
    [
        ({"low": 1.2, "high": 0.8}, "is above the highest friction"),
        ({"low": 0.8, "judge": "high"}, 'the band has no "high"'),
        ({"judge": "best"}, "low, high or a fall"),
        ({"low": 1.1}, "is above the friction of the crack, 1"),
        ({"high": 0.9}, "is below the friction of the crack, 1"),
        ({"slip_weakening": {"residual_friction": 1.1, "slip": "20 mm"}}, "is above the friction of the crack, 1"),
        ({"distribution": "normal", "mean": 1.0}, r"crack\.band\.std"),
        ({"distribution": "normal", "mean": 1.0, "std": "1 m"}, r"crack\.band\.std"),
        ({"distribution": "normal", "mean": 1.0, "std": 0.9}, "is below zero"),
        ({"distribution": "norm"}, r"crack\.band\.distribution"),
        (
            {"distribution": "uniform", "from": 1.2, "to": 0.8},
            r"crack\.band\.to: 0\.8 is out of range; give a value above 1\.2",
        ),
        ({"distribution": "uniform", "from": 0.8, "to": 1.2, "low": 0.7}, 'crack.band.low: cannot stand beside "distr'),
    ],
)
def test_a_band_that_is_none_is_refused(band, words):
    with pytest.raises(InputError, match=words):
        example("typical-base").with_({"crack.band": band})


def test_a_fall_beside_a_law_is_refused():
    changes = {**ALONE["slip_weakening"], "crack.band": {"speed_weakening": BAND["speed_weakening"]}}
    with pytest.raises(InputError, match="which falls by itself"):
        example("typical-base").with_(changes)


def test_the_band_of_a_distribution_has_its_5_and_95_percent():
    # By the table of the standard normal distribution: 95 % lie below 1.6449 standard deviations.
    case = example("typical-base")
    band = case.with_({"crack.band": {"distribution": "normal", "mean": 1.0, "std": 0.1}}).crack.band
    assert (band.low, band.high) == pytest.approx((1.0 - 0.16449, 1.0 + 0.16449), abs=1e-5)
    written = {"distribution": "lognormal", "median": 1.0, "dispersion": 0.15, "judge": "worst"}
    band = case.with_({"crack.band": written}).crack.band
    assert (band.low, band.high) == pytest.approx((math.exp(-0.15 * 1.64485), math.exp(0.15 * 1.64485)), abs=1e-5)
    assert band.judge == "worst"
    even = case.with_({"crack.band": {"distribution": "uniform", "from": 0.8, "to": 1.2}}).crack.band
    assert (even.low, even.high) == pytest.approx((0.82, 1.18))


def test_a_fitted_file_gives_friction_and_band(tmp_path):
    # Tests drawn about a friction of 0.9.
    rows = ["specimen,normal stress [MPa],peak shear [MPa]"]
    ratios = (0.88, 0.93, 0.9, 0.86, 0.91, 0.94, 0.89, 0.9)
    rows += [f"S{k},{0.2 + 0.1 * k:.1f},{ratio * (0.2 + 0.1 * k):.4f}" for k, ratio in enumerate(ratios)]
    (tmp_path / "tests.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    reply = command("law", "fit", "tests.csv", "--out", "fit", cwd=tmp_path)
    assert reply.returncode == 0, reply.stderr
    fields = read_fields(ROOT / "examples" / "typical-base.toml")
    del fields["crack"]["friction"]
    fields["crack"]["fit"] = str(tmp_path / "fit" / "law-fit.toml")
    case = read_case(fields)
    stated = tomllib.loads((tmp_path / "fit" / "law-fit.toml").read_text(encoding="utf-8"))["crack"]
    assert case.crack.friction == stated["friction"] == pytest.approx(0.9, abs=0.02)
    assert (case.crack.band.low, case.crack.band.high) == (stated["band"]["low"], stated["band"]["high"])
    assert "law-fit.toml" in case_schema()["$defs"]["Crack"]["properties"]["fit"]["description"]
    other = read_case(ROOT / "examples" / "typical-base.toml", {"crack.fit": fields["crack"]["fit"]})
    assert (other.crack.friction, other.crack.band) == (case.crack.friction, case.crack.band)
    # A friction that is set takes the place of the fit and of its band, or of those of the case.
    for case in (read_case(fields, "crack.friction=1.2"), other.with_("crack.friction=1.2")):
        assert (case.crack.friction, case.crack.band) == (1.2, None)
    with pytest.raises(InputError, match=r'crack\.friction: cannot stand beside "fit"'):
        read_case({**fields, "crack": {**fields["crack"], "friction": 1.0}})


@pytest.mark.parametrize(
    ("fit", "reason"),
    [
        ("none.toml", '"none.toml" is not there'),
        ("/dev/zero", '"/dev/zero" has more than 10 MB'),
        (".", '"." cannot be read (Is a directory)'),
        ("broken.toml", '"broken.toml" is not valid TOML'),
        ("empty.toml", '"empty.toml" has no friction of a crack'),
        ("flat.toml", '"flat.toml" has no friction of a crack'),
        ("dam.toml", '"dam.toml" is a case file, not a fit'),
        ("study.toml", '"study.toml" is a study, not a fit'),
        (3, "give the path of a file in quotes"),
    ],
)
def test_a_file_that_is_no_fit_is_refused_at_its_field(tmp_path, fit, reason):
    case = (ROOT / "examples" / "typical-base.toml").read_text(encoding="utf-8")
    for name, text in {
        "broken.toml": "[crack",
        "empty.toml": "title = 'no law'",
        "flat.toml": "crack = 0.9",
        "dam.toml": case,
        "study.toml": "case = 'dam.toml'\n[crack]\nfriction = 1.0",
    }.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    path = tmp_path / "own.toml"
    path.write_text(case.replace("friction = 1.0", f"fit = {json.dumps(fit)}"), encoding="utf-8")
    with pytest.raises(InputError) as refused:
        read_case(path)
    assert refused.value.field == "crack.fit"
    assert reason in str(refused.value)


def test_a_fit_is_read_with_the_file_of_the_case_alone():
    fields = read_fields(ROOT / "examples" / "typical-base.toml") | {"crack": {"fit": "law-fit.toml", "friction": 1.0}}
    with pytest.raises(ValidationError, match="has not been read"):
        Case.model_validate(fields)
    del fields["crack"]["friction"]
    assert [str(error) for error in problems(fields, None)[1]] == [
        'crack.fit: "law-fit.toml" has not been read; read the case by heeltoe.read_case'
    ]
