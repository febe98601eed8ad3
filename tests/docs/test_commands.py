"""Every command in the documentation can be typed as it stands."""

from __future__ import annotations

import shlex
from itertools import pairwise
from pathlib import Path

import pytest
import typer

from heeltoe import read_case
from heeltoe.cli.main import program
from shared.command import command
from shared.dams import KOYNA, ROOT
from shared.pages import PAGES, command_lines, spans

LINES = command_lines()
COMMANDS = typer.main.get_command(program()).commands
COARSE = ("--set", "flexible.elements_across=3", "--set", "flexible.evidence=none")
# What is added so that a command does not take long: an option given twice has its last value.
QUICK = {
    "run": (*COARSE, "--duration", "1s"),
    "statics": (*COARSE, "--set", "motion.duration=1s"),
    "animate": (*COARSE, "--set", "motion.duration=9s", "--fps", "1"),
    "periods": COARSE,
    "overturning": ("--count", "4"),
    "study": ("--dry-run",),
    "solve": (*COARSE, "--set", "motion.duration=1s", "--model", "rigid"),
    "export": (*COARSE, "--set", "motion.duration=1s"),
}
RECORD = """PEER NGA STRONG MOTION DATABASE RECORD
Somewhere, 1/1/2000, Station, 0
ACCELERATION TIME SERIES IN UNITS OF G
NPTS=    8, DT=   .0500 SEC
  .0E+00  .1E+00  .2E+00 -.1E+00 -.2E+00
  .1E+00  .0E+00  .0E+00
"""


@pytest.fixture(scope="module")
def place(tmp_path_factory) -> Path:
    """A directory as a user has it who follows the pages."""
    directory = tmp_path_factory.mktemp("docs")
    (directory / "examples").symlink_to(ROOT / "examples")
    (directory / "my-record.AT2").write_text(RECORD)
    (directory / "TESTS.csv").write_text("normal stress [MPa],peak shear [MPa]\n0.5,0.6\n1,1.1\n1.5,1.4\n2,1.9\n")
    (directory / "records").mkdir()
    (directory / "records" / "my-record.AT2").write_text(RECORD)
    other = RECORD.replace("Station, 0", "Station, 90").replace(".1E+00", ".3E-01")
    (directory / "records" / "my-other-record.AT2").write_text(other)
    assert command("new", "mydam", cwd=directory).returncode == 0
    # What the pages say beside the commands: the decoupled chain needs a crack at a height.
    case = directory / "mydam.toml"
    text = case.read_text(encoding="utf-8")
    (directory / "high.toml").write_text(text.replace('elevation = "0 m"', 'elevation = "60 m"'), encoding="utf-8")
    return directory


def test_there_are_some():
    assert len(LINES) > 30
    assert {line.split()[1] for _, line in LINES} == set(COMMANDS)


def words(line: str) -> tuple[str, list[str]]:
    """Return command and arguments of a line as a shell takes it: to the comment, or to the pipe."""
    _, name, *arguments = shlex.split(line.partition(" | ")[0], comments=True)
    return name, arguments


def test_every_line_is_understood(place, monkeypatch):
    """Commands, options and their values: all that typer sees before a command begins."""
    monkeypatch.chdir(place)
    for page, line in LINES:
        name, arguments = words(line)
        try:
            COMMANDS[name].make_context(name, [argument.replace("FILE", "my-record.AT2") for argument in arguments])
        except typer.Exit:
            pass
        except Exception as error:
            raise AssertionError(f"{page}: {line}") from error


#: The first line of each command; all others are run by the slow part.
FIRST = {words(line)[0]: line for _, line in reversed(LINES)}.values()


@pytest.mark.usefixtures("no_figures")
@pytest.mark.parametrize(
    "line",
    [pytest.param(line, id=page, marks=[] if line in FIRST else pytest.mark.slow) for page, line in LINES],
)
def test_a_line_can_be_typed(line, place, request):
    if "taft" in line:
        request.getfixturevalue("records")
    name, arguments = words(line)
    if name == "app":
        return  # it serves until it is ended, which tests/app sees
    if name in ("new", "examples"):
        arguments = [f"another-{len(list(place.iterdir()))}"]
    if "decoupled" in arguments:
        arguments = [argument.replace("mydam", "high") for argument in arguments]
    arguments = [argument.replace("FILE", "my-record.AT2") for argument in arguments]
    if "examples/aftershocks.toml" in arguments:
        # The motions after the first one have durations of their own.
        arguments += [f"--set=aftershocks[{place}].duration=1s" for place in (0, 1)]
    # The records of a suite have the length that they have.
    quick = COARSE if "--motions" in arguments else QUICK.get(name, ())
    process = command(name, *arguments, *quick, cwd=place)
    # In so short an earthquake the limit may be met in the whole range.
    assert process.returncode in ((0, 3) if name == "solve" else (0,)), process.stderr


def test_commands_and_options_in_passing_are_there():
    options = {option for item in COMMANDS.values() for parameter in item.params for option in parameter.opts}
    for page in PAGES:
        for span in spans(page):
            if span.startswith("heeltoe "):
                _, name, *arguments = shlex.split(span)
                if name == "--version":
                    continue
                assert name in COMMANDS, (page, span)
                known = {option for parameter in COMMANDS[name].params for option in parameter.opts}
            elif span.startswith("--") and page != "CONTRIBUTING.md":
                arguments, known = shlex.split(span), options
            else:
                continue
            assert {argument for argument in arguments if argument.startswith("--")} <= known, (page, span)
            for option, value in pairwise(arguments):
                if option == "--set" and "..." not in value:
                    read_case(KOYNA, [value])
                if option == "--model":
                    assert set(value.split(",")) <= {"auto", "rigid", "flexible", "decoupled", "both"}, (page, span)
