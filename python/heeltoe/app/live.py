"""The answer while a slider moves: both blocks, each as soon as it is there."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import Any

from heeltoe.app.dam import dam
from heeltoe.app.drawn import drawn
from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.kept import Kept
from heeltoe.models.run import cost_of, earthquake, live
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.beside import meaning

#: What blocks do not know and the elastic dam may, by the codes of errors.
_BESIDE = (
    "This model does not know the {field} of this case beside further cracks: run the elastic dam with its button."
)
ABSENT = {
    "kinks-straight": "This model knows straight cracks alone: run the elastic dam with its button.",
    "several-cracks": "This model knows one crack alone, since what is above one of several is no single block: run "
    "the elastic dam with its button.",
    "two-cracks-most": "This model knows two cracks at most: run the elastic dam with its button.",
    "one-crack-only": _BESIDE,
    "one-crack-value": _BESIDE,
}
_KEPT: Kept[Earthquake] = Kept(16)


def answer(case: Case, changes: Mapping[str, Any], model: str, units: str) -> dict[str, Any]:
    """Return what a block does, or why it cannot be said."""
    began = perf_counter()
    try:
        changed = case.with_(changes) if changes else case
        if model == "decoupled" and changed.crack.elevation == 0.0 and not changed.further_cracks:
            return {"absent": "The decoupled chain needs something below the crack: this one is at the base."}
        if model == "decoupled" and changed.concrete.modulus is None and not changed.further_cracks:
            return {"absent": "The decoupled chain needs the concrete's modulus, which this case does not give."}
        found = live(changed, model, _earthquake(changed))
    except InputError as error:
        absent = ABSENT.get(error.code)
        return refused(error) if absent is None else {"absent": absent.format(field=error.field)}
    return drawn(found, units) | {"dam": dam(changed, found), "computed_s": perf_counter() - began}


def _earthquake(case: Case) -> Earthquake:
    """Return what shakes a case: the very same where it is as before, so that what is kept of it is found."""
    found = earthquake(case)
    key = tuple(
        each and (each.name, each.time.tobytes(), each.acceleration.tobytes(), each.processing, each.warnings)
        for each in (found.motion, found.vertical)
    )
    return _KEPT.get((key, found.end), lambda: found)


def refused(error: InputError) -> dict[str, Any]:
    """Return an error as the page shows it, at its field."""
    return {"error": {"field": error.field, "text": str(error), "problem": error.problem, "remedy": error.remedy}}


def flexible(say: Callable[[str], None], case: Case, changes: Mapping[str, Any], units: str) -> dict[str, Any]:
    """Return what the elastic dam does, and what the block beside it means; it takes seconds to minutes."""
    from heeltoe.models.run import AUTO, run

    changed = case.with_(changes) if changes else case
    cost = cost_of(changed, "flexible")
    say("running the flexible model" + ("" if cost is None else f", about {max(1.0, cost.seconds):.0f} s"))
    found = run(changed, AUTO)
    beside = "" if found.beside is None else meaning(found, found.beside, units)
    return drawn(found, units) | {"dam": dam(changed, found), "beside": beside}
