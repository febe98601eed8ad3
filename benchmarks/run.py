"""Run the benchmarks, all or those that are named; write their tables to results.md and the pages that show them, our
figures to history.md.

python benchmarks/run.py                      # all parts, one after the other
python benchmarks/run.py crack_dam crack_peers
"""

from __future__ import annotations

import argparse
import re
import sys
import time
from importlib import import_module
from pathlib import Path

import history
from measure import NothingMeasured, Skipped

#: Modules with a `report`, and the title of the section that each writes; each is meant to stay below five minutes.
PARTS = {
    "rigid_ensemble": "Rigid ensemble",
    "study_million": "A million runs",
    "friction_laws": "Friction laws",
    "rigid_peers": "Rigid peers",
    "rocking_peers": "Rotations of any size",
    "spectra_peers": "Response spectra",
    "crack_dam": "Flexible dams",
    "cost_growth": "How cost grows",
    "flexible_study": "Flexible studies",
    "crack_peers": "Elastic block beside peers",
    "elastic_rocking": "Elastic block that rocks",
    "exported_dam": "The exported dam",
    "commands": "Commands",
    "other_build": "Beside a0d9960f",
    "app_redraw": "The app in a browser",
}
TITLE = "# Measured results\n\nWritten by `python benchmarks/run.py`; what the numbers mean is in the README beside it."
TARGET = Path(__file__).with_name("results.md")


def renewed(text: str, report: str) -> str:
    """Return the results with one section put in, in place of the one with its title; in the order of the parts."""
    sections = dict(_titled(section) for section in re.split(r"^(?=## )", text, flags=re.M)[1:])
    title, section = _titled(report)
    if title not in PARTS.values():
        raise NothingMeasured(f"no part writes a section {title!r}")
    sections[title] = section
    return "\n\n".join([TITLE, *(sections[name] for name in PARTS.values() if name in sections)]) + "\n"


def _titled(section: str) -> tuple[str, str]:
    return section.split("\n", 1)[0].removeprefix("## "), section.strip()


def main() -> None:
    """Run the parts. One that measures nothing leaves its old section alone, and the whole fails in the end; one that
    cannot be run here says so, and is no failure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("part", nargs="*", metavar="part", help=f"of {', '.join(PARTS)}; all without")
    wanted = parser.parse_args().part or list(PARTS)
    if unknown := set(wanted) - set(PARTS):
        parser.error(f"there is no part {', '.join(sorted(unknown))}")
    failed = False
    for part in wanted:
        start = time.perf_counter()
        try:
            report = import_module(part).report()
        except (ImportError, Skipped) as reason:
            print(f"{part}: not measured here, its section stays: {reason}", file=sys.stderr)
            continue
        except NothingMeasured as reason:
            print(f"{part}: nothing measured: {reason}", file=sys.stderr)
            failed = True
            continue
        old = TARGET.read_text(encoding="utf-8") if TARGET.exists() else ""
        TARGET.write_text(renewed(old, report), encoding="utf-8")
        history.add(history.picked(report, history.commit_now()))
        print(f"{part}: {time.perf_counter() - start:.0f} s, written to {TARGET}")
        for shown in ("friction_laws", "short"):
            import_module(shown).renew()
    sys.exit(failed)


if __name__ == "__main__":
    main()
