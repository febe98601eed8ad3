"""A million rigid runs, from the study file to the fragility figure: where the time goes, and how much memory it takes.

python benchmarks/study_million.py --runs 100000
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from measure import Skipped, heading, require, seconds, table

RUNS = (1_000_000, 3_000_000)
ROOT = Path(__file__).parents[1]
#: Of both components of 21 events; see CONTRIBUTING.md.
RECORDS = Path(os.environ.get("HEELTOE_RECORDS", ROOT.parent / "shared" / "records")) / "ensemble"
STEPS = ("sampling", "blocks", "kernel", "tables", "writing")
STUDY = """
title = "Typical dam, {runs:,} runs"
case = "case.toml"
method = "latin hypercube"
samples = {runs}

[vary]
"crack.friction" = {{ distribution = "lognormal", median = 1.0, dispersion = 0.15 }}
"reservoir.depth" = {{ from = "85 m", to = "100 m" }}
"uplift.drain_efficiency" = {{ from = 0.2, to = 0.8 }}
"crack.restitution" = {{ from = 0.2, to = 0.8 }}

[motions]
events = {events}
pairs = true
scale = {{ measure = "pga", values = {{ from = "0.1 g", to = "1 g" }} }}

[fragility]
limits = {{ residual_slip = ["10 mm", "150 mm"] }}
"""


def events() -> str:
    """Return both components of each earthquake as a study takes them: headers of one pair name its station in two
    ways, so that their folder would not pair them."""
    pairs: dict[str, list[str]] = {}
    for file in sorted(RECORDS.resolve().glob("*.txt")):
        pairs.setdefault(file.stem.rpartition("-")[0], []).append(str(file))
    each = (f"{{ name = {json.dumps(name)}, horizontal = {json.dumps(files)} }}" for name, files in pairs.items())
    return f"[{', '.join(each)}]"


def prepared(folder: Path, runs: int) -> Path:
    """Write the study and its case into a folder, and return the study's file."""
    folder.mkdir(exist_ok=True)
    case = (ROOT / "examples" / "typical-base.toml").read_text(encoding="utf-8")
    drained = 'pattern = "drained"\ndrain_position = 0.1\ndrain_efficiency = 0.5\n'
    before, pattern, after = case.partition('pattern = "triangular"')
    require(bool(pattern), "the typical dam has another uplift")
    (folder / "case.toml").write_text(before + drained + after.partition("\n")[2], encoding="utf-8")
    (folder / "study.toml").write_text(STUDY.format(runs=runs, events=events()), encoding="utf-8")
    return folder / "study.toml"


def measured(runs: int) -> list[str]:
    """Run a study in a process of its own, and return a row of the table."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        prepared(folder, runs)
        began = time.perf_counter()
        running = subprocess.Popen(
            [sys.executable, "-m", "heeltoe", "study", "study.toml", "--out", "out"],
            cwd=folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        # Unlike the usual wait it tells what this process alone took.
        _, status, used = os.wait4(running.pid, 0)
        running.returncode = os.waitstatus_to_exitcode(status)
        elapsed = time.perf_counter() - began
        require(running.returncode in (0, 3), f"the study ended with {running.returncode}")
        require((folder / "out" / "figures" / "fragility.png").is_file(), "there is no fragility figure")
        answer = json.loads((folder / "out" / "study.json").read_text(encoding="utf-8"))
        require(answer["count"] == runs, "not all runs were run")
    steps = [answer["seconds"][step] for step in STEPS]
    cells = [elapsed, used.ru_utime + used.ru_stime, *steps, elapsed - sum(steps)]
    return [f"{runs:,}", *map(seconds, cells), f"{used.ru_maxrss / 1024:.0f} MB"]


def report(runs: Sequence[int] = RUNS) -> str:
    """Measure and return Markdown."""
    if not RECORDS.is_dir():
        raise Skipped(f"there are no records in {RECORDS}")
    columns = ["runs", "elapsed", "processor", *STEPS, "start, answers, figures", "peak memory"]
    return "\n\n".join(
        [
            heading("A million runs", ["heeltoe", "numpy", "pyarrow"]),
            "The typical dam with drains as a rigid block; friction, water, drains and restitution drawn, each dam in "
            f"one of {len(list(RECORDS.glob('*.txt')))} components, at a strength that is drawn. `heeltoe study` from "
            "the file to the figures, once.",
            table(columns, [measured(count) for count in runs]),
        ]
    )


if __name__ == "__main__":
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--runs", type=int, nargs="+", default=RUNS, help="how many")
    print(report(arguments.parse_args().runs))
