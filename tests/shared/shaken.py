"""Short runs of the flexible model, for what is made of their frames."""

from __future__ import annotations

import numpy as np

from heeltoe import GroundMotion, flexible
from shared.dams import BASE, COARSE, ENDS, HEIGHT, plane_case

SMALL = [*COARSE, "motion.duration=2s", ENDS]
EXAMPLES = {"base": BASE, "height": HEIGHT}


def shaken(name, *changes, output_step=None):
    """Run an example coarsely, with 2 s of shaking that make it slide both ways and open."""
    time = np.linspace(0.0, 2.0, 201)
    motion = GroundMotion("sine", time, 7.0 * np.sin(2.0 * np.pi * 2.5 * time))
    return flexible(plane_case(EXAMPLES[name], [*SMALL, *changes]), motion, output_step=output_step)
