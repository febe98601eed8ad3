"""Work that no command does, for other_build.py: run by the interpreter of either version, with its heeltoe.

It takes an order in JSON and writes the processor time of the work, without the start of the interpreter and the
building of the dam, and what came out of it. It uses what both versions have.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable
from typing import Any

# All that a run does is counted, not how threads of the matrices wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from heeltoe import build_flexible_dam, read_case, rigid_many
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake

#: Spacing of the histories of a run [s].
FRAME_STEP = 0.01


def shaken(order: dict[str, Any]) -> ShakenDam:
    """Return the elastic dam of a case with its earthquake, ready to run."""
    case = read_case(order["case"]).with_(order["set"])
    dam = ShakenDam(case, build_flexible_dam(case), earthquake(case).shaking)
    dam.run_scaled(dam.first_step(), np.array([0.0]))  # what is made at first use is not counted
    return dam


def eight(order: dict[str, Any]) -> dict[str, Any]:
    """Run one elastic dam at several scales of its motion: their numbers, or with `histories` one run for each."""
    dam = shaken(order)
    step, scales = dam.first_step(), np.array(order["scales"])

    def work() -> list[float]:
        if order["histories"]:
            return [dam.run(step, FRAME_STEP, factor=factor).summary.slip for factor in scales]
        return [float(slip) for slip in dam.run_scaled(step, scales)["slip"]]

    return timed(work) | {"step": step}


def blocks(order: dict[str, Any]) -> dict[str, Any]:
    """Slide many flat blocks."""
    from problems import LIMITS, G, rectangle, taft

    motion, draw, count = taft(), np.random.default_rng(1), order["count"]
    drawn = np.tile(rectangle(100.0, 1.0, 2400.0, 1.0), (count, 1))
    at = [k for k, value in enumerate(rectangle(0.0, 0.0, 0.0, 7.0)) if value == 7.0]
    drawn[:, at] = draw.uniform(0.05, 0.6, (count, 1))
    scales = draw.uniform(0.1, 1.0, count) * G / motion.pga
    work = lambda: rigid_many(drawn, [motion], scales=scales, limits=LIMITS, threads=1)["slip"].tolist()  # noqa: E731
    work()
    return timed(work)


def timed(work: Callable[[], list[float]]) -> dict[str, Any]:
    """Return the processor time of a piece of work and the slips that it returns."""
    began = time.process_time()
    slips = work()
    return {"seconds": time.process_time() - began, "slips": slips}


if __name__ == "__main__":
    order = json.loads(sys.argv[1])
    print(json.dumps({"eight": eight, "blocks": blocks}[order["do"]](order)))
