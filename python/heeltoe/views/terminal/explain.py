"""What the terminal shows of the meaning of names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import groupby
from typing import Any

from rich.console import Console
from rich.markup import escape

from heeltoe.result.write import build_info
from heeltoe.views.explain.find import explain
from heeltoe.views.explain.meaning import KINDS, Meaning
from heeltoe.views.terminal.render import label_grid, label_lines

# Longer names push what they mean to the right.
_NAME = 40


def as_json(found: Sequence[Meaning]) -> dict[str, Any]:
    """Return all that is said of some names."""
    return {"names": [asdict(each) | {"parts": list(each.parts)} for each in found], "build": build_info()}


def print_meanings(found: Sequence[Meaning], console: Console) -> None:
    """Print what a name means, everywhere it means something."""
    for place, each in enumerate(found):
        if place:
            console.print()
        console.print(f"[bold]{escape(each.name)}[/bold]  ({each.kind})", soft_wrap=True)
        console.print(f"  {escape(each.meaning)}")
        lines = [
            ("holds" if each.kind.startswith("field") else "unit", each.holds),
            ("default", each.default),
            ("range", each.limits),
            ("read by" if each.kind == "field of a case" else "found in", each.found_in),
            ("not with", each.not_with),
            ("more in", f"docs/{each.page.replace(' equation', ', equation')}" if each.page else ""),
        ]
        told = [(f"  {label}", escape(text)) for label, text in lines if text]
        if told:
            console.print(label_lines(told))
        if each.parts:
            console.print()
            console.print(_parts(each))


def _parts(block: Meaning) -> Any:
    grid = label_grid()
    for name in block.parts:
        inner = next(each for each in explain(name) if each.kind == block.kind)
        grid.add_row(f"  {escape(name)}", escape(inner.meaning))
    return grid


def print_list(found: Sequence[Meaning], console: Console) -> None:
    """Print all names, kind by kind, a line each with the begin of what they mean."""
    for kind, names in groupby(found, key=lambda each: each.kind):
        console.print(f"[bold]{KINDS[kind]}[/bold]")
        console.print()
        for each in names:
            console.print(f"  {escape(f'{each.name:{_NAME}}')}  {escape(each.short)}", soft_wrap=True)
        console.print()
    console.print("heeltoe explain NAME says more of one")
