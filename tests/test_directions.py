"""Imports go one way: the contracts of pyproject.toml hold, and they would catch an import that goes back up."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from shared.dams import ROOT

PACKAGE = ROOT / "python" / "heeltoe"
ONE_WAY = "Data flows one way"
MODELS = "The chain stands on the other models, which do not know each other"
VIEWS = "Figures and words stand below the faces that use them"
WITHIN = "\n\ndef _climb() -> None:\n    {0}\n"
FOR_TYPES = "\n\nif TYPE_CHECKING:\n    {0}\n"


def linted(place: Path) -> tuple[int, str]:
    """Check the package that lies in `place`, which an editable installation does not hide."""
    program = "from importlinter.cli import lint_imports_command as check; check()"
    found = subprocess.run(
        [sys.executable, "-c", program, "--config", ROOT / "pyproject.toml", "--no-logo", "--no-cache"],
        cwd=place,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    return found.returncode, found.stdout + found.stderr


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    place = tmp_path_factory.mktemp("imports")
    shutil.copytree(PACKAGE, place / "heeltoe", ignore=shutil.ignore_patterns("*.so", "*.pyd", "__pycache__"))
    return place


def test_all_contracts_hold(copy):
    code, said = linted(copy)
    assert code == 0, said
    for contract in (ONE_WAY, MODELS, VIEWS):
        assert f"{contract} KEPT" in said


@pytest.mark.parametrize(
    ("file", "form", "forbidden", "contract"),
    [
        ("geometry/section.py", "\n{0}\n", "from heeltoe.case.model import Case", ONE_WAY),
        ("mechanics/block.py", "\n{0}\n", "from heeltoe import rigid", ONE_WAY),
        ("motion/spectrum.py", WITHIN, "from heeltoe.views.figures import write", ONE_WAY),
        ("result/response.py", FOR_TYPES, "from heeltoe.models.rigid.model import rigid", ONE_WAY),
        ("models/statics/cases.py", WITHIN, "from heeltoe.models.flexible.loads import edge_shapes", MODELS),
        ("views/words/numbers.py", FOR_TYPES, "from heeltoe.views.report.content import Value", VIEWS),
    ],
)
def test_an_import_that_goes_back_up_is_caught(copy, file, form, forbidden, contract):
    path = copy / "heeltoe" / file
    text = path.read_text()
    try:
        path.write_text(text + form.format(forbidden))
        code, said = linted(copy)
    finally:
        path.write_text(text)
    assert code == 1
    assert f"{contract} BROKEN" in said
    assert f"heeltoe.{file.removesuffix('.py').replace('/', '.')} -> {forbidden.split()[1]}" in said


def test_the_checks_are_part_of_make_lint():
    assert "lint-imports" in (ROOT / "Makefile").read_text()
