"""The common part of all commands: the program, its options, the output."""

from __future__ import annotations

import json
import os
import shlex
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from heeltoe.base.atomic_files import check_file, write_text
from heeltoe.cli.streams import console, print_data
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain
from heeltoe.result.outcome import NO_RESULT as NO_RESULT
from heeltoe.units.systems import unit_system

if TYPE_CHECKING:
    from rich.console import Console

    from heeltoe.case.model import Case
    from heeltoe.models.cost import Cost
    from heeltoe.study.run.run import Progress as StudyProgress

# Typer shows this class of its click by its heirs alone.
_UsageError: Any = typer.BadParameter.__mro__[1]


# Several of these look like a list; the last one would win silently.
_ONCE = ("--motion", "--pga", "--criteria", "--slip")


class Commands(TyperGroup):
    """The commands; options and arguments that cannot be used are refused in one line as all other input is."""

    def make_context(self, info_name: str | None, args: list[str], *more: Any, **extra: Any) -> Any:
        with _refused():
            return super().make_context(info_name, args, *more, **extra)

    def invoke(self, ctx: Any) -> Any:
        with _refused():
            return super().invoke(ctx)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        name, command, rest = super().resolve_command(ctx, args)
        for option in _ONCE:
            count = sum(argument.partition("=")[0] == option for argument in rest)
            if count > 1:
                raise InputError("option-repeated", option, count)
        return name, command, rest


@contextmanager
def _refused() -> Iterator[None]:
    try:
        yield
    except _UsageError as error:
        if type(error).show is not _UsageError.show:  # no arguments at all: shows the help
            raise
        path = str(error.ctx.command_path) if error.ctx else "heeltoe"
        where = path.partition(" ")[2] or "command line"
        raise InputError("usage", where, error.format_message().rstrip("."), command=path) from None


BUG = 1
BAD_INPUT = 2
INTERRUPTED = 130
LONGEST_PATH = 5000
# Runs that take longer say so before they start [s].
_A_WAIT = 5.0

CasePath = Annotated[str, typer.Argument(metavar="CASE.toml", help="The case file (TOML or JSON).")]
Changes = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Set a field of the case, e.g. crack.friction=1.0, units=us or motion.duration=30s; none removes an "
        "optional field.",
    ),
]
JsonPath = Annotated[str | None, typer.Option("--json", metavar="FILE|-", help="Write the result as JSON.")]
Workbook = Annotated[
    bool, typer.Option("--xlsx", help="Write the tables as a workbook for spreadsheets, with units, into --out.")
]
MotionSource = Annotated[
    str | None, typer.Option(metavar="FILE-or-NAME", help="Ground motion to use instead of that of the case.")
]
Peak = Annotated[str | None, typer.Option(metavar="0.4g", help="Scale the motion to this peak.")]
Details = Annotated[bool, typer.Option("--details", help="Print all results, not only the most important ones.")]
UnitsName = Annotated[
    str, typer.Option("--units", metavar="si|us", help="Units of text and figures; JSON and tables stay SI.")
]

# Options whose field of the case says the same with --set; they are read, and left out of the help.
OtherUnits = Annotated[str | None, typer.Option("--units", hidden=True, help="--set units=us")]
OtherMotion = Annotated[str | None, typer.Option("--motion", hidden=True, help="--set motion.file=FILE")]
OtherPeak = Annotated[str | None, typer.Option("--pga", hidden=True, help="--set motion.pga=0.4g")]


def units_of(case: Case, option: str | None) -> str:
    """Return the units in which a case is shown: those of the option, else its own."""
    return case.units if option is None else unit_system(option, "--units").name


def check_units(option: str | None) -> None:
    """Refuse units that there are none of, before anything is computed."""
    if option is not None:
        unit_system(option, "--units")


def command_line() -> str:
    """Return what was typed, for people who want to type it again."""
    return shlex.join(["heeltoe", *sys.argv[1:]])


def resolved_path(motion: str) -> str:
    """A path on the command line is relative to where the user stands, not to the case file."""
    path = Path(os.path.expanduser(motion))  # unlike that of paths, it leaves no one's home as it is
    return str(path.resolve()) if os.path.isfile(path) else motion


def motion_changes(motion: str | None, **fields: str | None) -> list[str]:
    """Return the changes of a case that the options of its motion make."""
    options = {"file": motion and json.dumps(resolved_path(motion)), **fields}
    return [f"motion.{name}={value}" for name, value in options.items() if value is not None]


def refuse(options: Mapping[str, object], owner: str, remedy: str) -> None:
    """Refuse the first of some options that is there, as it does not belong to `owner`."""
    for option, value in options.items():
        if value:
            raise InputError("option-foreign", option, owner=owner, remedy=remedy)


def check_written(out: Path | None, *, report: bool, xlsx: bool, others: Mapping[str, bool]) -> None:
    """Refuse a report or a workbook that cannot be made, and what of a workbook and `others` has nowhere to go."""
    if report:
        from heeltoe.views.report.write import check_packages

        check_packages()
    if xlsx:
        from heeltoe.views.files.workbook import check_workbook

        check_workbook()
    for option, ticked in {"--xlsx": xlsx, **others}.items():
        if ticked and out is None and not report:
            raise InputError("needs-other", option, other="--out or --report")


def removed_files(place: Path | None, earlier: Sequence[str]) -> list[Path]:
    """Return which of the files of an earlier run are gone."""
    return [] if place is None else [place / name for name in earlier if not (place / name).exists()]


def check_json(json_: str | None) -> None:
    """Refuse a place that JSON cannot be written to, before anything is computed or printed."""
    if json_ not in (None, "-"):
        check_file(str(json_), "--json")


def finish(
    data: Callable[[], dict[str, object]],
    json_: str | None,
    written: list[Path],
    show: Callable[[Console], None],
    removed: Sequence[Path] = (),
) -> None:
    """Write JSON where it is wanted, show the result, say what was written and what of an earlier run is gone."""
    from heeltoe.result.write import json_text

    text = "" if json_ is None else json_text(data())
    if json_ not in (None, "-"):
        written = [*written, write_text(str(json_), text + "\n", "--json")]
    words = console(stderr=json_ == "-")
    show(words)
    say_files("wrote", written, words)
    say_files("removed", removed, words)
    if json_ == "-":
        print_data(text)


def say_files(done: str, paths: Sequence[Path], words: Console) -> None:
    """Say what was done to files: a file alone by its path, those of a folder by their kinds."""
    from rich.table import Table
    from rich.text import Text

    folders: dict[Path, list[Path]] = {}
    for path in paths:
        # There are as many of these as frames; the file that lists them is shown.
        if path.suffix != ".vtu":
            folders.setdefault(path.parent, []).append(path)
    for folder, files in folders.items():
        if len(files) == 1:
            say_file(done, files[0], words)
            continue
        say_file(done, folder, words)
        stems: dict[str, list[str]] = {}
        for path in files:
            stems.setdefault(path.stem, []).append(path.suffix[1:])
        kinds: dict[str, list[str]] = {}
        for stem, suffixes in stems.items():
            kinds.setdefault(", ".join(sorted(suffixes)), []).append(plain(stem, LONGEST_PATH))
        table = Table.grid(padding=(0, 2, 0, 0))
        for kind, names in kinds.items():
            table.add_row("   ", Text(kind), Text(", ".join(names)))
        words.print(table)


def say_file(done: str, path: Path, words: Console) -> None:
    """Say what was done to a file."""
    words.print(f"  {done} {plain(path, LONGEST_PATH)}", soft_wrap=True, markup=False)


def say_cost(cost: Cost | None) -> None:
    """Print the estimated cost of a long run; None if the run is refused."""
    from heeltoe.models.cost import A_WAIT

    if cost is not None and cost.seconds > A_WAIT:
        words = f"heeltoe: takes about {cost.shown()} of memory; Ctrl-C ends it"
        console(stderr=True).print(words, soft_wrap=True, markup=False)


@contextmanager
def status() -> Iterator[Callable[[str], None]]:
    """Show a line that says what goes on and for how long, on a terminal; elsewhere nothing."""
    if not sys.stderr.isatty():
        yield lambda text: None
        return
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Progress(*columns, console=console(stderr=True), transient=True) as bar:
        task = bar.add_task("reading")
        yield lambda text: bar.update(task, description=text)


@contextmanager
def study_bar() -> Iterator[Callable[[StudyProgress], None]]:
    """Show how far the study is, on a terminal; elsewhere nothing."""
    if not sys.stderr.isatty():
        yield lambda progress: None
        return
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    from heeltoe.views.terminal.study import progress_text

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Bar(*columns, console=console(stderr=True), transient=True) as bar:
        task = bar.add_task("running", total=None)

        def show_progress(progress: StudyProgress) -> None:
            bar.update(task, description=progress_text(progress), completed=progress.done, total=progress.of)

        yield show_progress
