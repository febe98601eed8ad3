"""How fine the flexible runs of a study are: as fine as the evidence of one of them asks for."""

from __future__ import annotations

import math

import numpy as np

from heeltoe.models.flexible.reduced import build_flexible_dam
from heeltoe.models.flexible.refinement import answer
from heeltoe.models.flexible.shaken import ShakenDam
from heeltoe.study.plan import Pilot, Plan

#: Spacing of frames that nobody looks at [s].
_FRAMES = 1.0


def pilot_run(plan: Plan) -> Pilot:
    """Run the base case, in the motion and at the strength in the middle of the study, with the evidence that it asks
    for, and return the mesh and the step that this ends with."""
    runs = plan.runs(plan.count // 2, plan.count // 2 + 1)
    ground = plan.earthquakes[int(runs.motion[0])].shaking.scaled(float(np.median(runs.factor)))
    first = ShakenDam(plan.case, build_flexible_dam(plan.case), ground)
    found = answer(first, min(_FRAMES, ground.end), plan.case.flexible.evidence)
    options = found.shaken.case.flexible
    halvings = 0 if found.evidence is None else round(math.log2(first.first_step() / found.evidence.time_step))
    return Pilot(
        options.elements_across,
        options.elements_across_below,
        halvings,
        None if found.evidence is None else found.evidence.to_json(),
    )
