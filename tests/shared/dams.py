"""Where things are, and dams, motions and short runs that several tests use."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from heeltoe import Case
from validation.sources import on_rigid_plane as on_rigid_plane
from validation.sources import plane_case as plane_case

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
STUDIES = sorted((EXAMPLES / "studies").glob("*.toml"))
ALL_EXAMPLES = sorted(set(EXAMPLES.rglob("*.toml")) - set(STUDIES))
BASE, HEIGHT, KOYNA, KOYNA_TOP, BLOCK, SLENDER = (
    EXAMPLES / f"{name}.toml" for name in ("typical-base", "typical-height", "koyna", "koyna-top", "block", "slender")
)

# Corners [m]. The typical dam is that of the thesis, as it stands in examples/typical-base.toml.
TYPICAL = [(0.0, 0.0), (80.0, 0.0), (8.0, 90.0), (8.0, 100.0), (0.0, 100.0)]
TRIANGLE = [(0.0, 0.0), (80.0, 0.0), (0.0, 100.0)]
RECTANGLE = [(0.0, 0.0), (8.0, 0.0), (8.0, 12.0), (0.0, 12.0)]

# The same as a case says it, and a plainer one.
TYPICAL_SECTION = {
    "height": "100 m",
    "crest_width": "8 m",
    "neck_height": "90 m",
    "neck_width": "8 m",
    "base_width": "80 m",
}
PLAIN = {
    "section": {"height": "100 m", "crest_width": "10 m", "base_width": "80 m"},
    "crack": {"elevation": "0 m", "friction": 1.0},
}
PULSE = {"points": [["0 s", "0.8 g"], ["0.1 s", "0.8 g"], ["0.1 s", "0 g"], ["0.4 s", "0 g"]]}

# An elastic dam of few elements, without the second run that shows convergence; and of a short earthquake.
COARSE = ["flexible.elements_across=2", "flexible.evidence=none"]
# Runs that end with the motion, whether all is at rest then or not.
ENDS = "analysis.silence=0s"
FAST = [*COARSE, "motion.duration=3s", ENDS]
# Koyna by the decoupled chain.
SHORT = ["flexible.elements_across=3", "motion.duration=4s", ENDS]


def example(name: str, *changes: Any) -> Case:
    """Return an example with changes as on the command line, on a rigid plane and before water without sound where it
    says nothing of them: the simplest dam that has what is tested."""
    return plane_case(EXAMPLES / f"{name}.toml", list(changes))


def polygon(corners: Iterable[tuple[Any, Any]]) -> dict[str, Any]:
    """Return the section of a case from its corners [m]."""
    return {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]}
