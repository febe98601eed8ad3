"""Each numbered equation of the documentation names the function that computes it and a test that checks it."""

from __future__ import annotations

import re

import pytest

from shared.dams import ROOT
from shared.pages import PAGES, equation_rows, equations, functions, proofs

NUMBERED = [page for page in PAGES if equations(page)]
THEORY = {
    f"docs/{name}.md"
    for name in (
        "rigid",
        "flexible",
        "decoupled",
        "statics",
        "friction",
        "kinks",
        "rough-crack",
        "several-cracks",
        "water-and-rock",
    )
}


def missing(code: tuple[str, str], test: tuple[str, str]) -> list[str]:
    """Return which of a file, its function and a test are not there."""
    absent = [file for file, _ in (code, test) if not (ROOT / file).is_file()]
    if not absent and code[1] not in functions(code[0]):
        absent.append("::".join(code))
    if not absent and test[1] not in proofs(test[0]):
        absent.append("::".join(test))
    return absent


def test_the_theory_has_equations():
    assert set(NUMBERED) >= THEORY


def test_numbers_are_used_once():
    assert [page for page in NUMBERED if len(equations(page)) != len(set(equations(page)))] == []


def test_code_and_test_stand_below_each_equation():
    for page in NUMBERED:
        blocks = re.findall(r"^\$\$\n((?:(?!^\$\$).)*?\\tag\{\w+\})\n\$\$\n\n([^\n]*)$", PAGES[page], re.M | re.S)
        assert len(blocks) == len(equations(page)), page
        for equation, line in blocks:
            assert line.startswith("code `"), (page, equation)
            assert " · test `" in line, (page, equation)


def test_code_and_test_are_there():
    assert [(*row, absent) for row in equation_rows() if (absent := missing(*row[1:]))] == []


def test_what_is_not_there_is_noticed():
    code, test = equation_rows()[0][1:]
    assert missing((code[0], "no_such_function"), test)
    assert missing(code, (test[0], "test_no_such_test"))
    assert missing(("python/heeltoe/no_such_file.py", code[1]), test)


def test_formulas_can_be_shown():
    """Sphinx, MathML and the pages of repository hosts take the same LaTeX."""
    tex2mathml = pytest.importorskip("docutils.utils.math.latex2mathml").tex2mathml
    for page in NUMBERED:
        for block in re.findall(r"^\$\$\n(.*?)\n\$\$$", PAGES[page], re.M | re.S):
            tex2mathml(re.sub(r"\\tag\{\w+\}", "", block), as_block=True)
        text = re.sub(r"^```.*?^```$|^\$\$\n.*?\n\$\$$|`[^`\n]*`|^ {4}.*$", "", PAGES[page], flags=re.M | re.S)
        for formula in re.findall(r"(?<![\w$])\$([^$\n]+)\$", text):
            tex2mathml(formula)
