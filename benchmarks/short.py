"""Write the table of speed in docs/other-programs.md and paper.md from results.md, and in which of its rows another
program is quicker: `python benchmarks/short.py`."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "benchmarks" / "results.md"
PAGES = (ROOT / "docs" / "other-programs.md", ROOT / "paper.md")
BEGINS, ENDS = "<!-- speed: python benchmarks/short.py -->\n", "<!-- end of speed -->\n"
HEAD = [
    "problem",
    "program",
    "largest error, relative",
    "time of a run",
    "times ours at no larger error",
    "times ours at equal nodes",
]
ELASTIC = "8-node, exact contact"


class Problem(NamedTuple):
    """A problem of the table: its section, what is shown of it (a name, and how its row begins in columns), and the
    columns of the errors, the times and the ratios."""

    title: str
    section: str
    shown: tuple[tuple[str, dict[str, str]], ...]
    error: str = "relative"
    time: str = "time per run"
    ratio: str = "times ours at no larger error"


_AT_01 = {"k_y": "0.1"}
_NEWMARK = (
    ("Newmark in C, 0.01 s", {"program": "Newmark in C", "step": "0.01 s"}),
    ("Newmark in C, 0.001 s", {"program": "Newmark in C", "step": "0.001 s"}),
    ("Newmark in C, 0.0001 s", {"program": "Newmark in C", "step": "0.0001 s"}),
    ("Newmark in numba, 0.01 s", {"program": "Newmark in numba", "step": "0.01 s"}),
)
_ONE_WAY = (("heeltoe", _AT_01 | {"program": "heeltoe"}), *((name, _AT_01 | row) for name, row in _NEWMARK))
PROBLEMS = (
    Problem(
        "one-way sliding under Taft, *k_y* 0.1, with the slip at every sample",
        "Rigid peers",
        (
            *_ONE_WAY,
            ("pySLAMMER, 0.01 s", {"k_y": "0.1", "program": "pySLAMMER", "step": "0.01 s"}),
            ("pySLAMMER, 0.001 s", {"k_y": "0.1", "program": "pySLAMMER", "step": "0.001 s"}),
        ),
    ),
    Problem(
        "the same block among many, with its slip at the end",
        "Rigid peers",
        _ONE_WAY,
        time="in an ensemble",
        ratio="in an ensemble, times ours",
    ),
    Problem(
        "sliding both ways, pushed and shaken",
        "Rigid peers",
        (
            ("heeltoe, 0.002 s", {"program": "heeltoe", "settings": "sine sampled", "step": "0.002 s"}),
            *((name, row | {"settings": "sine sampled"}) for name, row in _NEWMARK),
            ("MuJoCo, 0.001 s", {"program": "MuJoCo", "settings": "impedance 0.99, ratio 100", "step": "0.001 s"}),
            ("PyBullet, 0.001 s", {"program": "PyBullet", "settings": "200 iterations", "step": "0.001 s"}),
        ),
    ),
    Problem(
        "the same block, elastic",
        "Elastic block beside peers",
        (
            ("heeltoe, 17 nodes on the base, 0.002 s", {"settings": f"8 across, {ELASTIC}", "step": "0.002 s"}),
            ("heeltoe, 33 nodes on the base, 0.002 s", {"settings": f"16 across, {ELASTIC}", "step": "0.002 s"}),
            ("OpenSees, 17 nodes, 0.00125 s", {"program": "OpenSees", "settings": ".*SSPquad", "step": "0.00125 s"}),
            ("OpenSees, 33 nodes, 0.00125 s", {"program": "OpenSees", "settings": ".*quad8n", "step": "0.00125 s"}),
            ("Siconos, 33 nodes, 0.001 s", {"program": "Siconos", "settings": ".*8-node", "step": "0.001 s"}),
        ),
    ),
    Problem(
        "an elastic block that rocks",
        "Elastic block that rocks",
        (
            ("heeltoe, 16 elements across, 0.0002 s", {"program": "heeltoe", "step": "0.0002 s"}),
            ("OpenSees, RockingBC, 16 pieces, 0.0002 s", {"program": "OpenSees RockingBC", "step": "0.0002 s"}),
        ),
    ),
    Problem(
        "rocking at any rotation, El Centro",
        "Rotations of any size",
        (
            ("heeltoe", {"above": "The same block through", "program": "heeltoe"}),
            ("SciPy, DOP853", {"above": "The same block through", "program": "SciPy", "tolerance": "1e-08"}),
        ),
        error="largest relative error",
        ratio="times ours",
    ),
)


def rows(text: str, section: str) -> list[dict[str, str]]:
    """Return the rows of all tables of a section by the heads of their columns, and `above` what stands before them."""
    (body,) = re.findall(rf"^## {re.escape(section)}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    result: list[dict[str, str]] = []
    for above, table in re.findall(r"^([^|\n].*)\n\n((?:^\|.*\n)+)", body, re.MULTILINE):
        head, _, *lines = ([cell.strip() for cell in line.strip("|\n ").split(" | ")] for line in table.splitlines())
        result += [{"above": above} | dict(zip(head, line, strict=False)) for line in lines]
    return result


def only(found: list[dict[str, str]], wanted: dict[str, str]) -> dict[str, str]:
    """Return the one row whose cells begin as is wanted."""
    fits = [row for row in found if all(re.match(rf"{each}(?!\d)", row.get(name, "")) for name, each in wanted.items())]
    if len(fits) != 1:
        raise SystemExit(f"{len(fits)} rows of results.md begin as {wanted}: choose anew in short.py")
    return fits[0]


def seconds(time: str) -> float:
    """Return a time such as `46.1 ms` in seconds."""
    number, unit = time.split()
    return float(number) * {"µs": 1e-6, "ms": 1e-3, "s": 1.0}[unit]


class Line(NamedTuple):
    """A row of the table: the problem, the program, its error, its time, and ratios to ours, or nothing."""

    problem: str
    program: str
    error: str
    time: str
    ratio: str
    alike: str


def lines(text: str) -> list[Line]:
    """Return the rows of the table of speed that results have."""
    result = []
    for problem in PROBLEMS:
        ours: dict[str, float] = {}
        for name, wanted in problem.shown:
            row = only(rows(text, problem.section), wanted)
            time = re.match(r"[\d.]+ \S+", row[problem.time])
            if time is None:
                raise SystemExit(f"no time in the row {row}")
            nodes = re.search(r"\d+ nodes", name)
            alike = ""
            if nodes and name.startswith("heeltoe"):
                ours[nodes[0]] = seconds(time[0])
            elif nodes:
                alike = f"{seconds(time[0]) / ours[nodes[0]]:,.0f}"
            ratio = row.get(problem.ratio, "").split(" ")[0]
            result.append(Line(problem.title, name, row[problem.error], time[0], ratio, alike))
    return result


def table(text: str) -> str:
    """Return the table of speed that results have, in Markdown."""
    cells, above = [HEAD, ["---"] * len(HEAD)], ""
    for line in lines(text):
        cells.append(["" if line.problem == above else line.problem, *line[1:]])
        above = line.problem
    return "".join(f"| {' | '.join(row)} |\n" for row in cells)


def quicker(text: str) -> str:
    """Return in which rows another program takes less time than our quickest run that is as exact, as a list."""
    lost: dict[str, list[str]] = {}
    for line in lines(text):
        if line.ratio and float(line.ratio.replace(",", "")) < 1.0:
            lost.setdefault(line.problem, []).append(f"{line.program} ({line.ratio})")
    if not lost:
        return "No program of this table takes less time than our quickest run that is as exact.\n"
    named = "".join(f"- {problem}: {'; '.join(programs)}\n" for problem, programs in lost.items())
    return f"We lose to programs that take less time than our quickest run that is as exact:\n\n{named}"


def renewed(page: str, text: str) -> str:
    """Return a page with the table that results have, and the sentence below it."""
    before, rest = page.split(BEGINS)
    return f"{before}{BEGINS}\n{table(text)}\n{quicker(text)}\n{ENDS}{rest.split(ENDS)[1]}"


def renew() -> None:
    """Write the table of results.md into the pages."""
    for path in PAGES:
        path.write_text(renewed(path.read_text(encoding="utf-8"), RESULTS.read_text(encoding="utf-8")), "utf-8")


if __name__ == "__main__":
    renew()
