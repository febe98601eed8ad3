"""The static checks of the app: with the slip of the elastic dam where that has been run as it is now."""

import pytest

pytest.importorskip("starlette")

from heeltoe.app.checks import checked
from shared.dams import example

SHORT = ("motion.duration=4s", "statics.criteria=USACE")


def slip_basis(answer):
    return dict(answer["basis"])["residual slip"]


def test_the_slip_is_that_of_the_elastic_dam_where_it_was_run():
    case = example("typical-base", *SHORT)
    left = [
        {
            "case": case.without_evidence().model_dump_json(),
            "source": "flexible model, a motion",
            "slips_m": {"0": 0.1234},
        }
    ]
    assert slip_basis(checked(case, {}, "si", left)) == "123.4 mm: flexible model, a motion"
    # The dam is another one by now.
    assert "rigid model" in slip_basis(checked(case, {"crack.friction": 0.9}, "si", left))
    assert "rigid model" in slip_basis(checked(case, {}, "si"))


def test_every_section_is_checked():
    case = example("two-cracks", *SHORT, {"statics.sections": ["0 m", "90 m"]})
    answer = checked(case, {}, "si")
    assert "at 2 sections" in answer["verdict"]
    assert {row["cells"][0] for row in answer["checks"]} >= {"0 m, usual", "90 m, usual"}
    assert not any("statics_of_sections" in text for text in answer["warnings"])
