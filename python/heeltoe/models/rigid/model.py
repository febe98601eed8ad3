"""The rigid model: case -> block -> kernel -> response."""

from __future__ import annotations

import numpy as np

from heeltoe.base.arrays import Floats, among, distinct
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.block import Block, build_block
from heeltoe.models.rigid.tables import crack_response, crest_looks, energy_of, references_of, with_crest
from heeltoe.models.rigid.walk import walk_with_drainage
from heeltoe.models.rigid.warnings import advice_of_block, warnings_of
from heeltoe.models.runner import largest_rotation, leaves
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.outcome import Outcome, decide
from heeltoe.result.response import Response


def run_rigid(
    case: Case,
    earthquake: Earthquake,
    output_step: float | None = None,
    block: Block | None = None,
    *,
    crest: bool = True,
) -> Response:
    """Run the rigid model on a case: exactly between events, or where loads or geometry change as the block moves by
    integration between them.

    Parameters
    ----------
    case
        Dam, crack and water.
    earthquake
        What shakes the crack.
    output_step
        Spacing of the histories [s]; where it is not given at the record's samples, and between those that are more
        than 0.02 s apart.
    block
        Of the case, where it has been built before.
    crest
        Whether the motion of the crest is wanted.

    Raises
    ------
    InputError
        Where the spacing cannot be used.
    """
    block = block or build_block(case)
    shaking = earthquake.shaking
    seen = moments_of(earthquake, output_step)
    moments = with_looks(seen, shaking.time[-1]) if crest else seen
    shown = among(moments, seen)
    run, drainage = walk_with_drainage(case, block, shaking, moments, whole=shown)
    moments, shown = moments[: len(run.places)], shown[: len(run.places)]
    end = run.summary.end_time
    if run.outcome == Outcome.OVERTURNED and moments[-1] < end:
        # Where it lies is between two moments: the last one is that just before, which a walk still passes.
        moments, shown = np.append(moments, np.nextafter(end, 0.0)), np.append(shown, True)
        run, drainage = walk_with_drainage(case, block, shaking, moments, whole=shown)
        # A walk that ends there all the same has no state at the last moment.
        moments[-1] = end
        moments, shown = moments[: len(run.places)], shown[: len(run.places)]
    row = run.summary.by_name()
    rotation, off = float(largest_rotation(row)), bool(leaves([row], [block.width]))
    outcome = decide(run.outcome, rotation=rotation, finite=case.analysis.rotation == "finite", off=off)
    started = outcome is not Outcome.UNSTABLE
    crack = crack_response(case, block, shaking, moments[shown], run, started=started, drainage=drainage)
    cracks, top = with_crest([crack], [block], [run], shaking, moments, shown) if crest else ([crack], None)
    return Response(
        model="rigid",
        title=case.title,
        outcome=outcome,
        advice=advice_of_block(block, run, outcome, rotation),
        warnings=tuple(warnings_of(case, block, run)),
        energy=energy_of(run) if started else None,
        motion=earthquake.motion,
        vertical=earthquake.vertical,
        cross=earthquake.cross,
        gravity=case.gravity,
        cracks=tuple(cracks),
        crest=top,
        references=references_of(case, block, run),
        silence_s=earthquake.silence,
    )


def with_looks(moments: Floats, end: float) -> Floats:
    """Return moments of histories up to an end [s] with those at which the crest is looked at."""
    return distinct(np.concatenate([moments, crest_looks(end)]))


#: Moments that a history may have: each takes some 200 bytes, here and in the file.
MOST_MOMENTS = 2_000_000
# In the silence after it there are samples as far apart as those of the record, within these bounds [s].
_SHORTEST_STEP, _LONGEST_STEP = 0.005, 0.02


def moments_of(earthquake: Earthquake, step: float | None) -> Floats:
    """Return the moments of the histories [s]: so far apart, or the samples of the record, and others between those
    that are far apart."""
    time = earthquake.shaking.time
    if step is None:
        gaps = np.diff(time)
        coarse = np.flatnonzero((gaps > _LONGEST_STEP * (1.0 + 1e-9)) & (time[:-1] < earthquake.end))
        if not earthquake.silence and not coarse.size and np.all(gaps > 0.0):
            return time
        # Between points that are far apart a block may rock and come to rest.
        ends = np.minimum(time[1:], earthquake.end)
        between = [np.arange(time[k], ends[k], _SHORTEST_STEP)[1:] for k in coarse.tolist()]
        spacing = float(np.clip(earthquake.motion.dt, _SHORTEST_STEP, _LONGEST_STEP))
        after = np.arange(earthquake.end, earthquake.run_end, spacing)
        return distinct(np.concatenate([time, *between, after]))
    if not 0.0 < step <= time[-1]:
        raise InputError("out-of-range", "output_step", f"{step:g} s", bound=f"above 0 s and up to {time[-1]:g} s")
    if time[-1] / step > MOST_MOMENTS:
        raise InputError("too-many", "output_step", f"{time[-1] / step:.3g} moments", most=f"{MOST_MOMENTS:.3g}")
    return np.arange(int(np.floor(time[-1] / step * (1.0 + 1e-12))) + 1, dtype=np.float64) * step
