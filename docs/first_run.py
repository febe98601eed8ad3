"""Write the verdict that the README shows, from the command above it: `python docs/first_run.py`."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "README.md"
CASE = "examples/typical-base.toml"
BEGINS, ENDS = "<!-- first run: python docs/first_run.py -->\n", "<!-- end of first run -->\n"


def verdict() -> str:
    """Return what the command prints from its verdict on."""
    run = subprocess.run(
        [sys.executable, "-m", "heeltoe", "run", CASE],
        cwd=ROOT,
        env={**os.environ, "COLUMNS": "100", "NO_COLOR": "1"},
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=True,
    )
    lines = [line.rstrip() for line in run.stdout.splitlines()]
    first = next(place for place, line in enumerate(lines) if line.startswith("Verdict"))
    return "\n".join(lines[first:]).rstrip()


def renewed(page: str, shown: str) -> str:
    """Return the page with this verdict."""
    before, rest = page.split(BEGINS)
    return f"{before}{BEGINS}```text\n{shown}\n```\n{ENDS}{rest.split(ENDS)[1]}"


if __name__ == "__main__":
    PAGE.write_text(renewed(PAGE.read_text(encoding="utf-8"), verdict()), encoding="utf-8")
