"""Little memory, no home, full disks, odd terminals: a command ends as it should, or says in one line what it needs."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from shared.dams import BASE, BLOCK, FAST, SLENDER

COMMANDS: dict[str, Sequence[str | Path]] = {
    "help": ["--help"],
    "version": ["--version"],
    "run": ["run", "dam.toml", "--json", "result.json"],
    "report": ["run", "dam.toml", "--report", "--out", "out"],
    "elastic": ["run", BASE, "--motion", "record.txt", *(part for change in FAST for part in ("--set", change))],
    "motion": ["motion", "record.txt"],
    "statics": ["statics", "dam.toml"],
    "periods": ["periods", BASE],
    "overturning": ["overturning", SLENDER, "--count=3"],
    "page": ["animate", "dam.toml", "--to=dam.html"],
    "video": ["animate", "dam.toml", "--to=dam.mp4", "--fps=5"],
    "new": ["new", "fresh"],
}
FURTHER: dict[str, Sequence[str | Path]] = {
    "solve": ["solve", "dam.toml", "crack.friction", "--until", "residual_slip = 1 mm", "--between", "0.05,1"],
    "law": ["law", "cohesion"],
    "explain": ["explain", "crack.friction"],
    "examples": ["examples"],
    "study": ["study", "study.toml", "--out", "out"],
}
RECORD = "# units: time [s], acceleration [g]\n" + "".join(f"{0.01 * k:.2f} {(-1) ** k * 0.2}\n" for k in range(50))


@dataclass(frozen=True)
class Place:
    """What is around a process."""

    set: dict[str, str | None] = field(default_factory=dict)
    limits: tuple[tuple[int, int], ...] = ()
    closed: tuple[int, ...] = ()
    empty: bool = False
    """Whether the environment has nothing else in it."""


NOWHERE = "/proc/nowhere"
PLACES = {
    "1 GB": Place(limits=((resource.RLIMIT_AS, 10**9),)),
    "files of 30 kB": Place(limits=((resource.RLIMIT_FSIZE, 30_000),)),
    "30 open files": Place(limits=((resource.RLIMIT_NOFILE, 30),)),
    "read-only home": Place({"HOME": "/proc", "XDG_CACHE_HOME": None, "XDG_CONFIG_HOME": None}),
    "no home": Place(empty=True),
    "no place for fonts": Place({"MPLCONFIGDIR": "/proc", "FONTCONFIG_FILE": os.devnull, "XDG_CACHE_HOME": "/proc"}),
    "no TMPDIR": Place({"TMPDIR": NOWHERE}),
    "C": Place({"LANG": "C", "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}),
    "a locale that is not installed": Place({"LANG": "xx_YY.UTF-8", "LC_ALL": "xx_YY.UTF-8", "LANGUAGE": "xx"}),
    "ascii": Place({"PYTHONIOENCODING": "ascii"}),
    "latin-1": Place({"PYTHONIOENCODING": "latin-1"}),
    "no input": Place(closed=(0,)),
    "no output": Place(closed=(1,)),
    "no errors": Place(closed=(2,)),
    "no streams": Place(closed=(0, 1, 2)),
    "no columns": Place({"COLUMNS": "0", "LINES": "0", "TERM": "dumb"}),
    "one column": Place({"COLUMNS": "1", "TERM": ""}),
    "a million columns": Place({"COLUMNS": "1000000", "FORCE_COLOR": "1"}),
    "words for columns": Place({"COLUMNS": "wide", "LINES": "-1", "TERM": "\x1b["}),
    "a notebook's figures": Place({"MPLBACKEND": "module://matplotlib_inline.backend_inline"}),
    "no figures": Place({"MPLBACKEND": "module://nowhere"}),
    "warnings are errors": Place({"PYTHONWARNINGS": "error", "PYTHONDEVMODE": "1"}),
    "optimized": Place({"PYTHONOPTIMIZE": "2"}),
}
# What differs in how a terminal shows texts alone, and what takes long to draw and says little: not both.
SCREENS = ("no input", "no columns", "one column", "a million columns", "words for columns", "ascii", "latin-1")
DRAWN = {"report", "page", "video"}
LOCALES = ("C", "a locale that is not installed")
QUICK = [
    *[("1 GB", name) for name in ("run", "report")],
    ("files of 30 kB", "report"),
    ("C", "report"),
    ("a locale that is not installed", "motion"),
    # A command that draws one figure.
    *[(around, "motion") for around in ("no home", "no figures")],
    *[(around, "run") for around in ("latin-1", "no output", "no streams", "no columns")],
]


def prepared(place: Path) -> Path:
    text = BLOCK.read_text(encoding="utf-8").replace("Block pushed once", "Stürzender Block 水壩 שלום")
    (place / "dam.toml").write_text(text, encoding="utf-8")
    (place / "record.txt").write_text(RECORD)
    (place / "study.toml").write_text('case = "dam.toml"\n[vary]\n"crack.friction" = [0.3, 0.5]\n')
    return place


def ended(name: str, around: Place, cwd: Path) -> subprocess.CompletedProcess[bytes]:
    """Run a command in a process of its own with this around it."""

    def enter() -> None:
        for kind, limit in around.limits:
            resource.setrlimit(kind, (limit, limit))
        for stream in around.closed:
            os.close(stream)

    environment = {} if around.empty else {**os.environ, "HEELTOE_RECORDS": ""}
    environment |= {key: value for key, value in around.set.items() if value is not None}
    for key, value in around.set.items():
        if value is None:
            environment.pop(key, None)
    return subprocess.run(
        [sys.executable, "-m", "heeltoe", *map(str, (COMMANDS | FURTHER)[name])],
        capture_output=True,
        stdin=subprocess.DEVNULL,
        cwd=cwd,
        env=environment,
        preexec_fn=enter,
        timeout=120,
        check=False,
    )


def judge(name: str, around: Place, cwd: Path) -> None:
    before = set(cwd.iterdir())
    run = ended(name, around, prepared(cwd))
    errors = run.stderr.decode(errors="replace")
    assert run.returncode in (0, 2, 3), errors
    assert "Traceback" not in errors
    if run.returncode == 0:
        assert run.stdout or 1 in around.closed or 2 in around.closed, errors
    elif 2 not in around.closed:
        # How long a command takes may stand before its error.
        own = [line for line in errors.splitlines() if line.startswith("heeltoe: ")]
        lines = [line for line in own if "Ctrl-C ends it" not in line]
        assert len(lines) == 1, errors
        assert len(own) <= 2, errors
    left = [path.name for path in cwd.rglob(".heeltoe-*") if path.name != ".heeltoe-files"]
    assert not left, left
    # Files come before what is said of them.
    if run.returncode == 2 and 1 not in around.closed:
        assert {path.name for path in cwd.iterdir()} - {path.name for path in before} <= {
            "dam.toml",
            "record.txt",
            "study.toml",
        }


@pytest.mark.slow
@pytest.mark.parametrize(("around", "name"), QUICK)
def test_where_a_command_runs(around, name, tmp_path):
    judge(name, PLACES[around], tmp_path)


@pytest.mark.product
@pytest.mark.parametrize("around", PLACES)
def test_where_every_command_runs(around, tmp_path):
    further = FURTHER if around in LOCALES else {}
    for name in COMMANDS | further if around not in SCREENS else COMMANDS.keys() - DRAWN:
        (tmp_path / name).mkdir()
        judge(name, PLACES[around], tmp_path / name)


@pytest.fixture
def small(tmp_path) -> Iterator[Path]:
    """A disk of 64 kB."""
    place = tmp_path / "small"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(place)]
    if (
        os.geteuid()
        or not Path("/bin/mount").exists()
        or subprocess.run(mount, capture_output=True, check=False).returncode
    ):
        pytest.skip("a small disk needs an administrator who may mount one")
    yield place
    subprocess.run(["umount", str(place)], check=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["report", pytest.param("video", marks=pytest.mark.product)])
def test_a_full_disk_for_temporary_files(name, small, tmp_path):
    (small / "full").write_bytes(bytes(60_000))
    (tmp_path / "here").mkdir()
    run = ended(name, Place({"TMPDIR": str(small)}), prepared(tmp_path / "here"))
    assert b"Traceback" not in run.stderr
    assert run.returncode == (2 if name == "report" else 0), run.stderr
    assert name != "report" or b"set TMPDIR" in run.stderr


@pytest.mark.slow
@pytest.mark.parametrize("name", ["report", *(pytest.param(name, marks=pytest.mark.product) for name in COMMANDS)])
def test_a_full_disk(name, small):
    (small / "full").write_bytes(bytes(30_000))
    judge(name, PLACES["read-only home"], small)
