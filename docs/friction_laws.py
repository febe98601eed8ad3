"""Print the table of docs/friction.md, the effect of each law on the typical dam on a rigid plane:
`python docs/friction_laws.py`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from heeltoe import flexible, read_case, rigid
from heeltoe.result.response import Response

LAWS: dict[str, dict[str, Any]] = {
    "constant, 1.2": {"crack.friction": 1.2},
    "constant, 1.0": {"crack.friction": 1.0},
    "constant, 0.8": {"crack.friction": 0.8},
    "slip weakening, 1.2 to 0.8 over 20 mm": {
        "crack.law": {"name": "slip weakening", "peak_friction": 1.2, "residual_friction": 0.8, "slip": "20 mm"}
    },
    "the same, exponential": {
        "crack.law": {
            "name": "slip weakening",
            "form": "exponential",
            "peak_friction": 1.2,
            "residual_friction": 0.8,
            "slip": "20 mm",
        }
    },
    "speed weakening, 1.2 to 0.9 over 0.1 m/s": {
        "crack.law": {"name": "speed weakening", "peak_friction": 1.2, "residual_friction": 0.9, "speed": "0.1 m/s"}
    },
    "cohesion 0.3 MPa, brittle, then 0.8": {
        "crack.law": {"name": "cohesion", "cohesion": "0.3 MPa", "residual_friction": 0.8}
    },
    "the same, lost over 5 mm": {
        "crack.law": {"name": "cohesion", "cohesion": "0.3 MPa", "residual_friction": 0.8, "slip": "5 mm"}
    },
    "Barton-Bandis, JRC 10, JCS 20 MPa, 32 degrees": {
        "crack.law": {"name": "barton-bandis", "jrc": 10, "jcs": "20 MPa", "residual_angle": "32 deg"}
    },
    "Barton-Bandis, JRC 5": {
        "crack.law": {"name": "barton-bandis", "jrc": 5, "jcs": "20 MPa", "residual_angle": "32 deg"}
    },
}
CASE = Path(__file__).parent.parent / "examples" / "typical-base.toml"
PLAIN: dict[str, Any] = {"rock": "rigid", "reservoir.compressible": False}


def main() -> None:
    """Print a row for each law."""
    print("| law | friction before, after | rigid block | flexible dam |\n| --- | --- | --- | --- |")
    for name, change in LAWS.items():
        case = read_case(CASE, PLAIN | change)
        block, dam = rigid(case), flexible(case)
        law = block.friction_law
        mu = case.crack.mu_static
        frictions = (mu, mu) if law is None else (law["apparent_friction_before"], law["apparent_friction_after"])
        slips = f"{slip_text(block)} | {slip_text(dam)} ± {1e3 * dam.evidence['residual_slip_m']['uncertainty']:.0f} mm"
        print(f"| {name} | {frictions[0]:.2f}, {frictions[1]:.2f} | {slips} |")


def slip_text(response: Response) -> str:
    """Return a residual slip in words."""
    if abs(response.residual_slip_m) > response.crack_width_m:
        return "slides off"
    return f"{1e3 * response.residual_slip_m:.0f} mm"


if __name__ == "__main__":
    main()
