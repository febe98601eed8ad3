"""What names mean: every field, every key of the JSON and every column is explained, and nothing else is."""

from __future__ import annotations

import json
import re

import pytest

from heeltoe import (
    dam_periods,
    open_study,
    overturning_map,
    read_case,
    run,
    run_study,
    run_suite,
    solve,
    statics,
    with_response_spectrum,
    with_spread,
)
from heeltoe.case.read import case_schema
from heeltoe.case.thesis import THESIS_FIELDS
from heeltoe.errors.error import InputError
from heeltoe.models.statics.joints import statics_of_sections
from heeltoe.result.outcome import Outcome
from heeltoe.study.plan.file import Study
from heeltoe.views.explain.find import everything, explain, related, usual_names
from heeltoe.views.explain.meaning import KINDS
from shared.command import command
from shared.dams import FAST, HEIGHT, KOYNA, SLENDER, example
from shared.every_field import leaves
from shared.studies import BLOCK, DRAWN, earthquakes, study_file

BOND = {
    "tensile_strength": "0.5 MPa",
    "cohesion": "1 MPa",
    "fracture_energy": "100 N/m",
    "shear_energy": "500 N/m",
}
LAW = {
    "friction": None,
    "law": {"name": "slip weakening", "peak_friction": 0.9, "residual_friction": 0.6, "slip": "20 mm"},
}

#: Keys of quantities of single warnings, words of those, and copies of what is explained by itself.
UNTOLD = re.compile(r"(.*\.)?(quantities\..*|left_out\..*|study\..*|varied\..*|vary\..*|pilot\..*)")


def keys(found, path=""):
    """Walk the paths of a JSON; places in lists are left out."""
    if isinstance(found, dict):
        for name, each in found.items():
            yield f"{path}.{name}" if path else name
            yield from keys(each, f"{path}.{name}" if path else name)
    elif isinstance(found, list | tuple):
        for item in found:
            yield from keys(item, path)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    place = tmp_path_factory.mktemp("study")
    allowed = '[limits]\nresidual_slip = "50 mm"\ncrest_displacement = "1 m"\n'
    run_study(study_file(place, DRAWN, case=BLOCK + allowed), place / "out")
    return open_study(place / "out")


@pytest.fixture(scope="module")
def results(tmp_path_factory, study):
    """JSON of every command."""
    anchored = example("anchored", *FAST, "limits.residual_slip=1mm")
    koyna = read_case(KOYNA, [*FAST, "concrete.tensile_strength=1MPa"])
    full = koyna.with_("flexible.evidence=full", "motion.duration=1s", "decoupled.rotation=true")
    block = run(read_case(HEIGHT, FAST), "rigid")
    process = command("motion", "record.txt", "--json", "-", cwd=_record(tmp_path_factory.mktemp("record")))
    return {
        "rigid": run(anchored, "rigid").to_json(),
        "flexible": run(full, "both").to_json(),
        "anchored": run(anchored.with_("concrete.modulus=20GPa"), "flexible").to_json(),
        "cracks": run(example("two-cracks", *FAST, "limits.residual_slip=1mm"), "flexible").to_json(),
        "sound": run(example("typical-base", *FAST, "reservoir.compressible=true"), "flexible").to_json(),
        "law": run(example("typical-base", *FAST).with_({"crack": LAW}), "both").to_json(),
        "joint": run(
            example("typical-base", *FAST, "flexible.evidence=step").with_({"crack.bond": BOND}), "both"
        ).to_json(),
        "rough": run(example("rough-crack", *FAST), "rigid").to_json(),
        "across": run(
            example("typical-base", *FAST, "motion.cross_valley.file=elcentro-1940-270-nga"), "rigid"
        ).to_json(),
        "elastic across": run(
            example("typical-base", *FAST, "motion.cross_valley.file=elcentro-1940-270-nga", "flexible.evidence=step"),
            "flexible",
        ).to_json(),
        "band": run(
            example("typical-base", *FAST, "limits.residual_slip=1mm").with_(
                {"crack.band": {"low": 0.8, "judge": "low"}}
            ),
            "rigid",
        ).to_json(),
        # Only the model that is chosen has a run with less friction.
        "less friction": run(example("typical-base", *FAST).with_("concrete.modulus=none", "rock=none")).to_json(),
        "aftershocks": run(example("aftershocks", *FAST), "rigid").to_json(),
        "decoupled": run(koyna, "decoupled").to_json(),
        "spread": with_spread(block, read_case(HEIGHT, FAST), 2).to_json(),
        "statics": statics(koyna.with_("statics.seismic_coefficient=0.1"), 0.01).to_json(),
        "spectrum": with_response_spectrum(statics_of_sections(koyna)).joints[0].statics.to_json(),
        "sections": statics_of_sections(koyna.with_({"statics.sections": ["0 m", "30 m"]})).to_json(),
        "periods": dam_periods(koyna, 2, response=True).to_json(),
        "overturning": overturning_map(read_case(SLENDER), count=12).to_json(),
        "motion": json.loads(process.stdout),
        "study": study.to_json(),
        "solve": solve(read_case(HEIGHT, FAST), "crack.friction", "residual_slip = 1 mm", model="rigid").to_json(),
        "portfolio": run_study(_portfolio(tmp_path_factory.mktemp("dams")), tmp_path_factory.mktemp("out")).to_json(),
        "suite": run_suite(
            anchored.with_("limits.crest_acceleration=1g"), earthquakes(tmp_path_factory.mktemp("suite")), model="rigid"
        ).to_json(),
    }


def _portfolio(place):
    (place / "dams.csv").write_text("name,crack.friction\nA,0.4\nB,0.6\n")
    scale = 'scale = { values = ["0.3 g", "0.5 g", "0.7 g", "1.2 g"] }\n'
    limits = '[fragility]\nlimits = { residual_slip = ["1 mm"] }\n[hazard]\ncurve = [["0.1 g", 0.1], ["1 g", 0.01]]\n'
    return study_file(place, f'case = "case.toml"\ncases = "dams.csv"\n[motions]\nfolder = "quakes"\n{scale}{limits}')


def _record(place):
    rows = "".join(f"{0.01 * k:.2f} {(-1) ** k * 0.2}\n" for k in range(50))
    (place / "record.txt").write_text(f"# units: time [s], acceleration [g]\n{rows}")
    return place


@pytest.mark.slow
def test_every_key_of_the_json_is_explained(results):
    unknown = set()
    for data in results.values():
        for path in set(keys(data)):
            if not UNTOLD.fullmatch(path) and not any(_is_key(item) for item in _explained(path)):
                unknown.add(path)
    assert sorted(unknown) == []


@pytest.mark.slow
def test_every_key_that_is_explained_is_there(results):
    there = {
        re.sub(r"^(beside|motions|sections\.statics)\.", "", path) for data in results.values() for path in keys(data)
    }
    met = {item.name for path in there for item in _explained(path)}
    # What only a suite of dams with bonded joints has.
    of_joints = {
        "records[].cracked_length_m",
        "joints[].elevation_m",
        "joints[].records_cracked",
        "joints[].statistics",
    }
    bonded = {f"suite.models[].{name}" for name in of_joints}
    # A suite is judged by the best estimate of a band.
    bonded.add("suite.models[].limits[].friction")
    # What only a run that is turned by hand, a match, a shelf of runs or a study of several cracks has.
    seldom = {"misfit.rms", "misfit.largest", "varied", "spread.time_step_s", "safe_gap[].frequency_hz"}
    seldom |= {"safe_gap[].from_g", "safe_gap[].to_g", "warnings[].quantities.*", "summary[].cracks"}
    names = {item.name for item in everything() if _is_key(item) and not item.name.endswith("[]")}
    # Only a dam whose single runs scatter has these.
    seldom |= {name for name in names if ".distribution" in name or name.endswith("].exceeding")}
    sobol = {name for name in names if name.startswith("sensitivity.*.")}
    assert sorted(names - met - seldom - bonded - sobol) == []


def _is_key(meaning):
    return meaning.kind == "key of the JSON"


def _explained(path):
    try:
        return explain(path)
    except InputError:
        return ()


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_every_column_of_a_run_is_explained(model):
    response = run(read_case(HEIGHT, [*FAST, "concrete.modulus=20GPa"]), model)
    answer = {kind: {item.name for item in everything() if item.kind == kind} for kind in KINDS}
    assert set(response.to_table().column_names) <= answer["column of the histories"]
    assert set(response.events_table().column_names) <= answer["column of the events"] or model == "flexible"


def test_every_column_of_a_study_is_explained(study):
    for name in study.to_table().column_names:
        assert explain(name)


def test_every_field_is_explained_with_a_sentence():
    names = {item.name.replace("[]", "[0]") for item in everything() if item.kind == "field of a case"}
    assert {path for path, _ in leaves() if "processing" not in path} <= names
    assert {f"motion.processing[{step}].{name}" for step, name in (("taper", "share"), ("window", "end"))} <= names
    assert set(case_schema()["properties"]) <= names
    assert set(Study.model_fields) <= {item.name for item in everything() if item.kind == "field of a study"}
    for each in everything():
        assert each.meaning.endswith("."), each.name
        assert len(each.meaning) > 8, each.name


@pytest.mark.parametrize(
    ("name", "holds"),
    [
        ("crack.friction", ["a number", "0 or more, 10 at most", "all models", "rigid.md equation 5"]),
        ("reservoir.depth", ["a length", '"100 m"', "all models"]),
        ("crack.inclination", ["0 deg", "-45° or more, 45° at most"]),
        ("crack.restitution", ["0.5", "the rigid model and the decoupled chain"]),
        ("flexible.contact", ["one of coulomb, idce", "the flexible model"]),
        ("analysis.time_limit", ["600 s"]),
        ("motion.vertical.pga", ["an acceleration"]),
        ("residual_slip_m", ["m", "heeltoe run --json"]),
        ("energy.input_j", ["J per metre of dam"]),
        ("vary.*.from", ["a value of the field that varies"]),
        ("flexible.title", ["Title of the case."]),
    ],
)
def test_what_is_said_of_a_name(name, holds):
    text = " | ".join(str(vars(item)) for item in explain(name))
    for each in holds:
        assert each in text


def test_a_name_may_be_written_in_several_ways():
    assert explain("anchors[0].capacity") == explain("anchors.capacity") == explain("anchors[].capacity")
    assert explain("beside.energy.input_j") == explain("energy.input_j") == explain(" input_j ")
    assert {item.kind for item in explain("friction")} == {"field of a case", "key of the JSON"}
    assert explain("band-pass")[0].parts[1].endswith(".low")
    assert [item.name for item in explain("evidence.residual_slip_m.step")] == ["evidence.residual_slip_m.step"]


def test_every_way_to_end_is_explained_with_its_remedy():
    assert {item.name for item in everything() if item.kind == "outcome of a run"} == set(Outcome)
    (found,) = explain("lifts across")
    assert "Set motion.cross_valley" in found.meaning
    assert found.meaning[0].isupper()


@pytest.mark.parametrize("name", ["", ".", "*", "crack.frction", "x" * 100_000, "a.b.c", "[", "\0"])
def test_what_is_not_there_is_refused(name):
    with pytest.raises(InputError, match="heeltoe explain --all` lists all") as refused:
        explain(name)
    assert ('did you mean "crack.friction"?' in str(refused.value)) == (name == "crack.frction")


# The right order is that of a user, who writes a case before reading a JSON.
def test_fields_come_before_keys_of_the_same_name():
    first, *rest = explain("friction")
    assert (first.name, first.kind) == ("crack.friction", "field of a case")
    assert any(meaning.kind == "key of the JSON" for meaning in rest)
    assert explain("residual_slip_m")[0].kind == "key of the JSON"


def test_a_part_of_a_name_that_is_misspelled_finds_fields_with_it():
    with pytest.raises(InputError) as refused:
        explain("drian")
    for name in ("uplift.drain_position", "uplift.drain_x", "uplift.drain_efficiency"):
        assert f'"{name}"' in str(refused.value)


# Words of section 3 of the design: what only the thesis needs, and the fields of one crack or motion again.
def test_fields_of_the_thesis_and_repeated_ones_are_out_of_sight_until_they_are_named(tmp_path):
    usual = {meaning.name for meaning in usual_names()}
    for name in sorted(THESIS_FIELDS):
        assert name not in usual
        assert name in {meaning.name for meaning in everything()}
        assert [meaning.name for meaning in explain(name)] == [name]
    shown = [meaning for meaning in usual_names() if meaning.kind == "field of a case" and not meaning.parts]
    assert len(shown) <= 215
    assert "aftershocks[].pause" in usual
    assert "aftershocks[].pga" not in usual
    text = " ".join(command("explain", "flexible", cwd=tmp_path).stdout.split())
    assert "  flexible.newmark_gamma" not in text
    assert "docs/thesis.md: damping, damping_on_water" in text
    assert "flexible.newmark_gamma" in command("explain", "flexible", "--all", cwd=tmp_path).stdout
    listed = command("explain", "further_cracks", cwd=tmp_path).stdout
    assert "and the fields of crack: heeltoe explain crack" in listed
    assert "further_cracks[].elevation" not in listed


def test_a_word_of_a_name_finds_the_fields_with_it():
    names = [meaning.name for meaning in explain("drain")]
    assert names[:3] == ["uplift.drain_position", "uplift.drain_x", "uplift.drain_efficiency"]
    assert {meaning.kind for meaning in explain("drain")} == {"field of a case"}


def test_other_names_with_the_word_follow(tmp_path):
    names = related("slip", explain("slip"))
    assert names[0].startswith(("limits.", "statics."))
    assert {"limits.residual_slip", "limits.peak_slip", "residual_slip_m"} <= set(names)
    text = " ".join(command("explain", "slip", cwd=tmp_path).stdout.split())
    assert "See also" in text
    assert "limits.residual_slip" in text


def test_the_bare_command_fits_a_screen_or_two(tmp_path):
    listed = command("explain", cwd=tmp_path, columns=80).stdout.splitlines()
    assert len(listed) < 70
    for subject in ("crack", "uplift", "fragility"):
        assert any(line.startswith(f"  {subject} ") for line in listed)
    assert "heeltoe explain --all lists every name" in listed


def test_the_command(tmp_path):
    process = command("explain", "uplift.pattern", "--json", "-", cwd=tmp_path)
    (name,) = json.loads(process.stdout)["names"]
    assert name["default"] == "triangular"
    assert "uplift.pattern" in process.stderr
    listed = command("explain", "--all", cwd=tmp_path).stdout
    for item in everything():
        assert re.search(rf"^  {re.escape(item.name)}  ", listed, re.MULTILINE), item.name
    parts = command("explain", "uplift", cwd=tmp_path).stdout
    assert "uplift.during_shaking" in parts
    assert "field of a case" in parts
    assert command("explain", "frction", cwd=tmp_path).returncode == 2
