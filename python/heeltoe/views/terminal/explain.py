"""Meanings of names on the terminal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import groupby

from rich.console import Console
from rich.markup import escape

from heeltoe.case.thesis import THESIS_FIELDS
from heeltoe.kernel.build import build_info
from heeltoe.views.explain.find import explain, related
from heeltoe.views.explain.meaning import KINDS, Meaning
from heeltoe.views.terminal.screen import label_grid, label_lines

# Longer names push what they mean to the right.
_NAME = 40
# A name with more meanings than these gets a line for each.
_MANY = 6


def as_json(meanings: Sequence[Meaning]) -> dict[str, object]:
    """Return the meanings of some names."""
    return {"names": [asdict(meaning) | {"parts": list(meaning.parts)} for meaning in meanings], "build": build_info()}


def print_meanings(meanings: Sequence[Meaning], console: Console, *, all_: bool = False) -> None:
    """Print the meanings of a name; where it has many, a line for each. `all_` prints hidden fields of a block, too."""
    if len(meanings) > _MANY:
        print_list(meanings, console)
        return
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
            _print_parts(meaning, console, all_=all_)
    others = related(meanings[0].last, meanings)
    if others:
        console.print()
        console.print(f"See also {', '.join(map(escape, others))}")


def _print_parts(block: Meaning, console: Console, *, all_: bool) -> None:
    """Print the fields of a block, then in a line each those of a block like it and those of the thesis."""
    fields = [next(found for found in explain(name) if found.kind == block.kind) for name in block.parts]
    shown = [field for field in fields if all_ or not field.hidden]
    if shown:
        grid = label_grid()
        for field in shown:
            grid.add_row(f"  {escape(field.name)}", escape(field.meaning))
        console.print(grid)
    hidden = [field for field in fields if field not in shown]
    thesis = [field.name.rpartition(".")[2] for field in hidden if field.name in THESIS_FIELDS]
    if block.like and len(hidden) > len(thesis):
        console.print(f"  and the fields of {block.like}: heeltoe explain {block.like}")
    if thesis:
        console.print(f"  and, for comparison with Zhu (2004), docs/thesis.md: {', '.join(thesis)}")


def print_subjects(meanings: Sequence[Meaning], console: Console) -> None:
    """Print what there is to ask for: the blocks of a case and of a study, and how many names of each other kind."""
    for kind, group in groupby(meanings, key=lambda meaning: meaning.kind):
        names = list(group)
        if not kind.startswith("field"):
            console.print(f"[bold]{KINDS[kind]}[/bold]  {len(names)}, such as {escape(names[0].name)}")
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
    """Print all names, kind by kind, a line each with the begin of their meaning."""
    for kind, names in groupby(meanings, key=lambda meaning: meaning.kind):
        console.print(f"[bold]{KINDS[kind]}[/bold]")
        console.print()
        for name in names:
            console.print(f"  {escape(f'{name.name:{_NAME}}')}  {escape(name.short)}", soft_wrap=True)
        console.print()
    console.print("heeltoe explain NAME says more of one")
