"""A row of a study is the single run of its dam, to the last bit, with all defaults: also where the motion stops while
the dam still swings."""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import heeltoe
from heeltoe import open_study, read_case, read_study, run_study
from heeltoe.case.toml_writer import case_text
from heeltoe.models.run import MODELS, earthquake
from heeltoe.result.crest import CREST_PEAKS, crest_peaks
from heeltoe.study.plan.plan import Pilot, _worth, plan_of
from heeltoe.study.run.batches import NUMBERS, run_part
from heeltoe.study.run.run import pilot_run
from shared.dams import example
from shared.studies import rows, study_file
from validation.sources import on_rigid_plane

COARSE = ("flexible.elements_across=4", "flexible.evidence=none")
# Dams with all that a model knows: a base and a height, two cracks, laws, rough faces, anchors, kinks, a sequence.
DAMS = {
    "rigid": ("typical-base", "typical-height", "two-cracks", "rough-crack", "anchored", "aftershocks", "block"),
    "decoupled": ("typical-height", "koyna"),
    "flexible": (
        "typical-base",
        "typical-height",
        "two-cracks",
        "anchored",
        "stepped-crack",
        "lift-joint",
        "bonded-joint",
    ),
}
VALUES = {
    "impacts": lambda response: response.impacts,
    "largest_impact_velocity_m_s": lambda response: response.largest_impact_velocity_m_s,
    "end_time_s": lambda response: response.end_time_s,
    "energy_residual": lambda response: response.energy.residual,
    "cracked_length_m": lambda response: cracked_length_of(response),
}


@pytest.mark.parametrize(
    ("first", "ended", "scatters", "step"),
    [
        # A longer step that is kept, and halved; runs that scatter, and halved once more.
        (8e-4, 8e-4, False, 4e-4),
        (8e-4, 4e-4, False, 2e-4),
        (2e-4, 2e-4, True, 1e-4),
        (2e-4, 1e-4, True, 5e-5),
    ],
)
def test_other_dams_of_a_study_take_the_step_of_its_first_run(first, ended, scatters, step):
    pilot = Pilot(8, None, first, ended, 0.0, 0, None, scatters=scatters)
    other = SimpleNamespace(first_step=lambda: 4e-4, halvings=2)
    assert pilot.step_of(other) == pytest.approx(step)


def cracked_length_of(response):
    """Return what the earthquake has cracked of a bonded joint in the end; zero of a plain crack."""
    joint = getattr(response, "joint", None)
    return 0.0 if joint is None else joint.cracked_length_m


def number_of(response, name):
    """Return the number of a response that a column of a study has."""
    if name in VALUES:
        return VALUES[name](response)
    kind, _, rest = name.partition("_")
    if kind == "slip" or kind == "time":
        block = response.slip_by_mode_m if kind == "slip" else response.time_by_mode_s
        return block[rest.rpartition("_")[0]]
    return getattr(response, name)


def row_and_run(folder, case, model, more=""):
    """Return the only row of a study of a case, and the single run."""
    crest = {} if model == "decoupled" else {"limits.crest_displacement": "1 mm"}
    case = case.with_({"motion.sign": "recorded"} | crest)
    text = case_text(case.model_dump(mode="json", exclude_unset=True))
    plan = plan_of(read_study(study_file(folder, f'case = "case.toml"\nmodel = "{model}"\n{more}', case=text)))
    (row,) = run_part(plan, 0, plan.count).to_pylist()
    return row, MODELS[model](case, earthquake(case), None)


def assert_same(row, response):
    assert row["outcome"] == response.outcome
    if response.ok:
        assert {name: row[name] for name in NUMBERS} == {name: number_of(response, name) for name in NUMBERS}
        crest = {name: row[name] for name in CREST_PEAKS if name in row}
        assert crest == pytest.approx({name: crest_peaks(response.crest)[name] for name in crest}, rel=1e-9)


@pytest.mark.parametrize("model", DAMS)
@settings(deadline=None, max_examples=5, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_row_is_the_single_run_to_the_last_bit(model, data, tmp_path_factory):
    name = data.draw(st.sampled_from(DAMS[model]))
    changes = list(COARSE if model == "flexible" else ())
    if name not in ("aftershocks", "lift-joint", "stepped-crack"):
        changes.append(f"motion.duration={data.draw(st.sampled_from((1.3, 1.9, 2.6, 3.3)))} s")
        changes.append(f"motion.pga={data.draw(st.sampled_from((0.3, 0.6, 1.1)))} g")
    elif model == "flexible":
        changes.append(f"motion.duration={data.draw(st.sampled_from((2.6, 3.3)))} s")
    if name not in ("rough-crack", "lift-joint"):
        changes.append(f"crack.friction={data.draw(st.floats(0.6, 1.4))}")
    # Dams on rock have rows of their own below.
    assert_same(*row_and_run(tmp_path_factory.mktemp("rows"), on_rigid_plane(example(name, *changes)), model))


@pytest.mark.slow
def test_a_study_of_one_row_says_what_the_run_with_its_evidence_says(tmp_path):
    case = example("typical-base", "motion.duration=2.6 s", "flexible.elements_across=4", "crack.friction=0.9")
    text = case_text(case.model_dump(mode="json", exclude_unset=True))
    file = study_file(tmp_path, 'case = "case.toml"\nmodel = "flexible"\n', case=text)
    run_study(file, tmp_path / "out")
    row = max(rows(open_study(tmp_path / "out")), key=lambda row: abs(row["residual_slip_m"]))
    alone = heeltoe.run(case, "flexible")
    assert row["reversed"] == alone.signs[1].governs
    assert alone.evidence.asked == "full"
    assert alone.silence_s > 0.0
    assert_same(row, alone)


def test_strengths_of_a_motion_are_scaled_as_a_case_scales_it(tmp_path):
    case = example("typical-base", "motion.duration=2.6 s", *COARSE)
    text = case_text(case.model_dump(mode="json", exclude_unset=True))
    more = '[motions]\nboth_signs = false\nfiles = ["quakes/quake-a-000.txt"]\n'
    more += 'scale = { measure = "pga", values = ["0.7 g"] }\n'
    file = study_file(tmp_path, f'case = "case.toml"\nmodel = "flexible"\n{more}', case=text)
    plan = plan_of(read_study(file))
    (row,) = run_part(plan, 0, plan.count).to_pylist()
    fields = case.model_dump(mode="json", exclude_unset=True)
    fields["motion"] = {"file": str(tmp_path / "quakes/quake-a-000.txt"), "pga": "0.7 g"}
    assert_same(row, heeltoe.flexible(read_case(fields)))


def test_drains_at_a_place_may_vary_in_their_efficiency(tmp_path):
    case = example(
        "typical-base",
        'uplift.pattern="drained"',
        'uplift.drain_x="10 m"',
        "uplift.drain_efficiency=0.5",
        "motion.duration=2.6 s",
        "motion.sign=recorded",
    )
    text = case_text(case.model_dump(mode="json", exclude_unset=True))
    study = 'case = "case.toml"\nmodel = "rigid"\n[vary]\n"uplift.drain_efficiency" = [0.2, 0.7]\n'
    plan = plan_of(read_study(study_file(tmp_path, study, case=text)))
    for row in run_part(plan, 0, plan.count).to_pylist():
        by_hand = heeltoe.rigid(case.with_({"uplift.drain_efficiency": row["uplift.drain_efficiency"]}))
        assert row["residual_slip_m"] == pytest.approx(by_hand.residual_slip_m, rel=1e-12)


def test_a_study_that_leaves_the_vertical_motion_out_says_so(tmp_path):
    case = example("typical-base")
    fields = case.model_dump(mode="json", exclude_unset=True)
    fields["motion"]["vertical"] = {"points": [["0 s", "0 g"], ["1 s", "0.1 g"], ["2 s", "0 g"]]}
    study = 'case = "case.toml"\nmodel = "rigid"\n[motions]\nboth_signs = false\nfiles = ["quakes/quake-a-000.txt"]\n'
    plan = plan_of(read_study(study_file(tmp_path, study, case=case_text(fields))))
    assert any("no vertical component" in text for text in plan.warnings())


def test_some_rows_without_a_result_leave_the_study_with_its_answer(tmp_path):
    from typer.testing import CliRunner

    from heeltoe.cli.main import program

    # The weaker crack does not stand before the earthquake.
    case = example("typical-base", "motion.duration=2.6 s")
    text = case_text(case.model_dump(mode="json", exclude_unset=True))
    for frictions, code in (("[0.2, 1.0]", 0), ("[0.2, 0.3]", 3)):
        study = f'case = "case.toml"\nmodel = "rigid"\n[vary]\n"crack.friction" = {frictions}\n'
        file, out = study_file(tmp_path, study, case=text), tmp_path / f"out-{code}"
        result = CliRunner().invoke(program(), ["study", str(file), "--out", str(out), "--no-figures"])
        assert result.exit_code == code, result.output
        assert "unstable" in result.output
        assert "unstable" in {row["outcome"] for row in rows(open_study(out))}


@pytest.mark.slow
def test_the_rows_of_one_dam_whose_runs_scatter_are_the_means_of_the_run(tmp_path):
    case = example("typical-height", "flexible.elements_across=2", "motion.pga=1 g", "motion.duration=5 s")
    text = case_text(case.model_dump(mode="json", exclude_unset=True))
    plan = plan_of(read_study(study_file(tmp_path, 'case = "case.toml"\nmodel = "flexible"\n', case=text)))
    plan = replace(plan, pilot=Pilot.from_json(json.loads(json.dumps(pilot_run(plan).to_json()))))
    table = run_part(plan, 0, plan.count).to_pylist()
    assert {row["reversed"] for row in table} == {False, True}
    scatter = 0
    for row in table:
        sign = "reversed" if row["reversed"] else "recorded"
        response = heeltoe.flexible(case.with_({"motion.sign": sign}))
        assert_same(row, response)
        scatter += response.evidence["value_is"] == "mean"
    assert scatter
    assert not any("single runs" in text for text in plan.warnings())


@pytest.mark.parametrize(
    ("evidence", "codes"),
    [
        ({"value_is": "run", "converged": True}, []),
        ({"value_is": "mean", "converged": True}, ["study-single-runs scatter"]),
        ({"value_is": "mean", "converged": False}, ["study-single-runs scatter", "study-single-runs uncertain"]),
    ],
)
def test_a_study_says_what_the_run_of_its_base_case_is_worth(evidence, codes):
    slip = {"value": 0.5, "run": 0.6, "uncertainty": 0.3}
    judged = evidence | {"residual_slip_m": slip}
    assert [notice.name for notice in _worth(judged, single_runs=True)] == codes
    # Where the rows are the pilot's own answers they are means, too.
    assert "study-single-runs scatter" not in {notice.name for notice in _worth(judged, single_runs=False)}


@pytest.mark.parametrize(
    ("name", "changes", "restitutions"),
    [
        ("typical-height", ["motion.pga=1.8g"], [0.3, 0.5, 0.8, 0.9, 0.95]),
        # The base bounces in all of them; the file lists the neck first.
        (
            "two-cracks",
            ["motion.pga=1.2g", "crack.friction=1.1", "crack.restitution=0.75", "further_cracks[0].friction=1.1"],
            [0.0, 0.75],
        ),
    ],
)
def test_a_row_whose_bounces_amplify_the_last_digit_is_counted(tmp_path, name, changes, restitutions):
    case = example(name, *changes, "motion.sign=recorded")
    text = case_text(case.model_dump(mode="json", exclude_unset=True))
    more = f'[vary]\n"crack.restitution" = {restitutions}\n'
    study = read_study(study_file(tmp_path, f'case = "case.toml"\nmodel = "rigid"\n{more}', case=text))
    plan = plan_of(study)
    ran = run_part(plan, 0, plan.count).to_pylist()
    result = [
        any(notice.name == "not-determined" for notice in MODELS["rigid"](one, earthquake(one), None).warnings)
        for one in (plan.case.with_({"crack.restitution": row["crack.restitution"]}) for row in ran)
    ]
    assert [row["undetermined"] for row in ran] == result
    assert any(result)
    assert name == "two-cracks" or not all(result)
    run_study(study, tmp_path / "out")
    assert open_study(tmp_path / "out").summary[0]["undetermined"] == sum(result)


@pytest.mark.parametrize("model", DAMS)
def test_a_row_of_a_dam_that_does_not_stand_ends_as_its_run(model, tmp_path):
    name = "typical-height" if model == "decoupled" else "typical-base"
    changes = COARSE if model == "flexible" else ()
    row, response = row_and_run(tmp_path, example(name, "crack.friction=0.05", "motion.duration=2 s", *changes), model)
    assert row["outcome"] == response.outcome == "unstable"
    assert all(row[name] is None for name in NUMBERS)
