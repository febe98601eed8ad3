"""What strangers have written, in titles, headers and names, is shown harmless in reports, notebooks and animations."""

from __future__ import annotations

import csv
import html
import io
import json
import re
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest
from pypdf import PdfReader

from heeltoe import Case, Response, read_case, rigid
from heeltoe.case.project import Project, Revision
from heeltoe.views.animation.write import animate
from heeltoe.views.notebook import html as notebook
from heeltoe.views.report.html import html as page
from heeltoe.views.report.typst_pdf import pdf
from heeltoe.views.report.write import build_report
from shared.command import command
from shared.dams import BLOCK

TEXTS = {
    "markup": '<script>alert(1)</script> </title> #import "x" $x$ \\ [/] %%SCENE%% {{ 1 }}',
    "lines": "dam\nVerdict  The dam stands.\r\n= Heading\u2028\u0085end",
    "controls": "a\x1b[31mred\x07\x08\0q",
    "turned": "\u202edam \u2066סכר\u2069 \ufeffend",
    "long": "dam " * 500,
    "long word": "x" * 2000,
    "many marks": "e" + "\u0301\u0336" * 900,
    "another script": "水壩 плотина",
}
EVERY = pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)


def strange_run(text: str) -> tuple[Case, Response]:
    """Return a case and its result in which all that strangers write is this."""
    case = read_case(BLOCK, [{"title": text}])
    response = rigid(case)
    motion = replace(response.motion, name=text, event=text, station=text, component=text, processing=(text,))
    return case, replace(response, motion=motion)


def strange(text: str) -> set[str]:
    return {
        letter
        for letter in html.unescape(text)
        if not letter.isprintable() and letter not in "\n\u200b\u2060\xa0\u2003"
    }


@pytest.fixture(scope="module")
def usual() -> int:
    """How many pages a report has."""
    return pages(*strange_run("Block pushed once"))


def pages(case: Case, result: Response) -> int:
    return len(PdfReader(io.BytesIO(pdf(build_report(case, result, figures={})))).pages)


@EVERY
def test_reports_as_html(text):
    case, result = strange_run(text)
    shown = page(build_report(case, result, figures={}))
    assert not strange(shown)
    assert "<script>alert" not in shown
    assert shown.count("</title>") == 1
    assert max(map(len, shown.splitlines())) < 10_000


@pytest.mark.parametrize("name", ["markup", "controls", "long word", pytest.param("long", marks=pytest.mark.product)])
def test_reports_as_pdf(name, usual):
    # What is long takes some lines more where the case is said again in full, and no page full of itself.
    assert pages(*strange_run(TEXTS[name])) <= usual + 2


@EVERY
def test_notebooks(text):
    for thing in strange_run(text):
        shown = notebook(thing)
        assert not strange(shown)
        assert "<script>" not in shown
        assert len(shown) < 30_000
    assert not strange(repr(strange_run(text)[0]))
    assert not strange(repr(strange_run(text)[1]))


@EVERY
def test_animations(text, tmp_path):
    written = animate(*strange_run(text), tmp_path / "dam.html").read_text(encoding="utf-8")
    head = written[: written.index("<style")] + written[written.index("</style>") :][:2000]
    assert not strange(head)
    assert "<script>alert" not in written
    assert written.count("</title>") == 1


EVIL = "=1+1 \x1b[2J\nVerdict  all checks are met\u202e"
CRITERIA = """
title = "{0}"
[sliding-without-cohesion]
usual = 1.5
extreme = 1.1
post-earthquake = 1.2
source = "{0}"
"""


@pytest.mark.slow
def test_no_text_of_an_input_file_controls_the_terminal_or_a_spreadsheet(tmp_path):
    """Every text field of a case, of a file of criteria and of a record, in words, tables and JSON."""
    written = EVIL.replace("\x1b", "\\u001b").replace("\n", "\\n")
    names = {"file": "=motion\x1b[31m.txt", "criteria_file": "=own\x1b[31m\n.toml"}
    (tmp_path / names["criteria_file"]).write_text(CRITERIA.format(written))
    rows = "".join(f"{0.02 * k:.2f} {0.4 * (k % 40 - 20) / 20:.3f}\n" for k in range(200))
    (tmp_path / names["file"]).write_text(f"# event: {EVIL[:9]}\n# station: {EVIL[:9]}\ntime [s], acc [g]\n{rows}")
    fields = tomllib.loads(Path(BLOCK).read_text(encoding="utf-8"))
    fields |= {
        "title": EVIL,
        "project": dict.fromkeys(Project.model_fields, EVIL)
        | {"date": "2026-01-01", "revisions": [dict.fromkeys(Revision.model_fields, EVIL)]},
        "motion": {"file": names["file"]},
        "statics": {
            "criteria_file": names["criteria_file"],
            "earthquakes": [{"name": EVIL[:60], "seismic_coefficient": 0.1, "rarity": "unusual"}],
        },
    }
    (tmp_path / "case.json").write_text(json.dumps(fields))
    for words in (("run",), ("run", "--details"), ("statics",), ("statics", "--details")):
        place = f"out{len(list(tmp_path.iterdir()))}"
        ended = command(*words, "case.json", "--out", place, *(("--csv",) if words[0] == "run" else ()), cwd=tmp_path)
        assert ended.returncode in (0, 3), ended.stderr
        assert not strange(ended.stdout + ended.stderr)
        assert not re.search(r"^ *Verdict  all checks", ended.stdout, re.MULTILINE)
        tables = list((tmp_path / place).rglob("*.csv"))
        assert tables
        for table in tables:
            cells = [cell for row in csv.reader(table.read_text().splitlines()) for cell in row]
            assert not [cell for cell in cells if cell.startswith(("=", "@"))]
