"""The command line. Results go to standard output, everything for people beside a result to standard error."""

from __future__ import annotations

import atexit
import gc
import os
import sys
from pathlib import Path
from typing import Annotated, Never

import typer

from heeltoe.base.atomic_files import check_directory, write_text, write_whole
from heeltoe.base.heap import share_heaps
from heeltoe.cli import app as app_command
from heeltoe.cli import dam as dam_commands
from heeltoe.cli import explain as explain_command
from heeltoe.cli import export as export_command
from heeltoe.cli import law as law_command
from heeltoe.cli import motion as motion_command
from heeltoe.cli import run as run_command
from heeltoe.cli import solve as solve_command
from heeltoe.cli import statics as statics_command
from heeltoe.cli import study as study_command
from heeltoe.cli.common import BAD_INPUT, BUG, INTERRUPTED, LONGEST_PATH, NO_RESULT, app
from heeltoe.cli.streams import end_if_deaf, streams
from heeltoe.errors.error import InputError, UnfinishedError, shown
from heeltoe.errors.sanitize import plain

_OBJECTS_BEFORE_COLLECTING = 200_000
# What a panic of the kernel is raised as; named, so that nothing is loaded for it.
_PANICS = ("InternalError", "PanicException")


def main() -> None:
    """Run the command line; input that cannot be used ends with one line and exit code 2."""
    # Figures are made of many small objects that live until the end: looking for rubbish among them as often as Python
    # does by default takes a fifth of the time of a report.
    gc.set_threshold(_OBJECTS_BEFORE_COLLECTING)
    # Nor does Python look among all that is left when it ends, which takes a tenth of a second.
    atexit.register(gc.freeze)
    # No window opens here, whatever a notebook that calls has chosen for itself.
    os.environ["MPLBACKEND"] = "agg"
    # No plugin of pydantic has a say in how a case is read; looking for one opens a file of every package there is.
    os.environ["PYDANTIC_DISABLE_PLUGINS"] = "1"
    # Tables of Arrow lie in the same heap as all else; its own keeps what was freed.
    os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")
    try:
        with streams():
            app()
    except InputError as error:
        for problem in (error, *error.others):
            print(f"heeltoe: {problem}", file=sys.stderr)
        sys.exit(NO_RESULT if isinstance(error, UnfinishedError) else BAD_INPUT)
    except MemoryError:
        _no_memory()
    except ImportError as error:
        # What the loader says where a library does not fit.
        if "failed to map" not in str(error) and "cannot allocate memory" not in str(error).lower():
            raise
        _no_memory()
    except SystemExit as ended:
        if ended.code == INTERRUPTED:
            print("; ".join(["heeltoe: interrupted", *_known(ended)]), file=sys.stderr)
        raise
    except BaseException as error:
        if type(error).__name__ not in _PANICS:
            raise
        remedy = "please report it with the command and its files"
        print(f"heeltoe: this is a bug of its kernel: {plain(error)}; {remedy}", file=sys.stderr)
        sys.exit(BUG)


def _no_memory() -> Never:
    print("heeltoe: not enough memory; provide more memory, or request a smaller run", file=sys.stderr)
    sys.exit(NO_RESULT)


def _known(ended: BaseException) -> list[str]:
    """Return what the kernels have noted on the interruption that ended a command."""
    cause = ended.__cause__ or ended.__context__
    return [*getattr(ended, "__notes__", ()), *(_known(cause) if cause else ())]


def first_sentence(text: str) -> str:
    """Return the first paragraph of a docstring on one line."""
    return " ".join(text.strip().partition("\n\n")[0].split())


def _version(shown: bool) -> None:
    if shown:
        from heeltoe.kernel.build import build_info

        print(" ".join(f"{name} {version}" for name, version in build_info().items()))
        raise typer.Exit


@app.callback()
def _options(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    share_heaps()
    # The app looks after Ctrl-C itself.
    if context.invoked_subcommand != "app":
        end_if_deaf()


def new(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the case; NAME.toml is written.")],
    all_: Annotated[bool, typer.Option("--all", help="Show every field, as comments where it is not set.")] = False,
    from_: Annotated[
        Path | None, typer.Option("--from", metavar="OLD.toml", help="Rewrite this case with today's fields.")
    ] = None,
) -> None:
    """Write a case file to start from."""
    from heeltoe.case.template import new_case_text

    if all_ and from_ is not None:
        raise InputError("fields-conflict", "--all", other="--from")
    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    if os.path.lexists(path):
        raise InputError("file-exists", str(path))
    text = new_case_text(path.stem, every_field=all_) if from_ is None else _rewritten(from_, path)
    write_text(path, text)
    written = plain(path, LONGEST_PATH)
    print(f"wrote {written}; run it with: heeltoe run {written}")


def _rewritten(old: Path, path: Path) -> str:
    """Return the text of a case in today's fields; `path` is where it will stand."""
    from heeltoe.case.fields_file import read_fields
    from heeltoe.case.read import read_case
    from heeltoe.case.toml_writer import case_text

    read_case(old)
    if path.parent.resolve() != old.parent.resolve():
        # Motions, meshes and drawings are relative to the case.
        raise InputError("contradiction", "NAME", shown(str(path)), other="--from, a case of another folder")
    return case_text(read_fields(old))


def examples(
    directory: Annotated[
        Path, typer.Argument(metavar="DIR", show_default=False, help="New directory to write into (default: examples).")
    ] = Path("examples"),
    list_: Annotated[bool, typer.Option("--list", help="List them with a line each, and write nothing.")] = False,
) -> None:
    """Write example cases and studies to start from."""
    from heeltoe.case.examples import copy_examples, list_examples

    if list_:
        for name, line in list_examples():
            print(f"{name}\n    {line}")
        return
    if os.path.lexists(directory):
        raise InputError("file-exists", str(directory))
    check_directory(directory, "DIR")
    written = write_whole(copy_examples, directory, (), field="DIR")
    print(f"wrote {len(written)} cases and studies into {plain(directory, LONGEST_PATH)}")


# In the order of the help.
app.command(cls=run_command.Run, short_help=first_sentence(run_command.run.__doc__ or ""))(run_command.run)
for command in (
    solve_command.solve,
    dam_commands.periods,
    dam_commands.overturning,
    law_command.law,
    statics_command.statics,
    dam_commands.animate,
    export_command.export,
    motion_command.motion,
    study_command.study,
    app_command.app,
    explain_command.explain,
    new,
    examples,
):
    # The whole first sentence: what is cut off says nothing.
    app.command(short_help=first_sentence(command.__doc__ or ""))(command)
