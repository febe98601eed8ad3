"""`make audit` never passes silently: what could not be looked up is said, and is an error of its own."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from shared.dams import ROOT

pytestmark = pytest.mark.skipif(shutil.which("bash") is None, reason="bash is not installed")
OLD, CLEAN = '{"name": "a", "version": "1", "vulns": [{"id": "OLD-1"}]}', '{"name": "a", "version": "1", "vulns": []}'
SKIPPED = '{"name": "a", "skip_reason": "not found"}'


def audit(place: Path, old: str | None, lock: str | None, deny: str = "exit 0") -> subprocess.CompletedProcess[str]:
    """Run the audit with tools that answer so: about an old weakness, about our packages, about our crates."""

    def answer(found: str | None) -> str:
        return "exit 1" if found is None else f'echo \'{{"dependencies": [{found}]}}\' > "$last"'

    tools = {
        "pip-audit": f'for last; do :; done\ncase "$2" in *lock) {answer(lock)};; *) {answer(old)};; esac',
        "cargo": deny,
    }
    for name, text in tools.items():
        (place / name).write_text(f"#!/bin/bash\n{text}\n")
        (place / name).chmod(0o755)
    around = {**os.environ, "PATH": f"{place}:{os.environ['PATH']}", "PIP_AUDIT": str(place / "pip-audit")}
    return subprocess.run(
        ["bash", ROOT / ".ci" / "audit"], env=around, capture_output=True, text=True, check=False, timeout=60
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("old", "lock", "deny", "code", "words"),
    [
        (OLD, CLEAN, "exit 0", 0, "Python packages: none known"),
        (OLD, OLD, "exit 0", 1, "Python packages: weaknesses are known"),
        (None, CLEAN, "exit 0", 2, "no database of weaknesses answers"),
        (CLEAN, CLEAN, "exit 0", 2, "no database of weaknesses answers"),
        (SKIPPED, CLEAN, "exit 0", 2, "no database of weaknesses answers"),
        (OLD, f"{CLEAN}, {SKIPPED}", "exit 0", 2, "some could not be looked up"),
        (OLD, None, "exit 0", 2, "some could not be looked up"),
        (OLD, CLEAN, "exit 1", 2, "cargo-deny is not installed"),
        (OLD, CLEAN, 'test "$2" != fetch', 2, "Rust crates: NOT LOOKED AT"),
        (OLD, CLEAN, 'test "$2" != --offline', 1, "Rust crates: weaknesses are known"),
    ],
)
def test_what_could_not_be_looked_at_is_no_pass(tmp_path, old, lock, deny, code, words):
    result = audit(tmp_path, old, lock, deny)
    assert result.returncode == code, result.stdout + result.stderr
    assert words in result.stdout
