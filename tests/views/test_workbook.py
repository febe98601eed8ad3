"""The tables of a result as a workbook: what stands in its sheets, and what it needs."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import pytest

import heeltoe
from heeltoe import InputError, statics_of_sections
from heeltoe.views.files import workbook
from shared.command import command
from shared.dams import BASE, ENDS, example


def sheets(path: Path) -> dict[str, list[list[str]]]:
    """Return the cells of each sheet, row by row."""
    with zipfile.ZipFile(path) as parts:
        names = re.findall(r'<sheet name="([^"]+)"', parts.read("xl/workbook.xml").decode())
        texts = [parts.read(f"xl/worksheets/sheet{k + 1}.xml").decode() for k in range(len(names))]
    rows = [re.findall(r"<row [^>]*>(.*?)</row>", text) for text in texts]
    cells = [[re.findall(r"<(?:t|v)[^>]*>(.*?)</(?:t|v)>", row) for row in item] for item in rows]
    return dict(zip(names, cells, strict=True))


def test_a_run_has_its_numbers_with_units_and_its_histories(tmp_path):
    response = heeltoe.rigid(example("typical-base", "motion.duration=3s", ENDS))
    result = sheets(heeltoe.write_workbook(response, tmp_path / "run.xlsx"))
    assert list(result) == ["numbers", "histories", "events"]
    slip = next(row for row in result["numbers"] if row[0] == "residual_slip_m")
    assert float(slip[1]) == pytest.approx(response.residual_slip_m, rel=1e-12)
    assert slip[2] == "m"
    head, *rows = result["histories"]
    assert "slip_m [m]" in head
    assert "ground_acceleration_m_s2 [m/s²]" in head
    assert len(rows) == len(response.histories["time_s"])


def test_static_checks_have_their_loads(tmp_path):
    result = sheets(heeltoe.write_workbook(statics_of_sections(heeltoe.read_case(BASE)), tmp_path / "checks.xlsx"))
    assert list(result) == ["numbers", "loads", "checks"]
    assert any("reservoir" in row for row in result["loads"])


@pytest.mark.slow
def test_the_command_line_writes_it_beside_the_rest(tmp_path):
    done = command("statics", BASE, "--out", tmp_path / "here", "--xlsx")
    assert done.returncode == 0, done.stderr
    assert list(sheets(tmp_path / "here" / "workbook.xlsx")) == ["numbers", "loads", "checks"]
    alone = command("run", BASE, "--xlsx")
    assert alone.returncode == 2
    assert "--xlsx" in alone.stderr


def test_without_its_package_there_is_none(tmp_path, monkeypatch):
    monkeypatch.setattr(workbook, "find_spec", lambda name: None)
    with pytest.raises(InputError, match="xlsxwriter, which is not installed"):
        heeltoe.write_workbook(statics_of_sections(heeltoe.read_case(BASE)), tmp_path / "checks.xlsx")
    assert not list(tmp_path.iterdir())
