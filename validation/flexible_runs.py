"""Runs of the flexible model for reference cases, and what their energy has to say."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import flexible
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.response import Response
from validation.row import Row

#: A little less, the very and a little more shaking.
SCALES = np.array([0.99, 1.0, 1.01])
#: The program warns where contact makes more than this part of the energy that goes about.
GAINED = 1e-4


class Runs:
    """Runs the flexible model and keeps the worst of the energy ledgers."""

    def __init__(self) -> None:
        self._residual = self._gained = 0.0

    def __call__(self, case: Case, motion: GroundMotion) -> Response:
        """Run a case."""
        response = flexible(case, motion)
        energy = response.energy
        assert energy is not None
        self._residual = max(self._residual, energy.residual)
        self._gained = max(self._gained, energy.gained_j / (energy.friction_j + energy.impact_j))
        return response

    def slip_mm(self, case: Case, motion: GroundMotion) -> float:
        """Run a case and return its residual slip [mm]."""
        return 1e3 * float(self(case, motion).residual_slip_m)

    def moved(self, row: Row, case: Case, motion: GroundMotion) -> Row:
        """Put beside the slip [mm] of a case what half the step and 1 % of the shaking make of it."""
        slips = scattered(case, motion)
        finer = float(_scaled(case, motion, SCALES[1:2], 0.5)[0])
        return replace(row, finer=finer, spread=(min(slips), max(slips)))

    def energy(self) -> Iterator[Row]:
        """Say what the ledgers of all runs so far leave open, and what contact has made out of nothing."""
        remark = "a slipping node that turns round"
        yield Row(
            "worst ledger, unexplained over turnover", 0.0, self._residual, 1e-9, relative=False, kind="condition"
        )
        what = "most energy made by contact, over the energy it takes"
        yield Row(what, 0.0, self._gained, GAINED, relative=False, remark=remark, kind="condition")


def scattered(case: Case, motion: GroundMotion) -> list[float]:
    """Return the slips [mm] under a little less, the very and a little more shaking."""
    return _scaled(case, motion, SCALES, 1.0)


def _scaled(case: Case, motion: GroundMotion, scales: Floats, part: float) -> list[float]:
    """Return the slips [mm] under multiples of the shaking, with a part of the step of the case."""
    step = case.flexible.time_step
    assert isinstance(step, float)
    shaken = ShakenDam(case, build_flexible_dam(case), Earthquake(motion, None, motion.duration).shaking)
    slips: list[float] = (1e3 * shaken.run_scaled(part * step, scales)["slip"]).tolist()
    return slips
