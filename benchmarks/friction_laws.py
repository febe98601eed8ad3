"""What a friction law costs a rigid dam, beside a constant coefficient; `--page` writes the table of results.md into
docs/real-cracks.md."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from crack_dam import least
from measure import heading, repeat, require, seconds, table
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


def _cost(crack: dict[str, Any]) -> tuple[float, float]:
    """Return the processor time of a run without histories [s], and the slip at its end [m]."""
    case, motion = _case(crack), el_centro()[0].scaled_to(0.4 * 9.80665)
    block, shaking = build_block(case), Earthquake(motion, None, motion.duration).shaking
    slip = walk(case, block, shaking).summary.slip
    require(slip > 1e-3, "the dam did not slide")
    return least(repeat(lambda: walk(case, block, shaking), 5)), slip


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    alone, plain = _cost({"friction": 0.9})
    lines = [["constant, 0.9", seconds(alone), "1", f"{1e3 * plain:.0f} mm"]]
    for name, crack in LAWS.items():
        taken, slip = _cost(crack)
        lines.append([name, seconds(taken), f"{taken / alone:.0f}", f"{1e3 * slip:.0f} mm"])
    return "\n\n".join(
        [
            heading(TITLE, ["heeltoe", "numpy"]),
            "The typical dam as a rigid block, 30 s of El Centro 1940 at 0.4 g: a run without histories, least "
            "processor time of five. Weakening laws and bonds come to the constant coefficient of the first row.",
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
