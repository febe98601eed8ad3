"""What all commands have in common: the program, its options, where results go."""

from __future__ import annotations

import shlex
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from heeltoe.errors import InputError

app = typer.Typer(
    name="heeltoe",
    help="What a cracked concrete gravity dam does in an earthquake.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
    rich_markup_mode=None,
)

BAD_INPUT = 2
NO_RESULT = 3

CasePath = Annotated[str, typer.Argument(metavar="CASE.toml", help="The case file (TOML or JSON).")]
Changes = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="PATH=VALUE", help="Set any field of the case, e.g. crack.friction=1.0."),
]
JsonPath = Annotated[str | None, typer.Option("--json", metavar="FILE|-", help="Write the result as JSON.")]
UnitsName = Annotated[
    str, typer.Option("--units", metavar="si|us", help="Units of all that people read; files of numbers stay SI.")
]


def command_line() -> str:
    """Return what was typed, for people who want to type it again."""
    return shlex.join(["heeltoe", *sys.argv[1:]])


def as_given(motion: str) -> str:
    """A path on the command line is relative to where the user stands, not to the case file."""
    path = Path(motion).expanduser()
    return str(path.resolve()) if path.is_file() else motion


def check_directory(directory: Path) -> None:
    """Refuse a directory that cannot be made, before anything is computed or printed."""
    for place in (directory, *directory.absolute().parents):
        if place.is_dir():
            return
        if place.exists():
            raise InputError("not-a-directory", "--out", place)


def check_json(json_: str | None) -> None:
    """Refuse a place that JSON cannot be written to, before anything is computed or printed."""
    if json_ not in (None, "-") and not Path(str(json_)).absolute().parent.is_dir():
        raise InputError("no-directory", str(Path(str(json_)).parent))


def finish(data: dict[str, Any], json_: str | None, written: list[Path], show: Callable[[Console], None]) -> None:
    """Write JSON where it is wanted, show the result, say what was written."""
    from heeltoe.result.write import json_text

    text = json_text(data)
    if json_ not in (None, "-"):
        written = [*written, replace_file(Path(str(json_)), text + "\n")]
    console = Console(stderr=json_ == "-", highlight=False)
    show(console)
    for path in written:
        console.print(f"  wrote {path}", soft_wrap=True, markup=False)
    if json_ == "-":
        print(text)


@contextmanager
def status() -> Iterator[Callable[[str], None]]:
    """Show a line that says what goes on and for how long, on a terminal; elsewhere nothing."""
    if not sys.stderr.isatty():
        yield lambda text: None
        return
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("reading")
        yield lambda text: bar.update(task, description=text)


def replace_file(path: Path, text: str) -> Path:
    """Write a file whole or not at all."""
    try:
        with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, encoding="utf-8") as file:
            file.write(text)
        return Path(file.name).replace(path)
    except OSError as error:
        raise InputError("cannot-write", "file", path, reason=error.strerror or error) from None
