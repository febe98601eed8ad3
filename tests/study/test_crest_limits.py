"""Limits on the crest in studies, suites and tables of dams: a row says of the crest what its single run says."""

from __future__ import annotations

import numpy as np
import pytest

import heeltoe
from heeltoe.errors.error import InputError
from heeltoe.models.run import MODELS
from heeltoe.result.crest import CREST_PEAKS, crest_peaks
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.run.batches import run_part
from shared.command import command
from shared.studies import study_file

DAM = """
title = "Dam"
rock = "rigid"
[section]
height = "40 m"
base_width = "32 m"
crest_width = "5 m"
neck_height = "36 m"
neck_width = "5 m"
[concrete]
modulus = "20 GPa"
[crack]
friction = 0.9
{crack}
[reservoir]
depth = "36 m"
compressible = false
[flexible]
elements_across = 3
evidence = "none"
[limits]
crest_displacement = "20 mm"
crest_acceleration = "5 m/s^2"
[motion]
points = [["0 s", "0 g"], ["0.2 s", "0.4 g"], ["0.4 s", "0 g"]]
"""
MOTIONS = """
[motions]
folder = "quakes"
both_signs = false
scale = { measure = "pga", values = ["0.5 g", "1.2 g"] }
"""


def rows_and_runs(folder, study, crack="", model="rigid"):
    """Walk the rows of a study, each with the single run of its dam."""
    plan = plan_of(heeltoe.read_study(study_file(folder, study + MOTIONS, case=DAM.format(crack=crack))))
    for row in run_part(plan, 0, plan.count).to_pylist():
        changes = {}
        for axis in plan.axes:
            changes |= axis.changes(row[axis.path])
        (place,) = (k for k, shake in enumerate(plan.shakes) if shake.name == row["motion"])
        shaken = plan.earthquakes[place].scaled(row["factor"])
        yield row, MODELS[model](plan.case.with_(changes), shaken, None)


@pytest.mark.parametrize(
    ("vary", "crack", "model"),
    [
        # Side by side in columns, among them the height of the crest above the crack, and one g.
        ('"crack.elevation" = ["0 m", "12 m"]\n"gravity" = ["9.81 m/s^2", "10 m/s^2"]', "", "rigid"),
        ('"crack.elevation" = ["0 m", "12 m"]', 'inclination = "5 deg"', "rigid"),
        # By cases, as no column says how high a dam is.
        ('"section.height" = ["38 m", "44 m"]', "", "rigid"),
        # By integration.
        ('"analysis.rotation" = ["finite", "p-delta"]', "", "rigid"),
        ('"crack.friction" = [1.0]', "", "flexible"),
    ],
)
def test_a_row_says_of_the_crest_what_its_run_says(tmp_path, vary, crack, model):
    study = f'case = "case.toml"\nmodel = "{model}"\n[vary]\n{vary}\n'
    moved = []
    for row, response in rows_and_runs(tmp_path, study, crack, model):
        assert row["outcome"] == response.outcome
        if not response.ok:
            # A dam that keeps sliding.
            assert [row[name] for name in CREST_PEAKS] == [None, None]
            continue
        peaks = crest_peaks(response.crest)
        assert {name: row[name] for name in CREST_PEAKS} == pytest.approx(peaks, rel=1e-9)
        moved.append(peaks["crest_displacement_m"])
    assert max(moved) > 1e-3


def test_nothing_is_said_of_the_crest_where_nobody_asks(tmp_path):
    study = study_file(tmp_path, 'case = "case.toml"\n')
    plan = plan_of(heeltoe.read_study(study))
    assert not set(CREST_PEAKS) & set(run_part(plan, 0, plan.count).column_names)


@pytest.mark.slow
def test_curves_limits_and_ranks_hold_the_crest_against_what_is_allowed(tmp_path):
    (tmp_path / "dams.csv").write_text("name, section.height [m], crack.friction\nHigh, 44, 0.8\nLow, 38, 1.2\n")
    asked = '[fragility]\nlimits = { crest_displacement = ["15 mm"], crest_acceleration = ["0.6 g"] }\n'
    file = study_file(tmp_path, f'case = "case.toml"\ncases = "dams.csv"\n{MOTIONS}{asked}', case=DAM.format(crack=""))
    process = command("study", "study.toml", "--out", "out", "--report", cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    said = " ".join(process.stdout.split())
    assert "crest displacement of 15.0 mm" in said
    assert "crest acceleration of 0.6 g" in said
    study = heeltoe.open_study(tmp_path / "out")
    table = study.to_table().to_pydict()
    values = {name: np.array(table[name]) for name in CREST_PEAKS}
    curves = {row["limit"]: row for row in study.fragility}
    assert curves["crest_displacement"]["exceeding"] == np.count_nonzero(values["crest_displacement_m"] > 0.015)
    assert curves["crest_acceleration"]["exceeding"] == np.count_nonzero(values["crest_acceleration_g"] > 0.6)
    broken = study.summary[0]["limits_not_met"]
    assert broken["crest_acceleration"] == np.count_nonzero(values["crest_acceleration_g"] > 5.0 / 9.80665)
    (ranks,) = study.portfolio
    assert {limit["limit"] for limit in ranks["limits"]} == {"crest_displacement", "crest_acceleration"}
    assert study.summary[0]["crest_displacement_m"]["largest"] == values["crest_displacement_m"].max()
    # Runs that say nothing of the crest are not those of a study that asks of it.
    plain = DAM.format(crack="").replace('crest_displacement = "20 mm"\ncrest_acceleration = "5 m/s^2"\n', "")
    (tmp_path / "case.toml").write_text(plain)
    file.write_text(file.read_text().replace(asked, ""))
    heeltoe.run_study(file, tmp_path / "plain")
    file.write_text(file.read_text() + asked)
    with pytest.raises(InputError, match="what is said of the crest"):
        heeltoe.run_study(file, tmp_path / "plain", resume=True)


def test_a_suite_judges_the_crest(tmp_path):
    case = study_file(tmp_path, "", case=DAM.format(crack="")).parent / "case.toml"
    suite = heeltoe.run_suite(case, tmp_path / "quakes", model="rigid", judge="largest")
    (answer,) = suite.suite["models"]
    limits = {limit["name"]: limit for limit in answer["limits"]}
    largest = max(record["crest_acceleration_g"] for record in answer["records"])
    assert limits["crest_acceleration"]["value"] == largest == answer["statistics"]["crest_acceleration_g"]["largest"]
    assert limits["crest_acceleration"]["allowed"] == pytest.approx(5.0 / 9.80665)
    assert limits["crest_displacement"]["unit"] == "m"


def test_a_model_that_does_not_know_the_crest_is_not_studied_for_it(tmp_path):
    study = study_file(tmp_path, 'case = "case.toml"\nmodel = "decoupled"\n', case=DAM.format(crack=""))
    with pytest.raises(InputError) as error:
        plan_of(heeltoe.read_study(study))
    assert error.value.code == "study-no-crest"
