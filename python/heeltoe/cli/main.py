"""The command line. Results go to standard output, everything for people beside a result to standard error."""

from __future__ import annotations

import atexit
import gc
import os
import sys
from functools import cache
from importlib import import_module
from typing import Annotated, Never

import typer

from heeltoe.base.heap import share_heaps
from heeltoe.cli.common import BAD_INPUT, BUG, INTERRUPTED, NO_RESULT, Commands
from heeltoe.cli.streams import end_if_deaf, streams
from heeltoe.errors.error import InputError, UnfinishedError
from heeltoe.errors.sanitize import plain

_OBJECTS_BEFORE_COLLECTING = 200_000
#: Modules of the commands, in the order of the help.
_MODULES = {
    "run": "run",
    "solve": "solve",
    "periods": "dam",
    "overturning": "dam",
    "law": "law",
    "statics": "statics",
    "animate": "dam",
    "export": "export",
    "motion": "motion",
    "study": "study",
    "app": "app",
    "explain": "explain",
    "new": "start",
    "examples": "start",
}
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
            program(*sys.argv[1:2])()
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


def _options(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    share_heaps()
    # Runs and meshes have threads of their own, beside which those of small matrices keep a core busy with waiting.
    # Heard when NumPy is loaded, here and in the processes beside.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # The app looks after Ctrl-C itself.
    if context.invoked_subcommand != "app":
        end_if_deaf()


@cache
def program(name: str = "") -> typer.Typer:
    """Return the command line with all commands, or with the one of this name alone: building 14 of them takes a tenth
    of a short run."""
    app = typer.Typer(
        cls=Commands,
        name="heeltoe",
        help="Compute the response of cracked concrete gravity dams to earthquakes.",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        add_completion=False,
        rich_markup_mode=None,
    )
    app.callback()(_options)
    for command in [name] if name in _MODULES else _MODULES:
        module = import_module(f"heeltoe.cli.{_MODULES[command]}")
        function = getattr(module, command)
        # The whole first sentence: a cut one says nothing.
        sentence = first_sentence(function.__doc__ or "")
        app.command(cls=module.Run if command == "run" else None, short_help=sentence)(function)
    return app
