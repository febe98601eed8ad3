"""The command that writes a dam for another program."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from heeltoe.base.atomic_files import check_directory
from heeltoe.cli.common import CasePath, Changes, OtherMotion, OtherPeak, motion_changes, say_cost, say_file, status
from heeltoe.cli.streams import console


def export(
    case: CasePath,
    to: Annotated[str, typer.Option("--to", metavar="opensees|calculix|gmsh", help="Program to write for.")],
    out: Annotated[Path, typer.Option(metavar="DIR", help="Write the files here.")],
    set_: Changes = None,
    motion: OtherMotion = None,
    pga: OtherPeak = None,
) -> None:
    """Write the elastic dam with its loads, cracks and motion for OpenSees, CalculiX or Gmsh.

    The files say at their top how the dam in them differs from the case.
    """
    from heeltoe.case.read import read_case
    from heeltoe.models.flexible.body.cost import building, parts_of
    from heeltoe.models.flexible.deck import build_deck
    from heeltoe.models.run import earthquake
    from heeltoe.views.files.programs.write import files_for, write_program

    own = files_for(to)
    loaded = read_case(case, [*(set_ or []), *motion_changes(motion, pga=pga)])
    check_directory(out, "--out", own)
    say_cost(building(parts_of(loaded.on_rigid_plane())))
    with status() as say:
        say("building the elastic parts")
        deck = build_deck(loaded, None if loaded.motion is None else earthquake(loaded))
    written = write_program(deck, to, out)
    words = console()
    for note in deck.notes:
        words.print(note, soft_wrap=True, markup=False)
    for path in written:
        say_file("wrote", path, words)
