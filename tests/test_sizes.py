"""Nothing is too large to be read in one go: files, functions, lists of parameters, folders."""

import ast
import re
from collections import Counter
from itertools import chain

from shared.dams import ROOT

PYTHON = sorted(chain.from_iterable((ROOT / top).rglob("*.py") for top in ("python", "tests", "benchmarks", "docs")))
RUST = sorted(path for path in ROOT.rglob("*.rs") if not {"target", ".venv"} & set(path.relative_to(ROOT).parts))
LONGEST_FILE = {".py": 400, ".rs": 450}
LONGEST_FUNCTION, MOST_PARAMETERS, MOST_FILES = 60, 7, 25


def named(path):
    return path.relative_to(ROOT).as_posix()


def python_functions(text):
    """Yield name, lines of code (the docstring apart) and number of parameters of every function."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            documented = ast.get_docstring(node, clean=False) is not None
            docstring = node.body[0].end_lineno - node.body[0].lineno + 1 if documented else 0
            given = node.args
            names = [each.arg for each in (*given.posonlyargs, *given.args, *given.kwonlyargs)]
            names += [each.arg for each in (given.vararg, given.kwarg) if each is not None]
            count = sum(name not in ("self", "cls") for name in names)
            yield node.name, node.end_lineno - node.lineno + 1 - docstring, count


def rust_functions(text):
    """Yield name and lines of every function with a body, by its braces."""
    # What is no code has braces too: comments, texts (raw ones first), characters.
    code = re.sub(
        r'//[^\n]*|/\*.*?\*/|r(#*)".*?"\1|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'',
        lambda found: re.sub(r"[^\n]", " ", found[0]),
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
        yield start[1], code.count("\n", start.start(), end) + 1


def test_the_measure_itself():
    python = 'def one(self, a, *b, c=1, **d):\n    """Say.\n\n    More.\n    """\n    def two(): ...\n    return 1\n'
    assert list(python_functions(python)) == [("one", 3, 4), ("two", 1, 0)]
    rust = (
        "trait A { fn no(&self) -> [u8; 3]; }\n"
        "fn one<'a>(s: &'a str) -> f64 {\n // }\n let c = '}';\n if x { \"{\" }\n}\n"
    )
    assert list(rust_functions(rust)) == [("one", 5)]


def test_files():
    lines = {path: path.read_text(encoding="utf-8").count("\n") for path in (*PYTHON, *RUST)}
    assert RUST
    found = {f"{named(path)}: {count} lines" for path, count in lines.items() if count > LONGEST_FILE[path.suffix]}
    assert not found, "\n".join(sorted(found))


def test_functions():
    # A command has its options for lines.
    of_all = [(path, python_functions) for path in PYTHON if "cli" not in path.parts]
    of_all += [(path, rust_functions) for path in RUST]
    found = {
        f"{named(path)} {name}: {lines} lines"
        for path, functions in of_all
        for name, lines, *_ in functions(path.read_text(encoding="utf-8"))
        if lines > LONGEST_FUNCTION
    }
    assert not found, "\n".join(sorted(found))


def test_parameters():
    # Of the program and its benchmarks: the parameters of a test are what it varies.
    found = {
        f"{named(path)} {name}: {count} parameters"
        for path in PYTHON
        for name, _, count in python_functions(path.read_text(encoding="utf-8"))
        if count > MOST_PARAMETERS and not {"cli", "tests"} & set(path.relative_to(ROOT).parts)
    }
    assert not found, "\n".join(sorted(found))


def test_folders():
    counts = Counter(named(path.parent) for path in (*PYTHON, *RUST))
    found = {f"{folder}: {count} files" for folder, count in counts.items() if count > MOST_FILES}
    assert not found, "\n".join(sorted(found))
