"""The typical dam exported to OpenSees and CalculiX: periods, forces at rest and slip beside ours."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from measure import NothingMeasured, Skipped, heading, repeat, require, table

from heeltoe import read_case, run
from heeltoe.kernel.build import PROFILE
from heeltoe.models.flexible.deck import Deck, build_deck
from heeltoe.models.run import earthquake
from heeltoe.views.files.programs.write import write_program

CASE = Path(__file__).parents[1] / "examples" / "typical-base.toml"
DURATION = 4.0
#: The case as the deck has it, with few elements, as OpenSees makes a thousand steps a second.
CHANGES = (
    "rock=rigid",
    "reservoir.compressible=false",
    "flexible.damping=stiffness",
    "flexible.elements_across=4",
    "flexible.evidence=step",
    "analysis.silence=0 s",
    "motion.sign=recorded",
    f"motion.duration={DURATION} s",
)
#: Penalties over the stiffness of an element, and time steps [s].
RUNS = ((50.0, 0.001), (200.0, 0.001), (200.0, 0.0005), (800.0, 0.001))


def _program(*command: str | Path, cwd: Path) -> str:
    done = subprocess.run(list(map(str, command)), cwd=cwd, capture_output=True, text=True, check=False)
    if done.returncode:
        raise NothingMeasured(f"{command[0]} ended with {done.returncode}: {done.stdout[-300:]} {done.stderr[-300:]}")
    return done.stdout


def _numbers(printed: str, name: str) -> list[float]:
    (line,) = re.findall(rf"^{name}.*?: ([-+.e\d ]+)", printed, re.MULTILINE)
    return [float(word) for word in line.split()]


def opensees(deck: Deck, folder: Path) -> tuple[list[list[object]], list[list[object]]]:
    """Return rows of the state at rest, and of the slip."""
    if find_spec("openseespy") is None:
        raise Skipped("OpenSeesPy is not installed")
    write_program(deck, "opensees", folder)
    rest, slips = list[list[object]](), list[list[object]]()
    for penalty, step in RUNS:
        printed = ""

        def work(penalty: float = penalty, step: float = step) -> None:
            nonlocal printed
            printed = _program(sys.executable, "dam.py", "--penalty", str(penalty), "--step", str(step), cwd=folder)

        timing = repeat(work, 1)
        slip = _numbers(printed, "slip of crack_1")[0]
        slips.append(
            ["OpenSees", f"{penalty:g}", f"{1e3 * step:g} ms", f"{1e3 * slip:.1f} mm", f"{timing.median:.0f} s"]
        )
        if not rest:
            periods, forces = _numbers(printed, "periods"), _numbers(printed, "reactions at rest")
            rest.append(["OpenSees", *(f"{period:.6g}" for period in periods), *(f"{force:,.0f}" for force in forces)])
    return rest, slips


def calculix(deck: Deck, folder: Path) -> list[list[object]]:
    """Return a row of the state at rest, without the earthquake; none where CalculiX is not installed."""
    program = shutil.which("ccx")
    if program is None:
        return []
    write_program(deck, "calculix", folder)
    path = folder / "dam.inp"
    path.write_text(path.read_text(encoding="utf-8").split("*END STEP")[0] + "*END STEP\n", encoding="utf-8")
    _program(program, "dam", cwd=folder)
    forces = re.findall(r"total force.*\n\n +(\S+) +(\S+)", (folder / "dam.dat").read_text())[-1]
    return [["CalculiX", *[""] * len(deck.periods), *(f"{float(force):,.0f}" for force in forces)]]


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    case = read_case(CASE, list(CHANGES))
    deck = build_deck(case, earthquake(case))
    with tempfile.TemporaryDirectory() as place:
        rest, slips = opensees(deck, Path(place))
        rest += calculix(deck, Path(place))
    response = run(case, "flexible")
    numbers: Any = response.to_json()
    timing = repeat(lambda: run(case.without_evidence(), "flexible"), 3)
    evidence = numbers["evidence"]["residual_slip_m"]
    slip, error = 1e3 * evidence["value"], 1e3 * evidence["uncertainty"]
    slips.append(["heeltoe", "exact contact", "its own", f"{slip:.1f} ± {error:.1f} mm", f"{timing.median:.2f} s"])
    forces = [f"{-force:,.0f}" for force in deck.resultant]
    rest += [
        ["the deck", *(f"{period:.6g}" for period in deck.periods), *forces],
        ["heeltoe, consistent masses", *(f"{period:.6g}" for period in deck.own_periods), *forces],
    ]
    names = [f"period {place} [s]" for place in range(1, len(deck.periods) + 1)]
    text = (
        f"`examples/typical-base.toml` on a rigid plane, with {len(deck.nodes)} nodes and damping by the stiffness, as "
        f"`heeltoe export` writes it; the first {DURATION:g} s of its motion. Forces are those of the ground on the "
        "dam, downstream and up."
    )
    other = (
        "Slip at the end. The contact of OpenSees forgets the friction of a node that has slid and sticks, so that the "
        "dam creeps downstream: by half as much with a penalty, or with a step, that is twice as large. Times of a "
        "process of OpenSees hold building the model and its modes; ours is a run without evidence."
    )
    require(np.isfinite(slip), "the dam has no slip")
    return "\n\n".join(
        [
            heading("The exported dam", ["heeltoe", "openseespy", "numpy"]),
            text,
            table(["program", *names, "force x [N]", "force y [N]"], rest),
            other,
            table(["program", "penalty", "step", "slip", "time"], slips),
        ]
    )


if __name__ == "__main__":
    print(report())
