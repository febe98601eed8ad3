"""The reference cases hold, and a wrong number would be seen."""

import io

import pytest
from rich.console import Console

from heeltoe import InputError
from heeltoe.validation.cases import CASES, run_case
from heeltoe.validation.row import Row
from heeltoe.validation.table import run_all

_NEED_RECORDS = {"triangular", "table-7.6-taft", "table-7.6-el-centro"}
# Half a second to minutes each.
_LONG = {
    "elastic-impulse",
    "elastic-sliding",
    "elastic-rocking",
    "contactors",
    "random-blocks",
    "random-dams",
    "evidence",
}
_LONG_ON_RECORDS = {"table-7.1", "table-7.7", "table-7.8", "table-7.10", "halving", "penalty", "koyna-chain"}
_SHORT = [name for name in CASES if name not in _NEED_RECORDS | _LONG | _LONG_ON_RECORDS]


@pytest.mark.parametrize("name", _SHORT)
def test_reference_case(name):
    _judge(run_case(name))


@pytest.mark.parametrize("name", sorted(_NEED_RECORDS))
def test_reference_case_on_a_real_record(name, records):
    _judge(run_case(name))


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(_LONG))
def test_long_reference_case(name):
    _judge(run_case(name))


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(_LONG_ON_RECORDS))
def test_long_reference_case_on_a_real_record(name, records):
    _judge(run_case(name))


def _judge(rows):
    assert rows
    assert all(row.remark for row in rows if row.tolerance is None or row.explained or row.kind == "thesis")
    outside = [f"{row.what}: {row.ours_text} instead of {row.reference_text}" for row in rows if row.holds is False]
    assert not outside


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
    assert run_all("impulse", Console(file=text, width=160))
    assert "slip after 0.4 s" in text.getvalue()
    assert "2 within what their reference is good for, 0 deviate and say why, 0 outside" in text.getvalue()


def test_an_unknown_case_is_refused():
    with pytest.raises(InputError, match="choose one of impulse"):
        run_all("koyna", Console(file=io.StringIO()))
