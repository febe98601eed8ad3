"""Imports go one way: the contracts of pyproject.toml hold and would catch an import that goes back up, no contract has
an exception, and no files import each other in a circle, neither of Python nor of Rust."""

import ast
import re
import shutil
import subprocess
import sys
import tomllib
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from shared.dams import ROOT

PACKAGE = ROOT / "python" / "heeltoe"
KERNELS = ROOT / "crates" / "heeltoe" / "src"
ONE_WAY = "Data flows one way"
MODELS = "The chain stands on the other models, which do not know each other"
VIEWS = "Figures and words stand below the faces that use them"
WITHIN = "\n\ndef _climb() -> None:\n    {0}\n"
FOR_TYPES = "\n\nif TYPE_CHECKING:\n    {0}\n"


def linted(place: Path) -> tuple[int, str]:
    """Check the package that lies in `place`, which an editable installation does not hide."""
    program = "from importlinter.cli import lint_imports_command as check; check()"
    process = subprocess.run(
        [sys.executable, "-c", program, "--config", ROOT / "pyproject.toml", "--no-logo", "--no-cache"],
        cwd=place,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    return process.returncode, process.stdout + process.stderr


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    place = tmp_path_factory.mktemp("imports")
    shutil.copytree(PACKAGE, place / "heeltoe", ignore=shutil.ignore_patterns("*.so", "*.pyd", "__pycache__"))
    return place


def test_all_contracts_hold(copy):
    code, message = linted(copy)
    assert code == 0, message
    for contract in (ONE_WAY, MODELS, VIEWS):
        assert f"{contract} KEPT" in message


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "form", "forbidden", "contract"),
    [
        ("geometry/section.py", "\n{0}\n", "from heeltoe.case.model import Case", ONE_WAY),
        ("mechanics/block.py", "\n{0}\n", "from heeltoe import rigid", ONE_WAY),
        ("motion/spectrum.py", WITHIN, "from heeltoe.views.figures import write", ONE_WAY),
        ("result/response.py", FOR_TYPES, "from heeltoe.models.rigid.model import rigid", ONE_WAY),
        ("models/statics/cases.py", WITHIN, "from heeltoe.models.flexible.body.loads import edge_shapes", MODELS),
        ("views/words/numbers.py", FOR_TYPES, "from heeltoe.views.content.tree import Value", VIEWS),
    ],
)
def test_an_import_that_goes_back_up_is_caught(copy, file, form, forbidden, contract):
    path = copy / "heeltoe" / file
    text = path.read_text()
    try:
        path.write_text(text + form.format(forbidden))
        code, message = linted(copy)
    finally:
        path.write_text(text)
    assert code == 1
    assert f"{contract} BROKEN" in message
    assert f"heeltoe.{file.removesuffix('.py').replace('/', '.')} -> {forbidden.split()[1]}" in message


def test_the_checks_are_part_of_make_lint():
    assert "lint-imports" in (ROOT / "Makefile").read_text()


def test_no_contract_has_an_exception():
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    assert contracts
    assert not [contract["name"] for contract in contracts if "ignore_imports" in contract]


def module_of(path: Path, package: Path) -> str:
    parts = (package.name, *path.relative_to(package).with_suffix("").parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports_at_run_time(tree: ast.AST):
    """Yield module and name of every import but those for types alone; imports within functions count."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            continue
        if isinstance(node, ast.ImportFrom) and node.module is not None:
            yield from ((node.module, name.name) for name in node.names)
        yield from imports_at_run_time(node)


def graph_of(package: Path) -> dict[str, set[str]]:
    modules = {module_of(path, package): path for path in package.rglob("*.py")}
    graph = {}
    for module, path in modules.items():
        imports = imports_at_run_time(ast.parse(path.read_text(encoding="utf-8")))
        targets = {f"{home}.{name}" if f"{home}.{name}" in modules else home for home, name in imports}
        graph[module] = (targets & modules.keys()) - {module}
    return graph


def circle_in(graph: dict[str, set[str]]) -> list[str]:
    try:
        list(TopologicalSorter(graph).static_order())
    except CycleError as error:
        return error.args[1]
    return []


@pytest.mark.slow
def test_no_files_import_each_other_in_a_circle(copy):
    package = copy / "heeltoe"
    assert circle_in(graph_of(package)) == []
    path = package / "geometry" / "section.py"
    text = path.read_text(encoding="utf-8")
    try:
        path.write_text(text + WITHIN.format("from heeltoe.geometry.levels import cut_levels"), encoding="utf-8")
        assert {"heeltoe.geometry.section", "heeltoe.geometry.levels"} <= set(circle_in(graph_of(package)))
    finally:
        path.write_text(text, encoding="utf-8")


def rust_module(path: Path, root: Path) -> tuple[str, ...]:
    parts = path.relative_to(root).with_suffix("").parts
    return parts[:-1] if parts[-1] in ("mod", "lib") else parts


def rust_paths(text: str):
    """Yield each path that a file uses, braces taken apart; comments, and tests at its end, use nothing."""
    code = re.sub(r"//[^\n]*|\(in [\w:]+\)", "", text)
    code = re.sub(r"#\[cfg\(test\)\]\s*mod \w+;", "", code).split("#[cfg(test)]\nmod")[0]
    # Of a module within the file the first step up ends in the file.
    code = re.sub(r"\bmod \w+ \{.*?\n\}", lambda inner: inner[0].replace("super::", "self::"), code, flags=re.DOTALL)
    for path in re.findall(r"\b((?:super|self|crate)::[\w:\s]*(?:\{[^;]*\})?)", code):
        start, _, several = path.partition("{")
        ends = [end for end in re.split(r"[,{}\s]+", several) if end]
        yield from ((start + end).replace(" ", "").split("::") for end in ends or [""])
    # What a module hands on of its children.
    yield from (["self", *path.split("::")] for path in re.findall(r"pub(?:\([^)]*\))? use ([a-z]\w*::\w+)", code))


def rust_graph(root: Path) -> dict[tuple[str, ...], set[tuple[str, ...]]]:
    modules = {rust_module(path, root): path for path in root.rglob("*.rs") if path.stem != "tests"}
    graph = {}
    for module, path in modules.items():
        targets = set()
        for names in rust_paths(path.read_text(encoding="utf-8")):
            place = () if names[0] == "crate" else module
            for name in names:
                place = place[:-1] if name == "super" else place
                if name not in ("super", "self", "crate"):
                    if (*place, name) not in modules:
                        break
                    place = (*place, name)
            targets.add(place)
        graph[module] = targets - {module}
    return graph


def test_no_modules_of_rust_use_each_other_in_a_circle(tmp_path):
    graph = rust_graph(KERNELS)
    assert sum(len(targets) for targets in graph.values()) > 300
    assert circle_in(graph) == []
    root = tmp_path / "src"
    shutil.copytree(KERNELS, root)
    block = root / "rigid" / "block.rs"
    block.write_text("use super::{event, impact::Impact};\n" + block.read_text(encoding="utf-8"), encoding="utf-8")
    assert {("rigid", "block"), ("rigid", "impact")} <= set(circle_in(rust_graph(root)))
