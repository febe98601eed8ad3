"""A table of dams: read with its units, each row the single run of its dam, ranked by probability and slip."""

from __future__ import annotations

import json

import numpy as np
import pytest

import heeltoe
from heeltoe.errors.error import InputError
from heeltoe.result.contract import CRACKED
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.run.batches import NUMBERS, run_part
from heeltoe.views.content.dam_pages import dam_pages
from heeltoe.views.content.study import study_answer, study_subject
from heeltoe.views.figures.studies.ranks import ranks_figure
from shared.command import command
from shared.studies import study_file

STUDY = """
case = "case.toml"
cases = "dams.csv"
{model}
[motions]
folder = "quakes"
both_signs = true
scale = {{ measure = "pga", values = ["0.7 g", "1.2 g"] }}
[fragility]
limits = {{ residual_slip = ["20 mm"] }}
"""
DAM = """
title = "Dams"
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
friction = 1.0
[reservoir]
depth = "36 m"
compressible = false
[flexible]
elements_across = 3
evidence = "none"
[motion]
points = [["0 s", "0 g"], ["0.2 s", "0.4 g"], ["0.4 s", "0 g"]]
"""
TABLE = """name, section.height [m], section.base_width [ft], reservoir.depth [m], crack.friction, uplift.pattern
Upper, 40, 105, 36, 0.9, none
Lower, 50, 140, 45, 0.8, triangular
Side,  42, 32 m, 30, 1.2, none
"""


def study(tmp_path, table=TABLE, model=""):
    (tmp_path / "dams.csv").write_text(table, encoding="utf-8")
    return study_file(tmp_path, STUDY.format(model=model), case=DAM)


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_a_row_is_the_single_run_of_its_dam(tmp_path, model):
    plan = plan_of(heeltoe.read_study(study(tmp_path, model=f'model = "{model}"')))
    assert plan.count == 3 * 10 * 2
    assert plan.dams == ("Upper", "Lower", "Side")
    row = run_part(plan, 20, 21).to_pylist()[0]
    assert row["section.base_width"] == pytest.approx(140 * 0.3048, rel=1e-15)
    changes = {
        "section.height": "50 m",
        "section.base_width": f"{row['section.base_width']!r} m",
        "reservoir.depth": "45 m",
        "crack.friction": 0.8,
        "uplift.pattern": "triangular",
    }
    motion = {"file": str(tmp_path / "quakes/quake-a-000.txt"), "pga": "0.7 g", "sign": "recorded"}
    fields = plan.case.with_(changes).model_dump(mode="json", exclude_unset=True) | {"motion": motion}
    alone = heeltoe.run(heeltoe.read_case(fields), model)
    names = [name for name in NUMBERS if name.endswith("_m") and not name.startswith("slip_") and name != CRACKED]
    assert {name: row[name] for name in names} == {name: getattr(alone, name) for name in names}
    # It was a crack from the beginning, which cracks no farther.
    assert row[CRACKED] == 0.0
    assert row["residual_slip_m"] != 0.0


def test_dams_are_ranked_by_probability_and_slip(tmp_path):
    result = heeltoe.run_study(study(tmp_path), tmp_path / "out")
    (answer,) = result.portfolio
    table = result.to_pandas()
    slips = table.assign(slip=table.residual_slip_m.abs(), strength=table.run % 2)
    worse = slips.groupby(["sample", "motion", "strength"], observed=True).slip.max()
    for dam in answer["dams"]:
        own = np.sort(worse[dam["dam"]].to_numpy())
        assert own.size == 10
        assert dam["exceeds"] == [pytest.approx(np.mean(own > 0.02))]
        assert dam["residual_slip_m"]["mean"] == pytest.approx(own.mean())
        assert dam["residual_slip_m"]["84%"] == pytest.approx(np.quantile(own, 0.84))
        assert dam["residual_slip_m"]["largest"] == own[-1]
    keys = [(dam["exceeds"][0], dam["residual_slip_m"]["mean"]) for dam in answer["dams"]]
    assert keys == sorted(keys, reverse=True)
    assert keys[0] > keys[-1]
    assert [dam["rank"] for dam in answer["dams"]] == [1, 2, 3]
    assert result.portfolio_table().num_rows == 3
    assert not any("above the crest" in text for text in result.manifest["warnings"])


def test_a_dam_that_fails_comes_first_and_warnings_name_their_dam(tmp_path):
    table = "name, crack.friction, reservoir.depth [m]\nGood, 1.2, 36\nBad, 0.2, 41\n"
    answer = heeltoe.run_study(study(tmp_path, table), tmp_path / "out")
    first, second = answer.portfolio[0]["dams"]
    assert (first["name"], first["exceeds"], first["residual_slip_m"]["mean"]) == ("Bad", [1.0], None)
    assert second["residual_slip_m"]["mean"] is not None
    assert json.loads(json.dumps(answer.to_json(), allow_nan=False))
    assert any(text.startswith("Bad: reservoir.depth") for text in answer.manifest["warnings"])
    with pytest.raises(InputError) as error:
        answer.to_xarray()
    assert error.value.code == "study-no-answer"


@pytest.mark.slow
def test_the_command_prints_the_ranks_and_writes_them(tmp_path):
    study(tmp_path)
    process = command("study", "study.toml", "--out", "out", "--report", cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    assert process.stdout.index("Lower") < process.stdout.index("Side")
    for name in ("portfolio.csv", "report.pdf", "figures/ranks.png"):
        assert (tmp_path / "out" / name).is_file()
    page = (tmp_path / "out/report.html").read_text()
    assert "The portfolio" in page
    # A page for each dam, the worst first, with its own numbers beside those of the base case.
    places = [page.index(f"</span> {name}</h3>") for name in ("Lower", "Upper", "Side")]
    assert places == sorted(places)
    assert page.count('class="page"') == 3
    assert ">50 m<" in page[places[0] : places[1]]
    assert ">50 m<" not in page[places[2] :].partition("Fields varied")[0]


def test_a_study_without_a_table_has_no_ranks(tmp_path):
    answer = heeltoe.run_study(study_file(tmp_path, 'case = "case.toml"\n', case=DAM), tmp_path / "out")
    assert answer.portfolio is None
    with pytest.raises(InputError) as error:
        answer.portfolio_table()
    assert error.value.code == "empty"


@pytest.mark.parametrize(
    ("table", "code", "text"),
    [
        ("name, crack.frictoin\nA, 1\n", "unknown-field", "crack.frictoin"),
        ("name, crack.friction\nA, 1\nB, -1\n", "out-of-range", "row 2 (B): crack.friction"),
        ("name, section.height [m]\nA, tall\n", "wrong-quantity", "row 1: section.height"),
        ("name, section.height [kg]\nA, 1\n", "wrong-quantity", "section.height"),
        ("name, uplift.pattern [m]\nA, none\n", "dams-unit", "uplift.pattern"),
        ("name, crack.friction\nA, 1, 2\n", "row-length", "row 1"),
        ("name, crack.friction\n", "empty", "cases"),
        ("name\nA\n", "empty", "cases"),
        ("name, motion.pga [g]\nA, 1\n", "study-motion-varies", "motion.pga"),
        ("crack.friction, crack.friction\n1, 1\n", "listed-twice", "cases"),
    ],
)
def test_what_is_wrong_with_a_table_is_said(tmp_path, table, code, text):
    with pytest.raises(InputError) as error:
        plan_of(heeltoe.read_study(study(tmp_path, table)))
    assert error.value.code == code
    assert text in str(error.value)


def test_a_table_must_be_there_and_readable(tmp_path):
    file = study(tmp_path)
    (tmp_path / "dams.csv").write_bytes(b"\xff\xfe\x00")
    for code in ("file-unreadable", "file-missing"):
        with pytest.raises(InputError) as error:
            plan_of(heeltoe.read_study(file))
        assert error.value.code == code
        (tmp_path / "dams.csv").unlink(missing_ok=True)
    conflict = 'case = "case.toml"\ncases = "dams.csv"\n[vary]\n"crack.friction" = [1.0, 1.1]\n'
    with pytest.raises(InputError) as error:
        heeltoe.read_study(study_file(tmp_path, conflict, case=DAM))
    assert error.value.code == "fields-conflict"


@pytest.mark.slow
def test_one_motion_has_no_median(tmp_path):
    study(tmp_path)
    text = (tmp_path / "study.toml").read_text()
    one = text.replace('folder = "quakes"', 'files = ["quakes/quake-a-000.txt"]')
    assert one != text
    (tmp_path / "study.toml").write_text(one.replace(', "1.2 g"', ""))
    case = tmp_path / "case.toml"
    case.write_text(case.read_text().replace('title = "Dams"', ""))
    result = heeltoe.run_study(tmp_path / "study.toml", tmp_path / "out")
    (answer,) = result.portfolio
    assert answer["motions"] == 1
    assert result.title == "portfolio of 3 dams"
    numbers = answer["dams"][0]["residual_slip_m"]
    assert numbers["largest"] > 0.0
    assert [numbers[name] for name in ("mean", "median", "84%")] == [None, None, None]
    slips = [dam["residual_slip_m"]["largest"] for dam in answer["dams"]]
    assert slips == sorted(slips, reverse=True)
    text = repr(study_answer(result, "si"))
    assert "in one motion, which has no median" in text
    assert "half stay below'" not in text
    page = repr(dam_pages(study_subject(result, tmp_path, "si", "", None)))
    assert "1 of 3 by the rigid model, in one motion: the residual slip is" in page
    assert result.portfolio_table().num_rows == 3
    assert ranks_figure(result).axes[0].get_xlabel() == "residual slip in the one motion [mm]"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("section.base_width [ft]", "section.base_widht [ft]", 'no such field; did you mean "base_width"?'),
        ("crack.friction", "crack.fricton", 'no such field; did you mean "friction"?'),
        ("uplift.pattern", "uplift.pattern [m]", "holds words, which have no unit (m)"),
        ("Lower", "Upper", 'row 1: "Upper" is the name of 2 dams'),
        ("Lower", "Lo\0wer", "row 2: the name"),
        ("Lower", "Lo\u202ewer", "row 2: the name"),
        ("50, 140", "5_0, 140", '"5_0" has the unknown unit "_0"'),
        ("50, 140", "٥٠, 140", '"٥٠" is not a length'),
    ],
)
def test_what_is_read_but_not_meant_is_refused(tmp_path, old, new, said):
    with pytest.raises(InputError) as refused:
        plan_of(heeltoe.read_study(study(tmp_path, TABLE.replace(old, new, 1))))
    assert said in str(refused.value)
    assert not [error for error in refused.value.others if "did you mean" in str(error)]
