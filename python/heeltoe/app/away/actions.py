"""Actions of what is taken away: the words that do the same, the case file, and files that are made when asked for."""

from __future__ import annotations

import shutil
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any

from heeltoe.app.actions import Asked, BadRequestError, Desk, Entry, text
from heeltoe.app.answer import start
from heeltoe.app.downloads import offer
from heeltoe.app.sessions import Session

_NUMBERS = count(1)
_MADE = "away"
_ALONE = ("rigid", "decoupled", "flexible")


async def look(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return the words that do the same elsewhere, and whether the files that were made are of the case as it is."""
    from heeltoe.app.away.lines import RUNS, command, program, wanted_of
    from heeltoe.app.case.draft import case_of
    from heeltoe.app.open_case import models_for

    session = desk.session
    case = await desk.workers.quick(case_of, session)
    known = () if case is None else models_for(case)["models"]
    wanted = wanted_of({"model": RUNS[0], **asked}, session.units, "si" if case is None else case.units)
    made = session.kept_files
    return {
        "of": "away",
        "command": command(wanted),
        "program": program(wanted),
        "models": list(RUNS),
        # Of two side by side, and of the one that fits, the run says itself why it cannot be.
        "cannot": [name for name in RUNS if name in _ALONE and name not in known],
        "ready": case is not None and case.motion is not None,
        "same": made is not None and made[1] == _state(case),
    }


async def make(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Begin to make the files; what was made before goes."""
    from heeltoe.app.away.lines import wanted_of
    from heeltoe.app.away.work import make as work
    from heeltoe.app.bundle import lay_out, sent_files
    from heeltoe.app.case.draft import case_of, fields_in_force

    session = desk.session
    case = await desk.workers.quick(case_of, session)
    if case is None:
        raise BadRequestError("there is no case")
    wanted = wanted_of(asked, session.units, case.units)
    folder = session.folder / f"away-{next(_NUMBERS)}"
    await desk.workers.quick(lay_out, fields_in_force(session), sent_files(session), folder)
    told = start(desk, _MADE, work, folder, wanted)
    if told["of"] != "job":
        await desk.workers.quick(partial(shutil.rmtree, ignore_errors=True), folder)
        return told
    before, session.kept_files = session.kept_files, (folder, _state(case))
    for job in [each for each in session.jobs.values() if each.what == _MADE and each.number != told["number"]]:
        job.cancel()
        del session.jobs[job.number]
    if before is not None:
        await desk.workers.quick(partial(shutil.rmtree, ignore_errors=True), before[0])
    return told


async def fetch(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return where a file can be fetched: one of those that were made, by its name among them, or all."""
    from heeltoe.app.away.lines import OUT
    from heeltoe.app.away.work import ZIP, listed

    made, name = desk.session.kept_files, text(asked, "name")
    if made is None:
        raise BadRequestError("nothing was made")
    folder = made[0]
    if name == "":
        return offer(desk.session, folder / ZIP, ZIP)
    if name not in [each["name"] for each in await desk.workers.quick(listed, folder)]:
        raise BadRequestError("there is no such file")
    return offer(desk.session, folder / OUT / name, name.replace("/", "-"))


async def case(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return where the case file can be fetched, in one file with the files that it names if there are any."""
    name, path = await desk.workers.quick(_case_file, desk.session)
    return offer(desk.session, path, name)


def _case_file(session: Session) -> tuple[str, Path]:
    from heeltoe.app.bundle import CASE, lay_out, sent_files, zipped
    from heeltoe.app.case.draft import fields_in_force

    folder = session.folder / f"case-{next(_NUMBERS)}" / "case"
    lay_out(fields_in_force(session), sent_files(session), folder)
    if len(list(folder.iterdir())) == 1:
        return CASE, folder / CASE
    return "case.zip", zipped(folder, folder.parent / "case.zip")


def _state(case: Any) -> str:
    return "" if case is None else str(case.model_dump_json())


ACTIONS = {
    "away": Entry(look, newest=True),
    "make": Entry(make),
    "fetch": Entry(fetch),
    "case file": Entry(case),
}
