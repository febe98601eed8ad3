"""Programs and cases in the documentation run and read as they stand."""

from __future__ import annotations

import tomllib

import pytest

import heeltoe
from heeltoe import read_case
from heeltoe.study.plan.file import Study
from shared.dams import FAST, ROOT
from shared.pages import blocks

PYTHON, TOML = blocks("python"), blocks("toml")


def test_there_are_some():
    assert len(PYTHON) >= 2
    assert len(TOML) >= 2


@pytest.mark.usefixtures("no_figures")
@pytest.mark.parametrize("block", [block for _, block, _ in PYTHON], ids=[place for place, _, _ in PYTHON])
def test_programs_run(block, tmp_path, monkeypatch):
    # As they stand, with few elements and for a short time.
    monkeypatch.setattr(heeltoe, "read_case", lambda source, changes=(): read_case(source, changes).with_(*FAST))
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    exec(compile(block, "block", "exec"), {})


@pytest.mark.parametrize(("block", "mark"), [item[1:] for item in TOML], ids=[place for place, _, _ in TOML])
def test_cases_can_be_read(block, mark):
    """A block that is a part of a case says above it of which: ``<!-- in examples/koyna.toml -->``."""
    fields = tomllib.loads(block)
    if "case" in fields:
        assert Study.model_validate(fields).case  # a study, not a case
        return
    if mark:
        whole = tomllib.loads((ROOT / mark.removeprefix("in ")).read_text(encoding="utf-8"))
        fields = whole | fields
    read_case(fields)
