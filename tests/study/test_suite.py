"""A suite of records: its rows are the single runs, its numbers those over the records, its limits judged by them."""

from __future__ import annotations

import json

import numpy as np
import pytest

import heeltoe
from heeltoe.base.blocks import plain_json
from heeltoe.case.suite import SuiteMotion
from heeltoe.case.toml_writer import case_text
from heeltoe.errors.error import InputError
from heeltoe.motion.targets import target_of
from heeltoe.study.answers.suite import below, suite_spectra
from heeltoe.study.plan.file import Study
from heeltoe.study.plan.motions import shakes_of, suite_events
from heeltoe.views.content.study import study_answer, study_sections
from heeltoe.views.figures.studies.suite import suite_figures
from shared.command import command
from shared.dams import example
from shared.record_samples import GAL
from shared.records_of_the_world import csmnc
from shared.studies import BLOCK, earthquakes

BASELINE = [{"step": "baseline"}]
ALLOWED = ("limits.residual_slip=5 mm", "limits.opening_upstream=1 m")


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    return earthquakes(tmp_path_factory.mktemp("suite") / "quakes")


@pytest.fixture(scope="module")
def dam():
    return example("typical-base", "flexible.elements_across=4", "flexible.evidence=none", *ALLOWED)


@pytest.mark.parametrize("model", ["rigid", pytest.param("flexible", marks=pytest.mark.slow)])
def test_the_records_are_the_single_runs_to_the_last_bit(dam, records, model):
    (answer,) = heeltoe.run_suite(dam, records, model=model, pga="0.7 g").suite["models"]
    assert len(answer["records"]) == 5  # vertical components shake no dam by themselves
    for record in answer["records"][:3]:
        motion = {"file": str(records / f"{record['motion']}.txt"), "pga": "0.7 g"}
        fields = dam.model_dump(mode="json", exclude_unset=True) | {"motion": motion}
        alone = heeltoe.run(heeltoe.read_case(fields), model)
        by_sign = {sign.sign: abs(sign.residual_slip_m) for sign in alone.signs}
        assert record["residual_slip_m"] == by_sign[record["sign"]] == max(by_sign.values())
        assert record["other_sign_residual_slip_m"] == min(by_sign.values())
        assert record["pga_g"] == pytest.approx(0.7, rel=1e-12)
        assert record["peak_slip_m"] == max(abs(alone.peak_slip_downstream_m), abs(alone.peak_slip_upstream_m))


@pytest.mark.parametrize(("judge", "place"), [("largest", -1), ("mean", None), ("median", 2)])
def test_the_limits_are_judged_by_what_is_asked_for(dam, records, judge, place):
    suite = heeltoe.run_suite(dam, records, model="rigid", pga="0.7 g", judge=judge)
    (answer,) = suite.suite["models"]
    slips = sorted(record["residual_slip_m"] for record in answer["records"])
    value = np.mean(slips) if place is None else slips[place]
    slip, opening = answer["limits"]
    assert slip["value"] == pytest.approx(value, rel=1e-12)
    assert slip["met"] == (value <= 0.005)
    assert slip["utilisation"] == pytest.approx(value / 0.005)
    assert opening["met"]
    assert suite.limits_met == slip["met"]
    assert max(answer["records"], key=lambda record: record["residual_slip_m"])["governs"]


def test_a_share_lies_between_two_records():
    values = np.array([0.0, 1.0, 2.0, 3.0, 4.5])
    assert below(values, 0.84) == pytest.approx(np.quantile(values, 0.84))
    assert below(values, 0.5) == 2.0
    assert below(np.array([[0.0, np.inf], [1.0, 2.0]]), 0.84).tolist() == [np.inf, pytest.approx(1.84)]


def test_a_dam_that_fails_in_a_record_has_no_mean_and_meets_no_limit(records):
    dam = example("typical-base", "crack.friction=0.3", *ALLOWED)
    (answer,) = heeltoe.run_suite(dam, records, model="rigid", judge="mean").suite["models"]
    assert {record["outcome"] for record in answer["records"]} == {"unstable"}
    assert answer["statistics"]["residual_slip_m"]["mean"] is None
    assert [limit["met"] for limit in answer["limits"]] == [False, False]
    assert json.loads(json.dumps(plain_json(answer), allow_nan=False))


def test_records_scaled_at_the_first_period_agree_there(dam, records):
    suite = heeltoe.run_suite(dam, records, model="rigid", sa="0.5 g", target="en1998:0.3g,B")
    period = suite.manifest["study"]["motions"]["scale"]["period"]
    first = heeltoe.dam_periods(dam, 1).intact[0]
    assert float(period.split()[0]) == pytest.approx(first, rel=1e-5)
    spectra = suite_spectra(suite.walk, suite.suite["models"][0]["records"])
    for row in spectra["records"]:
        at = np.exp(np.interp(np.log(first), np.log(spectra["period_s"]), np.log(row)))
        assert at == pytest.approx(0.5 * 9.81, rel=0.15)  # between the periods that are drawn
    target = target_of("en1998:0.3g,B", "target")
    drawn = spectra["target"]
    assert np.allclose(drawn["pseudo_acceleration_m_s2"], target(np.array(drawn["period_s"])))


def test_matched_records_follow_their_target(dam, records):
    suite = heeltoe.run_suite(dam, records / "quake-a-000.txt", model="rigid", match="en1998:0.3g,B")
    spectra = suite_spectra(suite.walk, suite.suite["models"][0]["records"])
    target = target_of("en1998:0.3g,B", "target")
    judged = (spectra["period_s"] > 0.12) & (spectra["period_s"] < 2.5)
    ratio = spectra["records"][0][judged] / target(spectra["period_s"][judged])
    assert np.sqrt(np.mean(np.log(ratio) ** 2)) < 0.1


def test_vertical_components_shake_the_dam_where_they_are_asked_for(dam, records):
    plain = heeltoe.run_suite(dam, records / "quake-a-000.txt", model="rigid").suite
    both = heeltoe.run_suite(
        dam, [records / "quake-a-000.txt", records / "quake-a-up.txt"], model="rigid", vertical=True
    )
    (record,), (upward,) = (answer["models"][0]["records"] for answer in (plain, both.suite))
    assert record["motion"] == upward["motion"]
    assert record["residual_slip_m"] != upward["residual_slip_m"]


def test_a_suite_goes_on_where_it_stopped(dam, records, tmp_path):
    first = heeltoe.run_suite(dam, records, model="rigid", out=tmp_path / "out")
    again = heeltoe.run_suite(dam, records, model="rigid", out=tmp_path / "out", resume=True, judge="mean")
    assert (first.suite["judge"], again.suite["judge"]) == ("largest", "mean")
    assert again.suite["models"][0]["records"] == first.suite["models"][0]["records"]
    with pytest.raises(InputError, match="another study") as error:
        heeltoe.run_suite(dam, records, model="rigid", out=tmp_path / "out", resume=True, pga="1 g")
    assert error.value.code == "study-other"


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ({"pga": "1 g", "sa": "1 g"}, "fields-conflict"),
        ({"period": "0.3 s"}, "needs-other"),
        ({"judge": "sum"}, "not-a-choice"),
        ({"match": "en1998:0.3g,Q"}, "not-a-choice"),
    ],
)
def test_what_is_wrong_with_a_suite_is_said(dam, records, arguments, code):
    with pytest.raises(InputError) as error:
        heeltoe.run_suite(dam, records, model="rigid", **arguments)
    assert error.value.code == code


def test_a_suite_needs_records_and_a_period(dam, records, tmp_path):
    with pytest.raises(InputError) as error:
        heeltoe.run_suite(dam, [])
    assert error.value.code == "study-motions"
    with pytest.raises(InputError) as error:
        heeltoe.run_suite(dam, tmp_path)
    assert error.value.code == "empty"
    with pytest.raises(InputError) as error:
        heeltoe.run_suite(dam, [records / "quake-a-000.txt"] * 2)
    assert error.value.code == "listed-twice"
    stiff = dam.model_dump(mode="json", exclude_unset=True)
    stiff["concrete"].pop("modulus")
    with pytest.raises(InputError) as error:
        heeltoe.run_suite(stiff, records, model="rigid", sa="1 g")
    assert error.value.code == "suite-no-period"


@pytest.mark.parametrize(
    ("study", "code"),
    [
        ('[vary]\n"crack.friction" = [0.5, 0.6]\n[motions]\nfolder = "quakes"\n', "suite-one-dam"),
        ('[motions]\nfolder = "quakes"\nscale = { values = ["0.1 g", "0.2 g"] }\n', "suite-one-strength"),
    ],
)
def test_a_study_file_with_a_suite_is_one_dam_at_one_strength(tmp_path, study, code):
    from shared.studies import study_file

    text = f'case = "case.toml"\n{study}[suite]\n'
    with pytest.raises(InputError) as error:
        heeltoe.run_study(study_file(tmp_path, text), tmp_path / "out")
    assert error.value.code == code


def test_the_command_prints_the_records_and_writes_page_and_figures(dam, records, tmp_path):
    (tmp_path / "dam.toml").write_text(case_text(dam.model_dump(mode="json", exclude_unset=True)))
    more = ("--model", "rigid", "--pga", "0.7g", "--judge", "mean", "--out", "out", "--report", "--json", "result.json")
    process = command("run", "dam.toml", "--motions", str(records), *more, cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    result = json.loads((tmp_path / "result.json").read_text())
    assert result["suite"]["judge"] == "mean"
    assert "quake-a-000" in process.stdout
    for name in ("report.pdf", "report.html", "figures/suite.png", "figures/suite-spectra.svg"):
        assert (tmp_path / "out" / name).is_file()
    assert "The suite of records" in (tmp_path / "out/report.html").read_text()


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (("--judge", "mean"), "--judge: does not belong to a run of one motion"),
        (("--motions", "quakes", "--reverse"), "--reverse: does not belong to a suite of records"),
        (("--motions", "quakes", "--resume"), "--resume: has no meaning without --out DIR"),
    ],
)
def test_options_that_do_not_go_together_are_refused(dam, records, tmp_path, arguments, text):
    (tmp_path / "dam.toml").write_text(case_text(dam.model_dump(mode="json", exclude_unset=True)))
    (tmp_path / "quakes").symlink_to(records)
    process = command("run", "dam.toml", *arguments, cwd=tmp_path)
    assert process.returncode == 2
    assert text in " ".join(process.stderr.split())


@pytest.mark.slow
def test_the_evidence_of_one_record_says_how_certain_a_limit_is(records):
    changes = ["flexible.elements_across=4", "flexible.evidence=step"]
    dam = example("typical-base", *changes, "limits.residual_slip=1 m", "limits.rotation=1 mrad")
    asked = records / "quake-a-000.txt"
    slip, turn = heeltoe.run_suite(dam, asked, model="flexible", pga="0.7 g").suite["models"][0]["limits"]
    assert (slip["certain"], slip["unit"], turn["unit"]) == (True, "m", "rad")
    assert 0.0 < slip["uncertainty"] < slip["value"]
    near = dam.with_([f"limits.residual_slip={slip['value'] + 0.5 * slip['uncertainty']} m"])
    suite = heeltoe.run_suite(near, asked, model="flexible", pga="0.7 g")
    close, _ = suite.suite["models"][0]["limits"]
    assert (close["met"], close["certain"]) == (True, False)
    assert suite.to_json()["directory"] is None


@pytest.mark.slow
def test_a_number_without_a_bound_may_be_off_by_as_much_as_it_is(records):
    changes = ["flexible.elements_across=2", "flexible.evidence=step", "flexible.modes=12", "analysis.silence=0 s"]
    dam = example("typical-base", *changes, "rock.modulus=20 GPa", "limits.rotation=1 mrad")
    (turn,) = heeltoe.run_suite(dam, records / "quake-a-000.txt", model="flexible", pga="0.7 g").suite["models"][0][
        "limits"
    ]
    assert turn["value"] > 0.0
    assert turn["uncertainty"] == pytest.approx(turn["value"])
    assert turn["certain"] == (abs(turn["value"] - 1e-3) > turn["value"])


PEER = ("RSN9_MADEUP_ABC-UP.AT2", "RSN9_MADEUP_ABC000.AT2", "RSN9_MADEUP_ABC090.AT2")
KNET = ("AOM0010001.EW", "AOM0010001.NS", "AOM0010001.UD")
SEED = ("XX.STA..HNE.txt", "XX.STA..HNN.txt", "XX.STA..HNZ.txt")


@pytest.mark.parametrize("names", [PEER, KNET, SEED])
def test_the_vertical_component_of_a_download_is_no_earthquake_of_its_own(tmp_path, names):
    for name in names:
        (tmp_path / name).write_text("0 0.1\n0.01 0.2\n")
    (up,) = (name for name in names if name.rpartition(".")[0].endswith(("UP", "HNZ")) or name.endswith("UD"))
    for vertical in (False, True):
        events, _ = suite_events([SuiteMotion(file=".")], tmp_path, vertical=vertical)
        assert len({event.name for event in events}) == len(events) == 2
        assert {event.horizontal[0].rpartition("/")[2] for event in events} == {*names} - {up}
        assert {event.vertical and event.vertical.rpartition("/")[2] for event in events} == {up if vertical else None}


SCALED = {"suite.pga": "0.7 g", "suite.judge": "mean", "suite.target": "en1998:0.3g,B"}


def listed(dam, *motions, **suite):
    """Return the dam with a suite of records in its case."""
    return dam.with_({"motions": list(motions), **SCALED}, {f"suite.{name}": value for name, value in suite.items()})


def test_the_records_of_the_case_are_those_of_a_folder(dam, records):
    given = heeltoe.run_suite(dam, records, model="rigid", pga="0.7 g", judge="mean", target="en1998:0.3g,B")
    folder = heeltoe.run_suite(listed(dam, {"file": str(records)}), model="rigid")
    assert folder.suite == given.suite
    named = [{"file": str(records / name)} for name in ("quake-a-000.txt", "quake-c-180.txt")]
    two = heeltoe.run_suite(listed(dam, *named), model="rigid").suite["models"][0]["records"]
    kept = [
        record for record in given.suite["models"][0]["records"] if record["motion"] in ("quake-a-000", "quake-c-180")
    ]
    keys = ("motion", "residual_slip_m", "sign", "pga_g")
    assert [[record[key] for key in keys] for record in two] == [[record[key] for key in keys] for record in kept]


@pytest.mark.parametrize(
    ("motion", "suite"),
    [
        ({"vertical": "quake-a-up.txt"}, {}),
        ({}, {"vertical": True}),
        ({}, {"pga": "0.6 g"}),
        ({}, {"pga": None, "sa": "0.5 g"}),
        ({}, {"pga": None, "sa": "0.5 g", "period": "0.5 s"}),
        ({}, {"match": "en1998:0.3g,B"}),
        ({}, {"judge": "largest"}),
        ({}, {"target": None}),
        ({}, {"both_signs": False}),
        ({}, {"unit": "m/s^2"}),
        ({}, {"time_step": "0.03 s"}),
        ({}, {"layout": "rows"}),
        ({}, {"factor": "multiply"}),
        ({}, {"processing": [{"step": "band-pass", "low": "0.5 Hz"}]}),
    ],
)
def test_every_field_of_a_suite_changes_something_or_is_refused(dam, records, motion, suite):
    def result(motion, suite):
        entry = {name: str(records / file) for name, file in motion.items()}
        try:
            return heeltoe.run_suite(listed(dam, entry, **suite), model="rigid")
        except InputError as error:
            return error

    file = {"file": "quake-a-000.txt"}
    before, after = result(file, {}), result(file | motion, suite)
    if isinstance(after, InputError):
        # The file states its unit and its step, and has no vertical component in it.
        assert after.field in (f"suite.{name}" for name in suite)
        return
    assert after.suite != before.suite or after.manifest["spectra"] != before.manifest["spectra"]


def test_what_is_wrong_with_a_suite_names_the_field_of_the_case(dam, records):
    with pytest.raises(InputError) as error:
        heeltoe.run_suite(listed(dam, {"file": str(records / "quake-a-000.txt")}, {"file": "nowhere"}), model="rigid")
    assert (error.value.code, error.value.field) == ("record-not-found", "motions[1].file")
    with pytest.raises(InputError) as error:
        heeltoe.run_suite(dam, model="rigid")
    assert (error.value.code, error.value.field) == ("study-motions", "motions")
    with pytest.raises(InputError) as error:
        listed(dam, {"file": "a"}, pga="-1 g", unit="hm")
    assert {error.value.field, *(other.field for other in error.value.others)} == {"suite.pga", "suite.unit"}


def test_a_single_run_of_a_case_without_a_motion_names_its_suite(dam, records):
    fields = listed(dam, {"file": str(records / "quake-a-000.txt")}).model_dump(mode="json", exclude_unset=True)
    with pytest.raises(InputError, match=r"heeltoe\.run_suite") as error:
        heeltoe.run(heeltoe.read_case({name: value for name, value in fields.items() if name != "motion"}))
    assert (error.value.code, error.value.field) == ("motion-of-suite", "motions")


def test_a_case_that_lists_motions_is_run_as_a_suite(dam, records, tmp_path):
    fields = dam.model_dump(mode="json", exclude_unset=True, exclude={"motion"})
    fields |= {"motions": [{"file": "quakes/quake-a-000.txt"}], "suite": {"pga": "0.5 g"}}
    (tmp_path / "dam.toml").write_text(case_text(fields))
    (tmp_path / "quakes").symlink_to(records)
    process = command("run", "dam.toml", "--model", "rigid", "--pga", "0.7g", "--json", "-", cwd=tmp_path)
    (record,) = json.loads(process.stdout)["suite"]["models"][0]["records"]
    assert record["pga_g"] == pytest.approx(0.7)
    refused = command("run", "dam.toml", "--spread", "3", cwd=tmp_path)
    assert "--spread: does not belong to a suite of records" in refused.stderr


def test_a_suite_of_one_record_states_no_number_over_several(dam, records):
    untitled = dam.with_({"title": ""})
    suite = heeltoe.run_suite(untitled, records / "quake-a-000.txt", model="rigid", pga="0.7 g")
    assert suite.title == "suite of 1 record"
    text = repr((study_answer(suite, "si"), study_sections(suite, "si")))
    assert "The one record" in text
    assert "that of the record is" in text
    for words in ("The mean is", "median", "84 % stay below '", "the largest of the records"):
        assert words not in text.partition("How the runs ended")[0]
    (figure, *_) = suite_figures(suite).values()
    assert not any(line.get_label().startswith("mean") for line in figure.axes[0].lines)
    several = heeltoe.run_suite(untitled, records, model="rigid", pga="0.7 g")
    assert several.title == "suite of 5 records"
    assert "The mean is" in repr(study_answer(several, "si"))


def spectrum_file(folder, unit, level):
    """Write a target spectrum, flat up to 0.3 s at a level in a unit, and of constant displacement beyond."""
    rows = "\n".join(f"{period},{level * min(1.0, 0.3 / period) ** 2}" for period in (0.05, 0.1, 0.3, 0.5, 1.0, 4.0))
    path = folder / "target.csv"
    path.write_text(f"period [s],Sa [{unit}]\n{rows}\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("how", ["match", "pga", "as recorded"])
def test_records_of_a_suite_are_looked_at_as_those_of_single_runs(dam, records, tmp_path, how):
    """Ten g is more than any ground has been seen to do, three more than any record: for a run and for a suite alike,
    whether a spectrum of 9.81 m/s2 under "[g]" asks for it, a peak, or the record itself."""
    record = records / "quake-a-000.txt"

    def suite(peak):
        if how == "match":
            return heeltoe.run_suite(dam, record, model="rigid", match=str(spectrum_file(tmp_path, "g", 2.3 * peak)))
        if how == "pga":
            return heeltoe.run_suite(dam, record, model="rigid", pga=f"{peak} g")
        motion = heeltoe.read_record(record)
        values = (motion.acceleration * (peak / motion.pga)).tolist()
        strong = tmp_path / f"strong-{peak:g}.txt"
        strong.write_text("# time step: 0.02 s\n# units: [g]\n" + "\n".join(map(repr, values)) + "\n")
        return heeltoe.run_suite(dam, strong, model="rigid")

    said = suite(5.0).manifest["warnings"]
    assert any("more than any recorded ground motion" in text for text in said)
    with pytest.raises(InputError) as refused:
        suite(40.0)
    assert refused.value.code in ("motion-peak", "motion-fast")
    fields = {"match": "suite.match", "pga": "suite.pga", "as recorded": "motions[0].file"}
    assert refused.value.field == fields[how]


def test_processing_of_a_suite_is_that_of_single_runs_to_the_last_bit(dam, records):
    """A band-pass puts its motion before both components, of another length for each: both begin together."""
    steps = [{"step": "band-pass", "low": "0.2 Hz", "high": "20 Hz"}, {"step": "taper"}]
    pair = {"file": str(records / "quake-a-000.txt"), "vertical": str(records / "quake-a-up.txt")}
    fields = dam.model_dump(mode="json", exclude_unset=True)
    case = heeltoe.read_case(fields | {"motions": [pair], "suite": {"processing": steps, "vertical": True}})
    (answer,) = heeltoe.run_suite(case, model="rigid").suite["models"]
    (record,) = answer["records"]
    single = {"file": pair["file"], "processing": steps, "vertical": {"file": pair["vertical"], "processing": steps}}
    alone = heeltoe.run(heeltoe.read_case(fields | {"motion": single}), "rigid")
    by_sign = {sign.sign: abs(sign.residual_slip_m) for sign in alone.signs}
    assert record["residual_slip_m"] == by_sign[record["sign"]] == max(by_sign.values()) > 0.0


@pytest.mark.parametrize(
    ("text", "said", "field"),
    [
        ("units: gal\nscale factor: 0.5\ndt: 0.01 s\n{column}", {"factor": "multiply"}, "factor"),
        ("units: gal\ndt: 0.01 s\n{rows}", {"layout": "rows"}, "layout"),
        ("dt: 0.01 s\n{column}", {"unit": "cm/s^2"}, "unit"),
        ("units: gal\n{column}", {"time_step": "0.01 s"}, "time_step"),
        ("{uncorrected}", {"processing": BASELINE}, "processing"),
    ],
)
@pytest.mark.parametrize("door", ["suite", "study"])
def test_each_remedy_is_a_field_where_the_error_is_raised(tmp_path, text, said, field, door):
    """A record that asks for a word, beside one that says it all, which keeps what it says."""
    values = (GAL * np.exp(-0.01 * np.arange(GAL.size))).tolist()
    filled = text.format(
        column="\n".join(map(repr, values)),
        rows="\n".join(" ".join(f"{v:.5f}" for v in values[k : k + 8]) for k in range(0, len(values), 8)),
        uncorrected=csmnc(np.array(values), "UNCORRECTED ACCELERATION  UNIT: CM/SEC/SEC"),
    )
    folder = tmp_path / "records"
    folder.mkdir()
    (folder / "asks-000.txt").write_text(filled)
    (folder / "says-000.txt").write_text("units: [g]\ndt: 0.02 s\n" + "\n".join(map(repr, (GAL / 981.0).tolist())))
    (tmp_path / "case.toml").write_text(BLOCK)
    case = heeltoe.read_case(tmp_path / "case.toml")

    def peaks_g(**how):
        if door == "suite":
            (answer,) = heeltoe.run_suite(case, folder, model="rigid", both_signs=False, **how).suite["models"]
            return {record["motion"]: record["pga_g"] for record in answer["records"]}
        shakes, _ = shakes_of(
            Study.of({"case": "case.toml", "motions": {"folder": "records", **how}}, tmp_path).motions, case, tmp_path
        )
        return {shake.name: shake.horizontal.pga / case.gravity for shake in shakes}

    with pytest.raises(InputError) as refused:
        peaks_g()
    assert f"{'suite' if door == 'suite' else 'motions'}.{field}" in str(refused.value)
    peaks = peaks_g(**said)
    peak = np.abs(values).max() / 981.0
    assert peaks["asks-000"] == pytest.approx(
        0.5 * peak if field == "factor" else peak, rel=0.1 if field == "processing" else 1e-3
    )
    assert peaks["says-000"] == pytest.approx(np.abs(GAL).max() / 981.0, rel=0.05)


def test_steps_that_differ_between_components_are_refused(dam, records):
    with pytest.raises(InputError, match=r"suite\.processing"):
        heeltoe.run_suite(dam, records, model="rigid", processing=[{"step": "scale-to-arias", "intensity": "1 m/s"}])
