"""The public names: one set, typed, each there whatever was imported before."""

import ast
import pkgutil
import subprocess
import sys
from importlib import import_module

import pytest

import heeltoe
from shared.dams import ROOT

PACKAGE = ROOT / "python" / "heeltoe"


def typed():
    """Return what type checkers read in the root: name to module."""
    tree = ast.parse((PACKAGE / "__init__.py").read_text(encoding="utf-8"))
    (block,) = (node for node in tree.body if isinstance(node, ast.If))
    assert ast.unparse(block.test) == "TYPE_CHECKING"
    result = {}
    for line in block.body:
        assert isinstance(line, ast.ImportFrom)
        for alias in line.names:
            # Without "as" a strict type checker would not hand it on.
            assert alias.asname == alias.name
            result[alias.name] = line.module
    return result


def test_all_lists_of_public_names_agree():
    homes = {name: f"heeltoe.{module}" for name, module in heeltoe._HOME.items()}
    assert homes == typed()
    assert sorted(homes) == heeltoe.__all__ == dir(heeltoe)


def test_each_public_name_is_at_home_where_the_root_says():
    for name, module in heeltoe._HOME.items():
        thing = getattr(heeltoe, name)
        assert thing is getattr(import_module(f"heeltoe.{module}"), name)
        assert thing.__module__ == f"heeltoe.{module}", name
        assert thing.__doc__, name


def test_no_module_takes_the_place_of_a_public_name():
    program = (
        "import importlib, pkgutil, heeltoe\n"
        "for found in pkgutil.walk_packages(heeltoe.__path__, 'heeltoe.'):\n"
        "    if not found.name.endswith(('__main__', '_kernel')):\n"
        "        importlib.import_module(found.name)\n"
        "for name in heeltoe.__all__:\n"
        "    assert callable(getattr(heeltoe, name)), name\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    packages = {result.name for result in pkgutil.iter_modules(heeltoe.__path__)}
    assert packages.isdisjoint(heeltoe.__all__)


def test_a_name_that_is_not_there_says_so():
    with pytest.raises(AttributeError, match="no attribute 'frictionless'"):
        _ = heeltoe.frictionless


@pytest.mark.slow
def test_a_type_checker_knows_every_public_name(tmp_path):
    names = tmp_path / "names.py"
    names.write_text("import heeltoe\n" + "".join(f"reveal_type(heeltoe.{name})\n" for name in heeltoe.__all__))
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", names],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    revealed = [line for line in done.stdout.splitlines() if "Revealed type" in line]
    assert len(revealed) == len(heeltoe.__all__), done.stdout + done.stderr
    assert [line for line in revealed if line.endswith('"Any"')] == []


def test_one_folder_names_the_compiled_kernels():
    named = {path.parent for path in PACKAGE.rglob("*.py") if "_kernel" in path.read_text(encoding="utf-8")}
    assert named == {PACKAGE / "kernel"}
