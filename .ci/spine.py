"""Counts in how many places a rule of the result stands. A report to look at; it never fails.

python .ci/spine.py [root of another copy that is installed]
"""

from __future__ import annotations

import ast
import contextlib
import io
import re
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from types import FrameType

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
PACKAGE = (ROOT if ROOT.is_dir() else ROOT.parents[1]) / "python" / "heeltoe"
OUTCOMES = {"overturned", "unstable", "paradox", "event limit", "cycling", "lost", "blown up", "large rotation"}
LIMITS = {"residual_slip", "peak_slip", "opening_upstream", "opening_downstream", "rotation", "crest_displacement"}
#: What the opening at the upstream face has been called.
OPENINGS = (
    *("opening_heel", "gap_heel", "largest_gap_heel", "gap heel", "gap_heel_m", "largest_gap_heel_m"),
    *("opening_upstream_m", "opening, upstream face", "opening\\nupstream", "upstream opening", "opening up"),
    *("opening at the upstream face",),
)
#: Names of numbers of a run, as its JSON has them.
UNITS = ("_m", "_s", "_rad", "_n", "_pa", "_j", "_g", "_m_s", "_m_s2")


def modules() -> dict[str, ast.Module]:
    """Return the modules of the package, by path."""
    paths = sorted(PACKAGE.rglob("*.py"))
    return {str(path.relative_to(PACKAGE)): ast.parse(path.read_text(encoding="utf-8")) for path in paths}


def texts(node: ast.AST) -> Iterator[str]:
    """Walk the texts of a tree, docstrings apart."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    skipped = {
        id(one.body[0].value)
        for one in ast.walk(node)
        if isinstance(one, documented) and ast.get_docstring(one, clean=False) is not None
    }
    for one in ast.walk(node):
        if isinstance(one, ast.Constant) and isinstance(one.value, str) and id(one) not in skipped:
            yield one.value


def lists_of(trees: dict[str, ast.Module], words: set[str], least: int, *, most: int = 99) -> list[str]:
    """Return where module-level names list so many of some words."""
    places = []
    for path, tree in trees.items():
        for node in tree.body:
            if isinstance(node, ast.Assign | ast.AnnAssign | ast.ClassDef):
                count = len(set(texts(node)) & words)
                if least <= count <= most:
                    places.append(f"{path}:{node.lineno}")
    return places


def circles(trees: dict[str, ast.Module]) -> list[list[str]]:
    """Return circles of files by their imports, those for types alone too (Tarjan's strong components)."""
    names = {"heeltoe." + path[:-3].replace("/", ".").removesuffix(".__init__"): path for path in trees}
    arrows: dict[str, set[str]] = defaultdict(set)
    for path, tree in trees.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.module:
                wanted = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
                arrows[path] |= {names[name] for name in wanted if name in names and names[name] != path}
    order: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(path: str) -> None:
        order[path] = low[path] = len(order)
        stack.append(path)
        for other in sorted(arrows[path]):
            if other not in order:
                visit(other)
            if other in stack:
                low[path] = min(low[path], low[other])
        if low[path] == order[path]:
            part = stack[stack.index(path) :]
            del stack[stack.index(path) :]
            if len(part) > 1:
                found.append(sorted(part))

    sys.setrecursionlimit(10_000)
    for path in trees:
        if path not in order:
            visit(path)
    return found


def calls_of_a_run() -> Counter[str]:
    """Return how many calls the second rigid run of an example in a process makes, by the file that is called."""
    from heeltoe.cli.main import main as heeltoe

    counts: Counter[str] = Counter()

    def count(frame: FrameType, event: str, _: object) -> None:
        file = frame.f_code.co_filename
        if event == "call" and file.startswith(str(PACKAGE)) and frame.f_code.co_name != "<module>":
            counts[file] += 1

    case = PACKAGE.parents[1] / "examples" / "typical-base.toml"
    sys.argv = ["heeltoe", "run", str(case), "--model", "rigid"]
    for profile in (None, count):
        sys.setprofile(profile)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(SystemExit):
            heeltoe()
        sys.setprofile(None)
    return counts


def main() -> None:
    """Print the counts."""
    trees = modules()
    sources = {path: (PACKAGE / path).read_text(encoding="utf-8") for path in trees}
    everything = "\n".join(sources.values())
    lines = everything.splitlines()
    keys = sum(
        bool(re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)+", text)) and text.endswith(UNITS)
        for tree in trees.values()
        for text in texts(tree)
    )
    loose = sum("dict[str, Any]" in line or "Mapping[str, Any]" in line for line in lines)
    quoted = {text for tree in trees.values() for text in texts(tree)}
    rings, calls = circles(trees), calls_of_a_run()
    rows = [
        ("lines of Python", sum(path.read_text("utf-8").count("\n") for path in PACKAGE.rglob("*.py")), ""),
        ("lists of outcomes", *counted(lists_of(trees, OUTCOMES, 5))),
        ("lists of failed or of results", *counted(lists_of(trees, OUTCOMES, 1, most=4))),
        ("lists of limits", *counted(lists_of(trees, LIMITS, 4))),
        ("names of the opening at the upstream face", *counted([name for name in OPENINGS if name in quoted])),
        ("files with residual_slip_m", sum("residual_slip_m" in text for text in sources.values()), ""),
        ("quoted keys of results", keys, ""),
        ("lines with dict[str, Any] or Mapping[str, Any]", loose, ""),
        ("calls of a rigid run, from command to printed answer", calls.total(), f"in {len(calls)} files"),
        ("circles of files", len(rings), "; ".join(" ".join(ring) for ring in rings)),
    ]
    for name, count, where in rows:
        print(f"{count:>7,}  {name}{f': {where}' if where else ''}")


def counted(places: list[str]) -> tuple[int, str]:
    """Return how many places there are, and which."""
    return len(places), ", ".join(places)


if __name__ == "__main__":
    main()
