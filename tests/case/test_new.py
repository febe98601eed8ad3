"""The cases that `heeltoe new` writes: they run unchanged; the long one names every field, and an old case keeps its
meaning."""

import re

import pytest

from heeltoe.case.read import case_schema, read_case
from heeltoe.case.template import new_case_text
from heeltoe.case.warnings import case_warnings
from shared.cases import refusal, write
from shared.command import command
from shared.dams import EXAMPLES


@pytest.mark.parametrize("name", ["My dam", 'He said "no" \\ ü 坝 \n\x7f', "{x}", ""])
@pytest.mark.parametrize("every_field", [False, True])
def test_new_case(tmp_path, name, every_field):
    case = read_case(write(tmp_path / "new.toml", new_case_text(name, every_field=every_field)))
    assert case_warnings(case) == ()
    assert case.title == name.replace("\n", " ").replace("\x7f", " ")


def test_the_short_case_is_the_long_one_in_25_lines(tmp_path):
    short, long = (
        read_case(write(tmp_path / "x.toml", new_case_text("x", every_field=every))) for every in (False, True)
    )
    assert short == long
    assert len([line for line in new_case_text("x").splitlines() if line]) == 25


@pytest.mark.parametrize("name", ["two-cracks", "aftershocks", "anchored", "koyna"])
def test_an_old_case_is_rewritten_with_the_same_meaning(tmp_path, name):
    old = tmp_path / "old.toml"
    old.write_text((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"), encoding="utf-8")
    process = command("new", "today", "--from", "old.toml", cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    text = (tmp_path / "today.toml").read_text(encoding="utf-8")
    assert "[[cracks]]" in text
    assert "further_cracks" not in text
    before, after = read_case(old), read_case(tmp_path / "today.toml")
    assert after.cracks == before.cracks
    assert after.model_dump(exclude={"crack", "further_cracks"}) == before.model_dump(
        exclude={"crack", "further_cracks"}
    )


def test_an_old_case_is_rewritten_in_its_own_folder(tmp_path):
    (tmp_path / "old.toml").write_text(new_case_text("x"), encoding="utf-8")
    (tmp_path / "other").mkdir()
    for arguments in (("new", "other/x", "--from", "old.toml"), ("new", "x", "--all", "--from", "old.toml")):
        process = command(*arguments, cwd=tmp_path)
        assert process.returncode == 2
        assert "keep one of them" in process.stderr


def test_new_case_shows_every_field():
    text = new_case_text("x", every_field=True)

    def check(fields, known):
        for name, schema in known["properties"].items():
            assert re.search(rf"^(# )?(\[(crack\.)?)?{name}\b", text, re.MULTILINE), name
            reference = schema.get("$ref") or schema.get("anyOf", [{}])[0].get("$ref")
            if reference and name != "vertical":
                check(fields, case_schema()["$defs"][reference.split("/")[-1]])

    check(text, case_schema())


def test_what_the_new_case_comments_out_is_sound(tmp_path):
    # Every commented field put in force, one at a time: none may be unknown, or have a wrong unit or value.
    # Alone, some have nothing to belong to.
    fine = {None, "needs-other", "missing-field", "fields-conflict", "option-foreign", "missing"}
    # Drawings that are not there.
    fine.add("file-missing")
    # Each law knows some of the fields.
    fine |= {"option-missing", "option-foreign"}
    # The crack of a new case is at the base, where there is nothing below it.
    fine.add("kinks-base")
    lines = new_case_text("x", every_field=True).splitlines()
    header, tried = -1, 0
    for number, line in enumerate(lines):
        if re.match(r"(# )?\[", line):
            header = number
        if re.match(r"# \w+ = ", line):
            tried += 1
            active = list(lines)
            for on in {header, number} - {-1}:
                active[on] = lines[on].removeprefix("# ")
            error = refusal(write(tmp_path / "case.toml", "\n".join(active)))
            assert (error and error.code) in fine, line
    assert tried > 20
