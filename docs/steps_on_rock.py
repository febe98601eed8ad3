"""Print the tables of docs/flexible.md of how far slips move with the time step, on rock and on a rigid plane.

python docs/steps_on_rock.py
"""

from __future__ import annotations

from pathlib import Path

import heeltoe
from heeltoe.case.model import Case
from heeltoe.models.flexible.body.modes import part_periods
from heeltoe.models.flexible.body.reduced import build_flexible_dam

EXAMPLES = Path(__file__).parents[1] / "examples"
DAMS = ("typical-base", "triangular", "stepped-crack", "koyna-top", "typical-height", "two-cracks")
#: Steps over the period of the part that vibrates fastest, and the longest one at a four-hundredth [s].
PARTS, LONGEST = (400, 200, 100, 50), 2e-4
LAW = {"name": "slip weakening", "form": "exponential", "peak_friction": 1.1, "residual_friction": 0.8, "slip": "30 mm"}
#: On a rigid plane, where the last but one strikes, and the steps there [ms].
ON_PLANE: dict[str, tuple[str, dict[str, object]]] = {
    **{name: (name, {}) for name in ("typical-base", "triangular", "pine-flat", "typical-height")},
    "typical-base, friction 1.1 to 0.8 over 30 mm": ("typical-base", {"crack.friction": None, "crack.law": LAW}),
}
STEPS_MS = (0.2, 0.4, 0.8)


def slip_mm(case: Case, step: float) -> float:
    """Return the slip of the worse sign at a step [s], of the upper crack [mm]."""
    stepped = case.with_(f"flexible.time_step={step} s", "flexible.evidence=none")
    return 1e3 * heeltoe.run(stepped, "flexible").cracks[0].residual_slip_m


def main() -> None:
    """Print a row for each dam of both tables."""
    print("| slip, mm | 1/400 | 1/200 | 1/100 | 1/50 |")
    print("| --- | --- | --- | --- | --- |")
    for name in DAMS:
        case = heeltoe.read_case(EXAMPLES / f"{name}.toml")
        dam = build_flexible_dam(case)
        period = min(float(part_periods(modes, 1)[0]) for modes in dam.modes[: dam.free])
        shortest = min(period / PARTS[0], LONGEST)
        slips = (slip_mm(case, shortest * PARTS[0] / part) for part in PARTS)
        print(f"| {name} | {' | '.join(f'{slip:.1f}' for slip in slips)} |")
    print("\n| slip, mm | " + " | ".join(f"{step:g} ms" for step in STEPS_MS) + " |")
    print("| --- " * (1 + len(STEPS_MS)) + "|")
    for name, (file, changes) in ON_PLANE.items():
        case = heeltoe.read_case(EXAMPLES / f"{file}.toml").on_rigid_plane().with_(changes)
        print(f"| {name} | {' | '.join(f'{slip_mm(case, 1e-3 * step):.1f}' for step in STEPS_MS)} |")


if __name__ == "__main__":
    main()
