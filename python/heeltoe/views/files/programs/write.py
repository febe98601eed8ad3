"""The files of a dam for another program, by the name of the program."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from heeltoe.base.atomic_files import write_whole
from heeltoe.errors.error import InputError, shown
from heeltoe.models.flexible.deck import Deck
from heeltoe.views.files.programs import calculix, gmsh, opensees

_WRITERS: dict[str, tuple[Callable[[Deck, Path], None], tuple[str, ...]]] = {
    "opensees": (opensees.write_opensees, opensees.FILES),
    "calculix": (calculix.write_calculix, calculix.FILES),
    "gmsh": (gmsh.write_gmsh, gmsh.FILES),
}
#: Programs that a dam is written for.
PROGRAMS = tuple(_WRITERS)


def files_for(program: str) -> tuple[str, ...]:
    """Return the names of the files that are written for a program.

    Raises
    ------
    InputError
        Where there is no such program among those.
    """
    if program not in _WRITERS:
        raise InputError("not-a-choice", "--to", shown(program), choices=", ".join(PROGRAMS))
    return _WRITERS[program][1]


def write_program(deck: Deck, program: str, directory: Path) -> list[Path]:
    """Write the files of a program, all of them or none, and return their paths; others in the directory stay.

    Raises
    ------
    InputError
        Where there is no such program, or the directory cannot be written.
    """
    own = files_for(program)
    return write_whole(lambda fresh: _WRITERS[program][0](deck, fresh), directory, own)
