"""pySLAMMER's rigid analysis: Newmark's block, which slides one way, on a record; one_way.py has the problem."""

from __future__ import annotations

import numpy as np
import pyslammer
from measure import require
from problems import Floats, G

from heeltoe import GroundMotion

require(pyslammer.constants.G_EARTH == G, "pySLAMMER has another g")


def record(motion: GroundMotion, step: float) -> pyslammer.GroundMotion:
    """Return a motion as pySLAMMER takes it, at a step [s]."""
    return pyslammer.GroundMotion(motion.resampled(step).acceleration / G, step)


def slip(motion: pyslammer.GroundMotion, yield_g: float) -> Floats:
    """Return the slip at every sample of a motion [m]."""
    return np.asarray(pyslammer.RigidAnalysis(yield_g, motion).sliding_disp)
