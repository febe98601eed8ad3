"""What a case shows is in its own units, unless an option says others."""

from __future__ import annotations

import re

import pytest

from heeltoe import animate, read_case, rigid
from heeltoe.case.field_usage import unused_fields
from shared.command import command, options
from shared.dams import BASE, FAST

# Units of the SI behind a number, which no one in the United States would see.
SI = re.compile(r"\d ?(?:m|mm|kN|MN|kPa|MPa|GPa|kg|m/s)(?:[ ,;.)/]|$)", re.MULTILINE)
RIGID = ("run", BASE, *options(FAST), "--model", "rigid")


def said(*arguments):
    process = command(*arguments)
    assert process.returncode == 0, process.stderr
    return process.stdout


@pytest.mark.parametrize("words", [("periods", BASE, "--details"), RIGID], ids=lambda words: words[0])
def test_the_case_says_the_units_and_the_option_wins(words):
    ours = said(*words, "--set", "units=us")
    assert not SI.search(ours), ours
    assert " ft" in ours
    assert said(*words, "--units", "us") == ours
    assert said(*words, "--set", "units=us", "--units", "si") == said(*words)


def test_units_there_are_none_of_are_refused():
    for words in (("periods",), ("overturning",), ("animate",), ("run",), ("study",)):
        process = command(*words, BASE, "--units", "imperial")
        assert (process.returncode, process.stdout) == (2, "")
        assert "--units: imperial is not a choice" in process.stderr
    assert "units" in command("run", BASE, "--set", "units=imperial").stderr


def test_units_are_no_choice_of_a_model():
    case = read_case(BASE, "units=us")
    assert unused_fields(case, ["rigid"]) == unused_fields(read_case(BASE), ["rigid"])


def test_a_case_and_its_animation_show_their_units(tmp_path):
    case = read_case(BASE, [*FAST, "units=us"])
    assert "262.5 ft" in case._repr_html_()
    page = animate(case, rigid(case), tmp_path / "dam.html").read_text(encoding="utf-8")
    assert "kip/ft; pale" in page
    assert '"unit":"in"' in page
    assert "MN/m" not in page
