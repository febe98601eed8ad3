"""The template that `heeltoe new` writes: it runs as it is, and names every field."""

import re

import pytest

from heeltoe.case.read import case_schema, read_case
from heeltoe.case.template import new_case_text
from heeltoe.case.warnings import case_warnings
from shared.cases import refusal, write


@pytest.mark.parametrize("name", ["My dam", 'He said "no" \\ ü 坝 \n\x7f', "{x}", ""])
def test_new_case(tmp_path, name):
    case = read_case(write(tmp_path / "new.toml", new_case_text(name)))
    assert case_warnings(case) == ()
    assert case.title == name.replace("\n", " ").replace("\x7f", " ")


def test_new_case_shows_every_field():
    text = new_case_text("x")

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
    fine = {None, "needs-other", "missing-field", "fields-conflict", "uplift-option-foreign", "friction-missing"}
    # Drawings that are not there.
    fine.add("section-file-missing")
    # Each law knows some of the fields.
    fine |= {"law-option-missing", "law-option-foreign"}
    # The crack of a new case is at the base, where there is nothing below it.
    fine.add("kinks-base")
    lines = new_case_text("x").splitlines()
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
