"""The book prints what another machine finds too, sees what has changed, and makes its pages from rows."""

import math

import pytest

from validation.book import numbers, pages, store
from validation.book.__main__ import make
from validation.row import Row


@pytest.mark.parametrize(
    ("row", "ours", "deviation", "tolerance"),
    [
        (Row("slip", 100.0, 104.0400001, 0.07), "104.04", "+4 %", "7 %"),
        (Row("slip", 100.0, 100.00001, 0.07), "100", "< 0.01 %", "7 %"),
        (Row("slip", 100.0, 119.9, 0.07, explained=0.22), "119.9", "+20 %", "7 %; explained to 22 %"),
        (Row("slip", 1.0, 1.0 + 1e-13, 1e-12), "1", "< 1e-09", "1e-12"),
        (Row("stress", 15.7, 15.72, 0.06, relative=False), "15.72", "+0.02", "0.06"),
        (Row("events", 19.0, 19.0, 0.0), "19", "0", "0"),
        (Row("ledger", 0.0, 3e-13, 1e-9, relative=False, kind="condition"), "< 1e-09", "", "1e-09"),
        (Row("made", 0.0, 3.2e-6, 1e-4, relative=False, kind="condition"), "< 1e-05", "", "0.0001"),
        (Row("peak", 0.5, 0.41234, 0.1, relative=False, digits=2), "0.41", "", "0.1"),
        (Row("made", 0.0, 0.6, None, relative=False, digits=0), numbers.VARIES, "", "none"),
        (Row("lost", 0.0, 0.0123, None, relative=False), "0.0123", "+0.012", "none"),
    ],
)
def test_numbers(row, ours, deviation, tolerance):
    assert (numbers.ours(row), numbers.deviation(row), numbers.tolerance(row)) == (ours, deviation, tolerance)


@pytest.mark.parametrize(
    ("old", "new", "same"),
    [
        ("104.04", "104.05", True),
        ("104.04", "104.06", False),
        ("421", "421.4", True),
        ("421", "423", False),
        ("+4.1 %", "-4.1 %", False),
        ("< 0.01 %", "+0.01 %", True),
        ("< 0.01 %", "+0.03 %", False),
        ("< 1e-05", "< 1e-06", True),
        ("< 1e-05", "< 1e-08", False),
        ("6.62 m in 50 s", "6.63 m in 50 s", True),
        ("6.62 m in 50 s", "6.62 m in 60 s", False),
        ("within", "outside", False),
        ("143.1 to 146.2", "143.1 to 146.3", True),
    ],
)
def test_the_same_but_for_the_last_digit(old, new, same):
    assert numbers.alike(old, new) is same
    assert numbers.alike(new, old) is same


def test_what_carries_rounding_on_may_move_a_little():
    assert numbers.alike("346.9", "348.5", 0.01)
    assert not numbers.alike("346.9", "358.5", 0.01)
    assert numbers.alike("+0.72 %", "+0.24 %", 0.01)
    assert not numbers.alike("+0.72 %", "-1.24 %", 0.01)
    assert not numbers.alike("346.9 mm", "346.9 m", math.inf)


def test_drift_is_told():
    before = [store.row_texts(Row("slip", 100.0, 104.0, 0.07, remark="print"))]
    assert store.drift(before, before) == []
    now = [store.row_texts(Row("slip", 100.0, 109.0, 0.07, remark="print"))]
    text = "\n".join(store.drift(before, now))
    assert "slip, ours: '104' before, '109' now" in text
    assert "slip, verdict: 'within' before, 'outside' now" in text
    assert store.drift(before, [*now, *now]) == ["1 rows before, 2 now"]
    assert store.drift(before, [now[0] | {"verdict": "within"}], steady=math.inf) == []
    assert "verdict" in store.drift(before, now, steady=math.inf)[0]
    spread = [store.row_texts(Row("slip", 100.0, 104.0, 0.07, remark="print", spread=(103.0, 105.0)))]
    assert "columns" in store.drift(before, spread)[0]


def test_a_row_outside_stands_out():
    page = pages.page("impulse", [store.row_texts(Row("slip", 100.0, 140.0, 0.07, remark="print", spread=(1.0, 2.0)))])
    assert "**outside**" in page
    assert "| slip | 100 | 140 |" in page
    assert "Reference: closed form, 7 %: print." in page


def test_references_of_several_kinds_have_notes():
    rows = [Row("slip", 100.0, 104.0, 0.07, remark="print", kind=kind) for kind in ("thesis", "book")]
    page = pages.page("impulse", [store.row_texts(row) for row in rows])
    assert "| slip [2] |" in page
    assert "1. thesis, 7 %: print\n2. book, 7 %: as in 1" in page


def test_one_page_is_made_anew(tmp_path, capsys):
    make(tmp_path, ["impulse"])
    make(tmp_path, ["sine"])
    assert set(store.read(tmp_path)) == {"impulse", "sine"}
    assert {path.name for path in tmp_path.glob("*.md")} == {"impulse.md", "sine.md", "index.md"}
    assert "[sine](sine.md)" in (tmp_path / "index.md").read_text(encoding="utf-8")
    assert "impulse: 2 rows" in capsys.readouterr().out


def test_what_cannot_be_computed_stays(tmp_path, monkeypatch, capsys):
    make(tmp_path, ["impulse"])
    before = store.read(tmp_path)
    monkeypatch.setenv("HEELTOE_RECORDS", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    make(tmp_path, ["table-7.6-taft"])
    assert store.read(tmp_path) == before
    assert "table-7.6-taft: as it was; the record" in capsys.readouterr().out
