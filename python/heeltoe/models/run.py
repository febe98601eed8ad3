"""The one way to run any model: what every result must have is put there once, whoever asks for it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from time import perf_counter
from typing import TYPE_CHECKING, Literal, TypeVar

from heeltoe.case.combinations import check, supports
from heeltoe.case.field_usage import unused_fields
from heeltoe.case.model import Case
from heeltoe.case.shaking import resolve_all
from heeltoe.case.warnings import case_warnings
from heeltoe.errors.error import InputError, expect
from heeltoe.errors.sanitize import near
from heeltoe.mechanics.beam import step_warnings
from heeltoe.mechanics.friction import friction_of
from heeltoe.models.cost import Cost, block_cost, reading_cost
from heeltoe.models.drain_closure import drained, follows_drains, with_shares
from heeltoe.models.friction_band import (
    band_of,
    effect_of,
    frictions_of,
    judged_name,
    named,
    with_less_friction,
    worse,
)
from heeltoe.models.rigid.omitted import omitted
from heeltoe.models.runner import (
    about_the_end,
    beside_one_component,
    block_until_rest,
    numbers_of_sign,
    twin_of,
    where_of,
    with_outcome,
    worse_way,
)
from heeltoe.models.statics.standing import standing_warnings
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.contract import SHEARS_M
from heeltoe.result.judge import Judgement
from heeltoe.result.limits import check_limits, judge_response
from heeltoe.result.numbers import BEST, Chosen
from heeltoe.result.outcome import Outcome
from heeltoe.result.response import Response
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice, by_gravity

# Not at run time: what another model needs is not loaded.
if TYPE_CHECKING:
    from heeltoe.models.decoupled.response import DecoupledResponse
    from heeltoe.models.flexible.model import Rested
    from heeltoe.models.flexible.result.response import FlexibleResponse

R = TypeVar("R", bound=Response)

#: Names of two models side by side, and what the block of the two is.
BOTH = {"both": "rigid", "rigid,flexible": "rigid", "decoupled,flexible": "decoupled"}
#: What fits the case.
AUTO = "auto"
_ASKED_FOR = "it was asked for"
# Restitution decides the slip where without it that differs by more than this part and by more than this [m].
_DECIDES, _SLIGHT_M = 0.25, 1e-3
# A slip of this part of the crack's width takes as much off what the dam stands on.
_FAR = 0.1
_BESIDE = "it stands beside the flexible model, which is the better one"


def run(
    case: Case,
    model: str = AUTO,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> Response:
    """Run a model on a case, or two of them.

    Parameters
    ----------
    case
        Dam, crack, water and earthquake.
    model
        ``"rigid"``, ``"decoupled"`` or ``"flexible"``; ``"both"`` or ``"decoupled,flexible"`` for the flexible model
        with a block beside it; ``"auto"`` for what the case has the data for: with a modulus the flexible model with
        the rigid one beside it, or with the decoupled chain where the crack is at a height; without, the rigid model.
    motion, vertical
        Ground motions to use, as they are, instead of the case's [m/s2, downstream and upward].
    output_step
        Spacing of the histories [s]; each model has its own where it is not given. It does not change the motion that
        is computed.

    Returns
    -------
    Response
        Of the worse sign of the motion, unless the case says which way round it is (``motion.sign``); `signs` has both.
        Of the class of the model, of the better one of two; with all that case, motion and model warn of, what the
        usual loads do to the crack, and the limits of the case. `beside` holds that of the simpler model.

    Raises
    ------
    InputError
        Where there is no such model or no motion, or something in them or in the case cannot be used.
    """
    check_model(model, "model")
    shaking = earthquake(case, motion, vertical)
    response = _run(case, model, shaking, output_step)
    if response.started and case.crack.band is not None:
        return _with_band(case, model, response, shaking, output_step)
    # One model that is asked for is what its own function returns.
    return _with_friction_effect(case, response, shaking, output_step) if model == AUTO else response


def run_as_stated(case: Case, model: str = AUTO) -> Response:
    """Run a model on a case as :func:`run` does, with the friction that the crack states and no other: for a caller who
    needs how far the dam slides."""
    check_model(model, "model")
    return _run(case, model, earthquake(case), None)


def _run(case: Case, model: str, shaking: Earthquake, output_step: float | None) -> Response:
    """Run a model or two, with the friction that the crack states."""
    names, why = models_of(case, model)
    for name in names:
        check(case, name)
    _check_costs(case, names, shaking, output_step)

    def one_way(shaking: Earthquake, first: Rested | None = None) -> Response:
        *block, better = _until_the_same_end(names, case, shaking, output_step, first)
        return replace(better, beside=block[0]) if block else better

    def complete(response: Response) -> Response:
        block, chosen = response.beside, Chosen(asked=model, why=why)
        if block is None:
            return _alone(response, case, chosen)
        # The better model is judged.
        simpler = replace(_completed(block, case, names, Chosen(asked=model, why=_BESIDE)), limits=())
        return replace(_completed(response, case, names, chosen), beside=simpler)

    if names[-1] != "flexible" or follows_drains(case, shaking) or not runs_both_signs(case, shaking):
        return complete(_by_sign(case, shaking, one_way))
    return complete(_elastic_by_sign(case, shaking, output_step, one_way))


def _with_band(case: Case, model: str, response: Response, shaking: Earthquake, output_step: float | None) -> Response:
    """Add what the other frictions of the band do, and judge the limits by the one that the case names: a run with all
    of its evidence."""
    began = perf_counter()
    cases = frictions_of(case)
    shakings = {"recorded": shaking}
    if runs_both_signs(case, shaking):
        shakings["reversed"] = shaking.reversed()
    governing = next((way.sign for way in response.signs if way.governs), "recorded")
    ways = {BEST: numbers_of_sign(governing, response, response.limits, governs=True)}
    if response.elastic and not follows_drains(case, shaking):
        from heeltoe.models.flexible.model import rest_each

        bare = {name: other.without_evidence() for name, other in cases.items()}
        ways |= {name: worse(each) for name, each in rest_each(bare, shakings, output_step).items()}
    else:
        for name, other in cases.items():
            each = _run(other.without_evidence(), response.model, shaking, output_step)
            ways[name] = numbers_of_sign(governing, each, each.limits, governs=True)
    judged = judged_name(case, ways)
    limits = response.limits
    if judged != BEST and limits:
        own = _run(cases[judged], model, shaking, output_step)
        limits = named(own.limits, judged)
        ways[judged] = numbers_of_sign(governing, own, own.limits, governs=True)
    took = perf_counter() - began
    band = band_of(case, ways, judged)
    return replace(response, friction_band=band, limits=limits, seconds=response.seconds + took)


def _with_friction_effect(case: Case, response: Response, shaking: Earthquake, output_step: float | None) -> Response:
    """Add what the sign of the motion that governs does with a little less friction; one or two quick runs of an
    elastic dam, none where no evidence is wanted, or where single runs scatter and two of them say nothing."""
    elastic = response.elastic and not follows_drains(case, shaking)
    evidence = getattr(response, "evidence", None)
    scatters = evidence is not None and evidence.scatters
    less = None if scatters or (elastic and case.flexible.evidence == "none") else with_less_friction(case)
    if less is None or not response.started or response.outcome != Outcome.OK:
        return response
    began = perf_counter()
    governing = next((way.sign for way in response.signs if way.governs), "recorded")
    through = {governing: shaking.reversed() if governing == "reversed" else shaking}
    own: float | None = response.residual_slip_m
    if elastic:
        from heeltoe.models.flexible.model import rest_each, runs_as_beside

        both = {"less": less.without_evidence()}
        # The difference has one mesh and one step.
        if evidence is None or not runs_as_beside(case, through[governing], evidence):
            both["own"] = case.without_evidence()
        each = rest_each(both, through, output_step)
        own, (numbers,) = each["own"][0].residual_slip_m if "own" in each else own, each["less"]
    else:
        ran = MODELS[response.model](less.without_evidence(), through[governing], output_step)
        numbers = numbers_of_sign(governing, ran, (), governs=True)
    took = perf_counter() - began
    return replace(response, friction_effect=effect_of(own, numbers), seconds=response.seconds + took)


def _elastic_by_sign(
    case: Case,
    shaking: Earthquake,
    output_step: float | None,
    run: Callable[[Earthquake, Rested | None], Response],
) -> Response:
    """Run an elastic dam both ways round without evidence, and the worse way with it."""
    from heeltoe.models.flexible.model import rest_both_ways

    began = perf_counter()
    recorded, *others = rest_both_ways(case, shaking, output_step)
    if not others:
        return run(shaking, recorded)
    ways = {"recorded": (shaking, recorded), "reversed": (shaking.reversed(), others[0])}
    worst = max(ways, key=lambda sign: ways[sign][1].judged(case).badness())
    took = perf_counter() - began
    response = run(*ways[worst])
    other = "recorded" if worst == "reversed" else "reversed"
    if ways[other][1].judged(case).badness() > judge_response(case.limits, response).badness():
        # Its evidence has made the worse way the better one: both are judged with theirs.
        judged = {worst: response, other: run(*ways[other])}
        worse = worse_way({sign: judged[sign] for sign in ways}, case.limits)
        return replace(worse, seconds=perf_counter() - began)
    signs = [
        numbers_of_sign(sign, response, check_limits(case.limits, response), governs=True)
        if sign == worst
        else rested.sign_numbers(case, sign)
        for sign, (_, rested) in ways.items()
    ]
    return replace(response, signs=tuple(signs), seconds=response.seconds + took)


def _by_sign(case: Case, shaking: Earthquake, run: Callable[[Earthquake], R]) -> R:
    """Run both ways round, the worse one leading, unless the case says which way round its motion is."""
    if not runs_both_signs(case, shaking):
        return run(shaking)
    recorded = run(shaking)
    # One that does not stand has no use for an earthquake.
    if not recorded.started:
        return recorded
    return worse_way({"recorded": recorded, "reversed": run(shaking.reversed())}, case.limits)


def runs_both_signs(case: Case, shaking: Earthquake | None = None) -> bool:
    """Whether a case leaves it open which way round its motion is; one that is zero is the same both ways."""
    known = case.motion is not None and case.motion.has_sign
    return not known and (shaking is None or shaking.motion.pga > 0.0)


def check_model(name: str, field: str) -> None:
    """Refuse a name of no model.

    Raises
    ------
    InputError
        Then.
    """
    if name not in (AUTO, *MODELS, *BOTH):
        models = f"{AUTO}, {', '.join(MODELS)}, both or decoupled,flexible"
        raise InputError("not-a-choice", field, name, choices=f"{models}{near(str(name), (AUTO, *MODELS, *BOTH))}")


def models_of(case: Case, model: str = AUTO) -> tuple[tuple[str, ...], str]:
    """Return the models that are run for a case by the word `model`, the better one last, and the reason."""
    joint_alone = case.crack.bond is not None and model == AUTO and case.concrete.modulus is not None
    if case.further_cracks or case.crack.kinks or joint_alone:
        return _of_several(case, model)
    if model in BOTH:
        return (BOTH[model], "flexible"), "it is the better one of the two that were asked for"
    if model != AUTO:
        return (model,), _ASKED_FOR
    if not supports(case, "flexible") and case.crack.roughness is not None:
        at_height = case.crack.elevation > 0.0 and case.concrete.modulus is not None
        return ("decoupled" if at_height else "rigid",), "the flexible model does not know asperities"
    if case.concrete.modulus is None:
        return ("rigid",), "the case gives no concrete.modulus, without which the dam can only be a rigid block"
    block = "decoupled" if case.crack.elevation > 0.0 else "rigid"
    if case.motion is not None and case.motion.cross_valley is not None and not supports(case, block):
        return ("flexible",), "no block beside it is followed where the ground shakes across the valley"
    return (block, "flexible"), "the case gives concrete.modulus, so that the dam can vibrate as it does"


def _of_several(case: Case, model: str) -> tuple[tuple[str, ...], str]:
    """Return the model that knows several cracks, kinks and bonds; the rigid one knows two cracks if it is named."""
    if model not in (AUTO, "flexible"):
        check(case, "beside" if model in BOTH else model)
        return (model,), _ASKED_FOR
    what = "several cracks, and its parts can vibrate as they do"
    alone = "a crack with kinks, which the flexible model alone knows"
    if not case.crack.kinks:
        alone = "a bonded joint, which the flexible model alone cracks step by step"
    why = f"the case has {what if case.further_cracks else alone}"
    return ("flexible",), _ASKED_FOR if model == "flexible" else why


def cost_of(case: Case, model: str = AUTO, output_step: float | None = None, spread: int = 0) -> Cost | None:
    """Return what a run is estimated to take where it makes elastic parts, with a number of runs for a spread; blocks
    take next to nothing."""
    if "flexible" not in models_of(case, model)[0]:
        return None
    return _cost(case, earthquake(case), output_step, spread)


def wish_cost(case: Case, model: str = AUTO, output_step: float | None = None, spread: int = 0) -> Cost | None:
    """Return the estimated cost of a run with its blocks, and with `spread` runs for a spread; None where the cost of
    its elastic parts is more than the case allows, which is refused."""
    names, shaking = models_of(case, model)[0], earthquake(case)
    signs, end = (2 if runs_both_signs(case, shaking) else 1), shaking.run_end
    samples = max(shaking.motion.time.size * end / max(shaking.motion.duration, 1e-9), end / (output_step or end))
    cost = Cost()
    for name in names:
        if name == "flexible":
            elastic = _cost(case, shaking, output_step, spread)
            if not elastic.within(case):
                return None
            cost += elastic
        else:
            one = block_cost(name, end, samples)
            cost += Cost((signs + spread) * one.seconds, signs * one.memory)
    return cost


def record_cost(case: Case) -> Cost:
    """Return what reading the records of a case is estimated to take."""
    motion = case.motion
    sources = () if motion is None else (motion, motion.vertical, motion.cross_valley)
    return reading_cost(case.base_directory / source.file for source in sources if source is not None and source.file)


def _cost(case: Case, shaking: Earthquake, output_step: float | None, spread: int = 0) -> Cost:
    from heeltoe.models.flexible.run.expected import analysing, frame_step_of

    end = shaking.run_end
    cost = analysing(case, end, frame_step_of(end, output_step), silence=case.analysis.silence, spread=spread)
    both, band = runs_both_signs(case, shaking), case.crack.band
    bare = analysing(case.without_evidence(), end, frame_step_of(end, output_step), silence=case.analysis.silence)
    # The other way round is run without evidence, as are other frictions both ways; one that is judged has its own.
    for _ in range(both + (0 if band is None else (1 + both) * len(band.names))):
        cost += bare
    if band is None and case.flexible.evidence != "none" and with_less_friction(case) is not None:
        # Both runs of the effect of friction have dams that are built already, and mostly longer steps.
        cost += bare
    return cost + cost if band is not None and band.judge != "best" else cost


def _check_costs(case: Case, names: Sequence[str], shaking: Earthquake, output_step: float | None) -> None:
    """Refuse what takes too much before the first model runs, and the first way round."""
    if "flexible" in names:
        from heeltoe.models.flexible.body.cost import check_cost

        check_cost(case, _cost(case, shaking, output_step))


def _until_the_same_end(
    names: Sequence[str], case: Case, shaking: Earthquake, output_step: float | None, first: Rested | None
) -> list[Response]:
    """Run models until all of them are at rest, one as long as the other; `first` is what the elastic dam has done
    without evidence, where that is known."""
    responses = []
    for name in names:
        known = first if name == "flexible" and first is not None and not shaking.silence else None
        responses.append(_timed(name, case, shaking, output_step, known))
        shaking = shaking.silent(responses[-1].silence_s)

    def as_long(response: Response) -> Response:
        again = _timed(response.model, case, shaking, output_step)
        return replace(again, seconds=response.seconds + again.seconds)

    return [response if response.silence_s == shaking.silence else as_long(response) for response in responses]


def _timed(
    model: str, case: Case, shaking: Earthquake, output_step: float | None, first: Rested | None = None
) -> Response:
    began = perf_counter()
    if first is None:
        response = MODELS[model](case, shaking, output_step)
    else:
        from heeltoe.models.flexible.model import run_flexible

        response = run_flexible(case, shaking, output_step, first)
    return replace(response, seconds=perf_counter() - began)


def rigid(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    rotation: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> Response:
    """Run the rigid model: the part above the crack is a block.

    Parameters, result and errors are those of :func:`run`. Histories come at the record's samples where no spacing is
    given; `rotation` is that of the ground about the middle of the crack, counter-clockwise [rad/s2].
    """
    expect(case, Case, "a case", "case")
    check(case, "rigid")
    if rotation is not None:
        check(case, "rotation")
    return _alone(_rigid(case, earthquake(case, motion, vertical, rotation), output_step), case)


def decoupled(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> DecoupledResponse:
    """Run the decoupled chain: the part below the crack is elastic, and its motion shakes the block above.

    Parameters, result and errors are those of :func:`run`. Histories come at an even part of the record's step, up to
    5 ms, where no spacing is given.
    """
    expect(case, Case, "a case", "case")
    check(case, "decoupled")
    return _alone(_decoupled(case, earthquake(case, motion, vertical), output_step), case)


def flexible(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
    evidence: Literal["full", "step", "none"] | None = None,
) -> FlexibleResponse:
    """Run the flexible model: the parts above and below the crack are elastic.

    Parameters, result and errors are those of :func:`run`. Histories come every 0.01 s where no spacing is given.
    `evidence` takes the place of the case's ``flexible.evidence``.
    """
    if evidence is not None:
        case = case.model_copy(update={"flexible": case.flexible.with_evidence(evidence)})
    return _alone(_flexible(case, earthquake(case, motion, vertical), output_step), case)


def live(case: Case, model: str, shaking: Earthquake) -> Response:
    """Run a block, ``"rigid"`` or ``"decoupled"``, for someone who waits: numbers and histories are those of
    :func:`run`, but a decoupled one has no evidence at the level of its crack.

    Raises
    ------
    InputError
        As :func:`run`.
    """
    check(case, model)

    def one_way(shaking: Earthquake) -> Response:
        return _live(case, shaking) if model == "decoupled" else _rigid(case, shaking, None)

    return _alone(_by_sign(case, shaking, one_way), case)


def earthquake(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    rotation: GroundMotion | None = None,
) -> Earthquake:
    """Return what shakes a case: the motions given, or its own, until the end that it asks for.

    Raises
    ------
    InputError
        Where there is no motion, or one that cannot be used.
    """
    expect(case, Case, "a case", "case")
    for name, component in (("motion", motion), ("vertical", vertical), ("rotation", rotation)):
        if component is not None:
            expect(component, GroundMotion, "a ground motion", name)
    cross = None
    if motion is None:
        motion, vertical, cross = resolve_all(case)
    elif not motion.parts and case.motion is not None:
        motion = motion.with_warnings(
            *(notice for notice in _left_out(case, vertical) if notice not in motion.warnings)
        )
    own = None if motion.parts or case.motion is None else case.motion.duration
    return Earthquake(motion, vertical, own or motion.duration, rotation, cross=cross)


def _left_out(case: Case, vertical: GroundMotion | None) -> Iterator[Notice]:
    """Walk what of a case's own motions a motion that is given beside it comes without."""
    if case.aftershocks:
        yield Notice("motions-left-out", field="aftershocks", effect="takes the place of all of its motions")
    if vertical is None and case.motion is not None and case.motion.vertical is not None:
        yield Notice("vertical-left-out")
    if case.motion is not None and case.motion.cross_valley is not None:
        yield Notice("motions-left-out", field="motion.cross_valley", effect="has no shaking across the valley")


def _alone(response: R, case: Case, chosen: Chosen | None = None) -> R:
    """Return a response with no better model beside it, which says what it leaves out; by default its model was named
    by the user."""
    return _completed(
        response, case, (response.model,), chosen or Chosen(asked=response.model, why=_ASKED_FOR), alone=True
    )


def _completed(response: R, case: Case, models: Sequence[str], chosen: Chosen, *, alone: bool = False) -> R:
    """Add what every result has, and to one that stands `alone` what it leaves out; a field that one of the `models`
    side by side reads is not reported as unused. A run that never started gives its own reason."""
    off: tuple[Notice, ...] = ()
    judgement = judge_response(case.limits, response)
    if response.started:
        off = (*_slides_on(case, response), *_anchors_crossed(case, response), *_slid_off(response, judgement))
    response, between = _sequence(case, response)
    unused = unused_fields(case, models)
    beside = [component for component in (response.vertical, response.cross) if component is not None]
    others = [notice for component in beside for notice in component.warnings]
    end = about_the_end(response, asked="silence" in case.analysis.model_fields_set)
    warnings = (*case_warnings(case), *response.motion.warnings, *others, *response.warnings, *end, *unused)
    response = replace(response, limits=check_limits(case.limits, response, judgement))
    if not response.started:
        return replace(response, chosen=chosen, warnings=by_gravity(warnings))
    warnings = (
        *warnings,
        *off,
        *standing_warnings(case, response.cracks[case.asked].static),
        *between,
        *(() if response.model == "rigid" else step_warnings(case, response.motion)),
    )
    if alone and not response.elastic and case.crack.bond is None:
        left_out = omitted(case, response) if response.model == "rigid" else (Notice("rigid-top"),)
        warnings = (*warnings, *left_out)
    return replace(response, chosen=chosen, warnings=by_gravity(warnings))


def _sequence(case: Case, response: R) -> tuple[R, tuple[Notice, ...]]:
    """Add the results of each motion of a sequence, and return the notices on it."""
    if not response.motion.parts or not response.started:
        return response, ()
    from heeltoe.models.statics.after import about_the_sequence, judged_stages

    followed, several = response.drainage_by_motion is not None, bool(case.further_cracks)
    by_crack = [judged_stages(alone, response.at_crack(place)) for place, alone in enumerate(case.single_crack_cases)]
    notices = [
        notice
        for alone, judged in zip(case.single_crack_cases, by_crack, strict=True)
        for notice in about_the_sequence(alone, judged, followed=followed, several=several)
    ]
    for place, judged in enumerate(by_crack):
        response = response.with_crack(place, sequence=judged)
    return response, tuple(notices)


def _slides_on(case: Case, response: Response) -> Iterator[Notice]:
    """Say where the friction of a crack that has begun to slip does not hold the static loads any more."""
    for crack, alone in zip(response.cracks, case.single_crack_cases, strict=True):
        factor, normal = crack.static.sliding_safety_factor, crack.static.normal_force_n
        if factor is None or factor < 1.0 or normal <= 0.0 or alone.crack.kinks or alone.crack.roughness is not None:
            continue
        at_rest, sliding = friction_of(alone.crack, normal, crack.crack_width_m)
        if at_rest / factor > sliding * (1.0 + 1e-9):
            yield Notice("slides-on", needed=at_rest / factor, sliding=sliding, where=where_of(case, alone))


def _anchors_crossed(case: Case, response: Response) -> Iterator[Notice]:
    """Say where a slip crosses anchors that keep their prestress through it."""
    for crack, alone in zip(response.cracks, case.single_crack_cases, strict=True):
        slip = max(abs(crack.peak_slip_downstream_m), abs(crack.peak_slip_upstream_m))
        anchors = [anchor for anchor in alone.anchors_at_crack if anchor.prestress]
        if slip >= SHEARS_M and anchors:
            constant = any(not anchor.axial_stiffness for anchor in anchors)
            how = "whose prestress counts to the end of the run" if constant else "that stretch without end"
            yield Notice("anchors-cross-slip", slip_m=slip, where=where_of(case, alone), how=how)


def _slid_off(response: Response, judgement: Judgement) -> tuple[Notice, ...]:
    """Say where little or nothing is left below the part above a crack."""
    notices, off = [], judgement.slid_off[0]
    for crack in response.cracks:
        slip = max(abs(crack.peak_slip_downstream_m), abs(crack.peak_slip_upstream_m))
        if off and slip > crack.crack_width_m:
            notices.append(Notice("slid-off", slip_m=slip, width_m=crack.crack_width_m))
        elif response.outcome == Outcome.OK and slip > _FAR * crack.crack_width_m:
            notices.append(Notice("slid-far", share=slip / crack.crack_width_m))
    return tuple(notices)


def _rigid(case: Case, earthquake: Earthquake, output_step: float | None) -> Response:
    from heeltoe.models.rigid.model import run_rigid

    def run(through: Earthquake) -> Response:
        if case.further_cracks:
            from heeltoe.models.rigid.stack import run_two_blocks

            return run_two_blocks(case, through, output_step)
        return run_rigid(case, through, output_step)

    response = with_outcome(*block_until_rest(run, lambda ran: ran, earthquake, case.analysis.silence))
    if earthquake.cross is not None:
        alone = run(replace(earthquake, cross=None).silent(response.silence_s))
        slip = alone.residual_slip_m if alone.ok else None
        response = beside_one_component(response, str(alone.outcome), slip)
    # Of bounces that amplify the last digit no run is the answer: a twin shows it.
    twin = twin_of(case, response, run, earthquake)
    if twin is None:
        return response
    bounce, slip = twin
    other = Sentence("has no result") if slip is None else Sentence.of("slides {twin_m:.4g mm}", twin_m=slip)
    notice = Notice("not-determined", other=other, slip_m=response.residual_slip_m, restitution=bounce)
    return replace(response, warnings=(notice, *response.warnings))


def _decoupled(case: Case, earthquake: Earthquake, output_step: float | None) -> DecoupledResponse:
    from heeltoe.models.decoupled.model import block_of_chain, run_decoupled

    response = run_decoupled(case, earthquake, output_step)
    if response.outcome != Outcome.OK or not response.impacts or not case.crack.restitution:
        return response
    # Blows are where the block and the dam differ most, and the restitution is seldom known.
    dead = case.model_copy(update={"crack": case.crack.model_copy(update={"restitution": 0.0})})
    other = block_of_chain(dead, earthquake.silent(response.silence_s), output_step)
    slip, without = response.residual_slip_m, other.residual_slip_m
    if other.outcome != Outcome.OK or abs(slip - without) <= max(_DECIDES * abs(slip), _SLIGHT_M):
        return response
    notice = Notice("restitution-decides", slip_m=slip, restitution=case.crack.restitution, dead_slip_m=without)
    return replace(response, warnings=(notice, *response.warnings))


def _live(case: Case, earthquake: Earthquake) -> DecoupledResponse:
    from heeltoe.models.decoupled.live import run_live

    def run(through: Earthquake) -> DecoupledResponse:
        return run_live(case, through)

    return with_outcome(*block_until_rest(run, lambda ran: ran, earthquake, case.analysis.silence, swings=True))


def _flexible(case: Case, earthquake: Earthquake, output_step: float | None) -> FlexibleResponse:
    from heeltoe.models.flexible.model import rest_of, run_flexible

    if not follows_drains(case, earthquake):
        return run_flexible(case, earthquake, output_step)
    rested, shares = drained(case, earthquake, rest_of(case, earthquake))
    response = run_flexible(case, replace(earthquake, drainage=rested.earthquake.drainage), output_step)
    return with_shares(response, shares)


#: The models by name.
MODELS: dict[str, Callable[[Case, Earthquake, float | None], Response]] = {
    "rigid": _rigid,
    "decoupled": _decoupled,
    "flexible": _flexible,
}
