"""What the pages are made of: the rows of each case as they were when the book was last made, in one file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from validation.book import numbers
from validation.row import Row

#: The rows of a case: the texts of each.
Rows = list[dict[str, str]]
#: Verdicts in the order of the matrix.
VERDICTS = ("within", "deviates, explained", "outside", "no verdict")
NAME = "rows.json"


def row_texts(row: Row) -> dict[str, str]:
    """Return a row in texts."""
    verdict = VERDICTS[3] if row.tolerance is None else VERDICTS[1] if row.deviates else VERDICTS[0 if row.holds else 2]
    record = {
        "what": row.what,
        "kind": row.kind,
        "reference": numbers.reference(row),
        "ours": numbers.ours(row),
        "deviation": numbers.deviation(row),
        "tolerance": numbers.tolerance(row),
        "verdict": verdict,
        "remark": row.remark,
    }
    if row.finer is not None:
        record["half the step"] = numbers.number(row, row.finer)
    if row.spread is not None:
        record["99 to 101 % of the shaking"] = " to ".join(numbers.number(row, value) for value in row.spread)
    return record


def drift(old: Rows, new: Rows, *, steady: float = 0.0) -> list[str]:
    """Return what is no longer as it was, a line each; numbers may be off by a part of them."""
    if len(old) != len(new):
        return [f"{len(old)} rows before, {len(new)} now"]
    drifts = []
    for before, now in zip(old, new, strict=True):
        if before.keys() != now.keys():
            drifts.append(f"{now['what']}: columns {', '.join(before)} before, {', '.join(now)} now")
            continue
        drifts += [
            f"{now['what']}, {name}: {before[name]!r} before, {now[name]!r} now"
            for name in now
            if not numbers.alike(before[name], now[name], steady=steady)
        ]
    return drifts


def read(folder: Path) -> dict[str, Rows]:
    """Return the rows of all cases; none where there is no book yet."""
    path = folder / NAME
    record: dict[str, Any] = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    return record


def write(folder: Path, rows: dict[str, Rows]) -> None:
    """Write the rows of all cases."""
    text = json.dumps(rows, indent=1, ensure_ascii=False)
    (folder / NAME).write_text(f"{text}\n", encoding="utf-8")
