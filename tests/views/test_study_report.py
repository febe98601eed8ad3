"""The report of a study says what was varied, what came out, what failed, and how to run it again."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

from heeltoe import open_study, run_study
from heeltoe.views.content.study import study_document, study_subject
from heeltoe.views.content.tree import FigureBlock, Section, Table
from heeltoe.views.report.html import html
from shared.command import command
from shared.studies import DRAWN, GRID, study_file


def report(found, folder, units="si"):
    document = study_document(study_subject(found, folder, units, "heeltoe study it", None))
    return document, " ".join(re.sub(r"<style>.*?</style>|<[^>]+>", " ", html(document), flags=re.DOTALL).split())


def titles(document):
    return [block.title for block in document.blocks if isinstance(block, Section)]


def figures(document):
    return [b.name for s in document.blocks if isinstance(s, Section) for b in s.blocks if isinstance(b, FigureBlock)]


@pytest.mark.slow
def test_a_drawn_study(tmp_path):
    study = run_study(study_file(tmp_path, DRAWN), tmp_path / "out")
    document, text = report(study, tmp_path)
    assert titles(document) == [
        *("Question and answer", "Fields varied", "Ground motions", "Results", "Fragility"),
        *("Measures of strength compared", "How it was computed", "References", "To run it again"),
        "Appendix: the base case",
    ]
    assert figures(document) == ["section", "bands", "slips", "modes", "fragility"]
    for message in (
        "60 runs: 60 dams, 10 ground motions of 3 events? Each dam meets one of them.",
        "lognormal, median 0.4, dispersion 0.2, upper 1",
        "triangular, from 0.1 to 0.9, mode 0.4",
        "They are scaled to SA at 0.3 s: uniform, from 0.2 g to 2 g. Each runs both ways round.",
        "Base case by itself. In points of the case , peak 0.8 g: As a rigid block",
        "Half of the dams exceed a residual slip of 50.0 mm at a PGA of",
        "all runs are of rigid blocks",
        "Shinozuka",
        "heeltoe study it",
        study.manifest["fingerprint"],
    ):
        assert message in text, message
    # What stands there is what the study says.
    value = study.summary[0]["residual_slip_m"]["84%"]
    assert f'data-key="summary.0.residual_slip_m.84%" value="{value!r}"' in html(document)


@pytest.mark.slow
def test_the_base_case_of_an_elastic_study_is_elastic(tmp_path):
    case = """
    [section]
    polygon = [["0 m", "0 m"], ["26 m", "0 m"], ["5 m", "30 m"], ["0 m", "30 m"]]
    [concrete]
    modulus = "20 GPa"
    [crack]
    friction = 0.6
    [reservoir]
    depth = "26 m"
    [motion]
    points = [["0 s", "0 g"], ["0.2 s", "0.7 g"], ["0.4 s", "0 g"]]
    [flexible]
    elements_across = 2
    [analysis]
    silence = "1 s"
    """
    text = 'case = "case.toml"\nmodel = "flexible"\n[vary]\n"crack.friction" = [0.6, 0.7]\n'
    study = run_study(study_file(tmp_path, text, case=case), tmp_path / "out")
    _, message = report(study, tmp_path)
    said = message.partition("Base case by itself. ")[2]
    assert "peak 0.7 g: The dam slides" in said
    slips = 1e3 * np.abs(study.to_pandas()["residual_slip_m"])
    assert f"{slips.max():.1f} mm" in said


def test_what_failed_and_what_is_missing_come_first(tmp_path):
    text = DRAWN.replace("median = 0.4", "median = 0.02").replace("samples = 60", "samples = 40")
    case = "\n".join(["[section]", "polygon = [['0 m', '0 m'], ['4 m', '0 m'], ['4 m', '10 m'], ['0 m', '10 m']]"])
    case += "\n[crack]\nfriction = 0.6\ninclination = '2 deg'\n"
    study = run_study(study_file(tmp_path, text, case=case), tmp_path / "out")
    assert study.outcomes["unstable"] > 10
    _, message = report(study, tmp_path)
    assert f"Runs without a result {study.outcomes['unstable']:,} of 40 runs ended without a result" in message
    assert "Base case by itself" not in message
    assert "Not run by itself" in message


def test_an_incomplete_study_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr("heeltoe.study.run.run.MOST_OF_PART", 20)
    run_study(study_file(tmp_path, GRID), tmp_path / "out")
    next((tmp_path / "out" / "runs").glob("part-00000001-*.parquet")).unlink()
    document, message = report(open_study(tmp_path / "out"), tmp_path)
    assert "Not complete 1 of 3 parts of the runs are missing." in message
    assert "Fragility" not in titles(document)


@pytest.mark.slow
@pytest.mark.parametrize(("method", "figure"), [("sensitivity", "sobol"), ("one at a time", "tornado")])
def test_what_the_slip_hangs_on_has_a_section(tmp_path, method, figure):
    drawn = DRAWN.replace('"latin hypercube"\nsamples = 60', '"sensitivity"\nsamples = 16')
    listed = GRID.replace('"case.toml"\n', '"case.toml"\nmethod = "one at a time"\n', 1)
    study = run_study(study_file(tmp_path, drawn if method == "sensitivity" else listed), tmp_path / "out")
    document, _ = report(study, tmp_path, "us")
    section = next(block for block in document.blocks if getattr(block, "title", "") == "Fields that decide the slip")
    assert [type(block) for block in section.blocks] == [Table, FigureBlock]
    assert section.blocks[1].name == figure


@pytest.mark.slow
def test_the_command_writes_it_beside_the_runs(tmp_path):
    out = tmp_path / "out"
    file = study_file(tmp_path, GRID)
    process = command("study", file, "--out", out, "--report", "--units", "us", "--no-figures", "--details")
    assert process.returncode == 0, process.stderr
    assert (out / "report.pdf").read_bytes().startswith(b"%PDF")
    text = (out / "report.html").read_text()
    assert "ft/s" in text or " in" in text
    assert not (out / "figures").exists()
    assert "residual slip: half stay below" in process.stdout
    assert re.search(r"largest +[\d.]+ (in|ft)", process.stdout)
    # Again, over that of before; what is the user's stays.
    assert command("study", file, "--out", out, "--resume", "--report").returncode == 0
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "report.pdf").write_text("mine")
    refused = command("study", file, "--out", mine, "--report")
    assert refused.returncode == 2
    assert "report.pdf" in refused.stderr
    assert sorted(path.name for path in mine.iterdir()) == ["report.pdf"]


def test_a_dry_run_as_json(tmp_path):
    process = command("study", study_file(tmp_path, GRID), "--dry-run", "--json", "-")
    answer = json.loads(process.stdout)
    assert (answer["runs"], answer["dams"], answer["motions_of_each"], answer["strengths_of_each"]) == (60, 6, 5, 2)
    assert answer["seconds"] == pytest.approx(answer["runs"] * answer["seconds_per_run"] / answer["cores"])
    assert "60 runs" in process.stderr
