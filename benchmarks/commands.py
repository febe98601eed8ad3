"""What a user waits for: whole commands from the shell, the interpreter's start included.

python benchmarks/commands.py                                     # printed only
python benchmarks/commands.py --beside ../other/.venv/bin/heeltoe # and the table of other_build.py, with that build
"""

from __future__ import annotations

import argparse
from functools import partial
from pathlib import Path

from measure import heading, require, seconds, table
from processes import Version, least, mine

from heeltoe.kernel.build import PROFILE

#: Work and the words of its command; paths are from the root of the checkout.
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
    ("report of a rigid dam", ("run", "examples/typical-base.toml", "--model", "rigid", "--report", "--out", "{out}")),
    ("report of the demo", ("run", "examples/typical-base.toml", "--report", "--out", "{out}")),
)


def measured(version: Version) -> list[list[str]]:
    """Time all commands."""
    lines = []
    for what, words in COMMANDS:
        (taken,), _ = least([partial(version.run, words)])
        lines.append([what, seconds(taken.elapsed), seconds(taken.processor), f"{taken.peak:.0f} MB"])
    return lines


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    version = mine()
    version.compile()
    text = (
        "From the shell to the end of the process; in the turn of least processor time of five, of three beyond a "
        "second, of two beyond four, once beyond eight. Runs have their evidence and both signs of the motion. "
        "`--json -`, but for the reports, which are two files each with all figures. Memory is that of the largest "
        "process at its peak."
    )
    columns = ["command", "elapsed", "processor", "peak memory"]
    return "\n\n".join(
        [heading("Commands", ["heeltoe", "numpy", "matplotlib"]), text, table(columns, measured(version))]
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--beside", type=Path, help="executable of another version, in an environment of its checkout")
    other = parser.parse_args().beside
    print(report())
    if other is not None:
        import other_build

        print(f"\n{other_build.report(other)}")
