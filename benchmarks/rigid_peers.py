"""Error beside time of ours and of named peers, on problems that both can solve."""

from __future__ import annotations

from importlib import import_module

import one_way
import peer_newmark
from measure import heading, require, table
from push_and_sine import EXACT, OUR_STEPS, STEPS, Attempt, ours, rows

from heeltoe.kernel.build import PROFILE

COLUMNS = ["program", "settings", "step", "largest error", "relative", "time per run", "times ours at no larger error"]


def engines() -> str:
    """Measure the push-and-sine block and return Markdown."""
    own = [ours(step) for step in OUR_STEPS]
    _, remarks = peer_newmark.programs()
    best: list[Attempt] = peer_newmark.attempts()
    for name in ("peer_mujoco", "peer_pybullet"):
        try:
            peer = import_module(name)
        except ImportError as reason:
            remarks.append(f"Not measured: {name.removeprefix('peer_')} ({reason}).")
            continue
        # Of all settings the most exact one at that step, and the quickest where it is another.
        for step in STEPS:
            tried = peer.attempts(step)
            exact, quick = min(tried, key=lambda a: a.error), min(tried, key=lambda a: a.timing.median)
            best += [exact] if exact is quick else [exact, quick]
    text = (
        f"Push-and-sine block, exact slip {EXACT[-1]:.10f} m after 5 s. Errors are the largest at any tenth of a "
        "second, relative to the slip in the end. Each engine has the setting with the smallest error at each step, "
        "and the quickest if that is another."
    )
    return "\n\n".join([text, table(COLUMNS, rows(own, best)), *remarks])


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    packages = ["heeltoe", "pyslammer", "numba", "mujoco", "pybullet", "numpy"]
    return "\n\n".join([heading("Rigid peers", packages), one_way.report(), engines()])


if __name__ == "__main__":
    print(report())
