"""The answer while a slider moves: both blocks, each as soon as it is there."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import Any

from heeltoe.app.response_payload import dam, drawn
from heeltoe.base.cache import Kept
from heeltoe.base.payload import Json
from heeltoe.case.combinations import UNSUPPORTED
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.models.run import AUTO, cost_of, earthquake, live, models_of, run
from heeltoe.models.statics.after import ligament_of, slip_source
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.comparison import meaning
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.outcome import Outcome
from heeltoe.result.response import Response

#: What takes longer than this by its estimate [s] does not begin by itself.
LONGEST_S = 20.0
_KEPT: Kept[Earthquake] = Kept(16)


def answer(case: Case, changes: Mapping[str, Any], model: str, units: str) -> Json:
    """Return the result of a block, or the reason why there is no result."""
    began = perf_counter()
    try:
        changed = case.with_numbers(changes) if changes else case
        if model == "decoupled" and changed.crack.elevation == 0.0 and not changed.further_cracks:
            return {"absent": "The decoupled chain needs a part below the crack; this crack is at the base."}
        if model == "decoupled" and changed.concrete.modulus is None and not changed.further_cracks:
            return {"absent": "The decoupled chain needs the concrete's modulus; this case does not give it."}
        response = live(changed, model, _earthquake(changed))
    except InputError as error:
        if error.code != UNSUPPORTED:
            return refused(error)
        return {"absent": f"{error.problem[:1].upper()}{error.problem[1:]}; see the elastic dam."}
    return drawn(response, units) | {"dam": dam(changed, response, units), "computed_s": perf_counter() - began}


def _earthquake(case: Case) -> Earthquake:
    """Return what shakes a case: the very same where it is as before, so that what is kept of it is found."""
    shaking = earthquake(case)
    key = tuple(
        motion
        and (motion.name, motion.time.tobytes(), motion.acceleration.tobytes(), motion.processing, motion.warnings)
        for motion in (shaking.motion, shaking.vertical)
    )
    return _KEPT.get((key, shaking.end), lambda: shaking)


def refused(error: InputError) -> Json:
    """Return an error as the page shows it, at its field."""
    return {"error": {"field": error.field, "text": str(error), "problem": error.problem, "remedy": error.remedy}}


def elastic(case: Case, changes: Mapping[str, Any], units: str, longest_s: float = LONGEST_S) -> Json:
    """Return what the elastic dam does, without evidence, or why that is not computed by itself: it takes longer."""
    began = perf_counter()
    try:
        changed = (case.with_numbers(changes) if changes else case).without_evidence()
        names, why = models_of(changed)
        if "flexible" not in names:
            return {"absent": f"The elastic dam cannot be run: {why}."}
        cost = cost_of(changed, "flexible")
        if cost is not None and cost.seconds > longest_s:
            return {"waits": f"The elastic dam takes about {cost.seconds:.0f} s, and does not follow the sliders."}
        response = run(changed, "flexible")
    except InputError as error:
        return refused(error)
    return _elastic(changed, response, units) | {"computed_s": perf_counter() - began}


def flexible(say: Callable[[str], None], case: Case, changes: Mapping[str, Any], units: str) -> Json:
    """Return what the elastic dam does with its evidence, and what the block beside it means; it takes seconds to
    minutes."""
    changed = case.with_numbers(changes) if changes else case
    if changed.flexible.evidence == "none":
        # Without it, it has run by itself.
        changed = changed.model_copy(update={"flexible": changed.flexible.with_evidence("full")})
    cost = cost_of(changed, "flexible")
    say("running the flexible model" + ("" if cost is None else f", about {max(1.0, cost.seconds):.0f} s"))
    response = run(changed, AUTO)
    beside = "" if response.beside is None else meaning(response, response.beside, units)
    return _elastic(changed, response, units) | {"beside": beside}


def _elastic(case: Case, response: Response, units: str) -> Json:
    """Return what the page shows of an elastic dam, and what the static checks go on from."""
    known = response.outcome == Outcome.OK
    left = {
        "case": case.without_evidence().model_dump_json(),
        "source": slip_source(response),
        "slips_m": {f"{crack.elevation:g}": RESIDUAL_SLIP.of(crack) for crack in response.cracks} if known else {},
        "ligaments_m": {f"{crack.elevation:g}": ligament_of(crack) for crack in response.cracks} if known else {},
    }
    return drawn(response, units) | {"dam": dam(case, response, units), "left": left}
