"""How a run ends: its outcome, when the dam is at rest, how long the silence after the motion is, what has slid off.

Single runs, rows of a study, spreads and the app all ask here, so that the same dam has the same answer by every door.
A slip that still grows is none to trust: a run goes on through silence after the ground motion until the dam is at
rest.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.case.options import Limits
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.contract import JOINT_METER_M, OPENINGS
from heeltoe.result.judge import LimitCheck, slides_off
from heeltoe.result.limits import check_limits, judge_response
from heeltoe.result.numbers import AnchorForce, CrackNumbers, CrossValley, SignNumbers, WithoutCrossValley
from heeltoe.result.outcome import LARGEST_ROTATION, Outcome, decide
from heeltoe.result.response import Response
from heeltoe.result.rest import comes_to_rest, last_of, rests_from
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

#: The silence is a multiple of this where the dam comes to rest before all of it is over [s].
STEP = 2.5
#: From which restitution on bounces may amplify the last digit, and by how much the motion of a twin is stronger.
BOUNCY, HAIR = 0.7, 1e-9
# A slip is determined where that of the twin differs by less than this part of it, or than a joint meter reads.
_CHAOTIC = 0.01
# What slides in the last quarter of its free motion by this part of the quarter before, or more, does not slow down: a
# block but for rounding, an elastic dam within the 0.4 % by which one that slides on as it vibrates does so. Less free
# motion [s] does not show that.
_AS_FAST, _AS_FAST_VIBRATING, _LEAST_SILENCE = 1.0 - 1e-6, 0.99, 2.0
#: Where in the free motion after the record the slip is looked at to see that.
_QUARTERS = (0.25, 0.5, 0.75)

# Joints of a real dam close before a monolith has slid so far across the valley [m].
_JOINTS_M = 0.02

T = TypeVar("T")
R = TypeVar("R", bound=Response)
Table = dict[str, Floats]
Words = NDArray[Any]


def beside_one_component(response: R, outcome: str, slip: float | None, own: float | None = None) -> R:
    """Add to a response what the dam does without the shaking across the valley, and what a reader must know.

    Parameters
    ----------
    response
        With what the part above its only crack does across the valley.
    outcome, slip
        How the run without that shaking ends, and its residual slip [m], or the mean of several; None without a result.
    own
        Residual slip of the run that is compared with it, where that is not the one of the response [m].
    """
    numbers = response.numbers
    across = getattr(numbers, "cross_valley", None)
    if not isinstance(numbers, CrackNumbers) or not isinstance(across, CrossValley):
        return response
    factor = None
    if response.ok and slip is not None and abs(slip) >= JOINT_METER_M:
        factor = (numbers.residual_slip_m if own is None else own) / slip
    across = replace(
        across, without_cross_valley=WithoutCrossValley(outcome=outcome, residual_slip_m=slip, factor=factor)
    )
    farthest = max(across.peak_slip_cross_left_m, -across.peak_slip_cross_right_m)
    notices = [Notice("cross-valley-upright")]
    if farthest > _JOINTS_M:
        notices.append(Notice("cross-valley-far", slip_m=farthest))
    response = replace(response, warnings=(*response.warnings, *notices))
    return response.with_crack(of_crack=replace(numbers, cross_valley=across))


def outcomes_of(
    outcomes: Sequence[str] | Words,
    tables: Sequence[Mapping[str, Floats]],
    widths: Sequence[Floats | float],
    *,
    finite: bool,
) -> Words:
    """Return the outcomes of many runs, (n,): `outcomes` are those of the kernel, `tables` have what it says of each of
    their cracks, which are so wide [m]."""
    turned = np.max([largest_rotation(table) for table in tables], axis=0)
    slides = tables[0].get("keeps_sliding", np.zeros_like(turned)) != 0.0
    off, words = leaves(tables, widths), np.array(outcomes, dtype=object)
    decided = np.array([Outcome.OK] * words.size, dtype=object)
    # Most runs end as they should: there is nothing to decide.
    doubtful = (words != Outcome.OK.value) | off | slides | ~(turned <= LARGEST_ROTATION)
    for row in np.flatnonzero(doubtful).tolist():
        decided[row] = decide(
            words[row], rotation=float(turned[row]), finite=finite, off=bool(off[row]), slows=not slides[row]
        )
    return decided


def leaves(tables: Sequence[Mapping[str, Floats | float]], widths: Sequence[Floats | float]) -> NDArray[np.bool_]:
    """Return in which runs a part slides farther than its crack is wide [m]; `tables` have what the kernel says of each
    crack."""
    off = [slides_off(table["slip_max"], table["slip_min"], width) for table, width in zip(tables, widths, strict=True)]
    return np.asarray(np.any(off, axis=0))


def largest_rotation(table: Mapping[str, Floats] | Mapping[str, float]) -> Floats:
    """Return the largest rotation of runs either way [rad]."""
    return np.maximum(table["rotation_max"], np.negative(table["rotation_min"]))


def advice_of(
    outcome: Outcome,
    *,
    rotation: float = 0.0,
    why: Sentence | None = None,
    unless_it_stands: str = Outcome.UNSTABLE.remedy,
    stopped: Sentence | None = None,
    silence: float = 0.0,
) -> Sentence | None:
    """Say why a run has no result, and what to do; None where it has one.

    Parameters
    ----------
    outcome
        How it ended.
    rotation
        The largest, either way [rad].
    why
        Why the static loads move the dam, where they do.
    unless_it_stands
        Remedy where they do, or may.
    stopped
        Where the run stopped.
    silence
        How long it went on after the ground motion [s].
    """
    if outcome.has_result:
        return None
    if outcome is Outcome.KEEPS_SLIDING:
        why = Sentence.of("it does not slow down in {silence_s:g s} after the ground motion", silence_s=silence)
        return Sentence.of("{why}: {remedy}", why=why, remedy=outcome.remedy)
    if outcome is Outcome.UNSTABLE and why is not None:
        return Sentence.of("{why}: {remedy}", why=why, remedy=unless_it_stands)
    if outcome is Outcome.LARGE_ROTATION:
        stopped = Sentence.of("it rotates by {rotation_rad:.3g rad}", rotation_rad=rotation)
    return Sentence.of(
        "{stopped}: {sentence}; {remedy}", stopped=stopped, sentence=outcome.sentence, remedy=outcome.remedy
    )


def determined(slip: Floats | float, twin: Floats | float) -> NDArray[np.bool_]:
    """Return whether residual slips are those of twins in a motion that is stronger by :data:`HAIR` [m]."""
    return np.less_equal(np.abs(np.subtract(slip, twin)), np.maximum(_CHAOTIC * np.abs(slip), JOINT_METER_M))


def twin_of(
    case: Case, response: R, run: Callable[[Earthquake], R], earthquake: Earthquake
) -> tuple[float, float | None] | None:
    """Return the largest restitution of a block's cracks, and the slip [m] of a twin in a motion that is stronger by
    :data:`HAIR`, where that differs from the slip of the `response`; None where the slip is determined. The slip of a
    twin without a result is None."""
    bounce = max(alone.crack.restitution for alone in case.single_crack_cases)
    if bounce < BOUNCY or response.outcome != Outcome.OK or not response.impacts:
        return None
    twin = run(earthquake.silent(response.silence_s).scaled(1.0 + HAIR))
    if twin.outcome != Outcome.OK:
        return bounce, None
    return None if determined(response.residual_slip_m, twin.residual_slip_m) else (bounce, twin.residual_slip_m)


def until_rest(
    run: Callable[[Earthquake], T],
    reach: Callable[[T], float],
    earthquake: Earthquake,
    longest: float,
    *,
    swings: bool = False,
) -> T:
    """Run through an earthquake, and where the dam still moves then again with silence after it, until it is at rest.

    A dam that is at rest as it is costs this one run; else there are up to two more, one of them through the longest
    silence, which says how much of it is needed.

    Parameters
    ----------
    run
        Runs through an earthquake.
    reach
        Says of a run how far it must reach to show the dam at rest [s]: infinite where the dam still moves at its end,
        minus infinite where it ended otherwise, so that there is nothing to wait for.
    earthquake
        It may have some silence after it already, which is kept.
    longest
        How much silence there may be [s].
    swings
        Whether what shakes the dam goes on in the silence, as a crack on an elastic part does: a dam that is at rest
        when the ground is may slide once more.
    """
    first = run(earthquake)
    rests = reach(first) < math.inf
    if earthquake.silence >= longest or (rests and not (swings and reach(first) > -math.inf)):
        return first
    whole = run(earthquake.silent(longest))
    needed = reach(whole) - earthquake.end
    if rests and needed <= earthquake.silence:
        return first
    seconds = STEP * max(1.0, math.ceil(needed / STEP)) if math.isfinite(needed) else longest
    if not earthquake.silence < seconds < longest:
        return whole
    last = run(earthquake.silent(seconds))
    # The steps of an elastic dam are now a ten-thousandth longer or shorter, which matters to one that bounces.
    return last if reach(last) < math.inf else whole


def keeps_sliding(slips: Floats, silence: float, as_fast: float = _AS_FAST) -> NDArray[np.bool_]:
    """Return which runs do not slow down in the free motion after the record, (...,).

    Parameters
    ----------
    slips
        (..., 4) slips after a quarter, a half, three quarters and the end of the free motion [m]; what slides on goes
        one way in between.
    silence
        How long it is [s].
    as_fast
        Least ratio of the last quarter to the quarter before it, of motion that does not slow down.
    """
    steps = np.diff(slips)
    one_way = np.all(steps > 0.0, axis=-1) | np.all(steps < 0.0, axis=-1)
    _, before, now = np.moveaxis(np.abs(steps), -1, 0)
    return np.asarray(one_way & (silence >= _LEAST_SILENCE) & (now > JOINT_METER_M) & (now >= as_fast * before))


def slides_on(time: Floats, slip: Floats, silence: float) -> bool:
    """Whether the slip [m] of an elastic dam, which ends with a free motion so long [s], does not slow down."""
    parts = np.array([*_QUARTERS, 1.0])
    moments = time[-1] - silence * (1.0 - parts)
    return bool(keeps_sliding(np.interp(moments, time, slip), silence, _AS_FAST_VIBRATING))


def block_until_rest(
    run: Callable[[Earthquake], T],
    response_of: Callable[[T], Response],
    earthquake: Earthquake,
    longest: float,
    *,
    swings: bool = False,
) -> tuple[T, Outcome]:
    """Run a block as :func:`until_rest` does; return the run, and its outcome: where the block still moves in the end,
    shorter runs say whether it slows down. `response_of` returns the response of a run."""
    whole = until_rest(run, lambda ran: reach_of_block(response_of(ran)), earthquake, longest, swings=swings)
    response = response_of(whole)
    silence = response.silence_s
    if silence < _LEAST_SILENCE or reach_of_block(response) < math.inf:
        return whole, response.outcome
    shorter = [response_of(run(earthquake.silent(part * silence))) for part in _QUARTERS]
    slips = np.array([[crack.residual_slip_m for crack in ran.cracks] for ran in (*shorter, response)])
    return whole, Outcome.KEEPS_SLIDING if keeps_sliding(slips.T, silence).any() else response.outcome


def with_outcome(response: R, outcome: Outcome) -> R:
    """Return a response of a block that ends so."""
    if outcome is response.outcome:
        return response
    return replace(response, outcome=outcome, advice=advice_of(outcome, silence=response.silence_s))


def worse_way(ways: Mapping[str, R], limits: Limits) -> R:
    """Return the response of the worse sign of the motion, the first where they are equal, with the results of each
    sign."""
    judgements = {sign: judge_response(limits, response) for sign, response in ways.items()}
    worst = max(ways, key=lambda sign: judgements[sign].badness())
    signs = [
        numbers_of_sign(sign, response, check_limits(limits, response, judgements[sign]), governs=sign == worst)
        for sign, response in ways.items()
    ]
    return replace(ways[worst], signs=tuple(signs))


def numbers_of_sign(sign: str, response: Response, limits: Sequence[LimitCheck], *, governs: bool) -> SignNumbers:
    """Return what a response says of one sign of the motion, beside its `limits`."""
    known = response.ok and response.started
    openings = [opening.of(crack) for crack in response.cracks for opening in OPENINGS] if known else []
    return SignNumbers(
        sign=sign,
        governs=governs,
        outcome=response.outcome,
        elevation_m=response.cracks[response.asked].elevation if known else None,
        residual_slip_m=response.residual_slip_m if known else None,
        opening_m=max(openings) if known else None,
        limits_not_met=len([check for check in limits if not check.met]),
    )


def rows_until_rest(
    run: Callable[[Integers, float], Table],
    reach: Callable[[Table], Floats],
    rows: Integers,
    longest: float,
) -> Iterator[tuple[Integers, Table]]:
    """Run many blocks as :func:`until_rest` runs one; later results replace earlier ones.

    A block that is at rest stays so while the ground is still: the shortest silence after which it does not move is the
    one that a single run finds by the time of its last event.

    Parameters
    ----------
    run
        Runs some rows with some silence after their motions [s].
    reach
        (n,) infinite where they still move at the end, minus infinite where they ended otherwise, zero at rest.
    rows
        (n,) their numbers.
    longest
        How much silence there may be [s].
    """
    table = run(rows, 0.0)
    yield rows, table
    left = rows[reach(table) == math.inf]
    if not left.size or not longest:
        return
    table = run(left, longest)
    moving = left[reach(table) == math.inf]
    if moving.size and longest >= _LEAST_SILENCE:
        shorter = [run(moving, part * longest)["slip"] for part in _QUARTERS]
        on = np.zeros(left.size)
        on[reach(table) == math.inf] = keeps_sliding(
            np.column_stack([*shorter, table["slip"][reach(table) == math.inf]]), longest
        )
        table = {**table, "keeps_sliding": on}
    yield left, table
    # What ends in another way, or never, has nothing to wait for.
    left = left[np.isfinite(reach(table))]
    silence = STEP
    while left.size and silence < longest:
        table = run(left, silence)
        moving = reach(table) == math.inf
        yield left[~moving], {name: values[~moving] for name, values in table.items()}
        left, silence = left[moving], silence + STEP


def reach_of_block(response: Response) -> float:
    """Return what :func:`until_rest` asks of the run of a block."""
    return rests_from(response) if response.outcome == Outcome.OK else -math.inf


def where_of(case: Case, alone: Case) -> Sentence | str:
    """Return where a crack is, `alone` in its case, for a sentence about one of several; nothing of the only one."""
    return Sentence.of(" at {at_m:g m}", at_m=alone.crack.elevation) if case.further_cracks else ""


def about_the_anchors(anchors: Sequence[AnchorForce]) -> Iterator[Notice]:
    """Say which anchors go slack or bear more than they are good for, and of which nothing says what that is."""
    for number, anchor in enumerate(anchors, start=1):
        if anchor.slack_s is not None:
            at_end = Sentence.of("pulls with {tension_n:.4g MN/m} at the end", tension_n=anchor.final_tension_n)
            yield Notice(
                "anchor-fails",
                "slack",
                number=number,
                time_s=anchor.slack_s,
                then=at_end if anchor.final_tension_n else Sentence("is slack at the end"),
            )
        if anchor.yields_s is not None:
            yield Notice(
                "anchor-fails",
                "overloaded",
                number=number,
                time_s=anchor.yields_s,
                force_n=anchor.peak_force_n,
                capacity_n=anchor.capacity_n,
            )
    unlimited = [anchor.peak_force_n for anchor in anchors if anchor.capacity_n is None]
    if unlimited:
        yield Notice("anchor-unlimited", force_n=max(unlimited))


def about_the_end(response: Response, *, asked: bool) -> Iterator[Notice]:
    """Say where the dam is not at rest when its run ends, or, where the case has `asked` for a silence, that there was
    no need to wait."""
    if response.outcome != Outcome.OK or comes_to_rest(response):
        if asked and not response.silence_s:
            ended = (
                "nothing moves when the ground motion ends" if response.outcome == Outcome.OK else "the run ends before"
            )
            yield Notice("fields-idle", field="analysis.silence", fields="analysis.silence", why=ended)
        return
    when = Sentence("when the ground motion ends")
    if response.silence_s:
        when = Sentence.of("{silence_s:g s} after the ground motion has ended", silence_s=response.silence_s)
    end = response.end_time_s
    if not response.elastic:
        how = Sentence.of(
            " ({mode}, slip velocity {slip_velocity_m_s:.3g m/s})",
            mode=response.final_mode,
            slip_velocity_m_s=response.final_slip_velocity_m_s,
        )
        yield Notice("still-moves", time_s=end, body="block", when=when, how=how)
        return
    last = last_of(response)
    span = "second" if last.seconds == 1.0 else f"{last.seconds:.2g} s"
    change = {"span": span, "what": last.what, "change_m": last.change_m}
    how = Sentence.of(": in the last {span} its {what} changes by {change_m:.3g mm}", **change)
    yield Notice("still-moves", time_s=end, body="dam", when=when, how=how)
