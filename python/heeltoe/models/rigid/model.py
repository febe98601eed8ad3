"""The rigid model: case -> block -> kernel -> response."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.case.model import Case
from heeltoe.case.shaking import resolve
from heeltoe.case.warnings import case_warnings
from heeltoe.errors import InputError
from heeltoe.mechanics.block import Block, build_block, static_state
from heeltoe.models.rigid.tables import energy_of, events_of, histories_of, summary_of
from heeltoe.models.rigid.varying import varies
from heeltoe.models.rigid.walk import GroundSeries, run_block
from heeltoe.models.rigid.warnings import advice_of, warnings_of
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.references import cited
from heeltoe.result.limits import check_limits
from heeltoe.result.response import Response

Floats = NDArray[np.float64]


def rigid(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    rotation: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> Response:
    """Run the rigid model on a case: exactly between events, or where loads or geometry change as the block moves by
    integration between them.

    Parameters
    ----------
    case
        Dam, crack, water and earthquake.
    motion, vertical
        Ground motions to use, as they are, instead of the case's [m/s2, downstream and upward].
    rotation
        Rotation of the ground about the middle of the crack, counter-clockwise [rad/s2].
    output_step
        Spacing of the histories [s]; at the record's samples where it is not given. It does not change the motion
        that is computed, which is exact between events.

    Returns
    -------
    Response

    Raises
    ------
    InputError
        Where the case has no motion, or one that cannot be used.
    """
    if motion is None:
        if case.motion is None:
            raise InputError("motion-missing", "motion")
        motion, vertical = resolve(case.motion, case.gravity, case.base_directory)
    block = build_block(case)
    end = case.motion.duration if case.motion and case.motion.duration else motion.duration
    shaking = GroundSeries.of(motion, vertical, rotation, end)
    moments = _moments(shaking.time, output_step)
    summary_row, history, modes, event_rows, tension = run_block(case, block, shaking, moments)
    raw = dict(zip(_kernel.SUMMARY_FIELDS, summary_row.tolist(), strict=True))
    outcome = _kernel.OUTCOMES[int(raw["outcome"])]
    started = outcome != "unstable"
    moments = moments[: modes.size]
    summary = summary_of(case, raw, block, tension) if started else {}
    return Response(
        model="rigid",
        title=case.title,
        outcome=outcome,
        advice=advice_of(outcome, raw, block),
        warnings=(*case_warnings(case), *motion.warnings, *warnings_of(case, raw, outcome, block, tension)),
        summary=summary,
        energy=energy_of(raw) if started else None,
        motion=motion,
        vertical=vertical,
        gravity=case.gravity,
        histories=histories_of(case, moments, history, shaking, block) if started else {},
        mode=tuple(_kernel.MODES[m] for m in modes) if started else (),
        event_log=events_of(event_rows),
        static=static_state(block),
        references=_references(case, block),
        limits=check_limits(case.limits, summary) if started else (),
    )


def _moments(time: Floats, step: float | None) -> Floats:
    if step is None:
        return np.unique(time)
    if not 0.0 < step <= time[-1]:
        raise InputError("output-step", "output_step", f"{step:g} s", duration=f"{time[-1]:g} s")
    return np.arange(int(np.floor(time[-1] / step * (1.0 + 1e-12))) + 1, dtype=np.float64) * step


def _references(case: Case, block: Block) -> tuple[str, ...]:
    keys = ["rigid", "rocking"] + (["water"] if block.water.mass else [])
    if case.analysis.rotation != "small":
        keys.append("overturning")
    if case.uplift.during_shaking != "constant":
        keys.append(case.uplift.during_shaking)
    if varies(case):
        keys.append("integration")
    return cited(*keys)
