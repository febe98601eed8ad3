"""A report whose static checks let water into what opens, while the run keeps the uplift of the case: both say so."""

from __future__ import annotations

import pytest

from heeltoe import read_case, rigid
from heeltoe.views.report.html import html
from heeltoe.views.report.write import build_report
from shared.report_reader import Reader

#: A dam whose heel opens under the usual loads: 2400 kg/m3, 30 m high, 20 m wide at its base.
DAM = {
    "section": {"height": "30 m", "crest_width": "3 m", "base_width": "20 m"},
    "crack": {"elevation": "0 m", "friction": 1.2},
    "reservoir": {"depth": "30 m"},
    "uplift": {"pattern": "triangular"},
    "motion": {"points": [["0 s", "0 g"], ["0.2 s", "0.1 g"], ["0.4 s", "0 g"]]},
    "statics": {"criteria": "USACE"},
}
OPENS = "of the crack, and water enters it"


@pytest.mark.parametrize(("depth", "opens"), [("30 m", True), pytest.param("20 m", False, marks=pytest.mark.slow)])
def test_each_table_says_which_state_it_has(depth, opens):
    case = read_case(DAM | {"reservoir": {"depth": depth}})
    response = rigid(case)
    document = build_report(case, response)
    text = Reader(html(document)).text
    # By hand: without water in what opens the resultant leaves the middle third where the stress at the heel is below
    # zero.
    position, width = response.static.resultant_from_heel_m, 20.0
    assert (position > 2.0 / 3.0 * width) is opens
    assert (text.count(OPENS) >= 2) is opens
    assert "Before the earthquake, with the uplift of the case" in text
    assert "Sliding safety factor before it, uplift of the case" in text
