"""The command line as a process."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from shared.dams import ROOT

EXAMPLES = ROOT / "examples"


def heeltoe(*arguments: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", "from heeltoe.cli.main import main; main()", *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=cwd,
        env={**os.environ, "COLUMNS": "200"},
        timeout=120,
        check=False,
    )
