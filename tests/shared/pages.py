"""What stands in the documentation, piece by piece."""

from __future__ import annotations

import ast
import re
import subprocess
from functools import cache
from pathlib import Path

from shared.dams import ROOT

PAGES = {
    str(path.relative_to(ROOT)): path.read_text(encoding="utf-8")
    for place in ("*.md", "docs/*.md", "docs/howto/*.md", "docs/validation/*.md", "benchmarks/*.md")
    for path in sorted(ROOT.glob(place))
}


def blocks(language: str) -> list[tuple[str, str, str]]:
    """Return the fenced blocks in a language: page with line, the block, and the comment on the line before it."""
    pieces = []
    for page, text in PAGES.items():
        for block in re.finditer(rf"(?:^<!-- (.*?) -->\n)?^```{language}\n(.*?)^```$", text, re.M | re.S):
            line = text.count("\n", 0, block.start(2))
            pieces.append((f"{page}:{line}", block[2], block[1] or ""))
    return pieces


def command_lines() -> list[tuple[str, str]]:
    """Return the commands of heeltoe that stand on lines of their own: page with line, and the line."""
    lines = []
    for page, text in PAGES.items():
        for line in re.finditer(r"^ {4}(heeltoe (?:.*\\\n)*.*)$", text, re.M):
            number = text.count("\n", 0, line.start()) + 1
            lines.append((f"{page}:{number}", line[1].replace("\\\n", " ")))
    return lines


def spans(page: str) -> list[str]:
    """Return what stands between backquotes in the running text of a page."""
    text = re.sub(r"^```.*?^```$", "", PAGES[page], flags=re.M | re.S)
    return [" ".join(span.split()) for span in re.findall(r"`([^`]+)`", text)]


def links() -> list[tuple[str, str]]:
    """Return page and target of every link and picture."""
    return [(page, target) for page, text in PAGES.items() for target in re.findall(r"\]\(([^)\s]+)\)", text)]


def headings(page: str) -> set[str]:
    """Return the anchors that the headings of a page make."""
    titles = re.findall(r"^#+ (.*)$", PAGES[page], re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


@cache
def files() -> tuple[str, ...]:
    """Return the paths of all files of the project."""
    names = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    ).stdout.split()
    return tuple(names or (str(path.relative_to(ROOT)) for path in ROOT.rglob("*") if _ours(path)))


def _ours(path: Path) -> bool:
    """Whether a path of a copy without its history can be a file of the project."""
    return path.is_file() and not {".venv", "target", "out"} & set(path.parts)


def equations(page: str) -> list[str]:
    """Return the numbers of the equations of a page, in their order."""
    return re.findall(r"\\tag\{(\d+[a-z]?)\}", PAGES[page])


_PLACE = r"`([\w./-]+\.(?:py|rs))::(\w+)`"


def equation_rows() -> list[tuple[str, tuple[str, str], tuple[str, str]]]:
    """Return what stands beside equations and rules: page, then file and function of the code, and of the test."""
    rows = []
    for page, text in PAGES.items():
        for row in re.findall(rf"^(?:code |\| [^|\n]* \| ){_PLACE}(?: · test | \| ){_PLACE}", text, re.M):
            rows.append((page, row[:2], row[2:]))
    return rows


@cache
def functions(file: str) -> frozenset[str]:
    """Return the names of all functions of a Python or Rust file, methods included."""
    text = (ROOT / file).read_text(encoding="utf-8")
    if file.endswith(".rs"):
        return frozenset(re.findall(r"\bfn (\w+)", text))
    return frozenset(
        node.name for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    )


@cache
def proofs(file: str) -> frozenset[str]:
    """Return the names of the tests in a Python or Rust file."""
    if file.endswith(".rs"):
        text = (ROOT / file).read_text(encoding="utf-8")
        return frozenset(re.findall(r"#\[test\](?:\s*#\[[^\]]*\])*\s*fn (\w+)", text))
    return frozenset(name for name in functions(file) if name.startswith("test_"))
