"""Lists what is large: files, functions, lists of parameters, folders. A symptom to look at; it never fails.

python .ci/sizes.py
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LONG_FILE, LONG_FUNCTION, MANY_PARAMETERS, MANY_FILES = 600, 60, 7, 25


def python_functions(text: str) -> Iterator[tuple[str, int, int]]:
    """Yield name, lines of code (the docstring apart) and number of parameters of every function."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            documented = ast.get_docstring(node, clean=False) is not None
            docstring = node.body[0].end_lineno - node.body[0].lineno + 1 if documented else 0
            arguments = node.args
            names = [name.arg for name in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]
            names += [name.arg for name in (arguments.vararg, arguments.kwarg) if name is not None]
            count = sum(name not in ("self", "cls") for name in names)
            yield node.name, node.end_lineno - node.lineno + 1 - docstring, count


def rust_functions(text: str) -> Iterator[tuple[str, int, int]]:
    """Yield name and lines of every function with a body, by its braces; its parameters are not counted."""
    # Comments, texts (raw ones first) and characters have braces too, and are no code.
    code = re.sub(
        r'//[^\n]*|/\*.*?\*/|r(#*)".*?"\1|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'',
        lambda match: re.sub(r"[^\n]", " ", match[0]),
        text,
        flags=re.DOTALL,
    )
    for start in re.finditer(r"\bfn\s+(\w+)", code):
        depth, end = 0, start.end()
        while depth or code[end] not in "{;":
            depth += {"{": 1, "(": 1, "[": 1, "}": -1, ")": -1, "]": -1}.get(code[end], 0)
            end += 1
        if code[end] == ";":
            continue
        depth = 1
        while depth:
            end += 1
            depth += {"{": 1, "}": -1}.get(code[end], 0)
        yield start[1], code.count("\n", start.start(), end) + 1, 0


def sources() -> list[Path]:
    """Return all Python and Rust files of the project."""
    tops = ("python", "tests", "benchmarks", "docs", ".ci", "crates")
    paths = (path for top in tops for ending in ("*.py", "*.rs") for path in (ROOT / top).rglob(ending))
    return sorted(paths)


def large() -> Iterator[str]:
    """Yield a line for everything that is large."""
    folders: Counter[str] = Counter()
    for path in sources():
        name, text = path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")
        folders[Path(name).parent.as_posix()] += 1
        if (lines := text.count("\n")) > LONG_FILE:
            yield f"{name}: {lines} lines"
        if "/cli/" in name:  # the options of a command are its lines and parameters
            continue
        for function, length, parameters in (python_functions if path.suffix == ".py" else rust_functions)(text):
            if length > LONG_FUNCTION:
                yield f"{name} {function}: {length} lines"
            if parameters > MANY_PARAMETERS and not name.startswith("tests/"):
                yield f"{name} {function}: {parameters} parameters"
    for folder, count in folders.items():
        if count > MANY_FILES:
            yield f"{folder}: {count} files"


if __name__ == "__main__":
    rows = list(large())
    print(f"large (look whether it is two subjects in one): {len(rows)}")
    print("\n".join(f"  {row}" for row in rows))
