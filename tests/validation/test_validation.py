"""The reference cases hold, their pages say what they find, and a wrong number would be seen."""

import io
import re

import pytest
from rich.console import Console

from shared.dams import ROOT
from shared.pages import PAGES
from validation.__main__ import run_all
from validation.book import pages, store
from validation.cases import CASES, run_case, wanted
from validation.row import Row, Skipped

BOOK = ROOT / "docs" / "validation"


# Seconds each, and their parts have tests of their own.
SECONDS = ("notched-beam", "bonded-cantilevers", "periods", "bonded-bar")


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.slow if name in SECONDS else ())
        for name, case in CASES.items()
        if not case.long
    ],
)
def test_reference_case(name):
    _judge(name)


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, case in CASES.items() if case.long])
def test_long_reference_case(name):
    _judge(name)


def _judge(name):
    try:
        rows = run_case(name)
    except Skipped as reason:
        assert CASES[name].records
        pytest.skip(str(reason))
    assert rows
    assert all(row.remark for row in rows if row.tolerance is None or row.explained or row.kind == "thesis")
    outside = [f"{row.what}: {row.ours_text} instead of {row.reference_text}" for row in rows if row.holds is False]
    assert not outside
    drift = store.drift(store.read(BOOK)[name], [store.row_texts(row) for row in rows], steady=CASES[name].steady)
    assert not drift, "\n".join(["make book:", *drift])


@pytest.mark.parametrize("name", CASES)
def test_pages_are_made_of_the_stored_rows(name):
    assert (BOOK / f"{pages.file_of(name)}.md").read_text(encoding="utf-8") == pages.page(name, store.read(BOOK)[name])
    assert (BOOK / f"{pages.file_of(name)}.png").exists() == (CASES[name].chart is not None)
    assert (BOOK / f"{pages.file_of(name)}-history.png").exists() == (CASES[name].history is not None)


def test_the_matrix_is_made_of_the_stored_rows():
    book = store.read(BOOK)
    assert list(book) == list(CASES)
    assert (BOOK / "index.md").read_text(encoding="utf-8") == pages.index(book)


#: Pages written by hand, or by `make attack`.
OTHERS = {"independent-codes", "flexible-choices", "rigid-rock", "attack"}


def test_the_book_has_no_other_pages():
    stems = {path.stem for path in BOOK.glob("*.md")}
    assert stems == {pages.file_of(name) for name in CASES} | OTHERS | {"index"}


def test_nothing_in_the_book_is_outside_and_each_row_has_a_verdict():
    for rows in store.read(BOOK).values():
        assert {row["verdict"] for row in rows} <= {"within", "deviates, explained", "no verdict"}
        assert all(row["remark"] for row in rows if row["verdict"] != "within")


def test_a_row_outside_its_tolerance_fails():
    row = Row("slip", 1.0, 1.2, 0.1)
    assert row.holds is False
    assert row.verdict == "NOT within 10%"


def test_what_deviates_is_said_and_not_called_ok():
    near, far, beyond = (Row("slip", 100.0, ours, 0.05, kind="thesis", explained=0.3) for ours in (104.0, 120.0, 131.0))
    assert (near.holds, far.holds, beyond.holds) == (True, None, False)
    assert (near.deviates, far.deviates, beyond.deviates) == (False, True, False)
    assert near.verdict == "ok, within 5%"
    assert far.verdict == "deviates: 20%, reference good for 5%"
    assert beyond.verdict == "NOT within 30%, all explained"


def test_the_tables_are_printed():
    text = io.StringIO()
    assert run_all(["impulse"], Console(file=text, width=160))
    assert "slip after 0.4 s" in text.getvalue()
    assert "chapters IV and V: the printed parabolas" in " ".join(text.getvalue().split())
    assert "2 within what their reference is good for, 0 deviate and say why, 0 outside" in text.getvalue()


def test_an_unknown_case_is_refused():
    with pytest.raises(SystemExit, match="no reference case: koyna; there are impulse"):
        wanted(["impulse", "koyna"])


def test_the_pages_name_cases_that_are_there():
    named = [name for text in PAGES.values() for name in re.findall(r"python -m validation ([a-z][\w.-]*)", text)]
    assert len(named) > len(CASES)
    assert set(named) == set(CASES)
