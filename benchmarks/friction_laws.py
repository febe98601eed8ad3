"""What a friction law, rotations of any size and uplift that follows the opening cost a rigid dam, beside a constant
coefficient; `--page` writes the table of results.md into docs/real-cracks.md."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

from measure import heading, require, seconds, table
from problems import el_centro
from short import RESULTS, rows

from heeltoe import build_block, read_case
from heeltoe.case.model import Case
from heeltoe.kernel.build import PROFILE
from heeltoe.models.rigid.walk import walk
from heeltoe.motion.earthquake import Earthquake

TITLE = "Friction laws"
EXAMPLES = Path(__file__).parents[1] / "examples"
PAGE = Path(__file__).parents[1] / "docs" / "real-cracks.md"
BEGINS, ENDS = "<!-- costs: python benchmarks/friction_laws.py --page -->\n", "<!-- end of costs -->\n"
WEAKENING = {"name": "slip weakening", "peak_friction": 1.1, "residual_friction": 0.9, "slip": "20 mm"}
BOND = {"name": "cohesion", "cohesion": "0.3 MPa", "residual_friction": 0.9}
ROUGH = {"asperity_height": "20 mm", "wave_length": "200 mm"}
#: The row with which the others are compared; how often all are run in turn, and how often each is then.
CONSTANT, TURNS, CALLS = "constant, 0.9", 15, 50
LAWS: dict[str, dict[str, Any]] = {
    "slip weakening, linear": {"law": WEAKENING},
    "slip weakening, exponential": {"law": {**WEAKENING, "form": "exponential"}},
    "cohesion, brittle": {"law": BOND},
    "cohesion, lost over 20 mm": {"law": {**BOND, "slip": "20 mm"}},
    "speed weakening": {
        "law": {"name": "speed weakening", "peak_friction": 1.1, "residual_friction": 0.9, "speed": "0.1 m/s"}
    },
    "barton-bandis": {"law": {"name": "barton-bandis", "jrc": 10, "jcs": "20 MPa", "residual_angle": "32 deg"}},
    "rough": {"friction": 0.7, "roughness": ROUGH},
    "rough, wearing": {"friction": 0.7, "roughness": {**ROUGH, "wear": "1e-6 m^2/J"}},
}
#: A dam that lies as it slides, and one that rocks and bounces; what may change as they move.
DAMS = {"typical-base, lies": ("typical-base", "0.9", 0.4), "koyna-top, bounces": ("koyna-top", "1.0", 0.6)}
CHANGES: dict[str, list[str]] = {
    "nothing": [],
    "rotation, p-delta": ["analysis.rotation=p-delta"],
    "rotation, finite": ["analysis.rotation=finite"],
    "uplift, follows opening": ["uplift.during_shaking=follows opening"],
    "uplift, zero while open": ["uplift.during_shaking=zero while open"],
    "uplift, full while open": ["uplift.during_shaking=full while open"],
}
HEADS = (["law", "a run", "times a constant's run", "slip"], ["dam", "changes", "a run", "times", "impacts", "slip"])


def _case(crack: dict[str, Any]) -> Case:
    fields = read_case(EXAMPLES / "typical-base.toml").model_dump(mode="json", exclude_unset=True)
    del fields["crack"]["friction"]
    fields["crack"] |= crack
    return read_case(fields)


def _run(case: Case, peak: float) -> tuple[Callable[[], Any], Any]:
    """Return a run without histories at a peak acceleration [g], and its summary."""
    motion = el_centro()[0].scaled_to(peak * 9.80665)
    block, shaking = build_block(case), Earthquake(motion, None, motion.duration).shaking
    summary = walk(case, block, shaking).summary
    require(summary.slip > 1e-3, "the dam did not slide")
    return lambda: walk(case, block, shaking), summary


def _taken(work: Callable[[], Any]) -> float:
    """Return the processor time of a call [s]."""
    start = time.process_time()
    for _ in range(CALLS):
        work()
    return (time.process_time() - start) / CALLS


def _measured(runs: dict[str, tuple[Callable[[], Any], Any]], plain: str) -> dict[str, list[str]]:
    """Return for each of some runs how long it takes, and in multiples of the `plain` one."""
    taken: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(TURNS):
        for name, (work, _) in runs.items():
            taken[name].append(_taken(work))
    ratios = {name: median([own / one for own, one in zip(taken[name], taken[plain], strict=True)]) for name in runs}
    return {
        name: [seconds(min(taken[name])), f"{ratios[name]:.2g}" if ratios[name] < 10.0 else f"{ratios[name]:.0f}"]
        for name in runs
    }


def _laws() -> str:
    laws = {CONSTANT: {"friction": 0.9}, **LAWS}
    runs = {name: _run(_case(crack), 0.4) for name, crack in laws.items()}
    costs = _measured(runs, CONSTANT)
    return table(HEADS[0], [[name, *costs[name], f"{1e3 * run.slip:.0f} mm"] for name, (_, run) in runs.items()])


def _changes() -> str:
    lines = []
    for dam, (example, friction, peak) in DAMS.items():
        case = f"{EXAMPLES / example}.toml"
        runs = {
            name: _run(read_case(case, [f"crack.friction={friction}", *fields]), peak)
            for name, fields in CHANGES.items()
        }
        costs = _measured(runs, "nothing")
        for name, (_, run) in runs.items():
            lines.append([dam, name, *costs[name], f"{run.impacts:.0f}", f"{1e3 * run.slip:.1f} mm"])
    return table(HEADS[1], lines)


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    return "\n\n".join(
        [
            heading(TITLE, ["heeltoe", "numpy"]),
            "The typical dam as a rigid block, 30 s of El Centro 1940 at 0.4 g: a run without histories, the least "
            f"processor time of {TURNS} turns; the multiple is the median over the turns. Weakening laws and bonds "
            "come to the constant coefficient of the first row.",
            _laws(),
            "The typical dam and, at 0.6 g, the top of Koyna Dam with a constant coefficient, where rotation or uplift "
            "change something as they move; multiples of a run in which nothing does.",
            _changes(),
        ]
    )


def page(text: str, results: str) -> str:
    """Return a page with the costs that results have."""
    measured = rows(results, TITLE)
    head = HEADS[0]
    laws = table(head, [[row[name] for name in head] for row in measured if head[0] in row])
    before, rest = text.split(BEGINS)
    return f"{before}{BEGINS}\n{laws}\n\n{ENDS}{rest.split(ENDS)[1]}"


def renew() -> None:
    """Write the costs of results.md into the page."""
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8"), RESULTS.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    if "--page" in sys.argv:
        renew()
    else:
        print(report())
