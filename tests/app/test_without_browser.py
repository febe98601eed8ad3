"""Where there is no browser its tests are left out and say so; where they are required they fail."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from shared.dams import ROOT

pytest.importorskip("playwright")


def outcome(path, required: str) -> subprocess.CompletedProcess[str]:
    """Run one test of a page where programs are looked for in `path` alone."""
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-k", "typical_dam"]
    environment = {**os.environ, "PATH": str(path), "HEELTOE_BROWSER": required}
    return subprocess.run(
        [*words, "tests/app/test_answer_page.py"], cwd=ROOT, env=environment, capture_output=True, text=True
    )


@pytest.mark.slow
def test_they_are_skipped_and_say_so(tmp_path):
    process = outcome(tmp_path, "")
    assert process.returncode == 0, process.stdout
    assert "1 skipped" in process.stdout
    assert "no browser: install chromium" in process.stdout


@pytest.mark.slow
def test_they_fail_where_they_are_required(tmp_path):
    process = outcome(tmp_path, "required")
    assert process.returncode == 1
    assert "1 error" in process.stdout
    assert "no browser: install chromium" in process.stdout
