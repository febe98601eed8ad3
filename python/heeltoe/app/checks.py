"""Actions beside the answer: the static checks of the same case, and how much its result hangs on the shaking."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from heeltoe.app.actions import Asked, BadRequestError, Desk, Entry
from heeltoe.app.answer import changes_of, start
from heeltoe.app.meant import meant
from heeltoe.case.model import Case

if TYPE_CHECKING:
    from heeltoe.models.statics.model import Statics

_MODELS = ("rigid", "decoupled", "flexible")


async def statics(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Judge the dam of the sliders by its criteria, before and after the earthquake."""
    session = desk.session
    changes = changes_of(session, asked.get("values"))
    return {"of": "statics", **await desk.workers.quick(checked, session.case, changes, session.units)}


async def spread(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Start the runs with a little weaker and a little stronger shaking."""
    session, model = desk.session, asked.get("model")
    if model not in _MODELS:
        raise BadRequestError("there is no such model")
    changes = changes_of(session, asked.get("values"))
    return start(desk, "spread", spread_of, session.case, changes, model, session.units)


def _judged(case: Case) -> Statics:
    """Return the static checks, with the slip of the rigid block where that knows the case."""
    from heeltoe.app.live import ABSENT
    from heeltoe.errors import InputError
    from heeltoe.models.run import earthquake, live
    from heeltoe.models.statics.after import statics_after
    from heeltoe.models.statics.model import statics as judge

    if case.motion is None:
        return judge(case)
    try:
        return statics_after(case, live(case, "rigid", earthquake(case)))
    except InputError as error:
        if error.code not in ABSENT:
            raise
        return judge(case)


def checked(case: Case, changes: Mapping[str, Any], units: str) -> dict[str, Any]:
    """Return the static checks, with the slip that the rigid block has in the earthquake."""
    from heeltoe.app.live import refused
    from heeltoe.errors import InputError
    from heeltoe.views.words.statics import basis, check_rows, failed, verdict_of

    try:
        changed = case.with_(changes) if changes else case
        found = _judged(changed)
    except InputError as error:
        return refused(error)
    return {
        "ok": found.ok,
        "verdict": verdict_of(found),
        "failed": failed(found, units),
        "basis": basis(found, units),
        "checks": check_rows(found),
        "warnings": [meant(each, units) for each in found.warnings],
    }


def spread_of(
    say: Callable[..., None], case: Case, changes: Mapping[str, Any], model: str, units: str
) -> dict[str, Any]:
    """Return the same run with weaker and stronger shaking, as a table."""
    from heeltoe.models.run import earthquake, flexible, live
    from heeltoe.study.spread import with_spread
    from heeltoe.views.words.spread import COLUMNS, spread_rows, spread_said

    changed = case.with_(changes) if changes else case
    say(f"running the {model} model")
    found = flexible(changed) if model == "flexible" else live(changed, model, earthquake(changed))
    if not found.summary:
        return {"model": model, "columns": COLUMNS, "rows": [], "said": found.outcome, "warnings": []}
    spread = with_spread(found, changed, progress=lambda done, of: say(f"{done} of {of} runs"))
    before = {meant(each, units) for each in found.warnings}
    warnings = [meant(each, units) for each in spread.warnings]
    return {
        "model": model,
        "columns": COLUMNS,
        "rows": spread_rows(spread, units),
        "said": spread_said(spread, units),
        "warnings": [each for each in warnings if each not in before],
    }


ACTIONS = {"statics": Entry(statics, newest=True), "spread": Entry(spread)}
