"""Actions of the page "Export": the commands that do the same, the case file, and files made on request."""

from __future__ import annotations

import shutil
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any

from heeltoe.app.answer import start
from heeltoe.app.desk import BadRequestError, Desk, Entry, Request, text
from heeltoe.app.sessions import Session
from heeltoe.app.transfers import offer
from heeltoe.base.payload import Json

_NUMBERS = count(1)
_MADE = "export"
_ALONE = ("rigid", "decoupled", "flexible")


async def look(desk: Desk, request: Request) -> Json:
    """Return the command and program that do the same, and whether the files are of the present case."""
    from heeltoe.app.case.draft import case_of
    from heeltoe.app.export.work import RUNS, command, program, wanted_of
    from heeltoe.app.open_case import models_for

    session = desk.session
    case = await desk.workers.quick(case_of, session)
    known = () if case is None else models_for(case)["models"]
    options = wanted_of({"model": RUNS[0], **request}, session.units, "si" if case is None else case.units)
    made = session.kept_files
    return {
        "of": "export",
        "command": command(options),
        "program": program(options),
        "models": list(RUNS),
        # Of two side by side, and of the one that fits, the run says itself why it cannot be.
        "cannot": [name for name in RUNS if name in _ALONE and name not in known],
        "ready": case is not None and case.motion is not None,
        "same": made is not None and made[1] == _state(case),
    }


async def make(desk: Desk, request: Request) -> Json:
    """Begin to make the files; what was made before goes."""
    from heeltoe.app.case.draft import case_of, fields_in_force
    from heeltoe.app.case.files import lay_out, sent_files
    from heeltoe.app.export.work import make as work
    from heeltoe.app.export.work import wanted_of

    session = desk.session
    case = await desk.workers.quick(case_of, session)
    if case is None:
        raise BadRequestError("there is no case")
    options = wanted_of(request, session.units, case.units)
    folder = session.folder / f"export-{next(_NUMBERS)}"
    await desk.workers.quick(lay_out, fields_in_force(session), sent_files(session), folder)
    message = start(desk, _MADE, work, folder, options, unless_done=folder)
    if message["of"] != "job":
        return message
    before, session.kept_files = session.kept_files, (folder, _state(case))
    for job in [job for job in session.jobs.values() if job.what == _MADE and job.number != message["number"]]:
        job.cancel()
        del session.jobs[job.number]
    if before is not None:
        await desk.workers.quick(partial(shutil.rmtree, ignore_errors=True), before[0])
    return message


async def fetch(desk: Desk, request: Request) -> Json:
    """Return where a file can be fetched: one of those that were made, by its name among them, or all."""
    from heeltoe.app.export.work import OUT, ZIP, listed

    made, name = desk.session.kept_files, text(request, "name")
    if made is None:
        raise BadRequestError("nothing was made")
    folder = made[0]
    if name == "":
        return offer(desk.session, folder / ZIP, ZIP)
    if name not in [entry["name"] for entry in await desk.workers.quick(listed, folder)]:
        raise BadRequestError("there is no such file")
    return offer(desk.session, folder / OUT / name, name.replace("/", "-"))


async def case(desk: Desk, request: Request) -> Json:
    """Return where the case file can be fetched, in one file with the files that it names if there are any."""
    name, path = await desk.workers.quick(_case_file, desk.session)
    return offer(desk.session, path, name)


def _case_file(session: Session) -> tuple[str, Path]:
    from heeltoe.app.case.draft import fields_in_force
    from heeltoe.app.case.files import CASE, lay_out, sent_files, zipped

    links = [offer.path for offer in session.offers.values()]
    for before in session.folder.glob("case-*"):
        # One that the browser has not asked for yet stays.
        if not any(path.is_relative_to(before) for path in links):
            shutil.rmtree(before, ignore_errors=True)
    folder = session.folder / f"case-{next(_NUMBERS)}" / "case"
    lay_out(fields_in_force(session), sent_files(session), folder)
    if len(list(folder.iterdir())) == 1:
        return CASE, folder / CASE
    return "case.zip", zipped(folder, folder.parent / "case.zip")


def _state(case: Any) -> str:
    return "" if case is None else str(case.model_dump_json())


ACTIONS = {
    "export": Entry(look, newest=True),
    "make": Entry(make, writes=True),
    "fetch": Entry(fetch),
    "case file": Entry(case, writes=True),
}
