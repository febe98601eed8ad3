"""One version, in one place, and all that repeats it says the same."""

import re
import runpy
import shutil
import tomllib

import pytest

import heeltoe
from heeltoe.kernel.build import build_info
from shared.command import command
from shared.dams import ROOT

problems = runpy.run_path(str(ROOT / ".ci" / "version.py"))["problems"]
NAMED = ("Cargo.toml", "Cargo.lock", "CITATION.cff", "CHANGELOG.md")
VERSION = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]


def test_files_commands_and_results_name_one_version():
    assert problems(ROOT) == []
    assert build_info()["heeltoe"] == VERSION
    assert command("--version").stdout.startswith(f"heeltoe {VERSION} ")
    result = heeltoe.rigid(heeltoe.read_case(ROOT / "examples" / "block.toml")).to_json()
    assert result["build"]["heeltoe"] == VERSION


def test_only_one_file_is_where_it_is_changed():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert "version" not in project
    assert project["dynamic"] == ["version"]


@pytest.mark.parametrize("name", NAMED)
def test_a_file_that_is_forgotten_is_told(name, tmp_path):
    for item in NAMED:
        shutil.copy(ROOT / item, tmp_path / item)
    assert problems(tmp_path) == []
    text = (tmp_path / name).read_text(encoding="utf-8")
    (tmp_path / name).write_text(text.replace(VERSION, "9.9.9"), encoding="utf-8")
    assert problems(tmp_path)


def test_a_tag_is_the_version_and_its_date_stands_in_both_places(tmp_path):
    for item in NAMED:
        shutil.copy(ROOT / item, tmp_path / item)
    assert problems(tmp_path, "v9.9.9")[0] == f"the tag is v9.9.9, the version {VERSION}"
    log = (tmp_path / "CHANGELOG.md").read_text(encoding="utf-8")
    cited = (tmp_path / "CITATION.cff").read_text(encoding="utf-8")
    heading = next(line for line in log.splitlines() if line.startswith(f"## {VERSION} ("))
    cited = re.sub("^date-released: .*\n", "", cited, flags=re.MULTILINE)
    unreleased, released = f"## {VERSION} (unreleased)", f"## {VERSION} (2027-01-31)"
    dated = f"{cited}date-released: 2027-01-31\n"
    for title, citation, alone, tagged in (
        (unreleased, cited, True, False),
        (released, dated, True, True),
        (unreleased, dated, False, False),
        (released, cited, False, False),
    ):
        (tmp_path / "CHANGELOG.md").write_text(log.replace(heading, title), encoding="utf-8")
        (tmp_path / "CITATION.cff").write_text(citation, encoding="utf-8")
        assert (problems(tmp_path) == []) is alone
        assert (problems(tmp_path, f"v{VERSION}") == []) is tagged


@pytest.mark.parametrize("name", ["requirements.lock", "requirements-bench.lock"])
def test_lock_files_pin_what_some_python_does_not_bring(name):
    text = (ROOT / name).read_text(encoding="utf-8")
    assert "were not pinned" not in text, "run pip-compile with --allow-unsafe"
