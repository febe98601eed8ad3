"""How much a result depends on the last per cent of the shaking: the same run, slightly weaker and stronger."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError, expect
from heeltoe.kernel.block import OUTCOMES, run_blocks
from heeltoe.kernel.dam import DAM_OUTCOMES
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block, build_block
from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.drain_closure import follows_drains, run_drained
from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.models.rigid.stack import walk_two_blocks
from heeltoe.models.rigid.tables import with_openings
from heeltoe.models.rigid.varying import by_itself
from heeltoe.models.rigid.walk import limits_of, walk
from heeltoe.models.run import earthquake
from heeltoe.models.runner import outcomes_of
from heeltoe.motion.ground_motion import Part
from heeltoe.result.contract import HEADLINES, JOINT_METER_M, RESIDUAL_SLIP, headlines
from heeltoe.result.numbers import Spread, Statistics
from heeltoe.result.response import Response
from heeltoe.warnings.notice import Notice

if TYPE_CHECKING:
    from heeltoe.models.flexible.run.dam_runner import ShakenDam

Progress = Callable[[int, int], None]
R = TypeVar("R", bound=Response)

#: Runs where no number is given: enough for a standard deviation, and one of them has the motion as it is.
RUNS = 11
_FEWEST, _MOST = 2, 1000
#: Factors on the ground motion, from the weakest to the strongest: no record and no site is known better than that.
WEAKEST, STRONGEST = 0.99, 1.01
#: Where half the step changed the slip by less than this, the longer step is good enough for a spread.
_SAME = 0.01
#: A standard deviation of the slip above this part of its mean is said as a warning.
_LARGE = 0.10


def check_runs(value: object, field: str) -> int:
    """Return the number of runs that `value` means.

    Raises
    ------
    InputError
        Where it is no whole number from 2 to 1000.
    """
    text = str(value).strip()
    if not (text.isascii() and text.isdigit() and _FEWEST <= int(text[:9]) <= _MOST):
        raise InputError("out-of-range", field, value, bound=f"from {_FEWEST} to {_MOST}, or none for {RUNS}")
    return int(text)


def with_spread(response: R, case: Case, runs: int = RUNS, *, progress: Progress | None = None) -> R:
    """Run a case again with its ground motion scaled by equally spaced factors from 0.99 to 1.01.

    Parameters
    ----------
    response
        Of :func:`heeltoe.rigid`, :func:`heeltoe.decoupled` or :func:`heeltoe.flexible`, which says the model and the
        motion.
    case
        What it is the response of.
    runs
        How many, 2 to 1000; they run on all cores.
    progress
        Called with how many runs are done, and of how many, as they go on.

    Returns
    -------
    Response
        The same with `spread`, and a warning where the slip varies much or runs end without a result. In `spread`:
        `runs`, `failed` (without a result; they count nowhere else), `scales`, `residual_slips_m` (None where failed),
        `time_step_s` of the flexible model, and for each of the headline numbers mean, std (of a sample), min and max.

    Raises
    ------
    InputError
        Where the number of runs cannot be used.
    """
    expect(case, Case, "a case", "case")
    expect(response, Response, "a response", "response")
    runs = check_runs(runs, "runs")
    scales = np.linspace(WEAKEST, STRONGEST, runs)
    ground = earthquake(case, response.motion, response.vertical).silent(response.silence_s)
    ground = replace(ground, cross=response.cross)
    step = None
    if isinstance(response, FlexibleResponse):
        # Here, so that the block need not wait for the elastic parts.
        from heeltoe.models.flexible.run.dam_runner import ShakenDam

        step = _step(response)
        shaken = ShakenDam(case, response.crack.dam, ground.shaking)
        # With drains that slip closes, each run finds those that its own slips leave.
        parts = ground.motion.parts if follows_drains(case, ground) else None
        columns, good = _flexible(shaken, parts, scales, step, response.asked, progress)
    elif isinstance(response, DecoupledResponse):
        from heeltoe.models.decoupled.model import crack_earthquake

        # The part below is linear: its motion grows as the ground's does.
        columns, good = _rigid(case, crack_earthquake(case, ground).shaking, scales, 0, progress)
    else:
        columns, good = _rigid(case, ground.shaking, scales, response.asked, progress)
    spread = Spread(
        runs=runs,
        failed=int(np.sum(~good)),
        scales=scales.tolist(),
        time_step_s=step,
        **{headline.key: _statistics(columns[headline.key][good]) for headline in HEADLINES},
        residual_slips_m=[
            float(slip) if fine else None for slip, fine in zip(columns[RESIDUAL_SLIP.key], good, strict=True)
        ],
    )
    return replace(response, spread=spread, warnings=(*response.warnings, *_warnings(spread)))


_Headlines = tuple[dict[str, Floats], NDArray[np.bool_]]


def _rigid(case: Case, shaking: Shaking, scales: Floats, leads: int, progress: Progress | None) -> _Headlines:
    """Return the headline numbers of a block above the crack that `leads`, and which of the runs have a result."""
    block, width = build_block(case), build_block(case.single_crack_cases[leads]).width
    if by_itself(case) or shaking.turning is not None or shaking.cross is not None or case.further_cracks:
        rows = _walked(case, block, shaking, scales, leads, progress)
    else:
        many = np.tile(block.parameters(), (scales.size, 1))
        first = np.zeros(scales.size, dtype=np.int64)
        rows = run_blocks(many, [shaking], first, np.column_stack([scales, scales]), limits_of(case))
        if progress is not None:
            progress(scales.size, scales.size)
    columns = with_openings(headlines(rows), case, np.full(scales.size, width))
    return columns, _trusted(rows, OUTCOMES, width, finite=case.analysis.rotation == "finite")


def _walked(
    case: Case, block: Block, shaking: Shaking, scales: Floats, leads: int, progress: Progress | None
) -> dict[str, Floats]:
    """Run a block that only integration can follow, once for each factor."""
    rows = []

    def run(scale: float) -> Mapping[str, float]:
        if case.further_cracks:
            return walk_two_blocks(case, shaking.scaled(scale))[1].cracks[1 - leads].summary.by_name()
        return walk(case, block, shaking.scaled(scale)).summary.by_name()

    # The kernel lets go of the interpreter.
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for done, row in enumerate(pool.map(run, scales.tolist())):
            if progress is not None:
                progress(done, scales.size)
            rows.append(row)
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def _flexible(
    shaken: ShakenDam,
    parts: Sequence[Part] | None,
    scales: Floats,
    step: float,
    leads: int,
    progress: Progress | None,
) -> _Headlines:
    """Return the headline numbers of an elastic dam at the crack that `leads`, and which of the runs have a result;
    `parts` are the motions of a sequence between which its drains close."""
    if parts is not None:
        rows = run_drained(shaken, parts, step, scales)
    elif progress is None:
        rows = shaken.run_scaled_cracks(step, scales)[leads]
    else:
        # In parts of one run for each core, so that there is something to tell.
        cores, some = os.cpu_count() or 1, []
        for start in range(0, scales.size, cores):
            progress(start, scales.size)
            some.append(shaken.run_scaled_cracks(step, scales[start : start + cores])[leads])
        rows = {name: np.concatenate([part[name] for part in some]) for name in some[0]}
    return headlines(rows), _trusted(rows, DAM_OUTCOMES, shaken.dam.sections[leads].crack_width, finite=False)


def _trusted(rows: Mapping[str, Floats], names: Sequence[str], width: float, *, finite: bool) -> NDArray[np.bool_]:
    """Return which of the runs have a result."""
    words = [names[place] for place in rows["outcome"].astype(np.int64).tolist()]
    return np.array([outcome.has_result for outcome in outcomes_of(words, [rows], [width], finite=finite)])


def _step(response: FlexibleResponse) -> float:
    """Return the step of the runs: the longer of the two that the response compared where they hardly differ."""
    evidence = response.evidence
    if evidence is not None:
        slip, longer = evidence.residual_slip_m, evidence.other_time_step_s
        if slip.step <= _SAME * max(abs(slip.value), JOINT_METER_M / _SAME):
            return max(longer, response.time_step_s)
    return response.time_step_s


def _statistics(values: Floats) -> Statistics | None:
    """Return mean, standard deviation and extremes; None of fewer than two values."""
    if values.size < 2:
        return None
    return Statistics(
        mean=float(values.mean()), std=float(values.std(ddof=1)), min=float(values.min()), max=float(values.max())
    )


def _warnings(spread: Spread) -> list[Notice]:
    notices = []
    if spread.failed:
        notices.append(Notice("slip-sensitive", "failures", failed=spread.failed, runs=spread.runs))
    slip = spread.residual_slip_m
    if slip is not None and slip.std > max(_LARGE * abs(slip.mean), JOINT_METER_M):
        notices.append(Notice("slip-sensitive", "shaking", slips_m=(slip.min, slip.max), scales=(WEAKEST, STRONGEST)))
    return notices
