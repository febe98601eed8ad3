"""Counts what a newcomer reads: fields, errors, warnings, options, words, sentences that avoid their noun.

A report to look at; it never fails. Run it with the Python that heeltoe is installed in:

    python .ci/knobs.py            # the counts
    python .ci/knobs.py --list     # every sentence that matches one of the nineteen patterns, too
"""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import typer

from heeltoe.cli.main import program
from heeltoe.errors.error import CATALOGUE as ERRORS
from heeltoe.views.explain import find
from heeltoe.warnings.notice import CATALOGUE as WARNINGS
from heeltoe.warnings.notice import templates

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "python" / "heeltoe"
#: The begin of a text or of a sentence in it.
_BEGIN = r"(?:^|(?<=[.:;!?] ))"
#: Nineteen ways of a sentence to avoid its noun. "What" and "Who" begin questions of headings, which may stand.
PATTERNS = {
    "begins with Of": _BEGIN + r"Of ",
    "begins with What": _BEGIN + r"What (?![^.]*\?)",
    "begins with Who": _BEGIN + r"(?:Who|Whose|Whoever) (?![^.]*\?)",
    "begins with There,": _BEGIN + r"There[;,]",
    "begins with That of": _BEGIN + r"(?:That|Those) (?:of|that|which)\b",
    "begins with The same of": _BEGIN + r"The same (?:of|for)\b",
    "preposition + what": r"\b(?:of|by|with|from|for|to|on|than|beside|as|over|under|after|before|against|like) what\b",
    "told": r"\btold\b",
    "said": r"\bsaid\b",
    "nobody": r"\b(?:nobody|somebody)\b",
    "as it is": r"\bas (?:it is|they are)(?=[.,;:)]|$)",
    "so many": r"\bso (?:many|much|few)\b",
    "none such": r"\b(?:no|none) such\b(?! (?:file|field))",
    "all that is": r"\b(?:all|everything|nothing) that (?:is|are|it|there)\b",
    "asked for": r"\basked for\b",
    "keeps within": r"\bkeeps? (?:within|its|none)\b",
    "has come to": r"\b(?:has|have) come to\b(?! rest)|\bfor certain\b",
    "has none": r"\b(?:has|have) none\b|\bis none of\b",
    "held against": r"\bheld against\b|\bgo(?:es)? on by\b|\bfrom when on\b",
}
assert len(PATTERNS) == 19


def options() -> Iterator[tuple[str, str, str]]:
    """Walk the visible options and arguments of all commands: command, name and help."""
    for name, command in typer.main.get_command(program()).commands.items():
        yield name, "", command.help or ""
        for parameter in command.params:
            if parameter.name != "help" and not getattr(parameter, "hidden", False):
                kind = parameter.opts[0] if parameter.param_type_name == "option" else ""
                yield name, kind, getattr(parameter, "help", None) or ""


def docstrings() -> Iterator[tuple[str, str]]:
    """Walk the first lines of the docstrings of the package."""
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
                text = ast.get_docstring(node)
                if text:
                    line = getattr(node, "lineno", 1)
                    yield f"{path.relative_to(ROOT)}:{line}", " ".join(text.partition("\n\n")[0].split())


def prose() -> Iterator[tuple[str, str]]:
    """Walk the paragraphs of README and docs, without programs and output."""
    for path in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        if "_build" in path.parts or "generated" in path.parts:
            continue
        text = re.sub(r"```.*?```", lambda match: "\n" * match[0].count("\n"), path.read_text("utf-8"), flags=re.DOTALL)
        number, first, lines = 0, 0, list[str]()
        for number, line in enumerate((*text.split("\n"), ""), 1):
            if not line.strip() or line.startswith(("    ", "|", "#", "- ", "* ")):
                if lines:
                    yield f"{path.relative_to(ROOT)}:{first}", " ".join(lines)
                lines = []
            if line.startswith(("|", "#")):
                for cell in line.strip("|# ").split("|"):
                    yield f"{path.relative_to(ROOT)}:{number}", cell.strip()
            elif line.strip() and not line.startswith("    "):
                first = first if lines else number
                lines.append(line.strip().lstrip("-* "))


def words() -> int:
    """Return how many words README and docs have."""
    paths = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
    kept = [path for path in paths if "_build" not in path.parts and "generated" not in path.parts]
    return sum(len(path.read_text(encoding="utf-8").split()) for path in kept)


def texts() -> dict[str, list[tuple[str, str]]]:
    """Return all that a reader is shown, by kind: places and texts."""
    names = find.everything()
    return {
        "help texts": [(f"{command} {option}", text) for command, option, text in options()],
        "field texts": [(meaning.name, meaning.meaning) for meaning in names if meaning.kind.startswith("field")],
        "JSON texts": [(meaning.name, meaning.meaning) for meaning in names if not meaning.kind.startswith("field")],
        "errors": [(code, part) for code, parts in ERRORS.items() for part in parts],
        "warnings": [(code, text) for code in WARNINGS for text in templates(code).values()],
        "docstrings": list(docstrings()),
        "docs": list(prose()),
    }


def shown_fields() -> tuple[int, int]:
    """Return how many fields of a case `explain` lists, blocks apart: by default, and with ``--all``."""
    every = [meaning for meaning in find.everything() if meaning.kind == "field of a case"]
    listed = getattr(find, "usual_names", find.everything)()
    usual = [meaning for meaning in listed if meaning.kind == "field of a case"]
    return tuple(sum(not meaning.parts for meaning in names) for names in (usual, every))  # type: ignore[return-value]


def main() -> None:
    """Print the counts."""
    usual, every = shown_fields()
    typed = Counter(command for command, option, _ in options() if option)
    lines = sum(path.read_text("utf-8").count("\n") for path in PACKAGE.rglob("*.py"))
    rows = [
        (usual, f"fields of a case in explain ({every} with --all)"),
        (len(ERRORS), "errors"),
        (len(WARNINGS), "warnings"),
        (sum(typed.values()), f"options ({', '.join(f'{name} {count}' for name, count in typed.items())})"),
        (words(), "words of README and docs"),
        (lines, "lines of Python in the wheel"),
    ]
    found: list[tuple[str, str, str, str]] = []
    for kind, places in texts().items():
        matches = [
            (kind, name, place, text)
            for place, text in dict.fromkeys(places)
            for name, pattern in PATTERNS.items()
            if re.search(pattern, text)
        ]
        found += matches
        rows.append((len(matches), f"sentences that avoid their noun, {kind}"))
    for count, name in rows:
        print(f"{count:>7,}  {name}")
    for name, count in Counter(match[1] for match in found).most_common():
        print(f"{count:>9,}  {name}")
    if "--list" in sys.argv:
        for kind, name, place, text in found:
            print(f"{kind} | {name} | {place} | {text}")


if __name__ == "__main__":
    main()
