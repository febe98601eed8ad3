"""Print the table of recorded pairs of docs/cross-valley.md: what the shaking across the valley adds to the slip of the
typical dam as a rigid block, with each component along the stream, and in the worst direction.

python docs/pairs_across_the_valley.py            # records in $HEELTOE_RECORDS/ensemble; some minutes on one core
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import heeltoe
from heeltoe.study.answers.suite import SuiteRecord
from heeltoe.study.plan.file import Study
from heeltoe.study.run.run import run_study

# The strongest stream of each pair, or each component along the stream, has this peak.
_PEAK, _STEP = "0.4 g", "15 deg"
_CASE = Path(__file__).parent.parent / "examples" / "typical-base.toml"
# Components of no known direction.
_LEFT_OUT = "tabas"


def pairs() -> list[tuple[str, list[str]]]:
    """Return the pairs of the ensemble: their names and their files."""
    files = sorted(Path(os.environ["HEELTOE_RECORDS"], "ensemble").glob("*.txt"))
    events: dict[str, list[str]] = {}
    for file in files:
        if not file.name.startswith(_LEFT_OUT):
            events.setdefault(file.stem.rpartition("-")[0], []).append(str(file))
    return list(events.items())


def records_of(case: heeltoe.Case, name: str, files: list[str], cross_valley: bool | str) -> list[SuiteRecord]:
    """Return what the dam does under a pair: by each component along the stream, or in its worst direction."""
    motions = {
        # The headers of one pair differ in what they say of its station.
        "events": [{"name": name, "horizontal": files}],
        "cross_valley": cross_valley,
        "scale": {"measure": "pga", "values": [_PEAK]},
    }
    study = Study.of({"case": "dam", "model": "rigid", "motions": motions, "suite": {}}, Path.cwd())
    with TemporaryDirectory() as place:
        found = run_study(study, place, case=case).suite
    assert found is not None
    return found.models[0].records


def main() -> None:
    """Run the pairs and print their table."""
    case = heeltoe.read_case(_CASE)
    rows, factors, directions = list[str](), list[float](), 0
    for name, files in pairs():
        both, (worst,) = records_of(case, name, files, True), records_of(case, name, files, _STEP)
        known = [record.cross_valley_factor for record in both if record.cross_valley_factor is not None]
        factors += known
        lifts = worst.residual_slip_m is None
        directions += lifts
        slips = ", ".join(_millimetres(record.without_cross_valley_slip_m) for record in both)
        ratios = ", ".join(f"{factor:.2f}" for factor in known) or "-"
        worst_slip = "lifts" if lifts else _millimetres(worst.residual_slip_m)
        rows.append(f"| {name} | {slips} | {ratios} | {worst_slip} | {worst.azimuth_deg:g} |")
        print(rows[-1], file=sys.stderr, flush=True)
    print("| pair | one component alone, mm | factor | worst direction, mm | its azimuth, deg |")
    print("| --- | --- | --- | --- | --- |")
    print("\n".join(rows))
    low, middle, high = np.quantile(factors, (0.16, 0.5, 0.84))
    print(
        f"\n{len(factors)} factors: {min(factors):.2f} to {max(factors):.2f}, median {middle:.2f}, "
        f"16 to 84 % {low:.2f} to {high:.2f}; {directions} of {len(rows)} pairs lift in some direction."
    )


def _millimetres(slip: float | None) -> str:
    return "lifts" if slip is None else f"{1e3 * slip:.1f}"


if __name__ == "__main__":
    main()
