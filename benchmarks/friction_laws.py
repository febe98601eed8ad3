"""What a friction law costs a rigid dam, beside a constant coefficient; `--page` writes the table of results.md into
docs/real-cracks.md."""

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
EXAMPLE = Path(__file__).parents[1] / "examples" / "typical-base.toml"
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


def _case(crack: dict[str, Any]) -> Case:
    fields = read_case(EXAMPLE).model_dump(mode="json", exclude_unset=True)
    del fields["crack"]["friction"]
    fields["crack"] |= crack
    return read_case(fields)


def _run(crack: dict[str, Any]) -> tuple[Callable[[], Any], float]:
    """Return a run without histories, and the slip at its end [m]."""
    case, motion = _case(crack), el_centro()[0].scaled_to(0.4 * 9.80665)
    block, shaking = build_block(case), Earthquake(motion, None, motion.duration).shaking
    slip = walk(case, block, shaking).summary.slip
    require(slip > 1e-3, "the dam did not slide")
    return lambda: walk(case, block, shaking), slip


def _taken(work: Callable[[], Any]) -> float:
    """Return the processor time of a call [s]."""
    start = time.process_time()
    for _ in range(CALLS):
        work()
    return (time.process_time() - start) / CALLS


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    runs = {name: _run(crack) for name, crack in {CONSTANT: {"friction": 0.9}, **LAWS}.items()}
    taken: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(TURNS):
        for name, (work, _) in runs.items():
            taken[name].append(_taken(work))
    ratios = {
        name: median([own / plain for own, plain in zip(taken[name], taken[CONSTANT], strict=True)]) for name in runs
    }
    lines = [
        [
            name,
            seconds(min(taken[name])),
            f"{ratios[name]:.2g}" if ratios[name] < 10.0 else f"{ratios[name]:.0f}",
            f"{1e3 * slip:.0f} mm",
        ]
        for name, (_, slip) in runs.items()
    ]
    return "\n\n".join(
        [
            heading(TITLE, ["heeltoe", "numpy"]),
            "The typical dam as a rigid block, 30 s of El Centro 1940 at 0.4 g: a run without histories, the least "
            f"processor time of {TURNS} turns; the multiple is the median over the turns. Weakening laws and bonds "
            "come to the constant coefficient of the first row.",
            table(["law", "a run", "times a constant's run", "slip"], lines),
        ]
    )


def page(text: str, results: str) -> str:
    """Return a page with the costs that results have."""
    head = ["law", "a run", "times a constant's run", "slip"]
    costs = [[row[name] for name in head] for row in rows(results, TITLE)]
    before, rest = text.split(BEGINS)
    return f"{before}{BEGINS}\n{table(head, costs)}\n\n{ENDS}{rest.split(ENDS)[1]}"


if __name__ == "__main__":
    if "--page" in sys.argv:
        PAGE.write_text(page(PAGE.read_text(encoding="utf-8"), RESULTS.read_text(encoding="utf-8")), encoding="utf-8")
    else:
        print(report())
