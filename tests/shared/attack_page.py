"""The page of the documentation that says what an attack has tried, and what came of it."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterable, Mapping
from importlib.metadata import version
from pathlib import Path

ENDS = ("accepted", "refused", "no result", "defect")
#: How many random cases a long attack tries, and with which seed; `make test-all` takes a few, `make attack` many.
CASES, SEED = int(os.environ.get("HEELTOE_ATTACK_CASES", "100")), int(os.environ.get("HEELTOE_ATTACK_SEED", "34"))
_TEXT = """# Attacks

`make attack` tries to break heeltoe, with random cases from a seed (`CASES`, `SEED`), and writes this page; with
`ADD=1` it adds the counts of other seeds. `make test-slow` tries a short form. Version {version}, seeds {seeds}.

| attack | tried | accepted | refused | no result | defects |
| --- | ---: | ---: | ---: | ---: | ---: |
{rows}

*Accepted* is an answer that passes {judge}: no NaN, no contradiction of outcome, verdict,
limits and numbers, an exit code that fits; for twins and laws, a comparison that agrees. *Refused* is a sentence for
each wrong field, exit code 2, and no file written or changed. *No result* is a run whose outcome gives the reason, exit
code 3. All else is a defect: a traceback, a run beyond its limit of time, a file left behind, a letter that controls a
terminal. Pairs of features are also compared with the table of [combinations](../generated/combinations.md). The cases
are in {generator}; a defect names its seed.
"""


def write_page(path: Path, rows: Iterable[tuple[str, Mapping[str, int]]], *, add: bool = False) -> None:
    """Write what came of all attacks; rows of one name are added up, with `add` to those that stand there."""
    sums, seeds = _read_page(path) if add else ({}, [])
    for what, counts in rows:
        # The attacks of one kind make one row: "laws: size of a block" and "places to read, case".
        sums.setdefault(re.split("[:,]", str(what))[0], Counter()).update(counts)
    total: Counter[str] = sum(sums.values(), Counter())
    lines = [_row(what, counts) for what, counts in [*sorted(sums.items()), ("all", total)]]
    text = _TEXT.format(
        seeds=", ".join(map(str, sorted({*seeds, SEED}))),
        version=version("heeltoe"),
        rows="\n".join(lines),
        judge="`tests/shared/contradictions.py`",
        generator="`tests/shared/random_features.py`",
    )
    path.write_text(text, encoding="utf-8")


def _read_page(path: Path) -> tuple[dict[str, Counter[str]], list[int]]:
    """Return what a page says: the counts by name, and the seeds."""
    text = path.read_text(encoding="utf-8")
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line[:1] == "|"][2:]
    counts = {what: Counter(dict(zip(ENDS, map(_number, ends), strict=True))) for what, _, *ends in cells}
    counts.pop("all", None)
    seeds = re.search(r"seeds? (\d+(?:, \d+)*)\.", text)
    return counts, [int(seed) for seed in seeds[1].split(", ")] if seeds else []


def _number(cell: str) -> int:
    return int(cell.replace(",", ""))


def _row(what: str, ends: Mapping[str, int]) -> str:
    counts = " | ".join(f"{ends.get(end, 0):,}" for end in ENDS)
    return f"| {what} | {sum(ends.values()):,} | {counts} |"
