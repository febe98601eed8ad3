"""One dam read as its owner would, by every door: terminal, page one, static checks, app and a study of it say the same
slip, the same worst and the same that is not met, to the last digit printed."""

from __future__ import annotations

import json
import re

import pytest

pytest.importorskip("starlette")

from heeltoe import open_study, read_case, run
from heeltoe.app.checks import checked
from heeltoe.app.live import flexible
from heeltoe.case.toml_writer import case_text
from heeltoe.units.write import length
from heeltoe.views.report.html import html
from heeltoe.views.report.write import build_report
from shared.command import command
from shared.dams import plane_case
from shared.report_reader import Reader
from shared.studies import rows

ANCHOR = {
    "head_x": "3 m",
    "head_elevation": "45 m",
    "foot_x": "4 m",
    "foot_elevation": "-12 m",
    "prestress": "0.6 MN/m",
    "capacity": "1.5 MN/m",
}
DAM = {
    "title": "Older dam, cracked at its base and at a lift joint",
    "anchors": [ANCHOR],
    "section": {
        "height": "45 m",
        "crest_width": "5 m",
        "neck_height": "39 m",
        "neck_width": "5 m",
        "base_width": "32 m",
    },
    "concrete": {"density": "2400 kg/m^3", "modulus": "24 GPa", "tensile_strength": "3 MPa"},
    "crack": {"elevation": "0 m", "friction": 0.9},
    "further_cracks": [{"elevation": "30 m", "friction": 0.8}],
    "reservoir": {"depth": "43 m"},
    "uplift": {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 0.5},
    "motion": {"file": "elcentro-1940-180-nga", "pga": "0.45 g", "duration": "6 s"},
    "flexible": {"elements_across": 4},
    "limits": {"residual_slip": "50 mm", "opening_upstream": "1 m"},
    "statics": {
        "criteria": "USACE",
        "seismic_coefficient": 0.15,
        "residual_friction": 0.8,
        "sections": [{"elevation": "0 m"}, {"elevation": "30 m"}],
    },
}


def words(text):
    return " ".join(text.split())


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("owner") / "dam.toml"
    path.write_text(case_text(plane_case(DAM).model_dump(mode="json", exclude_unset=True)), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def terminal(file):
    """What `heeltoe run` leaves in its JSON, and prints."""
    process = command("run", file, "--details", "--json", file.with_name("run.json"))
    assert process.returncode == 0, process.stderr
    return json.loads(file.with_name("run.json").read_text()), words(process.stdout)


@pytest.fixture(scope="module")
def checks(file):
    """The same of `heeltoe statics`."""
    process = command("statics", file, "--details", "--json", file.with_name("statics.json"))
    assert process.returncode == 0, process.stderr
    return json.loads(file.with_name("statics.json").read_text()), words(process.stdout)


def slips_of(told):
    return {crack["elevation_m"]: crack["residual_slip_m"] for crack in told["cracks"]}


def not_met(checks):
    """The sentences of the static checks that are not met, by section."""
    return [
        (section["elevation_m"], check["sentence"])
        for section in checks[0]["sections"]
        for check in section["statics"]["checks"]
        if not check["met"]
    ]


def test_terminal_says_the_worse_sign_the_worst_crack_and_what_is_not_met(terminal):
    answer, text = terminal
    slips = slips_of(answer)
    worst = max(slips, key=lambda at: abs(slips[at]))
    signs = {way["sign"]: way for way in answer["signs"]}
    (leads,) = [way for way in signs.values() if way["governs"]]
    assert leads["residual_slip_m"] == answer["residual_slip_m"] == slips[worst]
    assert abs(leads["residual_slip_m"]) == max(abs(way["residual_slip_m"]) for way in signs.values())
    assert f"The dam above the crack at {worst:g} m slides {length(abs(slips[worst]))}" in text
    for at, slip in slips.items():
        assert length(abs(slip)) in text, at
    assert f"residual slip at the crack at {worst:g} m of {length(abs(slips[worst]))}" in text
    (limit,) = [check for check in answer["limits"] if not check["met"]]
    assert limit["value"] == abs(slips[worst])
    # No number in the tables is without its unit.
    (table,) = re.findall(r"recorded ok 0 m (.*?) leads", text) or [""]
    assert table.count(" mm") == 4


@pytest.mark.slow
@pytest.mark.usefixtures("no_figures")
def test_page_one_says_what_the_terminal_and_the_static_checks_say(file, terminal, checks):
    answer, text = terminal
    case = read_case(file)
    page = words(Reader(html(build_report(case, run(case)))).text)
    page, _, _ = page.partition("Fields left to the program")
    assert answer["verdict"] in page
    assert answer["verdict"] in text
    for at, slip in slips_of(answer).items():
        assert length(slip) in page, at
    assert not_met(checks)
    for at, sentence in not_met(checks):
        assert f"Static check at {at:g} m. {sentence}" in page


def test_static_checks_take_the_slips_of_the_run(terminal, checks):
    slips, (answer, text) = slips_of(terminal[0]), checks
    assert {section["elevation_m"]: section["statics"]["slip_m"] for section in answer["sections"]} == slips
    assert all(section["statics"]["slip_source"].startswith("flexible model") for section in answer["sections"])
    worst = max(slips, key=lambda at: abs(slips[at]))
    assert f"Residual slip {length(slips[worst])}: flexible model" in text


@pytest.mark.slow
def test_the_app_says_the_same_of_run_and_static_checks(file, terminal, checks):
    reply, case = terminal[0], read_case(file)
    answer = flexible(lambda text: None, case, {}, "si")
    # The app shows the verdict of the short screen, without what a reader may ask for.
    assert answer["verdict"] in words(command("run", file).stdout)
    (cracks,) = [table for table in answer["tables"] if table["label"].startswith("Each crack")]
    assert [row[1] for row in cracks["rows"]] == [length(slip) for slip in slips_of(reply).values()]
    judged = checked(case, {}, "si", [answer["left"]])
    assert judged["failed"] == [f"{at:g} m, {sentence}" for at, sentence in not_met(checks)]
    assert dict(judged["basis"])["residual slip"].startswith(length(reply["residual_slip_m"]))


@pytest.mark.slow
def test_a_study_of_the_dam_has_the_run_as_its_row(file, terminal):
    answer = terminal[0]
    (leads,) = [way["sign"] for way in answer["signs"] if way["governs"]]
    study = file.with_name("study.toml")
    study.write_text('case = "dam.toml"\nmodel = "flexible"\n', encoding="utf-8")
    process = command("study", study, "--out", file.with_name("study"), "--no-figures")
    assert process.returncode == 0, process.stderr
    result = open_study(file.with_name("study"))
    by_sign = {row["reversed"]: row for row in rows(result)}
    row = by_sign[leads == "reversed"]
    assert row["residual_slip_m"] == answer["residual_slip_m"]
    assert row["opening_upstream_m"] == answer["opening_upstream_m"]
    at_cracks = [row[f"cracks[{place}].residual_slip_m"] for place in range(2)]
    assert at_cracks == list(slips_of(answer).values())
    (summary,) = result.summary
    assert summary["residual_slip_m"]["largest"] == answer["residual_slip_m"]
    broken = {check["name"]: int(not check["met"]) for check in answer["limits"]}
    # The other sign slides less, and may keep within what this one does not.
    assert summary["limits_not_met"]["opening_upstream"] == broken["opening_upstream"] == 0
    assert broken["residual_slip"] <= summary["limits_not_met"]["residual_slip"] <= 2
    text = words(process.stdout)
    assert f"the farthest run ends at {length(answer['residual_slip_m'])}" in text
    assert f"of 2 runs exceed the residual slip of {length(0.05)} that the case allows" in text
