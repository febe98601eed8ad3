"""What a user waits for: whole commands from the shell, the interpreter's start included.

python benchmarks/commands.py                                     # printed only
python benchmarks/commands.py --beside ../other/.venv/bin/heeltoe # another version too, in turn, on its own examples
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from measure import heading, require, seconds, table

from heeltoe.kernel.build import PROFILE

REPETITIONS = 3
#: What is done, and the words of the command; paths are from the root of the version that is run.
COMMANDS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("help", ("--help",)),
    ("version", ("--version",)),
    ("meaning of a name", ("explain", "crack.friction")),
    ("static checks", ("statics", "examples/typical-base.toml", "--json", "-")),
    ("rigid dam", ("run", "examples/typical-base.toml", "--model", "rigid", "--json", "-")),
    ("elastic dam, crack at its base", ("run", "examples/typical-base.toml", "--json", "-")),
    ("elastic dam, crack at a height", ("run", "examples/typical-height.toml", "--json", "-")),
    ("elastic dam, two cracks", ("run", "examples/two-cracks.toml", "--json", "-")),
    ("elastic dam on rock, water with sound", ("run", "examples/on-rock.toml", "--json", "-")),
    ("report of a rigid dam", ("run", "examples/typical-base.toml", "--model", "rigid", "--report", "--out")),
    ("report of the demo", ("run", "examples/typical-base.toml", "--report", "--out")),
)


@dataclass(frozen=True)
class Version:
    """A heeltoe that is installed in an environment of its checkout."""

    name: str
    executable: Path

    @property
    def root(self) -> Path:
        """Of its checkout, for its examples."""
        return self.executable.parents[2]

    def run(self, words: Sequence[str]) -> tuple[float, float] | None:
        """Return the elapsed and the processor time of a command [s], those of its children included; None where this
        version does not know it."""
        with tempfile.TemporaryDirectory() as folder:
            command = [str(self.executable), *words, *([folder] if words[-1] == "--out" else [])]
            before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
            done = subprocess.run(command, cwd=self.root, capture_output=True, check=False)
            taken, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode:
            return None
        return taken, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measured(versions: Sequence[Version]) -> list[list[str]]:
    """Time all commands of all versions in turn."""
    lines = []
    for what, words in COMMANDS:
        rounds = [[version.run(words) for version in versions] for _ in range(REPETITIONS)]
        line = [what]
        for runs in zip(*rounds, strict=True):
            times = [run for run in runs if run is not None]
            line += [seconds(median(pair[k] for pair in times)) if times else "-" for k in (0, 1)]
        require(line[1] != "-", f"`heeltoe {' '.join(words)}` fails")
        lines.append(line)
    return lines


def report(beside: Path | None = None) -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    versions = [Version("", Path(sys.executable).with_name("heeltoe"))]
    if beside is not None:
        versions.append(Version("other: ", beside.absolute()))
    columns = ["command"] + [f"{version.name}{what}" for version in versions for what in ("elapsed", "processor")]
    text = (
        f"From the shell to the end of the process, {REPETITIONS} times in turn; the medians. Runs have their evidence "
        "and both signs of the motion. `--json -`, but for the report, which is two files with all figures."
    )
    return "\n\n".join(
        [heading("Commands", ["heeltoe", "numpy", "matplotlib"]), text, table(columns, measured(versions))]
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--beside", type=Path, help="executable of another version, in an environment of its checkout")
    print(report(parser.parse_args().beside))
