"""What the form of a study says becomes a study file; what no form says is refused."""

from __future__ import annotations

import json
import pickle
import tomllib
from pathlib import Path

import numpy as np
import pytest

from heeltoe.app.case.draft import edit
from heeltoe.app.desk import BadRequestError
from heeltoe.app.motion.look import channels
from heeltoe.app.open_case import begin
from heeltoe.app.sessions import Session
from heeltoe.app.studies.draft import choices, study_of_form
from heeltoe.app.studies.work import OUT, answers, lay, look, run
from heeltoe.errors.error import InputError
from heeltoe.study.answers.study_results import open_study
from heeltoe.study.plan.components import components_of, grouped
from heeltoe.study.plan.motions import records_of
from heeltoe.study.run.suite import run_suite
from shared.downloads import DOWNLOADS, write

EVIL = "../../evil <script>'\".dat"
FORM = {"models": ["rigid"], "method": "grid", "source": "case", "vary": []}


@pytest.fixture
def session(tmp_path):
    folder = tmp_path / "tab"
    folder.mkdir()
    one_session = Session("x", folder)
    begin(one_session)
    time = np.arange(400) * 0.01
    np.savetxt(folder / "upload-1", np.column_stack([time, np.sin(9.0 * time)]))
    one_session.sent[EVIL] = "upload-1"
    return one_session


def test_a_record_that_was_sent_goes_with_the_study_under_a_harmless_name(session, tmp_path):
    form = {**FORM, "source": "records", "records": [EVIL], "motions.unit": "m/s^2"}
    form |= {"scale.measure": "pga", "scale.values": "0.1 g, 0.2 g"}
    picture = look(study_of_form(form, session), session.folder / "study-1", 100)
    assert "2 runs" in picture["outlook"]
    both = look(study_of_form({**form, "both_signs": True}, session), session.folder / "study-0", 100)
    assert "4 runs" in both["outlook"]
    files = {path.name for path in (session.folder / "study-1").iterdir()}
    assert files == {"case.toml", "study.toml", "evil-script-.dat"}
    assert {path.name for path in tmp_path.iterdir()} == {"tab"}
    study = tomllib.loads((session.folder / "study-1" / "study.toml").read_text())
    assert study["motions"]["events"][0]["horizontal"] == ["evil-script-.dat"]


@pytest.mark.parametrize("name", ["/etc/passwd", "../upload-1", "upload-1", "nothing", "~/x"])
def test_no_other_file_is_looked_for(session, name):
    for form in ({"records": [name]}, {"ordered": name}):
        with pytest.raises(InputError, match="motions"):
            study_of_form({**FORM, "source": "records", **form}, session)


@pytest.mark.parametrize(
    "form",
    [None, [], {"models": "rigid"}, {"title": 3}, {"vary": [3]}, {"vary": [{"path": "__class__"}]}, {"records": [1]},
     {"vary": [{"path": "motion.file", "kind": "list", "values": "/etc/passwd"}]}, {"title": "x" * 30_000},
     {"vary": [{"path": "crack.friction", "kind": "__import__"}]}],
)  # fmt: skip
def test_what_no_form_says_is_refused(session, form):
    with pytest.raises(BadRequestError):
        study_of_form({**FORM, **form} if isinstance(form, dict) else form, session)


@pytest.mark.parametrize(
    ("form", "field"),
    [({"samples": "9", "method": "sobol"}, "samples"),
     ({"method": "latin hypercube", "samples": "1000000000"}, "study"),
     ({"vary": [{"path": "crack.friction", "kind": "normal", "mean": "1"}]}, "vary.crack.friction.std"),
     ({"vary": [{"path": "crack.friction", "kind": "list", "values": ""}]}, "vary.crack.friction"),
     ({"limit.opening": "10"}, "fragility.limits.opening[0]"),
     ({"scale.measure": "sa", "scale.values": "0.1 g"}, "motions.scale.period")],
)  # fmt: skip
def test_errors_are_told_at_their_fields(session, form, field):
    picture = look(study_of_form({**FORM, **form}, session), session.folder / "study-2", 10_000)
    assert picture["error"]["field"] == field


def test_fields_are_drawn_together_and_intervals_have_their_confidence(session):
    row = {"kind": "uniform", "from": "0.8", "to": "1.2"}
    vary = [{"path": "crack.friction", **row}, {"path": "uplift.intensity", **row, "from": "0.2", "to": "0.9"}]
    form = {**FORM, "method": "latin hypercube", "samples": "8", "vary": vary}
    form |= {"correlation": "crack.friction, uplift.intensity, 0.4;", "limit.opening": "10 mm"}
    _, study, _ = asked = study_of_form({**form, "fragility.confidence": "0.8"}, session)
    assert study["correlation"] == [["crack.friction", "uplift.intensity", 0.4]]
    assert study["fragility"]["confidence"] == 0.8
    assert "8 runs" in look(asked, session.folder / "study-3", 100)["outlook"]
    for wrong, field in (({"correlation": "crack.friction, x, 0.4"}, "correlation[0]"),
                         ({"correlation": "crack.friction"}, "correlation[0]"),
                         ({"fragility.confidence": "2"}, "fragility.confidence")):  # fmt: skip
        picture = look(study_of_form({**form, **wrong}, session), session.folder / "study-4", 100)
        assert picture["error"]["field"].startswith(field), wrong


def test_plain_numbers_are_in_the_units_that_are_chosen(session):
    session.units = "us"
    row = {"path": "reservoir.depth", "kind": "list", "values": "300, 90 m"}
    _, study, _ = study_of_form({**FORM, "vary": [row]}, session)
    assert study["vary"] == {"reservoir.depth": ["300 ft", "90 m"]}


def test_the_motion_of_the_case_takes_strengths(session):
    form = {**FORM, "scale.measure": "pga", "scale.values": "0.2 g", "both_signs": True}
    _, study, _ = study_of_form(form, session)
    assert study["motions"]["events"] == [{"horizontal": ["elcentro-1940-180-nga"]}]
    assert study["motions"]["both_signs"]


def test_motions_are_ordered_by_magnitude_and_distance(session):
    order = {"scenario.magnitude": "6.5", "scenario.distance": "20 km", "scenario.count": "3"}
    form = {**FORM, "source": "records", "ordered": "synthetic:M7.0,30km,seed=4; synthetic:M7.0,30km,seed=5", **order}
    _, study, _ = asked = study_of_form(form, session)
    names = [f"synthetic:M6.5,20km,seed={seed},scatter=yes" for seed in (1, 2, 3)]
    ordered = [{"horizontal": [f"synthetic:M7.0,30km,seed={seed}"]} for seed in (4, 5)]
    scenario = [{"horizontal": [name], "magnitude": 6.5, "distance": "20 km"} for name in names]
    assert study["motions"]["events"] == [*ordered, *scenario]
    assert "5 runs" in look(asked, session.folder / "study-5", 100)["outlook"]
    for wrong, field in (("count", "0"), ("count", "x"), ("magnitude", ""), ("distance", "far"), ("distance", "9000")):
        with pytest.raises(InputError) as refused:
            study_of_form({**form, f"scenario.{wrong}": field}, session)
        assert refused.value.field == ("scenario.count" if wrong == "count" else "scenario")


def test_a_suite_has_the_numbers_of_the_shell(session):
    """The records of the form, run as a suite by the app, are those of `run_suite`, with its governing record."""
    for number in range(3):
        values = 3.0 * np.sin((9.0 + number) * 0.01 * np.arange(400))
        np.savetxt(
            session.folder / f"quake{number}.txt", values, header="time step: 0.01 s, units: acceleration [m/s^2]"
        )
        session.sent[f"quake{number}.txt"] = f"quake{number}.txt"
    edit(session, {"limits": {"residual_slip": "5 mm"}})
    records = [f"quake{number}.txt" for number in range(3)]
    form = {**FORM, "method": "suite", "source": "records", "records": records, "both_signs": True}
    form |= {"suite.judge": "84%", "scale.measure": "pga", "scale.values": "0.9 g", "suite.target": "en1998:0.3g,B"}
    # What only a study has is left out.
    form |= {"limit.opening": "10 mm", "vary": [{"path": "crack.friction", "kind": "list", "values": "1"}]}
    folder = session.folder / "suite"
    lay(study_of_form(form, session), folder, 100)
    run(lambda *_: None, folder, False, "si")
    app = open_study(folder / OUT)
    shell = run_suite(
        folder / "case.toml", [folder / name for name in records], model="rigid", pga="0.9 g", judge="84%",
        target="en1998:0.3g,B",
    )  # fmt: skip
    answer, expected = (results.suite["models"][0].to_json() for results in (app, shell))
    for record in (*answer["records"], *expected["records"]):
        del record["event"]  # the app groups components by their names
    assert answer == expected
    assert answer["limits"][0]["value"] == answer["statistics"]["residual_slip_m"]["84%"] > 0.0
    document = answers(folder, "si")
    (headline,) = document["headlines"]
    assert headline["label"] == "residual slip, what 84 % of the records stay below"
    assert headline["state"] == ("met" if answer["limits"][0]["met"] else "failed")
    text = json.dumps(document)
    assert document["subtitle"].startswith("A suite of 6 runs")
    assert all(word in text for word in ("governs", "The mean is", "84 % stay below", "suite-spectra", "quake2"))


def test_the_motions_of_a_case_are_its_suite(session):
    assert choices(session)["suite"] is None
    names = ["elcentro-1940-180-nga", EVIL]
    edit(session, {"motions": [{"file": names[0]}, {"file": EVIL}], "suite": {"sa": "0.5 g", "judge": "mean"}})
    own = choices(session)["suite"]
    assert (own["of"], own["suite.judge"], own["scale.measure"], own["scale.values"], own["scale.period"]) == (
        2, "mean", "sa", "0.5 g", "T1")  # fmt: skip
    _, study, _ = study_of_form({**FORM, "method": "suite", "suite.judge": "mean", "both_signs": True}, session)
    assert study["motions"]["events"] == [{"horizontal": [name]} for name in names]
    assert study["suite"] == {"judge": "mean"}
    for form, field in (({"suite.target": "/etc/passwd"}, "suite.target"), ({"motions.match": "x"}, "motions.match")):
        with pytest.raises(InputError) as refused:
            study_of_form({**FORM, "method": "suite", **form}, session)
        assert refused.value.field == field


def test_every_choice_is_a_field_of_a_study(session):
    result = choices(session)
    assert {"crack.friction", "reservoir.depth", "uplift.pattern"} <= {item["path"] for item in result["fields"]}
    assert all(item["meaning"] for item in result["fields"])
    assert EVIL in [record["name"] for group in result["records"] for record in group["records"]]


def test_no_record_at_all_is_said_in_words(session):
    with pytest.raises(InputError) as refused:
        study_of_form({**FORM, "method": "suite", "source": "records", "records": []}, session)
    assert (refused.value.code, refused.value.field) == ("study-motions", "motions")


def test_unit_and_time_step_are_asked_for_at_once(session):
    np.savetxt(session.folder / "bare", np.sin(0.3 * np.arange(400)))
    session.sent["bare.txt"] = "bare"
    form = {**FORM, "method": "suite", "source": "records", "records": ["bare.txt"]}

    def outlook(**more):
        return look(study_of_form({**form, **more}, session), session.folder / "study-6", 100)

    both = outlook()["error"]
    assert (both["field"], "neither its unit nor its time step" in both["problem"]) == ("motions.unit", True)
    assert outlook(**{"motions.time_step": "0.01 s"})["error"]["field"] == "motions.unit"
    assert outlook(**{"motions.unit": "m/s^2"})["error"]["field"] == "motions.time_step"
    assert "1 run" in outlook(**{"motions.unit": "m/s^2", "motions.time_step": "0.01 s"})["outlook"]


def test_errors_come_back_from_other_processes():
    error = InputError("too-many", "samples", 3, most=2)
    error.field = "study"
    back = pickle.loads(pickle.dumps(error))
    assert (str(back), back.args, back.code) == (str(error), error.args, "too-many")


def test_what_stands_in_an_empty_form_is_in_the_units_that_are_chosen(session):
    session.units = "us"
    assert choices(session)["units"] == "us"
    assert next(item for item in choices(session)["fields"] if item["path"] == "reservoir.depth")["now"].endswith(" ft")


@pytest.mark.parametrize("producer", ["K-NET, renamed", "AFAD", "SAC", "BHRC"])
def test_records_that_were_sent_are_paired_by_what_they_say(session, tmp_path, producer):
    """The same events as a folder of them has: names of K-NET's files say nothing here, AFAD has all in one file."""
    make, count = DOWNLOADS[producer]
    folder = write(tmp_path / "records", make())
    for number, path in enumerate(sorted(folder.iterdir())):
        seen = channels(path, path.name)
        (session.folder / f"sent-{number}").write_bytes(path.read_bytes())
        session.sent[path.name], session.records[path.name] = f"sent-{number}", seen["channels"]
    shown = [
        group
        for group in choices(session)["records"]
        if any(path.name in group["records"][0]["name"] for path in folder.iterdir())
    ]
    assert [[record["vertical"] for record in group["records"]] for group in shown] == [[False, False, True]] * 2
    names = [record["name"] for group in shown for record in group["records"]]
    form = {**FORM, "source": "records", "records": names, "vertical": True, "pairs": True}
    said = {
        "SAC": {"motions.unit": "m/s^2", "motions.factor": "multiply"},
        "BHRC": {"motions.low": "0.1", "motions.high": "25 Hz"},
    }
    _, study, _ = study_of_form({**form, **said.get(producer, {})}, session)
    parts = components_of(records_of("records", tmp_path), tmp_path)
    events = [
        [sorted(Path(part.file).name for part in (*group.horizontal, *group.vertical)) for group in grouped(parts)]
    ]
    assert [[sorted([*event["horizontal"], event["vertical"]]) for event in study["motions"]["events"]]] == events
    picture = look(study_of_form({**form, **said.get(producer, {})}, session), session.folder / "study-7", 100)
    assert f"{count} runs" in picture["outlook"]
    if producer in said:
        error = look(study_of_form(form, session), session.folder / "study-8", 100)["error"]
        assert error["field"] in ("motions.factor", "motions.processing")


def test_a_vertical_record_by_itself_is_what_its_user_asks_for(session):
    session.sent["quake-up.dat"] = "upload-1"
    session.records["quake-up.dat"] = channels(session.folder / "upload-1", "quake-up.dat")["channels"]
    form = {**FORM, "source": "records", "records": ["quake-up.dat"], "motions.unit": "m/s^2"}
    _, study, _ = study_of_form(form, session)
    assert study["motions"]["events"] == [{"name": "quake", "horizontal": ["quake-up.dat"]}]
