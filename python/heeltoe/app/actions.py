"""What a tab can ask for, by name. A new page adds its module to this list."""

from __future__ import annotations

from heeltoe.app import answer, checks, open_case
from heeltoe.app.case import actions as case
from heeltoe.app.desk import Entry
from heeltoe.app.export import actions as export
from heeltoe.app.motion import actions as motion
from heeltoe.app.studies import actions as studies


def actions() -> dict[str, Entry]:
    """Return all of them."""
    entries: dict[str, Entry] = {}
    for module in (open_case, case, motion, answer, checks, studies, export):
        entries |= module.ACTIONS
    return entries
