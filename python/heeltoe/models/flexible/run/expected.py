"""Cost of runs of the flexible model, estimated before they begin.

A step costs 2 k m for each part of k nodes on the crack and m modes; measured as the rest of
:mod:`heeltoe.models.flexible.body.cost`."""

from __future__ import annotations

import math
from itertools import pairwise

from heeltoe.case.model import Case
from heeltoe.models.cost import Cost
from heeltoe.models.flexible.body.cost import NUMBER, building, parts_of, surroundings_of, wave_bodies
from heeltoe.models.flexible.run.dam_runner import FRAME_STEP, short_step, usual_step
from heeltoe.models.runner import STEP

#: Fewer elements along the crack than these have no coarser mesh worth a comparison.
FEWEST_ACROSS = 4
# Seconds of a step, of each 2 k m in it, and of that to the power of 3/2, as caches end.
_STEP, _ANSWERED, _FETCHED = 6e-7, 4.3e-10, 8.6e-13
# A step costs this power of how many times it is longer than the shorter one of a case.
_BY_LENGTH = 0.5
# Times as much where a friction law is found by passes, 1.7 to 4 of it.
_BY_LAW = 2.5
# Times as much where bonds soften: 1.2 to 2 of it; seconds of a step with a body with waves, measured with
# water of 100 m on one side.
_BY_BOND, _WATERED = 2.0, 3e-6
# Seconds of a step with several joints of which some soften, of the square of the forces on all of them. Measured with
# 2 to 30 joints of 2 to 8 elements, within a factor of two.
_JOINTS = 7e-9
# Bytes of a step of the ground, and of the way of the crest with its acceleration within the band; copies of a frame.
_GROUND, _CREST, _COPIES = 100.0, 30.0, 1.2
# Runs that a result takes by its evidence, in single ones, without refinement.
_RUNS = {"full": 5.0, "step": 3.0, "none": 1.0}
# The longest period of a free part in times that waves of compression take through its height.
_PERIOD = 3.1


def frame_step_of(end: float, output_step: float | None) -> float:
    """Return the spacing of the frames of a run [s]."""
    return output_step or min(FRAME_STEP, end)


def running(case: Case, end: float, frame_step: float, step: float | None = None, runs: float | None = None) -> Cost:
    """Return what the runs of a dam cost once it is built.

    Parameters
    ----------
    case
        With its evidence.
    end
        Length of a run [s].
    frame_step
        Spacing of its frames [s].
    step
        Its step [s]; about that of the program where it is not given.
    runs
        How many there are; as many as the evidence takes where it is not given.
    """
    parts = parts_of(case)
    answers = sum(2.0 * part.nodes * part.modes for part in parts)
    usual, short = _steps_of(case)
    step = step or case.flexible.time_step or usual
    steps = end / step
    seconds = steps * (_STEP * len(parts) + _ANSWERED * answers + _FETCHED * answers**1.5)
    # More contacts change in a longer one.
    seconds *= max(1.0, step / short) ** _BY_LENGTH
    cracks = (case.crack, *case.further_cracks)
    if any(crack.law is not None for crack in cracks):
        seconds *= _BY_LAW
    joints = sum(crack.bond is not None for crack in cracks)
    if joints:
        seconds *= _BY_BOND
    if joints > 1:
        forces = joints * 2.0 * (2.0 * case.flexible.elements_across + 1.0)
        seconds = max(seconds, steps * _JOINTS * forces**2)
    seconds += steps * _WATERED * wave_bodies(case)
    frame = 16.0 + sum(part.modes + 6.0 * part.nodes for part in parts)
    frames = min(steps, end / frame_step) * frame * NUMBER * _COPIES
    seconds *= _RUNS[case.flexible.evidence] if runs is None else runs
    return Cost(seconds, (_GROUND + _CREST) * steps + frames)


def analysing(
    case: Case, end: float, frame_step: float, step: float | None = None, *, silence: float = 0.0, spread: int = 0
) -> Cost:
    """Return what a result of the flexible model costs, without refinement.

    Parameters
    ----------
    case, end, frame_step, step
        As :func:`running` takes them.
    silence
        How long the run may go on through silence [s]. Most dams still move a little when the motion ends: the run goes
        on from where it is, one by penalties begins anew.
    spread
        How many runs with the shaking varied follow.
    """
    around, counted = surroundings_of(case), _RUNS[case.flexible.evidence] + spread
    parts = building(parts_of(case), around)
    if case.flexible.evidence == "full":
        # Rock and water are made once more so that they reach farther, and for the coarser mesh of a fine one.
        parts += Cost(2.0 * around.seconds, around.memory)
    if case.flexible.evidence == "full" and case.flexible.elements_across < FEWEST_ACROSS:
        finer = with_mesh(case, 1)
        parts += building(parts_of(finer), surroundings_of(finer))
    runs = [running(case, end + min(silence, STEP), frame_step, step, counted)]
    if case.surroundings.assumed and case.flexible.evidence != "none":
        parts, others = _on_other_rock(case, parts, end + min(silence, STEP), frame_step, step)
        runs.append(others)
    if silence:
        again = end if case.flexible.contact == "idce" else 0.0
        runs.append(running(case, again + silence, frame_step, step, 1.0))
    return Cost(parts.seconds + sum(run.seconds for run in runs), parts.memory + max(run.memory for run in runs))


def _on_other_rock(case: Case, parts: Cost, end: float, frame_step: float, step: float | None) -> tuple[Cost, Cost]:
    """Return what building costs with three dams on other rock than is assumed, two of them at once, and their runs.
    Stiffer rock has the shapes of the assumed one, softer rock those of the rock that full evidence asks for."""
    assert case.foundation is not None
    dams = [case.on_rock(factor * case.foundation.modulus) for factor in (0.5, 2.0)] + [case.on_rigid_plane()]
    built = [building(parts_of(dam), surroundings_of(dam)) for dam in dams]
    runs = [running(dam, end, frame_step, step, 1.0) for dam in dams]
    known = sum(surroundings_of(dam).seconds for dam in dams[: 2 if case.flexible.evidence == "full" else 1])
    seconds, beside = sum(cost.seconds for cost in built) - known, max(cost.memory for cost in built)
    return (
        Cost(parts.seconds + seconds, parts.memory + beside),
        Cost(sum(run.seconds for run in runs), 2.0 * max(run.memory for run in runs)),
    )


def _steps_of(case: Case) -> tuple[float, float]:
    """Return about the step that the program will choose, and that of runs that scatter [s]."""
    speed = math.sqrt((case.concrete.modulus or math.inf) / case.concrete.density)
    _, base, _, crest = case.outline.bounds
    levels = sorted({crack.elevation for crack in (case.crack, *case.further_cracks)})
    # The lowest part vibrates fastest.
    lowest = min(top - foot for foot, top in pairwise([*levels, crest - base]))
    period = _PERIOD * lowest / speed
    return usual_step(case, period), short_step(case, period)


def with_mesh(case: Case, mesh: int) -> Case:
    """Return the case with its elements along the crack doubled `mesh` times; -1 for half of them, rounded up."""

    def changed(across: int) -> int:
        return math.ceil(across * 2.0**mesh)

    names = ("elements_across", "elements_across_below", "elements_away")
    counts = {name: getattr(case.flexible, name) for name in names}
    update = {name: None if count is None else changed(count) for name, count in counts.items()}
    return case.model_copy(update={"flexible": case.flexible.model_copy(update=update)})
