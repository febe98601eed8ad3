"""What strangers have written, in titles, headers and names, is shown harmless in reports, notebooks and animations."""

from __future__ import annotations

import html
import io
from dataclasses import replace

import pytest
from pypdf import PdfReader

from heeltoe import Case, Response, read_case, rigid
from heeltoe.views.animation.write import animate
from heeltoe.views.notebook import html as notebook
from heeltoe.views.report.html import html as page
from heeltoe.views.report.typst_pdf import pdf
from heeltoe.views.report.write import build_report
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


def told(text: str) -> tuple[Case, Response]:
    """Return a case and its result in which all that strangers write is this."""
    case = read_case(BLOCK, [{"title": text}])
    found = rigid(case)
    motion = replace(found.motion, name=text, event=text, station=text, component=text, processing=(text,))
    return case, replace(found, motion=motion)


def strange(text: str) -> set[str]:
    return {
        letter
        for letter in html.unescape(text)
        if not letter.isprintable() and letter not in "\n\u200b\u2060\xa0\u2003"
    }


@pytest.fixture(scope="module")
def usual() -> int:
    """How many pages a report has."""
    return pages(*told("Block pushed once"))


def pages(case: Case, result: Response) -> int:
    return len(PdfReader(io.BytesIO(pdf(build_report(case, result, figures={})))).pages)


@EVERY
def test_reports_as_html(text):
    case, result = told(text)
    shown = page(build_report(case, result, figures={}))
    assert not strange(shown)
    assert "<script>alert" not in shown
    assert shown.count("</title>") == 1
    assert max(map(len, shown.splitlines())) < 10_000


@pytest.mark.parametrize("name", ["markup", "controls", "long word", pytest.param("long", marks=pytest.mark.slow)])
def test_reports_as_pdf(name, usual):
    # What is long takes some lines more where the case is said again in full, and no page full of itself.
    assert pages(*told(TEXTS[name])) <= usual + 2


@EVERY
def test_notebooks(text):
    for thing in told(text):
        shown = notebook(thing)
        assert not strange(shown)
        assert "<script>" not in shown
        assert len(shown) < 30_000
    assert not strange(repr(told(text)[0]))
    assert not strange(repr(told(text)[1]))


@EVERY
def test_animations(text, tmp_path):
    written = animate(*told(text), tmp_path / "dam.html").read_text(encoding="utf-8")
    head = written[: written.index("<style")] + written[written.index("</style>") :][:2000]
    assert not strange(head)
    assert "<script>alert" not in written
    assert written.count("</title>") == 1
