"""The method that the report describes is that of the options."""

from __future__ import annotations

import pytest

from heeltoe import flexible, read_case, rigid
from heeltoe.views.report.html import html
from heeltoe.views.report.write import build_report
from shared.dams import BASE, FAST
from shared.report_reader import Reader

METHOD = [
    ([], ["cubic in time", "small"]),
    (["crack.inclination=5deg"], ["inclined plane"]),
    (["uplift.pattern=none"], ["no water pressure in the crack"]),
    (["uplift.intensity=0.5"], ["all of it times 0.5"]),
    (["decoupled.rotation=true"], ["cubic in time", "exactly from event to event"]),
]


@pytest.mark.usefixtures("no_figures")
@pytest.mark.parametrize(("changes", "words"), METHOD)
def test_the_method_is_that_of_the_options(changes, words):
    case = read_case(BASE, ["motion.duration=2s", *changes])
    text = " ".join(Reader(html(build_report(case, rigid(case)))).text.split())
    for word in words:
        assert word in text
    assert "quadrilaterals" not in text


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (["flexible.damping=modal"], "same damping ratio"),
        (["flexible.damping=relative"], "relative to a rigid slide"),
        (["flexible.damping=deformation"], "deformation of the parts by themselves"),
        (["flexible.contact=idce", "flexible.damping=thesis"], "Contact is by penalties"),
    ],
)
@pytest.mark.usefixtures("no_figures")
def test_the_method_of_the_flexible_model_is_that_of_the_options(changes, words):
    case = read_case(BASE, [*FAST, "motion.duration=1s", *changes])
    text = " ".join(Reader(html(build_report(case, flexible(case)))).text.split())
    assert words in text
    assert "cubic in time" not in text
