"""What a notebook shows of a case, a motion and a response."""

from __future__ import annotations

from dataclasses import replace

import pytest

from heeltoe import read_case, rigid, statics, with_spread
from shared.dams import BASE, BLOCK
from shared.report_reader import Reader


@pytest.fixture(scope="module")
def block():
    case = read_case(
        BASE, ["motion.duration=5s", "motion.pga=1g", 'limits.residual_slip="10 mm"', "limits.peak_slip=9m"]
    )
    return case, with_spread(rigid(case), case, 3)


def test_notebooks_show_cases_motions_and_results(block, typical_both):
    case, response = block
    for shown_object, words in (
        (case, ("2650 kg/m³", "reservoir.depth", "<svg")),
        (response.motion, ("peak acceleration", "1 g", "m/s", "<polyline")),
        (response, ("residual slip", "mm", "the dam slides", "<polyline")),
    ):
        outcome = shown_object._repr_html_()
        Reader(outcome)
        for item in words:
            assert item in outcome
        # A page of a notebook is no place for a megabyte.
        assert len(outcome) < 60_000
    for result, words in (
        (typical_both, ("The dam slides", "rigid beside it", "(rigid)", "(flexible)")),
        (statics(case, 0.1), ("USACE", "checks", "not met", "sliding factor")),
    ):
        assert all(word in result._repr_html_() for word in words)
    never = rigid(read_case(BASE, ["crack.friction=0.2"]))
    assert "No result to trust" in never._repr_html_()
    assert "<b>" not in replace(response, title="<b>")._repr_html_()
    bare = read_case(BLOCK)
    assert "Block pushed once" in bare._repr_html_()
    assert rigid(bare)._repr_html_()
