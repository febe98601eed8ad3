"""Pages of the reference, from what the code says of itself: fields, keys, columns, commands, the Python names."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import typer

import heeltoe
from heeltoe.case.combinations import FEATURES, RULES, USERS
from heeltoe.cli.main import program
from heeltoe.views.explain.find import everything
from heeltoe.views.explain.meaning import Meaning

PAGES = {
    "case": ("Fields of a case", ("field of a case",), "`heeltoe explain NAME` says the same on the terminal."),
    "study": (
        "Fields of a study",
        ("field of a study",),
        "A field that varies has a list of values or, under `vary.*`, a distribution; [studies](../studies.md) have "
        "examples.",
    ),
    "json": (
        "Keys of the JSON",
        ("key of the JSON",),
        "The numbers of `--json` and of `response.to_json()`. `[]` is a place in a list, `*` any name. Numbers are "
        "SI, per metre of dam. [How to read results in pandas](../howto/pandas.md) has examples.",
    ),
    "columns": (
        "Columns of the tables",
        ("column of the histories", "column of the events", "column of a study"),
        "Parquet or CSV, SI. An elastic dam has no events; columns of what a model does not have are not there.",
    ),
    "outcomes": (
        "Outcomes of a run",
        ("outcome of a run",),
        "The key and the column `outcome` have one of these; a command whose run has no result ends with exit code 3.",
    ),
}


def write_reference(place: Path) -> None:
    """Write the pages into a directory."""
    for name, (title, kinds, remark) in PAGES.items():
        (place / f"{name}.md").write_text("\n".join(_page(title, kinds, remark)), encoding="utf-8")
    (place / "combinations.md").write_text("\n".join(combinations()), encoding="utf-8")
    (place / "commands.md").write_text("\n".join(_commands()), encoding="utf-8")
    (place / "python.md").write_text("\n".join(_python()), encoding="utf-8")


def _page(title: str, kinds: tuple[str, ...], said: str) -> Iterator[str]:
    yield from (f"# {title}", "", said, "")
    for kind in kinds:
        result = [item for item in everything() if item.kind == kind]
        level = "##"
        if len(kinds) > 1:
            yield from (f"## {kind.removeprefix('column of ').capitalize()}", "")
            level = "###"
        for block, members in _blocks(result):
            if block:
                about = f" {_link(block.page)}" if block.page else ""
                yield from (f"{level} {_text(block.name)}", "", f"{_text(block.meaning)}{about}", "")
            for member in members:
                yield from _entry(member, "" if block is None else block.page)


def _blocks(found: list[Meaning]) -> Iterator[tuple[Meaning | None, list[Meaning]]]:
    """Group names by the block that they stand in; those of no block come first."""
    blocks = [item for item in found if item.parts]
    inside = {name for block in blocks for name in block.parts}
    yield None, [item for item in found if not item.parts and item.name not in inside]
    by_name = {item.name: item for item in found}
    for block in blocks:
        yield block, [by_name[name] for name in block.parts if name in by_name and not by_name[name].parts]


def _entry(each: Meaning, page: str) -> Iterator[str]:
    """Walk the lines of a name, which links to a page only where its block does not."""
    field = each.kind.startswith("field")
    command = each.found_in if each.kind == "key of the JSON" and each.found_in != "heeltoe run --json" else ""
    parts = [
        each.holds if field or not each.holds else f"in {each.holds}",
        each.default if each.default in ("", "it must be said") else f"default {each.default}",
        each.limits,
        f"read by {each.found_in}" if field and each.found_in not in ("", "all models", "what is shown alone") else "",
        f"found in {command}" if command else "",
    ]
    remark = _text("; ".join(filter(None, parts)))
    more = [f"*{remark}*" if remark else "", _link(each.page) if each.page != page else ""]
    yield f"`{each.name}`"
    yield f": {_text(each.meaning)}" + "".join(f"\\\n  {line}" for line in [" ".join(filter(None, more))] if line)
    yield ""


def _link(page: str) -> str:
    """Return a link to a page and the heading or the equation on it."""
    if not page:
        return ""
    if " equation " in page:
        file, number = page.split(" equation ")
        name = file.removesuffix(".md")
        return f'<a href="../{name}.html#equation-{number}">equation {number} of {name}</a>'
    return f"[more](../{page})"


def _text(text: str) -> str:
    """Return a text in which stars and brackets are themselves."""
    pieces = re.split(r"(`[^`]*`)", text)
    return "".join(piece if piece.startswith("`") else re.sub(r"([*\[\]<>_])", r"\\\1", piece) for piece in pieces)


def combinations() -> Iterator[str]:
    """Walk the page of what goes with what, from the table that the checks read."""
    yield from (
        "# Fields that go together",
        "",
        "A case that has both is refused, with the field and the remedy; or it runs, and a warning says what is left",
        "out. Whatever is not listed here goes together. [Fields of a case](case.md) say which models read them.",
        "",
        "| feature | not with | in | verdict | reason |",
        "| --- | --- | --- | --- | --- |",
    )
    for rule in RULES:
        users = ", ".join(USERS[user] for user in rule.users) or "everything"
        cells = (rule.feature, rule.other or "(alone)", users, rule.verdict, rule.reason)
        yield f"| {' | '.join(map(_text, cells))} |"
    yield from ("", "## Fields of these features", "")
    for feature in FEATURES.values():
        fields = ", ".join(f"`{field}`" for field in feature.fields)
        yield from (f"{feature.name}", f": {fields}. Without it: {_text(feature.removal)}.", "")


def _commands() -> Iterator[str]:
    """Walk the page of the commands."""
    yield from (
        "# Commands",
        "",
        "The words of `heeltoe COMMAND --help`. Exit codes: 0 a result, 2 the input is wrong,",
        "3 the run ended without a result to trust, 1 a bug.",
        "",
    )
    commands: dict[str, Any] = typer.main.get_command(program()).commands  # type: ignore[attr-defined]
    for name, command in commands.items():
        arguments = [param for param in command.params if param.param_type_name == "argument"]
        options = [param for param in command.params if _is_listed(param)]
        text = " ".join((command.help or "").split())
        called = " ".join([f"heeltoe {name}", *(argument.metavar or argument.name.upper() for argument in arguments)])
        yield from (f"## heeltoe {name}", "", _text(text), "", f"    {called}{' [OPTIONS]' if options else ''}", "")
        for item in (*arguments, *options):
            written = ", ".join(item.opts) if item.param_type_name == "option" else item.metavar or item.name.upper()
            value = "" if item.param_type_name == "argument" or item.is_flag else f" {item.metavar or 'TEXT'}"
            default = f" *Default: {item.default}.*" if _worth_saying(item) else ""
            yield from (
                f"`{written}{value}`",
                "",
                f": {_text(getattr(item, 'help', None) or 'Its subject.')}{default}",
                "",
            )


def _is_listed(parameter: Any) -> bool:
    """Whether the help of a command lists a parameter as an option."""
    return parameter.param_type_name == "option" and parameter.name != "help" and not parameter.hidden


def _worth_saying(parameter: Any) -> bool:
    return isinstance(parameter.default, str | int | float) and not isinstance(parameter.default, bool)


def _python() -> Iterator[str]:
    """Walk the page of the public names: classes, then functions."""
    yield from (
        "# Python",
        "",
        "All public names; `dir(heeltoe)` lists them. [From Python](../python.md) shows how they go",
        "together.",
        "",
    )
    names = [(name, getattr(heeltoe, name)) for name in heeltoe.__all__]
    yield from _named("Functions", (name for name, each in names if not inspect.isclass(each)), "autofunction")
    yield from _named("Classes", (name for name, each in names if inspect.isclass(each)), "autoclass")


def _named(title: str, names: Iterable[str], directive: str) -> Iterator[str]:
    yield from (f"## {title}", "")
    for name in names:
        members = ["   :members:"] if directive == "autoclass" else []
        if name == "Case":  # its fields have a page of their own
            members = ["   :members: of, with_, plot"]
        yield from ("```{eval-rst}", f".. {directive}:: heeltoe.{name}", *members, "```", "")
