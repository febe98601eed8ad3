"""Forty questions of a newcomer. The theory pages answer thirty: where is this computed, and which test shows it? The
names of files answer the other ten."""

from __future__ import annotations

import ast
import re

import pytest

from shared.dams import ROOT
from shared.pages import equation_rows, functions, proofs

RIGID, FLEXIBLE = "crates/heeltoe/src/rigid", "crates/heeltoe/src/flexible"
BLOCK, DAM = "tests/models/rigid", "tests/models/flexible"
#: A question, the file and function that answer it, and the test.
QUESTIONS = {
    "Where is restitution applied at an impact?": (
        f"{RIGID}/impact.rs::with_restitution",
        f"{BLOCK}/test_kernel_impact.py::test_drift_one_corner_strikes",
    ),
    "Does a rocking block lose what Housner says?": (
        f"{RIGID}/impact.rs::impact",
        f"{BLOCK}/test_kernel_impact.py::test_a_rocking_rectangle_loses_what_housner_says",
    ),
    "What keeps an impact from creating energy?": (
        f"{RIGID}/impact.rs::energy_gain",
        f"{BLOCK}/test_kernel_impact.py::test_restitution_is_lowered_where_it_would_create_energy",
    ),
    "When do infinitely many bounces end?": (
        f"{RIGID}/impact.rs::come_to_lie",
        f"{BLOCK}/test_kernel_invariants.py::test_the_settling_velocity_does_not_matter",
    ),
    "How is the next event found?": (
        f"{RIGID}/event.rs::cubic",
        f"{RIGID}/event.rs::a_root_of_a_cubic_is_exact_to_rounding",
    ),
    "How does the block choose between sliding and rocking?": (
        f"{RIGID}/choice.rs::select",
        f"{BLOCK}/test_kernel_twin.py::test_ten_thousand_blocks_agree_with_the_twin",
    ),
    "At which acceleration does the block start to slide or rock?": (
        "python/heeltoe/mechanics/block.py::critical_accelerations",
        "tests/mechanics/test_block.py::test_critical_accelerations_are_where_the_kernel_starts_to_move",
    ),
    "What happens in Painlevé's paradox?": (
        f"{RIGID}/impact.rs::jam",
        f"{BLOCK}/test_random_blocks.py::test_a_slip_that_friction_jams_on_its_way_ends_there",
    ),
    "Does the energy of a rigid run balance?": (
        f"{RIGID}/ledger.rs::residual",
        f"{BLOCK}/test_kernel_invariants.py::test_every_run_is_sound",
    ),
    "How can a block overturn?": (
        f"{RIGID}/varying/instant.rs::turned_about",
        f"{BLOCK}/test_varying.py::test_mirrored_dams_overturn_the_other_way",
    ),
    "How does uplift change while the crack is open?": (
        "crates/heeltoe/src/inside.rs::pressure",
        "crates/heeltoe/src/inside.rs::the_change_is_the_difference_from_the_still_pressure",
    ),
    "With which force does an anchor pull?": (
        "crates/heeltoe/src/inside.rs::tension",
        f"{BLOCK}/test_varying.py::test_an_anchor_pulls_with_its_prestress_and_its_elongation",
    ),
    "What mass of water moves with an elastic dam?": (
        "python/heeltoe/models/flexible/body/virtual_water.py::virtual_masses",
        f"{DAM}/test_nodal_loads.py::test_water_moves_along_the_normal_of_a_face",
    ),
    "How does virtual water resist rotation?": (
        "python/heeltoe/mechanics/virtual_water.py::virtual_mass",
        "tests/mechanics/test_virtual_water.py::test_mass_before_both_faces_against_numeric_integration",
    ),
    "How is the uplift pattern turned into pressures?": (
        "python/heeltoe/mechanics/loads.py::uplift_profile",
        "tests/mechanics/test_loads.py::test_uplift_patterns",
    ),
    "From which state does an elastic dam start?": (
        f"{FLEXIBLE}/start.rs::find_rest",
        f"{DAM}/test_start.py::test_it_is_an_equilibrium_with_friction",
    ),
    "Which modes of the elastic parts are kept?": (
        "python/heeltoe/models/flexible/body/modes.py::reduce",
        f"{DAM}/test_modes.py::test_static_flexibility_against_a_direct_solution",
    ),
    "Does a dam that slides as a whole feel damping?": (
        "python/heeltoe/models/flexible/body/damping.py::damping_of",
        f"{DAM}/test_damping.py::test_sliding_as_a_whole_is_not_damped",
    ),
    "Where are stick, slip and opening of all nodes solved?": (
        f"{FLEXIBLE}/coulomb/mod.rs::solve",
        f"{FLEXIBLE}/tests.rs::random_problems_are_solved_to_rounding",
    ),
    "When does an elastic dam count as rocking?": (
        "python/heeltoe/models/flexible/body/rocking_thresholds.py::elastic_give",
        f"{DAM}/test_stance.py::test_what_a_dam_does_goes_with_its_size",
    ),
    "Where does the uncertainty of an elastic result come from?": (
        "python/heeltoe/models/flexible/evidence/refinement.py::answer",
        f"{DAM}/test_evidence.py::test_each_part_is_the_difference_of_two_runs_of_ones_own",
    ),
    "When does sliding feed a vibration of the dam?": (
        "python/heeltoe/models/flexible/evidence/growth.py::growth_of",
        f"{DAM}/test_growth.py::test_of_the_typical_dam_as_an_independent_program_has_it",
    ),
    "How is the largest tension found?": (
        f"{FLEXIBLE}/envelope.rs::meet",
        f"{DAM}/stress/test_envelope.py::test_it_is_the_largest_of_all_moments",
    ),
    "How does the crack of the decoupled chain move?": (
        "python/heeltoe/models/decoupled/crack_motion.py::accelerations",
        "tests/models/decoupled/test_crack_motion.py::test_an_oscillator_is_one_of_the_response_spectrum",
    ),
    "How does friction weaken with slip?": (
        "crates/heeltoe/src/friction.rs::friction",
        f"{BLOCK}/test_friction_laws.py::test_a_weakening_slider_under_a_pulse_by_hand",
    ),
    "Where is the curve of Barton and Choubey?": (
        "crates/heeltoe/src/friction.rs::barton",
        f"{BLOCK}/test_barton_bandis.py::test_barton_bandis_gives_a_published_table",
    ),
    "How do asperities wear?": (
        "crates/heeltoe/src/asperity.rs::worn",
        f"{BLOCK}/test_rough_crack.py::test_the_angle_wears_with_the_work_of_friction",
    ),
    "How do two cracks respond to each other?": (
        f"{FLEXIBLE}/coupling.rs::fill",
        f"{DAM}/test_several_cracks.py::test_the_neck_alone_where_the_base_is_bonded",
    ),
    "How far does a static crack open?": (
        "python/heeltoe/models/statics/contact.py::settle",
        "tests/models/statics/test_statics.py::test_cracked_length_with_uplift_in_the_crack",
    ),
    "How does slip close drains before an aftershock?": (
        "python/heeltoe/mechanics/drains.py::drainage_left",
        "tests/models/statics/test_statics.py::test_slip_closes_drains",
    ),
}


def test_there_are_thirty():
    assert len(QUESTIONS) == 30


@pytest.mark.parametrize("question", QUESTIONS)
def test_the_theory_answers(question):
    code, test = (tuple(place.split("::")) for place in QUESTIONS[question])
    assert (ROOT / code[0]).is_file(), code
    assert code[1] in functions(code[0])
    assert test[1] in proofs(test[0])
    assert (code, test) in [row[1:] for row in equation_rows()]


#: A question, and the file and the name in it that answer it; a word of the question stands in the name of the file.
NAMED = {
    "Where does uplift change while the crack opens?": (
        "python/heeltoe/models/flexible/body/uplift_and_anchors.py::following_water"
    ),
    "Where does the report get its slip, as all other numbers?": "python/heeltoe/result/numbers.py::CrackNumbers",
    "Which outcome counts as failed?": "python/heeltoe/result/outcome.py::Outcome",
    "Where are results compared with the limits of the case?": "python/heeltoe/result/limits.py::check_limits",
    "When does a dam come to rest?": "python/heeltoe/result/rest.py::rests_from",
    "Where is the sentence of the verdict made?": "python/heeltoe/result/verdict.py::verdict",
    "Which surroundings, rock and water, are assumed where a case gives none?": (
        "python/heeltoe/case/surroundings.py::surroundings_of"
    ),
    "Where are the criteria of FERC and USACE?": "python/heeltoe/models/statics/criteria.py::CRITERIA",
    "Where is the fragility curve fitted?": "python/heeltoe/study/answers/fragility.py::curve",
    "Who does the matching of a record to a spectrum?": "python/heeltoe/motion/matching.py::match",
}


def test_there_are_ten_more():
    assert len(NAMED) == 10


@pytest.mark.parametrize("question", NAMED)
def test_a_file_whose_name_says_so_answers(question):
    path, _, name = NAMED[question].partition("::")
    stem = (ROOT / path).stem
    assert set(stem.split("_")) & set(re.findall("[a-z]+", question.lower())), stem
    tops = ast.parse((ROOT / path).read_text(encoding="utf-8")).body
    named = [getattr(top, "name", None) or getattr(getattr(top, "target", None), "id", None) for top in tops]
    assert name in named
