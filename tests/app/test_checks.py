"""The static checks of the app: with the slip of the elastic dam where that has been run as it is now."""

import math
from types import SimpleNamespace

import pytest

pytest.importorskip("starlette")

from heeltoe.app.checks import checked
from heeltoe.app.live import elastic
from heeltoe.app.sliders import sliders
from heeltoe.models.run import run
from heeltoe.models.statics.after import statics_after
from shared.dams import COARSE, example

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
            "ligaments_m": {"0": None},
        }
    ]
    answer = checked(case, {}, "si", left)
    assert slip_basis(answer) == "123.4 mm: flexible model, a motion"
    assert answer["provisional"] == ""
    # The motion made that slip.
    assert not any("motion.file" in text for text in answer["warnings"])
    # The dam is another one by now.
    assert "rigid model" in slip_basis(checked(case, {"crack.friction": 0.9}, "si", left))
    assert "rigid model" in slip_basis(checked(case, {}, "si"))


def test_every_section_is_checked():
    case = example("two-cracks", *SHORT, {"statics.sections": ["0 m", "90 m"]})
    answer = checked(case, {}, "si")
    assert "at 2 sections" in answer["verdict"]
    assert {row["cells"][0] for row in answer["checks"]} >= {"0 m, usual", "90 m, usual"}
    assert not any("statics_of_sections" in text for text in answer["warnings"])


def test_a_slip_that_is_not_the_elastic_dam_s_is_marked():
    case = example("typical-base", *SHORT)
    assert checked(case, {}, "si")["provisional"].startswith(
        "Provisional: the slip after the earthquake is that of the"
    )
    several = example(
        "two-cracks", *SHORT, "crack.law={name='slip weakening',peak_friction=1,residual_friction=1,slip='1 mm'}"
    )
    assert "no slip is taken" in checked(several, {}, "si")["provisional"]
    assert checked(case.with_("statics.residual_slip=1 mm"), {}, "si")["provisional"] == ""
    block = example("block", "statics.criteria=USACE")
    assert checked(block, {}, "si")["provisional"] == ""


# The right factor is that of the checks after the run itself, `statics_after`, which leaves the joint that holds whole.
def test_a_joint_that_holds_has_its_bond_after_the_earthquake():
    case = example("bonded-joint", "motion.pga=0.02 g", "motion.duration=1s", "analysis.silence=0s", *COARSE)
    response = run(case, "flexible")
    after = statics_after(case, response).cases[-1]
    answer = checked(case, {}, "si", [elastic(case, {}, "si")["left"]])
    row = next(row for row in answer["checks"] if row["cells"][:2] == ("post-seismic", "sliding factor"))
    assert row["cells"][2] == f"{after.sliding_factor:.2f}"
    assert after.cohesive_force_n > 0.0


def test_sliders_name_their_crack():
    labels = {slider.path: slider.label for slider in sliders(example("two-cracks"), "si")}
    assert labels["crack.friction"] == "Friction coefficient, crack at 0 m"
    assert labels["crack.restitution"] == "Restitution, crack at 0 m"
    assert labels["reservoir.depth"] == "Water level"
    assert sliders(example("typical-base"), "si")[0].label == "Friction coefficient"


def test_a_long_dam_says_how_long_and_runs_when_it_is_asked(monkeypatch):
    case = example("typical-base", "motion.duration=1s", "analysis.silence=0s", *COARSE)
    monkeypatch.setattr("heeltoe.app.live.cost_of", lambda *_: SimpleNamespace(seconds=23.0))
    assert elastic(case, {}, "si") == {"waits": "The elastic dam takes about 23 s, and does not follow the sliders."}
    assert elastic(case, {}, "si", math.inf)["verdict"]
