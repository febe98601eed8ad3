"""Write the table of speed in docs/other-programs.md and paper.md from results.md: `python benchmarks/short.py`."""

from __future__ import annotations

import re
from pathlib import Path

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
#: Problem, the section and the column of its errors; then what is shown: a name, and how its row begins in columns.
CHOSEN: tuple[tuple[str, str, str, tuple[tuple[str, dict[str, str]], ...]], ...] = (
    (
        "one-way sliding under Taft, *k_y* 0.1",
        "Rigid peers",
        "relative",
        (
            ("heeltoe", {"k_y": "0.1", "program": "heeltoe", "time per run": r"\S+ \S+ \S+ one call"}),
            ("pySLAMMER, 0.01 s", {"k_y": "0.1", "program": "pySLAMMER", "step": "0.01 s"}),
            ("pySLAMMER, 0.001 s", {"k_y": "0.1", "program": "pySLAMMER", "step": "0.001 s"}),
        ),
    ),
    (
        "sliding both ways, pushed and shaken",
        "Rigid peers",
        "relative",
        (
            ("heeltoe, 0.002 s", {"settings": "sine sampled", "step": "0.002 s"}),
            ("MuJoCo, 0.001 s", {"program": "MuJoCo", "settings": "impedance 0.99, ratio 100", "step": "0.001 s"}),
            ("PyBullet, 0.001 s", {"program": "PyBullet", "settings": "200 iterations", "step": "0.001 s"}),
        ),
    ),
    (
        "the same block, elastic",
        "Elastic block beside peers",
        "relative",
        (
            ("heeltoe, 17 nodes on the base, 0.002 s", {"settings": f"8 across, {ELASTIC}", "step": "0.002 s"}),
            ("heeltoe, 33 nodes on the base, 0.002 s", {"settings": f"16 across, {ELASTIC}", "step": "0.002 s"}),
            ("OpenSees, 17 nodes, 0.00125 s", {"program": "OpenSees", "settings": ".*SSPquad", "step": "0.00125 s"}),
            ("OpenSees, 33 nodes, 0.00125 s", {"program": "OpenSees", "settings": ".*quad8n", "step": "0.00125 s"}),
            ("Siconos, 33 nodes, 0.001 s", {"program": "Siconos", "settings": ".*8-node", "step": "0.001 s"}),
        ),
    ),
    (
        "an elastic block that rocks",
        "Elastic block that rocks",
        "relative",
        (
            ("heeltoe, 16 elements across, 0.0002 s", {"program": "heeltoe", "step": "0.0002 s"}),
            ("OpenSees, RockingBC, 16 pieces, 0.0002 s", {"program": "OpenSees RockingBC", "step": "0.0002 s"}),
        ),
    ),
    (
        "rocking at any rotation, El Centro",
        "Rotations of any size",
        "largest relative error",
        (
            ("heeltoe", {"above": "The same block through", "program": "heeltoe"}),
            ("SciPy, DOP853", {"above": "The same block through", "program": "SciPy", "tolerance": "1e-08"}),
        ),
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


def table(text: str) -> str:
    """Return the table of speed that results have, in Markdown."""
    lines = [HEAD, ["---"] * len(HEAD)]
    for problem, section, error, shown in CHOSEN:
        ours: dict[str, float] = {}
        for number, (name, wanted) in enumerate(shown):
            row = only(rows(text, section), wanted)
            time = re.match(r"[\d.]+ \S+", row["time per run"])
            if time is None:
                raise SystemExit(f"no time in the row {row}")
            ratio = next((value for key, value in row.items() if key.startswith("times ours")), "").split(" ")[0]
            nodes = re.search(r"\d+ nodes", name)
            alike = ""
            if nodes and name.startswith("heeltoe"):
                ours[nodes[0]] = seconds(time[0])
            elif nodes:
                alike = f"{seconds(time[0]) / ours[nodes[0]]:,.0f}"
            lines.append(["" if number else problem, name, row[error], time[0], ratio, alike])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def renewed(page: str, text: str) -> str:
    """Return a page with the table that results have."""
    before, rest = page.split(BEGINS)
    return f"{before}{BEGINS}\n{table(text)}\n{ENDS}{rest.split(ENDS)[1]}"


if __name__ == "__main__":
    for path in PAGES:
        path.write_text(renewed(path.read_text(encoding="utf-8"), RESULTS.read_text(encoding="utf-8")), "utf-8")
