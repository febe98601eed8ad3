"""The types of the compiled kernels, written by hand, have the names and arguments that the kernels have."""

import ast
import inspect

import pytest

from heeltoe.kernel import _kernel
from shared.dams import ROOT

Kind = inspect._ParameterKind
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


def of_stub(node: ast.FunctionDef) -> list[tuple[str, inspect._ParameterKind, str]]:
    """Name, kind and default, as text, of each argument of a stub."""
    arguments = node.args
    positional = [*arguments.posonlyargs, *arguments.args]
    defaults = [None] * (len(positional) - len(arguments.defaults)) + arguments.defaults
    rows = [
        (argument, Kind.POSITIONAL_ONLY if argument in arguments.posonlyargs else Kind.POSITIONAL_OR_KEYWORD, default)
        for argument, default in zip(positional, defaults, strict=True)
    ]
    if arguments.vararg is not None:
        rows.append((arguments.vararg, Kind.VAR_POSITIONAL, None))
    pairs = zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
    rows += [(argument, Kind.KEYWORD_ONLY, default) for argument, default in pairs]
    return [(argument.arg, kind, "" if default is None else ast.unparse(default)) for argument, kind, default in rows]


def of_compiled(function: object) -> list[tuple[str, inspect._ParameterKind, str]]:
    parameters = inspect.signature(function).parameters.values()
    return [
        (each.name, each.kind, "" if each.default is inspect.Parameter.empty else repr(each.default))
        for each in parameters
    ]


@pytest.mark.parametrize("name", [node.name for node in STUB.body if isinstance(node, ast.FunctionDef)])
def test_a_function_has_its_arguments(name):
    node = next(part for part in STUB.body if isinstance(part, ast.FunctionDef) and part.name == name)
    assert of_stub(node) == of_compiled(getattr(_kernel, name))


@pytest.mark.parametrize("name", [name for name in CLASSES if name != "InternalError"])
def test_methods_of_a_class_have_their_arguments(name):
    compiled = getattr(_kernel, name)
    for node in (part for part in CLASSES[name].body if isinstance(part, ast.FunctionDef)):
        decorators = {ast.unparse(decorator) for decorator in node.decorator_list}
        if "property" in decorators:
            continue
        if node.name == "__init__":
            # The compiled class has it as its signature, without the instance.
            assert of_stub(node)[1:] == of_compiled(compiled)
        else:
            assert [row[0] for row in of_stub(node)] == [row[0] for row in of_compiled(getattr(compiled, node.name))]
            assert of_stub(node)[1:] == of_compiled(getattr(compiled, node.name))[1:]
