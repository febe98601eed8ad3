"""The workflows build with the tools that the project builds with, and name versions of all that they use."""

import re

import pytest
import yaml

from shared.dams import ROOT

WORKFLOWS = {path.name: path.read_text(encoding="utf-8") for path in (ROOT / ".github" / "workflows").glob("*.yml")}


@pytest.mark.parametrize("name", ["ci.yml", "release.yml"])
def test_actions_are_pinned(name):
    """By the hash of a commit, which no one can move, and with its version beside it."""
    used = re.findall(r"uses: (.+)", WORKFLOWS[name])
    jobs = yaml.safe_load(WORKFLOWS[name])["jobs"]
    assert len(used) == sum("uses" in step for job in jobs.values() for step in job["steps"])
    pinned = r"[\w./-]+@[0-9a-f]{40}  # v\d+\.\d+\.\d+"
    assert [item for item in used if not re.fullmatch(pinned, item)] == []


def test_wheels_are_built_with_the_tools_of_the_makefile_and_of_the_lock_file():
    makefile, lock = ((ROOT / name).read_text(encoding="utf-8") for name in ("Makefile", "requirements.lock"))
    (zig,) = re.findall(r"^ZIG := (\S+)$", makefile, re.MULTILINE)
    (maturin,) = re.findall(r"^(maturin==\S+)", lock, re.MULTILINE)
    assert f"pip install {maturin} {zig}\n" in WORKFLOWS["release.yml"]


def test_scripts_that_workflows_run_are_there():
    run = {path for text in WORKFLOWS.values() for path in re.findall(r"\.ci/[\w.]+", text)}
    assert run == {".ci/run", ".ci/try_wheel.py", ".ci/version.py"}
    assert [path for path in run if not (ROOT / path).is_file()] == []


def test_nothing_is_published_but_by_a_tag():
    publish = yaml.safe_load(WORKFLOWS["release.yml"])["jobs"]["publish"]
    assert publish["if"] == "github.ref_type == 'tag'"
    assert publish["needs"] == ["build", "test-all"]
