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


def as_json(meanings: Sequence[Meaning]) -> dict[str, Any]:
    """Return all that is said of some names."""
    return {"names": [asdict(meaning) | {"parts": list(meaning.parts)} for meaning in meanings], "build": build_info()}


def print_meanings(meanings: Sequence[Meaning], console: Console) -> None:
    """Print what a name means, everywhere it means something."""
    for place, meaning in enumerate(meanings):
        if place:
            console.print()
        console.print(f"[bold]{escape(meaning.name)}[/bold]  ({meaning.kind})", soft_wrap=True)
        console.print(f"  {escape(meaning.meaning)}")
        lines = [
            ("holds" if meaning.kind.startswith("field") else "unit", meaning.holds),
            ("default", meaning.default),
            ("range", meaning.limits),
            ("read by" if meaning.kind == "field of a case" else "found in", meaning.found_in),
            ("not with", meaning.not_with),
            ("more in", f"docs/{meaning.page.replace(' equation', ', equation')}" if meaning.page else ""),
        ]
        rows = [(f"  {label}", escape(text)) for label, text in lines if text]
        if rows:
            console.print(label_lines(rows))
        if meaning.parts:
            console.print()
            console.print(_parts(meaning))


def _parts(block: Meaning) -> Any:
    grid = label_grid()
    for name in block.parts:
        inner = next(candidate for candidate in explain(name) if candidate.kind == block.kind)
        grid.add_row(f"  {escape(name)}", escape(inner.meaning))
    return grid


def print_subjects(meanings: Sequence[Meaning], console: Console) -> None:
    """Print what there is to ask for: the blocks of a case and of a study, and how many names of each other kind."""
    for kind, group in groupby(meanings, key=lambda meaning: meaning.kind):
        names = list(group)
        if not kind.startswith("field"):
            console.print(f"[bold]{KINDS[kind]}[/bold]  {len(names)}, as {escape(names[0].name)}")
            continue
        subjects = [name for name in names if "." not in name.name]
        console.print(f"[bold]{KINDS[kind]}[/bold]")
        console.print()
        grid = label_grid()
        for subject in subjects:
            if subject.parts:
                grid.add_row(f"  {escape(subject.name)}", escape(subject.short))
        console.print(grid)
        alone = ", ".join(escape(subject.name) for subject in subjects if not subject.parts)
        if alone:
            console.print(f"  and {alone}")
        console.print()
    console.print()
    console.print("heeltoe explain NAME explains a subject with its fields, a field, a key or a column:")
    console.print("  heeltoe explain crack, heeltoe explain friction, heeltoe explain residual_slip_m")
    console.print("heeltoe explain --all lists every name")


def print_list(meanings: Sequence[Meaning], console: Console) -> None:
    """Print all names, kind by kind, a line each with the begin of what they mean."""
    for kind, names in groupby(meanings, key=lambda meaning: meaning.kind):
        console.print(f"[bold]{KINDS[kind]}[/bold]")
        console.print()
        for name in names:
            console.print(f"  {escape(f'{name.name:{_NAME}}')}  {escape(name.short)}", soft_wrap=True)
        console.print()
    console.print("heeltoe explain NAME says more of one")
