"""Style of animations: colours that readers with colour-blindness can tell apart (after Okabe and Ito)."""

from __future__ import annotations

UPPER, LOWER = "#dedcd5", "#c2bfb6"
EDGE, GRID = "#3a3a38", "#aaa8a0"
WATER, SURFACE = "#cfe5f4", "#5b9bc8"
GROUND = "#d9cbb2"
BEFORE = "#6a6a66"
ANCHOR = "#b22222"
FORCE, FORCE_CUT = "#882255", "#e08bb4"
#: By `Scene.status`, the last two of bonded joints alone; what is open is a mere rim.
STATUS = ("#ffffff", "#333333", "#0072B2", "#D55E00", "#009E73", "#F0E442")
STATUS_NAMES = ("open", "sticks", "slips downstream", "slips upstream", "intact", "softens")
MODES = {"rest": "#DDDDDD", "slide": "#56B4E9", "rock": "#E69F00", "slide-rock": "#D55E00", "drift": "#000000"}
#: By `Trace.role`; the page has them in its style sheet.
TRACES = {
    "ground": "#000000",
    "vertical": "#009E73",
    "crack": "#0072B2",
    "slip": "#0072B2",
    "heel": "#CC79A7",
    "toe": "#009E73",
}
#: Colours that say something, which no picture may lose.
SPEAKING = (*STATUS, *MODES.values(), *TRACES.values(), FORCE, FORCE_CUT, WATER, UPPER, LOWER, GROUND)
# Units of force per length of dam; others are of stress.
_FORCES = ("MN/m", "kip/ft")


def exaggeration_text(exaggeration: float) -> str:
    """Say how large displacements are drawn."""
    return "displacements drawn to scale" if exaggeration == 1.0 else f"displacements drawn × {exaggeration:g}"


def force_text(force: float, unit: str, cut: float) -> str:
    """Say what the arrow of the legend stands for."""
    what = "force on the part above" if unit in _FORCES else "stress on the part above"
    return f"{what}, {force:g} {unit}; pale where cut at {cut * force:g}"
