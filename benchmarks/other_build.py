"""This heeltoe beside a build of a0d9960f, the version before the work on speed: the same dams, in turn.

HEELTOE_BESIDE=../other/.venv/bin/heeltoe python benchmarks/other_build.py        # printed only
HEELTOE_BESIDE=../other/.venv/bin/heeltoe python benchmarks/run.py other_build    # into results.md
HEELTOE_BESIDE=... HEELTOE_MILLION=none python benchmarks/other_build.py          # without the million dams
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import study_million
from measure import NothingMeasured, Skipped, heading, repeat, require, seconds, table
from processes import Taken, Version, commit_of, least, mine

import heeltoe
from heeltoe import build_block, build_flexible_dam, read_case
from heeltoe.kernel.block import run_block
from heeltoe.kernel.build import PROFILE
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake

#: The build that is compared with.
BASE = "a0d9960f"
#: Names its executable.
WHERE = "HEELTOE_BESIDE"
#: `none` leaves the million dams out.
MILLION = "HEELTOE_MILLION"
#: Fields that give a case what was the default at that build.
PLANE = {"rock": "rigid", "reservoir.compressible": False}
EXAMPLES = ("typical-base", "typical-height", "koyna-top", "two-cracks")
SCALES = [sign * size for size in (1.0, 0.9, 0.8, 0.7) for sign in (1, -1)]
LAW = {"name": "slip weakening", "peak_friction": 1.0, "residual_friction": 0.9, "slip": "20 mm"}
#: Eight runs of one dam: what it has, its example, what is changed in it, whether on a plane, and the ratio asked for.
EIGHT: tuple[tuple[str, str, dict[str, Any], bool, float], ...] = (
    ("8 across", "typical-base", {"flexible.elements_across": 8}, True, 0.25),
    ("16 across", "typical-base", {"flexible.elements_across": 16}, True, 0.4),
    ("8 across, water with sound", "typical-base", {"reservoir.compressible": True}, True, 0.25),
    ("8 across, rock", "on-rock", {"reservoir.compressible": False}, False, 0.25),
    ("8 across, a friction law", "typical-base", {"crack.friction": None, "crack.law": LAW}, True, 0.25),
    ("two cracks", "two-cracks", {}, True, 0.25),
    ("8 across, with histories", "typical-base", {"flexible.elements_across": 8}, True, 0.25),
)
#: Flat blocks that slide.
BLOCKS = 20_000
#: Both components over one: a rigid run, and a step of the elastic dam.
ASKED_RIGID, ASKED_ELASTIC = 8.0, 1.5
PAIR = ("elcentro-1940-270-nga", "elcentro-1940-180-nga")
#: Elastic rows of a study: five dams by ten motions by two strengths.
ROWS, MOTIONS = 100, 10
STUDY = """
case = "{case}"
model = "flexible"
[vary]
"crack.friction" = [0.8, 0.9, 1.0, 1.1, 1.2]
[motions]
files = {records}
both_signs = false
scale = {{ measure = "pga", values = ["0.2 g", "0.4 g"] }}
"""
#: Records of the suite.
SUITE = 11
#: Slips of which no uncertainty is stated may differ by so much, as each version has its own step and rock; what a run
#: states of itself is 3 % and more.
ALIKE = 0.05
#: Two processes that do the same differ by so much in their memory.
SAME_PEAK = 1.02
COLUMNS = ("work", "turns", "elapsed", "processor", "ratio", "asked", "memory", "slip")


@dataclass(frozen=True)
class Measured:
    """Costs of a piece of work: times [s], memory [MB]; its slip and the uncertainty stated of it [m]."""

    elapsed: float
    processor: float
    peak: float
    slip: float | None = None
    band: float = 0.0


def plain(taken: Taken) -> Measured:
    """Return what a command took of which no slip is read."""
    return Measured(taken.elapsed, taken.processor, taken.peak)


def of_run(taken: Taken) -> Measured:
    """Return what a run took, and its slip with its uncertainty."""
    answer = taken.answer
    stated = (answer.get("evidence") or {}).get("residual_slip_m") or {}
    slip = stated.get("value", answer["residual_slip_m"])
    return Measured(taken.elapsed, taken.processor, taken.peak, slip, stated.get("uncertainty") or 0.0)


def of_runs(taken: Taken) -> Measured:
    """Return what a suite or a study took, and the mean of its slips."""
    slip = taken.answer["summary"][0]["residual_slip_m"]["mean"]
    return Measured(taken.elapsed, taken.processor, taken.peak, slip)


def of_work(taken: Taken, count: int = 1) -> Measured:
    """Return what work within a process took, or one of `count` parts of it, and the mean size of its slips."""
    answer = taken.answer
    slip = float(np.abs(answer["slips"]).mean())
    return Measured(taken.elapsed, answer["seconds"] / count, taken.peak, slip)


@dataclass(frozen=True)
class Row:
    """A piece of work by both versions.

    Attributes
    ----------
    what
        Its name.
    works
        Ours, then the other's.
    asked
        Largest ratio that is asked for; None where none is.
    read
        Takes what counts from a process.
    same
        Whether both versions have the same dam, so that their slips must agree.
    asked_peak
        Largest ratio of the peaks of memory that is asked for.
    """

    what: str
    works: tuple[Callable[[], Taken], Callable[[], Taken]]
    asked: float | None
    read: Callable[[Taken], Measured]
    same: bool = True
    asked_peak: float = 1.0

    def measured(self) -> list[str]:
        """Measure it, and return a row of the table: ours, and the other's after a slash."""
        taken, turns = least(self.works)
        ours, other = map(self.read, taken)
        ratio = ours.processor / other.processor
        return [
            self.what,
            str(turns),
            f"{seconds(ours.elapsed)} / {seconds(other.elapsed)}",
            f"{seconds(ours.processor)} / {seconds(other.processor)}",
            f"{ratio:.2f}",
            "" if self.asked is None else _judged(ratio, self.asked),
            f"{ours.peak:.0f} / {other.peak:.0f} MB{self._judged_peak(ours.peak / other.peak)}",
            self._slips(ours, other),
        ]

    def _judged_peak(self, ratio: float) -> str:
        return "" if ratio <= self.asked_peak * SAME_PEAK else f", **above {self.asked_peak:g}**"

    def _slips(self, ours: Measured, other: Measured) -> str:
        if ours.slip is None or other.slip is None:
            return ""
        cells = [f"{1e3 * m.slip:.1f}" + (f" ± {1e3 * m.band:.1f}" if m.band else "") for m in (ours, other)]
        allowed = ours.band + other.band or ALIKE * abs(other.slip)
        apart = self.same and abs(ours.slip - other.slip) > allowed
        return " / ".join(cells) + " mm" + (", **apart**" if apart else "")


def _judged(ratio: float, asked: float) -> str:
    return f"{asked:g}, {'met' if ratio <= asked else '**not met**'}"


@dataclass(frozen=True)
class Both:
    """Both versions, and a folder for the cases that are not examples."""

    ours: Version
    other: Version
    folder: Path

    def plane(self, name: str) -> tuple[str, str]:
        """Return a dam on a rigid plane before water without sound: our file, and the other's, which is its example."""
        text = Path(self.own(name)[0]).read_text(encoding="utf-8")
        require("[section]" in text and "[reservoir]\n" in text, f"{name} has no section or no reservoir")
        text = text.replace("[section]", 'rock = "rigid"\n\n[section]', 1)
        text = text.replace("[reservoir]\n", "[reservoir]\ncompressible = false\n", 1)
        file = self.folder / f"{name}.toml"
        file.write_text(text, encoding="utf-8")
        return str(file), self.own(name)[1]

    def own(self, name: str) -> tuple[str, str]:
        """Return an example as it is: our file, and the other's."""
        ours, other = (str(version.root / "examples" / f"{name}.toml") for version in (self.ours, self.other))
        return ours, other

    def command(
        self,
        what: str,
        words: Sequence[str],
        asked: float | None,
        files: tuple[str, str] = ("", ""),
        read: Callable[[Taken], Measured] = plain,
        exits: Sequence[int] = (0,),
        same: bool = True,
        asked_peak: float = 1.0,
    ) -> Row:
        """Return the row of a command; `{case}` among its words is the file of each version."""
        ours, other = (tuple(word.replace("{case}", file) for word in words) for file in files)
        works = (partial(self.ours.run, ours, exits), partial(self.other.run, other, exits))
        return Row(what, works, asked, read, same, asked_peak)

    def work(
        self,
        what: str,
        orders: tuple[dict[str, Any], dict[str, Any]],
        asked: float,
        read: Callable[[Taken], Measured] = of_work,
    ) -> Row:
        """Return the row of work within a process, by an order to each version."""
        ours, other = (partial(version.work, "other_build_work.py") for version in (self.ours, self.other))
        return Row(what, (partial(ours, orders[0]), partial(other, orders[1])), asked, read)


def commands(both: Both) -> list[Row]:
    """Return the rows of commands from the shell."""
    run = ("run", "{case}", "--json", "-")
    report = ("run", "{case}", "--report", "--out", "{out}")
    base, plane, own = both.plane("typical-base"), both.plane, both.own
    motions = [word for file in records(SUITE) for word in ("--motions", file)]
    return [
        both.command("help", ("--help",), None),
        both.command("`explain`", ("explain", "crack.friction"), 0.2),
        both.command("`statics`", ("statics", "{case}", "--json", "-"), 0.375, base),
        both.command("`run`, rigid", (*run, "--model", "rigid"), 0.417, base, of_run),
        both.command("`run`, base", run, 0.45, base, of_run),
        both.command("`run`, height", run, 0.35, plane("typical-height"), of_run),
        both.command("`run`, koyna-top", run, 0.35, plane("koyna-top"), of_run),
        both.command("`run`, two cracks", run, 0.5, plane("two-cracks"), of_run),
        both.command("`run`, on rock", run, 0.5, own("on-rock"), of_run),
        both.command("`run`, base, each by its default", run, 1.0, own("typical-base"), of_run, same=False),
        both.command(f"suite of {SUITE}, elastic, both signs", (*run, *motions), 0.35, base, of_runs),
        both.command("`run --report`, rigid", (*report, "--model", "rigid"), None, base),
        both.command("`run --report`, the demo", report, 0.354, own("typical-base"), asked_peak=0.56),
    ]


def records(count: int) -> list[str]:
    """Return a component of each of so many earthquakes."""
    if not study_million.RECORDS.is_dir():
        raise Skipped(f"there are no records in {study_million.RECORDS}")
    files = sorted(study_million.RECORDS.resolve().glob("*.txt"), reverse=True)
    return sorted({file.stem.rpartition("-")[0]: str(file) for file in files}.values())[:count]


def studies(both: Both) -> list[Row]:
    """Return the rows of studies: elastic dams, and a million rigid ones."""
    ours, other = both.folder / "ours.toml", both.folder / "other.toml"
    for file, case in zip((ours, other), both.plane("typical-base"), strict=True):
        file.write_text(STUDY.format(case=case, records=json.dumps(records(MOTIONS))), encoding="utf-8")
    study = ("study", "{case}", "--out", "{out}", "--json", "-")
    rows = [both.command(f"study of {ROWS} elastic rows", study, 0.3, (str(ours), str(other)), of_runs)]
    if os.environ.get(MILLION) != "none":
        million = str(study_million.prepared(both.folder / "million", 1_000_000))
        # 3: a limit is not met, or a dam does not stand.
        row = both.command("a million dams, file to figures", study, 0.5, (million, million), of_runs, (0, 3))
        rows.append(row)
    return rows


def within(both: Both) -> list[Row]:
    """Return the rows of work within a process: eight runs of one dam, and flat blocks."""
    rows = []
    for what, example, changes, on_plane, asked in EIGHT:
        ours, other = both.own(example)
        order = {"do": "eight", "scales": SCALES, "histories": "histories" in what}
        here = {**PLANE, **changes} if on_plane else changes
        orders = ({**order, "case": ours, "set": here}, {**order, "case": other, "set": changes})
        rows.append(both.work(f"eight runs, {what}", orders, asked))
    order = {"do": "blocks", "count": BLOCKS}
    return [*rows, both.work(f"one of {BLOCKS:,} flat blocks", (order, order), 0.25, partial(of_work, count=BLOCKS))]


def two_components() -> list[list[str]]:
    """Return what a run with both horizontal components costs beside one with one: a block, and an elastic dam."""
    example = mine().root / "examples" / "typical-base.toml"
    alone = read_case(example).with_({**PLANE, "motion.file": PAIR[0]})
    cases = (alone, alone.with_({"motion.cross_valley": {"file": PAIR[1]}}))
    shakings = [earthquake(case).shaking for case in cases]
    block, silent = build_block(alone), np.empty(0)
    # The water before the block does not move across the valley.
    across = (None, (block.mass_vertical, np.inf, np.inf, 0.0, 0.0))
    runs = [
        partial(run_block, block.parameters(), shaking, silent, across=mass)
        for shaking, mass in zip(shakings, across, strict=True)
    ]
    require(runs[1]().crossing is not None, "the block did not move across the valley")
    dams = [ShakenDam(case, build_flexible_dam(case), shaking) for case, shaking in zip(cases, shakings, strict=True)]
    step = dams[0].first_step()
    for dam in dams:
        dam.run(step)
    # Each in turn.
    turns = [[repeat(partial(dam.run, step), 1).cpu[0] for dam in dams] for _ in range(3)]
    walks = [min(repeat(run).cpu) for run in runs]
    rigid = [min(repeat(partial(heeltoe.rigid, case)).cpu) for case in cases]
    elastic = np.min(turns, axis=0) * step / dams[0].shaking.end
    measured = (
        ("rigid, `heeltoe.rigid` with all histories", rigid, ASKED_RIGID),
        ("rigid, the kernel without histories", walks, ASKED_RIGID),
        ("elastic, a step", elastic, ASKED_ELASTIC),
    )
    return [
        [what, seconds(one), seconds(two), f"{two / one:.2f}", _judged(two / one, asked)]
        for what, (one, two), asked in measured
    ]


def report(executable: Path | None = None) -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    place = executable or Path(os.environ.get(WHERE, ""))
    if not place.is_file():
        raise Skipped(f"{WHERE} does not name the executable of a build of {BASE}")
    ours, other = mine(), Version(place.absolute())
    require(commit_of(other).startswith(BASE), f"{place} is not of a checkout of {BASE}")
    for version in (ours, other):
        version.compile()
    with TemporaryDirectory() as folder:
        both = Both(ours, other, Path(folder))
        lines, remarks = [], []
        for row in (*within(both), *commands(both), *studies(both)):
            try:
                lines.append(row.measured())
            except NothingMeasured as reason:
                # One command that fails does not cost the others their quarter of an hour.
                remarks.append(f"Not measured: {row.what} ({reason}).")
                print(remarks[-1], file=sys.stderr, flush=True)
            else:
                print(*lines[-1], sep=" | ", file=sys.stderr, flush=True)
    text = (
        f"Ours / a build of {BASE}, in turn; each in its turn of least processor time, with byte code cached. The "
        "ratio is that of the processor time, of all processes together; memory is that of the largest process at its "
        "peak, marked where it is above what was asked for. But for *by its default* and *the demo*, both have the "
        "same dam: on a rigid plane before water without sound, which that version has by default. *Eight runs* of "
        "one reduced dam have four scales and both signs; their processor time leaves out start and set-up, their "
        "slip is the mean size of the eight. Runs from the shell have their evidence. "
        f"The study's {ROWS} rows are five frictions by ten motions by two strengths, its evidence included."
    )
    crosswise = (
        f"The typical dam under both components of El Centro ({PAIR[0]} along the stream, {PAIR[1]} across) beside the "
        "first alone; least processor time."
    )
    return "\n\n".join(
        [
            heading(f"Beside {BASE}", ["heeltoe", "numpy"]),
            text,
            table(COLUMNS, lines),
            *remarks,
            crosswise,
            table(("work", "one component", "both", "ratio", "asked"), two_components()),
        ]
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.parse_args()
    print(report())
