"""Rock and sound that are assumed where a case says nothing of them, and what is said of that."""

from __future__ import annotations

import json
import math

import pytest

from heeltoe import (
    InputError,
    flexible,
    read_case,
    read_study,
    run,
    statics_of_sections,
    verdict,
    with_response_spectrum,
)
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.surroundings.lowest_modes import first_period
from heeltoe.models.flexible.surroundings.rock import ENOUGH
from heeltoe.study.plan.plan import plan_of
from shared.dams import BASE, COARSE, EXAMPLES, FAST, HEIGHT

PULSE = {"points": [["0 s", "0 g"], ["0.05 s", "0.5 g"], ["0.1 s", "0 g"]]}
# A small dam: cracked along its base, and on whatever the case has.
SMALL = {
    "section": {"height": "30 m", "crest_width": "5 m", "base_width": "24 m"},
    "concrete": {"modulus": "25 GPa"},
    "crack": {"elevation": "0 m", "friction": 0.8},
    "reservoir": {"depth": "27 m"},
    "motion": PULSE,
    "flexible": {"elements_across": 2, "evidence": "none"},
    "analysis": {"silence": "2 s"},
}
# The same on rock that rises downstream by 2 m.
RISING = {
    "section": {"polygon": [["0 m", "0 m"], ["24 m", "2 m"], ["5 m", "30 m"], ["0 m", "30 m"]]},
    "crack": {"elevation": "0 m", "inclination": f"{math.atan(2.0 / 24.0)!r} rad", "friction": 0.8},
}
STILL_WATER = {"depth": "27 m", "compressible": False}
PENALTY = SMALL["flexible"] | {"contact": "idce", "damping": "stiffness"}
THESIS = SMALL["flexible"] | {"damping": "thesis"}


def codes(response) -> set[str]:
    return {notice.name for notice in response.warnings}


@pytest.mark.parametrize(
    ("fields", "modulus", "sound", "assumed"),
    [
        ({}, 25e9, ["reservoir"], True),
        ({"rock": "rigid"}, None, ["reservoir"], False),
        ({"rock": {"modulus": "10 GPa"}}, 10e9, ["reservoir"], False),
        ({"reservoir": STILL_WATER}, 25e9, [], True),
        ({"reservoir": None}, 25e9, [], True),
        ({"tailwater": {"depth": "5 m"}}, 25e9, ["reservoir", "tailwater"], True),
        ({"concrete": {}}, None, [], False),
        ({"flexible": PENALTY}, None, [], False),
        ({"flexible": THESIS}, None, [], False),
        (RISING, None, ["reservoir"], False),
    ],
    ids=["silent", "rigid", "given", "mass", "dry", "both sides", "block", "penalty", "thesis", "rising"],
)
def test_one_place_decides_what_is_around_a_dam(fields, modulus, sound, assumed):
    case = read_case({name: value for name, value in (SMALL | fields).items() if value is not None})
    assert (case.foundation and case.foundation.modulus) == modulus
    assert sorted(case.surroundings.sound) == sound
    assert case.surroundings.assumed is assumed


def test_assumed_rock_is_that_of_the_docs():
    rock = read_case(SMALL).foundation
    assert rock is not None
    assert (rock.poisson, rock.density, rock.damping, rock.radiation, rock.massless) == (
        0.25,
        2650.0,
        0.02,
        True,
        False,
    )
    assert read_case(SMALL).reservoir.floor_reflection == 0.9


def test_a_silent_case_is_that_with_the_same_rock_and_sound():
    """By hand: the fields that are assumed, written down."""
    said = SMALL | {
        "rock": {"modulus": "25 GPa", "poisson": 0.25, "density": "2650 kg/m^3", "damping": 0.02},
        "reservoir": {"depth": "27 m", "compressible": True, "floor_reflection": 0.9},
    }
    silent, written = flexible(read_case(SMALL)), flexible(read_case(said))
    assert silent.residual_slip_m == written.residual_slip_m != 0.0
    assert first_period(read_case(SMALL), "x") == first_period(read_case(said), "x")
    assert written.assumed_rock is None
    assert silent.assumed_rock == {"modulus_pa": 25e9, "trials": []}


def test_two_words_take_both_away():
    plane = read_case(SMALL | {"rock": "rigid", "reservoir": STILL_WATER})
    response = flexible(plane)
    assert {response.energy.rock_j, response.energy.floor_j, response.energy.far_end_j} == {0.0}
    assert response.residual_slip_m == flexible(read_case(SMALL).on_rigid_plane()).residual_slip_m
    assert response.residual_slip_m != flexible(read_case(SMALL)).residual_slip_m
    assert not codes(response) & {"surroundings-not-assumed rock", "surroundings-not-assumed sound"}
    assert "assumed" not in verdict(response)


def test_the_word_gives_way_to_the_fields_of_a_block():
    plane = read_case(SMALL | {"rock": "rigid"})
    assert plane.with_("rock.modulus=10GPa").foundation.modulus == 10e9
    assert plane.with_({"rock": None}).surroundings.assumed
    assert read_case(SMALL, "rock=rigid") == plane
    with pytest.raises(InputError, match="rock"):
        read_case(SMALL | {"rock": "soft"})


def test_other_rock_is_tried_and_said():
    """The runs beside the result are those of cases that say so: on the rigid plane to the last digits; on rock, which
    takes the shapes of the assumed one, within the error that each of both reductions may leave."""
    case = read_case(SMALL | {"flexible": {"elements_across": 2, "evidence": "step"}})
    response = flexible(case)
    assumed = response.assumed_rock
    assert [trial.modulus_pa for trial in assumed.trials] == [12.5e9, 50e9, None]
    plain = case.with_("flexible.evidence=none")
    others = [plain.with_(f"rock.modulus={modulus}") for modulus in ("12.5GPa", "50GPa")]
    others.append(plain.with_("rock=rigid", "reservoir.compressible=false"))
    for trial, other, off in zip(assumed.trials, others, (2.0 * ENOUGH, 2.0 * ENOUGH, 1e-9), strict=True):
        alone = flexible(other)
        assert trial.outcome == alone.outcome
        assert trial.residual_slip_m == pytest.approx(alone.residual_slip_m, rel=off)
    said = verdict(response)
    assert "rock as stiff as the concrete (25 GPa) is assumed; with half and twice its modulus the dam" in said
    assert f"{1000.0 * abs(assumed.trials[2].residual_slip_m):.1f} mm" in said


@pytest.mark.parametrize(
    ("fields", "code", "why"),
    [
        ({"flexible": PENALTY}, "surroundings-not-assumed rock", "penalty contact"),
        ({"flexible": PENALTY}, "surroundings-not-assumed sound", "penalty contact"),
        ({"flexible": THESIS}, "surroundings-not-assumed rock", "options of the thesis"),
        (RISING, "surroundings-not-assumed rock", "not level"),
        (
            {
                "reservoir": {"depth": "27 m", "follows_vertical_motion": True},
                "motion": PULSE | {"vertical": PULSE},
            },
            "surroundings-not-assumed sound",
            "follows the vertical motion",
        ),
    ],
)
def test_what_cannot_be_assumed_is_a_grave_warning(fields, code, why):
    response = flexible(read_case(SMALL | fields | {"analysis": {"silence": "0 s"}}))
    notice = next(notice for notice in response.warnings if notice.name == code)
    assert notice.severity == "grave"
    assert why in str(notice)


def test_dams_of_other_contact_have_their_own_water():
    """Built one after the other: penalty contact takes the water as a mass, exact contact does not."""
    sound, mass = (build_flexible_dam(read_case(SMALL | {"flexible": more})) for more in (SMALL["flexible"], PENALTY))
    assert sound.reservoir is not None
    assert mass.reservoir is None
    own, carried = (dam.bodies[0] for dam in (sound, mass))
    assert (own.mass - own.mass_concrete).nnz == 0
    assert (carried.mass - carried.mass_concrete).diagonal().sum() > 0.0


@pytest.mark.parametrize("path", [BASE, HEIGHT, EXAMPLES / "koyna.toml"], ids=["base", "height", "koyna"])
def test_models_beside_it_keep_their_ground(path):
    """A block knows no waves: what is assumed for the elastic dam is nothing to it."""
    silent = read_case(path, [*COARSE, *FAST])
    plane = silent.on_rigid_plane()
    block = "rigid" if path == BASE else "decoupled"
    assert run(silent, block).residual_slip_m == run(plane, block).residual_slip_m


def test_a_block_has_a_rigid_plane_and_water_as_a_mass_in_any_case():
    plain = {name: value for name, value in SMALL.items() if name not in ("flexible", "concrete")}
    plane = read_case(plain | {"rock": "rigid", "reservoir": STILL_WATER})
    assert "fields-unused" not in codes(run(plane, "rigid"))
    said = read_case(plain | {"rock": {"modulus": "10 GPa"}})
    unused = next(notice for notice in run(said, "rigid").warnings if notice.name == "fields-unused")
    assert "rock.modulus" in str(unused)


def test_static_checks_and_studies_name_it_too(tmp_path):
    """Their answers have no verdict of one dam."""
    plain = {name: value for name, value in SMALL.items() if name not in ("flexible", "analysis")}
    for fields, named in ((plain, True), (plain | {"rock": "rigid"}, False)):
        joints = with_response_spectrum(statics_of_sections(read_case(fields)), "en1998:0.3 g,B")
        assert any(notice.name == "rock-assumed" for notice in joints.joints[0].statics.warnings) is named
        (tmp_path / "case.json").write_text(json.dumps(fields | {"flexible": SMALL["flexible"]}))
        study = tmp_path / "study.toml"
        study.write_text('case = "case.json"\nmodel = "flexible"\n[vary]\n"crack.friction" = [0.8, 0.9]\n')
        plan = plan_of(read_study(study))
        assert any("rock as stiff as the concrete (25 GPa)" in text for text in plan.warnings()) is named


@pytest.mark.parametrize(
    ("rock", "words"),
    [
        ("soft", 'rock: "soft" is not a choice; choose "rigid" or a block of fields'),
        (True, "rock: true is of the wrong type; give a block of fields"),
        ({"damping": 0.05}, "rock.modulus: is required but missing"),
        ({"modulus": "10 GPa", "dampng": 0.05}, 'rock.dampng: no such field; did you mean "damping"?'),
    ],
)
def test_rock_that_is_neither_word_nor_block_is_one_sentence(rock, words):
    with pytest.raises(InputError) as refused:
        read_case(SMALL | {"rock": rock})
    assert str(refused.value).startswith(words)
    assert not refused.value.others
