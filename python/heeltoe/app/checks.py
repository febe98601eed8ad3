"""Actions beside the answer: the static checks of the same case, how its crest answers the ground by frequency, and how
much its result depends on the shaking."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from heeltoe.app.answer import aside, changes_of, start
from heeltoe.app.desk import BadRequestError, Desk, Entry, Request, text
from heeltoe.app.wording import in_words_of_the_page, meant
from heeltoe.base.cache import Kept
from heeltoe.base.payload import Json
from heeltoe.case.model import Case

if TYPE_CHECKING:
    from heeltoe.models.flexible.surroundings.amplification import Amplification
    from heeltoe.models.statics.joints import Joints
    from heeltoe.models.statics.model import Statics

_MODELS = ("rigid", "decoupled", "flexible")
# What the response of a dam without a slip does not depend on, as far as sliders move it.
_NOT_IN_RESPONSE: Any = {
    "motion": True,
    "statics": True,
    "limits": True,
    "analysis": True,
    "uplift": True,
    "crack": {"friction", "restitution", "bond"},
}
# The page marks checks whose slip is not that of the elastic dam with the present sliders.
_BLOCK_SLIP = (
    "Provisional: the slip after the earthquake is that of the rigid block, until the elastic dam has run with the "
    "sliders as they stand."
)
_NO_SLIP = (
    "Provisional: no slip is taken after the earthquake, until the elastic dam has run with the sliders as they stand."
)
_RESPONSES: Kept[Amplification] = Kept(4)


async def statics(desk: Desk, request: Request) -> Json:
    """Judge the dam of the sliders by its criteria, before and after the earthquake, and by a response spectrum on
    request."""
    session = desk.session
    changes = changes_of(session, request.get("values"))
    left = [job.result["left"] for job in session.jobs.values() if job.result and "left" in job.result]
    if session.elastic is not None:
        # With evidence it is the better one.
        left.insert(0, session.elastic)
    spectrum = text(request, "spectrum").strip()
    if spectrum:
        return {"of": "statics", **await aside(desk, checked, session.case, changes, session.units, left, spectrum)}
    return {"of": "statics", **await desk.workers.quick(checked, session.case, changes, session.units, left)}


async def crest(desk: Desk, request: Request) -> Json:
    """Return how the crest of the dam of the sliders answers the ground by frequency."""
    session = desk.session
    changes = changes_of(session, request.get("values"))
    return {"of": "crest", **await aside(desk, crest_response, session.case, changes, session.units)}


async def spread(desk: Desk, request: Request) -> Json:
    """Start the runs with a little weaker and a little stronger shaking."""
    session, model = desk.session, request.get("model")
    if model not in _MODELS:
        raise BadRequestError("there is no such model")
    changes = changes_of(session, request.get("values"))
    return start(desk, "spread", spread_of, session.case, changes, model, session.units)


def _judged(case: Case, left: Sequence[Mapping[str, Any]]) -> tuple[Joints, str]:
    """Return the static checks at every section, with the slips of the elastic dam where that has been run as it is
    now, or else of the rigid block where that knows the case; and what makes their slip provisional, if anything."""
    from heeltoe.case.combinations import UNSUPPORTED
    from heeltoe.errors.error import InputError
    from heeltoe.models.run import earthquake, live, models_of
    from heeltoe.models.statics.after import joints_after
    from heeltoe.models.statics.joints import statics_of_sections
    from heeltoe.models.statics.model import statics as judge

    if case.motion is None:
        return statics_of_sections(case), ""
    awaited = case.statics.residual_slip is None and "flexible" in models_of(case)[0]
    now = case.without_evidence().model_dump_json()
    elastic = next((run for run in reversed(left) if run["case"] == now and run["slips_m"]), None)
    if elastic is not None and case.statics.residual_slip is None:

        def after(alone: Case, place: int | None) -> Statics:
            level = f"{alone.crack.elevation:g}"
            slip, held = elastic["slips_m"].get(level), elastic["ligaments_m"].get(level)
            if slip is None:
                return judge(alone)
            # A crack that holds has not slid.
            kept, ligament = (slip, None) if held is None else (0.0, (held[0], held[1]))
            return judge(alone, kept, slip_source=elastic["source"], ligament=ligament, beside=("flexible",))

        return statics_of_sections(case, after), ""
    try:
        response = live(case, "rigid", earthquake(case))
    except InputError as error:
        if error.code != UNSUPPORTED:
            raise
        beside = ("flexible",) if awaited else ()
        without = statics_of_sections(case, lambda alone, place: judge(alone, beside=beside))
        return without, _NO_SLIP if awaited else ""
    return joints_after(case, lambda: (response,)), _BLOCK_SLIP if awaited else ""


def checked(
    case: Case, changes: Mapping[str, Any], units: str, left: Sequence[Mapping[str, Any]] = (), spectrum: str = ""
) -> Json:
    """Return the static checks, after the slips that the earthquake leaves; `left` has those of elastic runs. With the
    name of a spectrum they have an earthquake by that, too; no file is looked for."""
    from heeltoe.app.live import refused
    from heeltoe.errors.error import InputError
    from heeltoe.motion.targets import STANDARDS
    from heeltoe.study.small.response_spectrum import OF_MOTION, with_response_spectrum
    from heeltoe.units.sentences import quantity
    from heeltoe.views.content.checks import answer_of
    from heeltoe.views.words.statics import basis, check_rows, failed, section_warnings, verdict_of

    try:
        changed = case.with_numbers(changes) if changes else case
        judged, provisional = _judged(changed, left)
        if spectrum:
            if spectrum != OF_MOTION and not spectrum.startswith(STANDARDS):
                raise InputError("target-form", "spectrum", spectrum)
            judged = with_response_spectrum(judged, spectrum)
    except InputError as error:
        return refused(error)
    several = len(judged.joints) > 1
    missed, rows = list[str](), list[dict[str, object]]()
    for joint in judged.ranked:
        where = f"{quantity(joint.elevation_m, '.5g m', units)}, " if several else ""
        missed += [f"{where}{text}" for text in failed(joint.statics, units)]
        rows += [
            {"cells": (where + load_case, *cells), "met": met} for (load_case, *cells), met in check_rows(joint.statics)
        ]
    return {
        "ok": judged.ok,
        "provisional": provisional,
        "verdict": answer_of(judged, units) if several else verdict_of(judged.governing.statics),
        "failed": missed,
        "basis": basis(judged.governing.statics, units),
        "checks": rows,
        "warnings": [in_words_of_the_page(text) for text in section_warnings(judged.joints, units)],
    }


def crest_response(case: Case, changes: Mapping[str, object], units: str) -> Json:
    """Return the amplification of the crest by frequency for each rock and water, and the first peaks as a table."""
    import numpy as np

    from heeltoe.models.flexible.surroundings.amplification import crest_amplification
    from heeltoe.views.animation.page import packed
    from heeltoe.views.words.amplification import COLUMNS, peak_rows

    changed = case.with_numbers(changes) if changes else case
    response = _RESPONSES.get(changed.model_dump_json(exclude=_NOT_IN_RESPONSE), lambda: crest_amplification(changed))
    return {
        "frequency": packed(response.frequencies, "float32"),
        "curves": [
            {
                "rock": curve.rock,
                "water": curve.water,
                "amplification": packed(np.abs(curve.response.amplification), "float32"),
            }
            for curve in response.curves
        ],
        "columns": COLUMNS,
        "rows": peak_rows(response),
        "assumptions": response.sentences(units),
        "damping": f"{100.0 * response.damping_ratio:.3g} %",
    }


def spread_of(say: Callable[..., None], case: Case, changes: Mapping[str, object], model: str, units: str) -> Json:
    """Return the same run with weaker and stronger shaking, as a table."""
    from heeltoe.models.run import earthquake, flexible, live
    from heeltoe.study.small.spread import with_spread
    from heeltoe.views.words.response import SPREAD_COLUMNS, spread_rows, spread_sentence

    changed = case.with_numbers(changes) if changes else case
    say(f"running the {model} model")
    response = flexible(changed) if model == "flexible" else live(changed, model, earthquake(changed))
    if not response.summary:
        return {"model": model, "columns": SPREAD_COLUMNS, "rows": [], "sentence": response.outcome, "warnings": []}
    spread = with_spread(response, changed, progress=lambda done, of: say(f"{done} of {of} runs"))
    before = {meant(warning, units) for warning in response.warnings}
    warnings = [meant(warning, units) for warning in spread.warnings]
    return {
        "model": model,
        "columns": SPREAD_COLUMNS,
        "rows": spread_rows(spread, units),
        "sentence": spread_sentence(spread, units),
        "warnings": [warning for warning in warnings if warning not in before],
    }


ACTIONS = {"statics": Entry(statics, newest=True), "crest": Entry(crest, newest=True), "spread": Entry(spread)}
