"""The command line, in this process or in one of its own."""

from __future__ import annotations

import functools
import io
import os
import subprocess
import sys
from collections.abc import Iterable
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

import pytest
import typer.main

from heeltoe.cli.main import main

#: The commands with their options: alike for each call, and a tenth of the time of a short one.
_GET_COMMAND = functools.cache(typer.main.get_command)


@dataclass(frozen=True)
class Reply:
    """What a command leaves: how it ended, and its two outputs."""

    returncode: int
    stdout: str
    stderr: str


def command(*arguments: str | Path, cwd: Path | None = None, columns: int = 200) -> Reply:
    """Run a command in this process: all but what belongs to processes (pipes, signals, terminals) is the same."""
    out, err, code = io.StringIO(), io.StringIO(), None
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(err):
        patch.setattr(typer.main, "get_command", _GET_COMMAND)
        patch.setattr(sys, "argv", ["heeltoe", *map(str, arguments)])
        patch.setenv("COLUMNS", str(columns))
        if cwd:
            patch.chdir(cwd)
        try:
            main()
        except SystemExit as ended:
            code = ended.code
    return Reply(int(code or 0), out.getvalue(), err.getvalue())


def process(*arguments: str | Path, cwd: Path | None = None, columns: int = 200) -> Reply:
    """Run a command in a process of its own."""
    run = subprocess.run(
        [sys.executable, "-m", "heeltoe", *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=cwd,
        env={**os.environ, "COLUMNS": str(columns)},
        timeout=120,
        check=False,
    )
    return Reply(run.returncode, run.stdout, run.stderr)


def options(changes: Iterable[str]) -> list[str]:
    """Return changes of a case as options of a command."""
    return [part for change in changes for part in ("--set", change)]
