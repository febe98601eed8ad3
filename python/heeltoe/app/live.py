"""The answer while a slider moves: both blocks, each as soon as it is there."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import Any

from heeltoe.app.response_payload import dam, drawn
from heeltoe.base.cache import Kept
from heeltoe.case.combinations import UNSUPPORTED
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.models.run import cost_of, earthquake, live
from heeltoe.models.statics.after import slip_source
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.comparison import meaning

_KEPT: Kept[Earthquake] = Kept(16)


def answer(case: Case, changes: Mapping[str, Any], model: str, units: str) -> dict[str, Any]:
    """Return what a block does, or why it cannot be said."""
    began = perf_counter()
    try:
        changed = case.with_(changes) if changes else case
        if model == "decoupled" and changed.crack.elevation == 0.0 and not changed.further_cracks:
            return {"absent": "The decoupled chain needs a part below the crack; this crack is at the base."}
        if model == "decoupled" and changed.concrete.modulus is None and not changed.further_cracks:
            return {"absent": "The decoupled chain needs the concrete's modulus; this case does not give it."}
        response = live(changed, model, _earthquake(changed))
    except InputError as error:
        if error.code != UNSUPPORTED:
            return refused(error)
        return {"absent": f"{error.problem[:1].upper()}{error.problem[1:]}; run the elastic dam with its button."}
    return drawn(response, units) | {"dam": dam(changed, response), "computed_s": perf_counter() - began}


def _earthquake(case: Case) -> Earthquake:
    """Return what shakes a case: the very same where it is as before, so that what is kept of it is found."""
    shaking = earthquake(case)
    key = tuple(
        motion
        and (motion.name, motion.time.tobytes(), motion.acceleration.tobytes(), motion.processing, motion.warnings)
        for motion in (shaking.motion, shaking.vertical)
    )
    return _KEPT.get((key, shaking.end), lambda: shaking)


def refused(error: InputError) -> dict[str, Any]:
    """Return an error as the page shows it, at its field."""
    return {"error": {"field": error.field, "text": str(error), "problem": error.problem, "remedy": error.remedy}}


def flexible(say: Callable[[str], None], case: Case, changes: Mapping[str, Any], units: str) -> dict[str, Any]:
    """Return what the elastic dam does, and what the block beside it means; it takes seconds to minutes."""
    from heeltoe.models.run import AUTO, run

    changed = case.with_(changes) if changes else case
    cost = cost_of(changed, "flexible")
    say("running the flexible model" + ("" if cost is None else f", about {max(1.0, cost.seconds):.0f} s"))
    response = run(changed, AUTO)
    beside = "" if response.beside is None else meaning(response, response.beside, units)
    # What the static checks go on from.
    known = response.outcome == "ok"
    slips = {
        "case": changed.model_dump_json(),
        "source": slip_source(response),
        "slips_m": {f"{crack.elevation:g}": crack.residual_slip_m for crack in response.cracks} if known else {},
    }
    return drawn(response, units) | {"dam": dam(changed, response), "beside": beside, "left": slips}
