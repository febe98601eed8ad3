"""What the page draws is what the models say."""

from __future__ import annotations

import base64
import pickle
import re

import numpy as np
import pytest
import shapely

from heeltoe import InputError, decoupled
from heeltoe.app.checks import checked
from heeltoe.app.live import answer
from heeltoe.app.open_case import models_for
from heeltoe.app.response_payload import drawn, thinned
from heeltoe.app.sliders import change, sliders
from heeltoe.app.wording import in_words_of_the_page
from heeltoe.models.run import earthquake, live, run
from heeltoe.result.verdict import band_sentence, effect_sentence
from heeltoe.units.parse import InSI
from heeltoe.warnings.notice import CATALOGUE, templates
from shared.dams import COARSE, SHORT, example
from shared.scenes import unpacked


@pytest.mark.parametrize("count", [2, 100, 1999, 2000, 2001, 54321])
def test_no_peak_is_lost(count):
    rng = np.random.default_rng(count)
    rows = [rng.normal(size=count).cumsum(), rng.normal(size=count)]
    kept = thinned(rows, 100)
    assert (np.diff(kept) > 0).all()
    assert (kept[0], kept[-1]) == (0, count - 1)
    assert kept.size <= max(5 * 101, 200)
    for row in rows:
        assert (row[kept].max(), row[kept].min()) == (row.max(), row.min())


def test_curves_are_the_histories():
    case = example("typical-base")
    reply = answer(case, {}, "rigid", "si")
    slip = np.frombuffer(base64.b64decode(reply["curves"]["slip"]["values"]["data"]), "<f4")
    result = live(case, "rigid", earthquake(case))
    assert slip[-1] == pytest.approx(1e3 * result.residual_slip_m)
    assert reply["verdict"] in repr(result)
    assert sum(span["end"] - span["start"] for span in reply["ribbon"]) == pytest.approx(result.end_time_s)


def test_a_sequence_and_a_law_are_told_beside_the_numbers():
    reply = answer(example("aftershocks"), {}, "rigid", "si")
    [table] = reply["tables"]
    assert table["label"] == "Motion by motion"
    assert [row[0].split()[0] for row in table["rows"]] == ["1", "2", "3"]
    assert not reply["facts"]
    law = {"name": "slip weakening", "peak_friction": 1.2, "residual_friction": 0.8, "slip": "20 mm"}
    case = example("typical-base").with_({"crack.law": law})
    [[label, text]] = answer(case, {}, "rigid", "us")["facts"]
    assert label == "friction law"
    assert "0.8, before 1.2, under 119 psi" in text


def test_a_rough_crack_is_told_beside_the_numbers():
    reply = answer(example("rough-crack"), {}, "rigid", "si")
    [[label, text]] = reply["facts"]
    assert label == "rough crack"
    assert "the flanks wore from 11.3 to 11.2 degrees" in text
    # The elastic dam knows no asperities: it is not what is advised.
    [advice] = [warning["text"] for warning in reply["warnings"] if "and the dam is elastic" in warning["text"]]
    assert "run it without crack.roughness, too, and with concrete.modulus" in advice


def test_other_frictions_stand_beside_the_numbers():
    case = example("typical-base", *COARSE, "motion.duration=3s").with_({"crack.band": {"low": 0.9, "high": 1.1}})
    response = run(case, "rigid")
    facts = dict(drawn(response, "si")["facts"])
    assert list(facts) == ["other frictions"]
    assert facts["other frictions"] == band_sentence(response, "si")
    assert facts["other frictions"].count("it slides") == 2
    # As the terminal, the report and the JSON have them.
    alone = run(example("block"))
    facts = dict(drawn(alone, "us")["facts"])
    assert list(facts) == ["less friction"]
    assert facts["less friction"] == effect_sentence(alone.friction_effect, "us")
    assert facts["less friction"].startswith("With 0.1 less friction it ")
    # While a slider moves the block is run alone.
    assert not answer(example("block"), {}, "rigid", "us")["facts"]


def test_two_blocks_answer_and_move_one_on_the_other():
    case = example("two-cracks")
    reply = answer(case, {}, "rigid", "si")
    [table] = reply["tables"]
    assert [row[0] for row in table["rows"]] == ["90 m", "0 m (leads)"]
    assert [crack["name"] for crack in reply["curves"]["cracks"]] == ["crack at 90 m"]
    # The lower block is what stands between the cracks.
    upper, lower = (
        shapely.Polygon(unpacked(part["points"])[unpacked(part["outline"])]) for part in reply["dam"]["parts"]
    )
    assert (upper.area, lower.area) == pytest.approx((80.0, case.outline.area - 80.0))


@pytest.mark.parametrize(
    ("name", "changes", "said"),
    [
        ("stepped-crack", {}, "does not support kinks"),
        (
            "two-cracks",
            {"further_cracks": [{"elevation": "50 m"}, {"elevation": "90 m"}]},
            "does not support three cracks",
        ),
        ("two-cracks", {"aftershocks": [{"file": "elcentro-1940-180-nga"}]}, "aftershocks with several cracks"),
        ("two-cracks", {"analysis.rotation": "finite"}, '("finite") with several cracks'),
    ],
)
def test_what_a_block_does_not_know_is_no_error(name, changes, said):
    case = example(name).with_(changes)
    absent = answer(case, {}, "rigid", "si")["absent"]
    assert said in absent
    assert "see the elastic dam" in absent
    assert models_for(case)["models"] == ["flexible"]


def test_static_checks_need_no_block():
    case = example("two-cracks").with_({"aftershocks": [{"file": "elcentro-1940-180-nga"}]})
    assert checked(case, {}, "si")["checks"]
    assert checked(example("stepped-crack"), {}, "si")["checks"]


def test_what_knows_one_crack_alone_says_so():
    case = example("two-cracks")
    assert models_for(case) == {"models": ["rigid", "flexible"], "inelastic": ""}
    assert "does not support several cracks" in answer(case, {}, "decoupled", "si")["absent"]
    assert models_for(example("typical-height"))["models"] == ["rigid", "decoupled", "flexible"]
    block = models_for(example("block"))
    assert (block["models"], "concrete.modulus" in block["inelastic"]) == (["rigid"], True)


def test_the_live_chain_is_the_chain():
    case = example("koyna-top", *SHORT, "motion.sign=recorded")
    for changes in ({}, {"crack.friction": 0.7}, {"motion.pga": "0.3 g"}):
        changed = case.with_(changes)
        quick, whole = live(changed, "decoupled", earthquake(changed)), decoupled(changed)
        assert quick.residual_slip_m == pytest.approx(whole.residual_slip_m, rel=1e-9, abs=1e-12)
        assert np.allclose(quick.histories["slip_m"], whole.histories["slip_m"], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("units", ["si", "us"])
def test_sliders_move_the_strengths_of_a_joint(units):
    case = example("bonded-joint")
    paths = [slider.path for slider in sliders(case, units)]
    assert {"crack.bond.tensile_strength", "crack.bond.cohesion"} < set(paths)
    for slider in sliders(case, units):
        assert slider.least <= slider.value <= slider.most
        for value in (slider.least, slider.most):
            changed = case.with_numbers(change(slider, value, case))
            if slider.path == "crack.bond.cohesion":
                assert changed.crack.bond.cohesion == pytest.approx(
                    value * (1e6 if units == "si" else 6894.757), rel=1e-6
                )


@pytest.mark.parametrize("units", ["si", "us"])
def test_sliders_stand_where_the_case_is_and_change_it(units):
    case = example("typical-base")
    for slider in sliders(case, units):
        assert slider.least <= slider.value <= slider.most + slider.step
        case.with_numbers(change(slider, slider.most, case))
        case.with_numbers(change(slider, slider.least, case))
    [above] = [item for item in sliders(case.with_({"reservoir.depth": "103 m"}), "si") if "depth" in item.path]
    assert (above.value, above.most) == (103.0, 103.0)
    with_drains = case.with_numbers(change(sliders(case, units)[-1], 0.5, case))
    assert (with_drains.uplift.pattern, with_drains.uplift.drain_efficiency) == ("drained", 0.5)


@pytest.mark.parametrize("name", ["typical-base", "bonded-joint", "two-cracks"])
@pytest.mark.parametrize("units", ["si", "us"])
def test_a_number_changes_a_case_as_its_text_with_a_unit_does(name, units):
    case = example(name)
    for slider in sliders(case, units):
        if slider.off:
            continue
        changes = pickle.loads(pickle.dumps(change(slider, 0.5 * (slider.least + slider.most), case)))
        quick = case.with_numbers(changes)
        slow = case.with_({path: str(value) if isinstance(value, InSI) else value for path, value in changes.items()})
        block, _, field = slider.path.partition(".")
        assert quick.model_fields_set == slow.model_fields_set
        assert quick.model_dump(exclude={block}) == slow.model_dump(exclude={block})
        for one, other in zip(_leaves(getattr(quick, block)), _leaves(getattr(slow, block)), strict=True):
            assert one == (pytest.approx(other, rel=1e-9) if isinstance(other, float) else other), field


def _leaves(block):
    for value in vars(block).values():
        yield from _leaves(value) if hasattr(value, "model_fields_set") else [getattr(value, "value", value)]


def test_a_number_that_cannot_be_is_refused_as_its_text_is():
    case, messages = example("typical-base"), []
    for changed, value in ((case.with_numbers, InSI(-3.048, "-10 ft")), (case.with_, "-10 ft")):
        with pytest.raises(InputError) as refused:
            changed({"reservoir.depth": value})
        messages.append(str(refused.value))
    assert messages[0] == messages[1]


def test_an_error_is_told_at_its_field():
    reply = answer(example("typical-base"), {"crack.friction": -1.0}, "rigid", "si")
    assert reply["error"]["field"] == "crack.friction"


def test_warnings_name_buttons_and_no_commands():
    message = {(code, kind): in_words_of_the_page(text) for code in CATALOGUE for kind, text in templates(code).items()}
    assert not {code: each for code, each in message.items() if re.search(r"(^| )--\w|heeltoe [a-z]+ ", each)}


def test_a_block_is_told_to_be_run_as_an_elastic_dam():
    text = " ".join(warning["text"] for warning in answer(example("typical-height"), {}, "rigid", "si")["warnings"])
    assert "see the elastic dam beside it" in text
    assert "--model" not in text
