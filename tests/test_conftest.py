"""What a run of tests says at its end: what failed, and the page of what attacks came to."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from shared.attack_page import write_page
from shared.dams import ROOT


def pytest_run(place: Path, *options: str) -> tuple[int, list[str]]:
    """Run the tests in a folder with our conftest; return the code of its end and its lines."""
    (place / "pytest.ini").write_text("[pytest]\ntestpaths = .\nmarkers = slow: long\n")
    run = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "conftest", *options],
        cwd=place,
        env={**os.environ, "PYTHONPATH": os.pathsep.join((str(ROOT), str(ROOT / "tests")))},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    return run.returncode, run.stdout.splitlines()


@pytest.mark.slow
def test_the_last_lines_name_what_no_test_raises(tmp_path):
    (tmp_path / "test_nothing.py").write_text(
        "from heeltoe import InputError\ndef test_one(): InputError('source-missing', 'dam.toml', expected='a case')\n"
    )
    code, lines = pytest_run(tmp_path)
    assert code == 1
    assert lines[-2].startswith("FAILED catalogue: ")
    named = [line for line in lines if line.startswith("FAILED catalogue: ")]
    assert lines[-1 - len(named) : -1] == named
    assert "FAILED catalogue: error case-file-syntax" in named
    assert not [line for line in named if line.endswith(" source-missing")]
    assert pytest_run(tmp_path, "-k", "one")[0] == 0


@pytest.mark.slow
@pytest.mark.parametrize("workers", [(), ("-n1",)])
def test_a_test_that_fails_is_named_at_once(tmp_path, workers):
    (tmp_path / "test_two.py").write_text("def test_fails(): assert 0\ndef test_holds(): pass\n")
    code, lines = pytest_run(tmp_path, *workers)
    assert code == 1
    at_once, end = [k for k, line in enumerate(lines) if line.startswith("FAILED test_two.py::test_fails")]
    assert at_once < lines.index(next(line for line in lines if "FAILURES" in line)) < end


def test_figures_of_other_seeds_are_added(tmp_path, monkeypatch):
    page = tmp_path / "attack.md"
    for seed, accepted in ((81, 1200), (82, 34)):
        monkeypatch.setattr("shared.attack_page.SEED", seed)
        write_page(page, [("cases", {"accepted": accepted, "defect": 1})], add=seed == 82)
    text = page.read_text()
    assert "| cases | 1,236 | 1,234 | 0 | 0 | 2 |" in text
    assert "| all | 1,236 |" in text
    assert "seeds 81, 82." in text


@pytest.mark.slow
@pytest.mark.parametrize("workers", [(), ("-n2",)])
def test_what_an_attack_has_tried_is_added_once(tmp_path, monkeypatch, workers):
    page = tmp_path / "attack.md"
    write_page(page, [("cases", {"accepted": 5})])
    body = "record_property('attack', ('cases', {'accepted': 3}))"
    (tmp_path / "test_two.py").write_text(f"def test_a(record_property): {body}\ndef test_b(record_property): {body}\n")
    monkeypatch.setenv("HEELTOE_ATTACK_PAGE", str(page))
    monkeypatch.setenv("HEELTOE_ATTACK_ADD", "1")
    pytest_run(tmp_path, "-k", "test", *workers)
    assert "| cases | 11 | 11 |" in page.read_text()
