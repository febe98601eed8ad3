"""One bibliography: every source once, so that all results cite the same of the same thing."""

import re
from pathlib import Path

import pytest

import heeltoe
from heeltoe import read_case, run
from heeltoe.mechanics.references import REFERENCES

CASE = {
    "title": "references",
    "section": {
        "height": "40 m",
        "crest_width": "5 m",
        "neck_height": "36 m",
        "neck_width": "5 m",
        "base_width": "32 m",
    },
    "concrete": {"density": "2400 kg/m^3", "modulus": "20 GPa"},
    "crack": {"elevation": "0 m", "friction": 1.0},
    "reservoir": {"depth": "36 m"},
    "flexible": {"elements_across": 4, "evidence": "none"},
    "motion": {"points": [["0 s", "0 g"], ["0.1 s", "0.1 g"], ["0.2 s", "0 g"]]},
}


@pytest.mark.parametrize("rule", ["zero while open", "full while open", "follows opening"])
def test_both_models_cite_the_same_source_of_what_both_do(rule):
    both = run(read_case({**CASE, "uplift": {"pattern": "triangular", "during_shaking": rule}}), "both")
    assert REFERENCES[rule] in both.beside.citation()
    assert REFERENCES[rule] in both.citation()


def test_every_source_stands_once_and_nowhere_else():
    """Titles are what makes a source: none is in two entries, but that of the thesis, or in another module."""
    titles = re.findall(r'"([^"]{20,})"', "\n".join(REFERENCES.values()))
    thesis = "Seismic Behavior of Cracked Concrete Gravity Dams"
    assert titles.count(thesis) > 1
    others = [title for title in titles if title != thesis]
    assert len(set(others)) == len(others)
    package = Path(heeltoe.__file__).parent
    for path in package.rglob("*.py"):
        if path.name != "references.py":
            text = path.read_text()
            assert not [title for title in {thesis, *others} if title in text], path
