"""The types of the compiled kernels, written by hand, have the names that the kernels have."""

import ast

import pytest

from heeltoe.kernel import _kernel
from shared.dams import ROOT

STUB = ast.parse((ROOT / "python" / "heeltoe" / "kernel" / "_kernel.pyi").read_text(encoding="utf-8"))
CLASSES = {
    node.name: node
    for node in STUB.body
    if isinstance(node, ast.ClassDef) and "Protocol" not in {ast.unparse(base) for base in node.bases}
}


def names_of(node: ast.ClassDef) -> set[str]:
    fields = {part.target.id for part in node.body if isinstance(part, ast.AnnAssign)}
    return fields | {part.name for part in node.body if isinstance(part, ast.FunctionDef)} - {"__init__"}


def test_all_classes_and_functions_are_there():
    functions = {node.name for node in STUB.body if isinstance(node, ast.FunctionDef)}
    compiled = {name for name in dir(_kernel) if callable(getattr(_kernel, name))}
    assert functions | CLASSES.keys() == compiled


@pytest.mark.parametrize("name", [name for name in CLASSES if name != "InternalError"])
def test_a_class_has_its_fields(name):
    compiled = {member for member in dir(getattr(_kernel, name)) if not member.startswith("_")}
    assert names_of(CLASSES[name]) == compiled
