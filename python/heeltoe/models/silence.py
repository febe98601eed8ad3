"""On through the silence after the ground motion until the dam is at rest: a slip that still grows is none to trust."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TypeVar

from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.response import Response
from heeltoe.result.rest import comes_to_rest, last_of, rests_from
from heeltoe.units.sentences import Sentence
from heeltoe.warnings import Notice

#: What the silence is a multiple of, where the dam comes to rest before it is over [s].
STEP = 2.5

T = TypeVar("T")


def until_rest(
    run: Callable[[Earthquake], T],
    reach: Callable[[T], float],
    earthquake: Earthquake,
    most: float,
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
    most
        How much silence there may be [s].
    swings
        Whether what shakes the dam goes on in the silence, as a crack on an elastic part does: a dam that is at rest
        when the ground is may slide once more.
    """
    found = run(earthquake)
    rests = reach(found) < math.inf
    if earthquake.silence >= most or (rests and not (swings and reach(found) > -math.inf)):
        return found
    whole = run(earthquake.silent(most))
    needed = reach(whole) - earthquake.end
    if rests and needed <= earthquake.silence:
        return found
    seconds = STEP * max(1.0, math.ceil(needed / STEP)) if math.isfinite(needed) else most
    if not earthquake.silence < seconds < most:
        return whole
    found = run(earthquake.silent(seconds))
    # The steps of an elastic dam are now a ten-thousandth longer or shorter, which matters to one that bounces.
    return found if reach(found) < math.inf else whole


def reach_of_block(response: Response) -> float:
    """Return what :func:`until_rest` asks of the run of a block."""
    return rests_from(response) if response.outcome == "ok" else -math.inf


def about_the_end(response: Response, *, asked: bool) -> Iterator[Notice]:
    """Say where the dam is not at rest when its run ends, or, where the case has `asked` for a silence, that there was
    no need to wait."""
    if response.outcome != "ok" or comes_to_rest(response):
        if asked and not response.silence_s:
            ended = "nothing moves when the ground motion ends" if response.outcome == "ok" else "the run ends before"
            yield Notice("fields-idle", field="analysis.silence", fields="analysis.silence", why=ended)
        return
    when = Sentence("when the ground motion ends")
    if response.silence_s:
        when = Sentence.of("{silence_s:g s} after the ground motion has ended", silence_s=response.silence_s)
    end = response.end_time_s
    if not response.elastic:
        yield Notice(
            "block-still-moves",
            time_s=end,
            when=when,
            mode=response.final_mode,
            slip_velocity_m_s=response.final_slip_velocity_m_s,
        )
        return
    last = last_of(response)
    span = "second" if last.seconds == 1.0 else f"{last.seconds:.2g} s"
    yield Notice("dam-still-moves", time_s=end, when=when, span=span, what=last.what, change_m=last.change_m)
