"""Joints that are bonded before the earthquake: case, results, words, and what always holds."""

from __future__ import annotations

import copy
import io
import math
from typing import Any

import meshio
import numpy as np
import pytest
from rich.console import Console

from heeltoe import InputError, flexible, run
from heeltoe.models.flexible.body.bond import node_lengths, zone_mesh
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.body.step import longest_step
from heeltoe.models.flexible.evidence.growth import growth_of
from heeltoe.models.statics.after import ligament_of, statics_after
from heeltoe.result.verdict import verdict
from heeltoe.study.small.run_table import parse_axes, run_small
from heeltoe.views.animation.frames import BONDED, STATUSES, build_scene
from heeltoe.views.animation.page import page_data
from heeltoe.views.content.question import question
from heeltoe.views.content.subject import Subject
from heeltoe.views.figures.all import all_figures
from heeltoe.views.figures.crack import joint_figure, joint_states
from heeltoe.views.figures.energy import energy_figure
from heeltoe.views.files.vtk import write_vtk_series
from heeltoe.views.terminal.response import print_response
from heeltoe.views.terminal.small import print_small
from heeltoe.views.words.numbers import Numbers
from shared.dams import plane_case

# Strong and tough: a brittle one would ask for elements and steps of its own.
STRONG = {
    "tensile_strength": "50 MPa",
    "cohesion": "60 MPa",
    "fracture_energy": "10 MN/m",
    "shear_energy": "10 MN/m",
}
BOND = {
    "tensile_strength": "0.2 MPa",
    "cohesion": "0.6 MPa",
    "fracture_energy": "200 N/m",
    "shear_energy": "1000 N/m",
}
PULSES = [["0 s", "0 g"], ["0.1 s", "0.6 g"], ["0.3 s", "-0.9 g"], ["0.5 s", "0.9 g"], ["0.6 s", "0 g"]]
DAM: dict[str, Any] = {
    "section": {
        "height": "30 m",
        "crest_width": "5 m",
        "neck_height": "25 m",
        "neck_width": "6 m",
        "base_width": "26 m",
    },
    "concrete": {"modulus": "25 GPa"},
    "crack": {"elevation": "6 m", "friction": 1.0, "bond": BOND},
    "reservoir": {"depth": "26 m"},
    "motion": {"points": PULSES},
    "flexible": {"elements_across": 8, "evidence": "none"},
    "analysis": {"silence": "0 s"},
}

CORNERS = ((0.0, 0.0), (26.0, 0.0), (6.0, 25.0), (5.0, 30.0), (0.0, 30.0))


def dam(**bond: Any) -> dict[str, Any]:
    fields = copy.deepcopy(DAM)
    fields["crack"]["bond"] = BOND | bond
    return fields


def test_a_joint_cracks_and_says_so():
    response = run(plane_case(dam()), "flexible")
    bond = response.joint
    assert response.ok
    assert bond.first_cracking_s > 0.0
    assert 0.0 < bond.cracked_length_m <= response.crack_width_m * (1.0 + 1e-12)
    history = response.histories
    # Nothing heals.
    for name in ("cracked_upstream_m", "cracked_downstream_m", "cracked_length_m"):
        assert np.all(np.diff(history[name]) >= 0.0), name
    assert history["cracked_length_m"][-1] == bond.cracked_length_m
    assert response.energy.residual < 1e-9
    assert "The joint begins to crack at" in verdict(response)
    broken = response.summary["joint"]["fracture_energy_j"]
    assert broken >= 0.99 * 200.0 * bond.cracked_length_m
    assert response.energy.fracture_j == pytest.approx(broken, rel=1e-9)
    entries = [text.get_text() for axes in energy_figure(response).axes for text in axes.get_yticklabels()]
    assert any("fracture" in entry for entry in entries) == (broken > 1e-3 * abs(response.energy.input_j))


@pytest.mark.parametrize(
    ("tensile", "friction", "factor"), [("0.4 MPa", 1.3, 2.0), ("0.2 MPa", 1.3, 1.5), ("0.8 MPa", 1.0, 1.5)]
)
def test_a_joint_that_breaks_makes_no_energy_whatever_the_step(tensile, friction, factor):
    """The right values are no energy made, and at least the case's own G_f on all that is cracked.

    These joints slip while they are held under tension: friction of a negative force would give energy.
    """
    fields = dam(tensile_strength=tensile, cohesion="1.05 MPa")
    fields["crack"]["friction"] = friction
    fields["motion"]["points"] = [[t, f"{factor * float(a.split()[0])} g"] for t, a in PULSES]
    whole = run(plane_case(fields), "flexible")
    fields["flexible"]["time_step"] = f"{whole.summary['time_step_s'] / 4.0} s"
    quarter = run(plane_case(fields), "flexible")
    for response in (whole, quarter):
        energy, joint = response.energy, response.joint
        assert joint.cracked_length_m > 0.999 * response.crack_width_m
        assert energy.fracture_j >= 200.0 * joint.cracked_length_m * (1.0 - 1e-3)
        assert energy.gained_j < 0.01 * energy.fracture_j
        assert energy.friction_j > 0.0
        assert energy.residual < 1e-9
        assert "energy-made" not in {notice.code for notice in response.warnings}
    assert quarter.energy.gained_j < 0.1 * whole.energy.gained_j + 1e-6


def test_two_lines_of_which_the_first_has_all_the_energy_are_one():
    one, same, two = (
        run(plane_case(dam(**more)), "flexible")
        for more in ({}, {"initial_energy": BOND["fracture_energy"]}, {"initial_energy": "80 N/m"})
    )
    for name, values in one.histories.items():
        assert np.array_equal(values, same.histories[name]), name
    assert two.energy.residual < 1e-9
    # The first line is the steeper one: more softens, and what breaks takes all of its energy.
    assert two.histories["softening_length_m"].max() > one.histories["softening_length_m"].max()
    assert two.summary["joint"]["fracture_energy_j"] >= 0.99 * 200.0 * two.joint.cracked_length_m
    assert two.joint.process_zone_m == pytest.approx(0.4 * one.joint.process_zone_m)
    assert np.all(np.diff(two.crack.damage, axis=0) >= 0.0)


def test_the_energy_of_the_first_line_is_a_part_of_all():
    with pytest.raises(InputError, match="fracture_energy") as wrong:
        plane_case(dam(initial_energy="201 N/m"))
    assert (wrong.value.code, wrong.value.field) == ("out-of-range", "crack.bond.initial_energy")


@pytest.mark.parametrize("initial", [None, "80 N/m"])
def test_the_image_of_a_dam_cracks_from_the_other_face(initial):
    fields = dam(**({} if initial is None else {"initial_energy": initial}))
    fields["motion"]["sign"] = "recorded"
    fields["section"] = {"polygon": [[f"{x} m", f"{z} m"] for x, z in CORNERS]}
    image = copy.deepcopy(fields)
    image["section"]["polygon"] = [[f"{-x} m", f"{z} m"] for x, z in CORNERS[::-1]]
    image["tailwater"] = image.pop("reservoir")
    image["motion"]["points"] = [[t, f"{-float(a.split()[0])} g"] for t, a in PULSES]
    own, other = (run(plane_case(item), "flexible").joint for item in (fields, image))
    assert own.cracked_length_m > 0.0
    assert own.cracked_upstream_m == pytest.approx(other.cracked_downstream_m, abs=1e-9)
    assert own.cracked_downstream_m == pytest.approx(other.cracked_upstream_m, abs=1e-9)
    assert own.fracture_energy_j == pytest.approx(other.fracture_energy_j, rel=1e-6)


def test_a_strength_beyond_reach_is_the_bonded_dam():
    """A linear dam moves as many times as far as it is shaken more strongly."""
    fields = dam(**STRONG)
    twice = copy.deepcopy(fields)
    twice["motion"]["points"] = [[t, f"{2.0 * float(a.split()[0])} g"] for t, a in PULSES]
    one, two = (run(plane_case(item), "flexible") for item in (fields, twice))
    assert one.joint.first_cracking_s is None
    assert verdict(one).startswith("The joint does not crack over its")
    assert max(one.opening_upstream_m, one.opening_downstream_m) < 1e-12
    # The first frame is the state of rest, which is not scaled.
    for name in ("normal_force_n", "friction_force_n"):
        single, double = (item.histories[name][1:] for item in (one, two))
        rest = 2.0 * single[0] - double[0]
        change, twofold = single - rest, double - rest
        assert np.abs(twofold - 2.0 * change).max() < 1e-6 * np.abs(twofold).max(), name


def test_a_bond_that_no_step_follows_is_refused():
    brittle = dam(shear_energy="0.001 N/m")
    with pytest.raises(InputError) as wrong:
        run(plane_case(brittle), "flexible")
    assert wrong.value.code == "step-stiff"
    assert wrong.value.field == "crack.bond"


def test_the_flexible_model_is_taken_by_itself():
    assert run(plane_case(dam())).model == "flexible"


def test_the_cohesion_reaches_the_end_of_the_line():
    with pytest.raises(InputError, match="cohesion") as wrong:
        plane_case(dam(cohesion="0.1 MPa"))
    assert wrong.value.code == "bond-apex"
    # The friction is that of the first crack.
    weak = {"elevation": "15 m", "bond": BOND | {"cohesion": "0.1 MPa"}}
    with pytest.raises(InputError) as wrong:
        plane_case(dam() | {"further_cracks": [weak]})
    assert (wrong.value.code, wrong.value.field) == ("bond-apex", "further_cracks[0].bond.cohesion")
    assert plane_case(dam() | {"further_cracks": [weak | {"friction": 0.4}]}).further_cracks


def test_long_elements_lower_the_strength_and_a_warning_says_so():
    response = run(plane_case(dam(tensile_strength="3 MPa", cohesion="4 MPa", fracture_energy="100 N/m")), "flexible")
    notice = next(warning for warning in response.warnings if warning.code == "joint-coarse")
    bond = response.joint
    assert bond.process_zone_m == pytest.approx(25e9 * 100.0 / 3e6**2)
    assert bond.tensile_strength_pa == pytest.approx(math.sqrt(25e9 * 100.0 / (3.0 * bond.element_m)))
    assert "is lowered from 3 MPa" in str(notice)


def test_a_fine_mesh_takes_the_strength_as_it_is():
    case = plane_case(dam())
    mesh = zone_mesh(case.crack.bond, 25e9, np.linspace(0.0, 20.0, 41))
    assert mesh.zone == pytest.approx(125.0)
    assert mesh.element == 1.0
    assert (mesh.is_coarse, mesh.strength) == (False, 0.2e6)


def test_nodes_share_the_joint():
    assert node_lengths(np.array([0.0, 3.0, 6.0, 12.0, 18.0])) == pytest.approx([1.0, 4.0, 3.0, 8.0, 2.0])


def test_a_brittle_joint_asks_for_a_short_step():
    case = plane_case(dam(shear_energy="1 N/m"))
    tough, brittle = (longest_step(build_flexible_dam(item), 0.5, 2e-4) for item in (plane_case(dam()), case))
    assert tough[0] == 2e-4
    assert brittle[0] < 2e-4
    assert brittle[1] == "crack.bond"


@pytest.mark.slow
def test_a_mesh_that_is_fine_at_the_joint_alone_cracks_as_one_that_is_fine_everywhere():
    fields = dam()
    fields["flexible"]["elements_across"] = 16
    even = run(plane_case(fields), "flexible")
    fields["flexible"]["elements_away"] = 4
    graded = run(plane_case(fields), "flexible")
    assert graded.joint.element_m == pytest.approx(even.joint.element_m)
    assert 0.0 < even.joint.cracked_length_m < even.crack_width_m
    assert graded.joint.first_cracking_s == pytest.approx(even.joint.first_cracking_s, abs=1e-3)
    assert graded.joint.cracked_length_m == pytest.approx(even.joint.cracked_length_m, abs=even.joint.element_m)
    assert graded.joint.fracture_energy_j == pytest.approx(even.joint.fracture_energy_j, rel=0.05)


def test_several_joints_crack_in_an_order():
    fields = dam()
    fields["cracks"] = [
        {"elevation": "18 m", "friction": 1.0, "bond": BOND | {"fracture_energy": "20 N/m"}},
        {"elevation": "6 m", "bond": STRONG},
    ]
    del fields["crack"]
    response = run(plane_case(fields), "flexible")
    upper, lower = (crack.joint for crack in response.cracks)
    assert upper.first_cracking_s is not None
    assert lower.first_cracking_s is None
    assert "The joint at 6 m does not crack" in verdict(response)


@pytest.mark.parametrize("pattern", ["constant", "full while open", "zero while open"])
def test_water_enters_what_opens(pattern):
    fields = dam()
    fields["uplift"] = {"pattern": "triangular", "during_shaking": pattern}
    response = run(plane_case(fields), "flexible")
    assert response.ok
    assert response.energy.residual < 1e-9


#: Its heel bears some 0.9 MPa of tension and of shear before the earthquake, and more on a finer mesh.
BASE = {"tensile_strength": "0.8 MPa", "cohesion": "1.2 MPa", "fracture_energy": "100 N/m"}


@pytest.mark.slow
@pytest.mark.parametrize("across", [13, 26, 40])
def test_what_a_joint_is_before_the_earthquake_does_not_depend_on_the_mesh(across):
    """A corner that softens by a hair is no crack, and keeps the shear that its limit allows."""
    fields = dam(**BASE)
    fields["crack"]["elevation"] = "0 m"
    fields["flexible"]["elements_across"] = across
    still = build_flexible_dam(plane_case(fields))
    along, across_ = still.crack_forces[0]
    lengths = node_lengths(still.reduced[0].position[: along.size])
    tension, shear = -across_[0] / lengths[0], abs(along[0]) / lengths[0]
    assert still.start.stands
    assert tension <= 0.8e6 * (1.0 + 1e-9)
    # The end of the line of the shear strength: c - f_t at that tension.
    assert 0.35e6 < shear < 1.2e6 - tension + 2e3
    fields["motion"]["points"] = [["0 s", "0 g"], ["0.01 s", "0.001 g"], ["0.02 s", "0 g"]]
    assert run(plane_case(fields), "flexible").joint.first_cracking_s is None


def test_the_picture_shows_what_the_numbers_say():
    fields = dam()
    fields["limits"] = {"cracked_length": "1 m"}
    response = run(plane_case(fields), "flexible")
    along, states = joint_states(response.crack)
    lengths = node_lengths(along)
    cracked = np.where(states >= 2, lengths, 0.0).sum(axis=1)
    assert cracked == pytest.approx(response.histories["cracked_length_m"], abs=1e-9)
    softening = np.where(states == 1, lengths, 0.0).sum(axis=1)
    assert softening == pytest.approx(response.histories["softening_length_m"], abs=1e-9)
    # Nothing heals.
    assert np.all(np.diff(response.crack.damage, axis=0) >= 0.0)
    assert {text.get_text() for text in joint_figure(response).legends[0].get_texts()} >= {"intact", "softening"}
    (check,) = response.limits
    assert (check.name, check.value) == ("cracked_length", response.joint.cracked_length_m)
    assert check.met == (response.joint.cracked_length_m <= 1.0)


def test_vtk_files_have_the_damage(tmp_path):
    history = run(plane_case(dam()), "flexible").crack
    write_vtk_series(history, tmp_path, frames=[0, -1])
    last = meshio.read(sorted(tmp_path.glob("crack-*.vtu"))[-1])
    upper = last.point_data["damage"][: history.upper_position.shape[2]]
    assert upper == pytest.approx(history.damage[-1][: upper.size])
    assert upper.max() == 1.0
    # Nodes at one place crack as one.
    assert last.point_data["damage"][upper.size :] == pytest.approx(upper)


def test_the_report_asks_whether_the_joint_cracks():
    fields = dam()
    response = run(plane_case(fields), "flexible")
    subject = Subject(plane_case(fields), response, Numbers(response.to_json(), "si"), figures={})
    text = str(question(subject))
    assert "Does the joint of" in text
    assert "Cracked length of the joint" in text


def test_the_terminal_says_how_much_is_cracked():
    fields = dam()
    response = run(plane_case(fields), "flexible")
    console = Console(file=io.StringIO(), width=80)
    print_response(response, console)
    heading, row = (line for line in console.file.getvalue().splitlines() if "residual" in line or " dam  " in line)
    assert heading.split()[-1] == "cracked"
    assert float(row.split()[-2]) == pytest.approx(response.joint.cracked_length_m, abs=0.01)


def test_a_small_table_has_the_cracked_length():
    axes = parse_axes(["crack.bond.tensile_strength=0.2MPa,0.5MPa"])
    table = run_small(dam(), [], axes, flexible)
    weak, strong = table.rows()
    assert weak["cracked_length_m"] == table.responses[0].joint.cracked_length_m > strong["cracked_length_m"]
    console = Console(file=io.StringIO(), width=120)
    print_small(table, console)
    assert "cracked" in console.file.getvalue()


def test_what_is_left_bears_after_the_earthquake():
    case = plane_case(dam(**STRONG))
    held = run(case, "flexible")
    assert ligament_of(held) == (0.0, held.crack_width_m)
    (after,) = (item for item in statics_after(case, held).cases if item.name == "post-seismic")
    assert after.cohesive_force_n == pytest.approx(60e6 * held.crack_width_m, rel=1e-6)
    assert any("the joint holds over" in str(text) for text in after.assumptions)


def test_the_evidence_covers_the_cracked_length():
    fields = dam()
    fields["flexible"] = {"elements_across": 6, "evidence": "step"}
    response = run(plane_case(fields), "flexible")
    worth = response.evidence.cracked_length_m
    assert worth.value == response.joint.cracked_length_m
    width = response.crack_width_m
    assert 0.5 * width / 6.0 * (1.0 - 1e-9) <= worth.uncertainty < width
    # A strength that depends on the mesh tells nothing of the length.
    fields["crack"]["bond"] = BOND | {"tensile_strength": "3 MPa", "cohesion": "4 MPa", "fracture_energy": "100 N/m"}
    coarse = run(plane_case(fields), "flexible").evidence
    lowered = coarse.cracked_length_m
    assert lowered.uncertainty == pytest.approx(max(lowered.value, width - lowered.value))
    # Nor of what slips and opens: at its own strength the joint may hold.
    for key in ("residual_slip_m", "peak_slip_downstream_m", "opening_upstream_m"):
        assert coarse[key].uncertainty >= abs(coarse[key].value)


def test_what_has_softened_up_to_its_end_may_break():
    """On half the mesh this joint is cracked through."""
    bond = {
        "tensile_strength": "0.65007 MPa",
        "cohesion": "1.14908 MPa",
        "fracture_energy": "209.2735 N/m",
        "shear_energy": "1031.371 N/m",
    }
    fields = dam(**bond)
    turns = [(0.0, 0.0), (0.1281, -0.1881), (0.17, -0.716), (0.3063, -0.3508), (0.5251, 0.1181), (0.5398, -0.8783)]
    fields["motion"] = {"points": [[f"{t} s", f"{a} g"] for t, a in [*turns, (0.65, 0.0)]], "sign": "recorded"}
    fields["flexible"] = {"elements_across": 12, "evidence": "step"}
    response = run(plane_case(fields), "flexible")
    left = response.crack_width_m - response.joint.cracked_length_m
    assert response.joint.softening_length_m == pytest.approx(left, abs=0.1)
    assert 1.0 < left <= response.evidence.cracked_length_m.uncertainty


def test_a_joint_that_cracks_through_is_as_long_as_it_is():
    # The dead load strains the faces, whose lengths add up to more than the crack is wide.
    response = run(
        plane_case(dam(tensile_strength="0.1 MPa", cohesion="0.3 MPa") | {"limits": {"cracked_length": "30 m"}})
    )
    assert response.joint.cracked_through_s is not None
    assert response.joint.cracked_length_m <= response.crack_width_m
    assert response.histories["cracked_length_m"].max() <= response.crack_width_m


def test_of_many_joints_the_verdict_and_a_picture_say_which_cracks_first():
    fields = dam()
    del fields["crack"]
    fields["flexible"]["elements_across"] = 3
    fields["motion"]["sign"] = "recorded"
    fields["joints"] = {"every": "10 m", "friction": 1.0, "bond": BOND | {"tensile_strength": "0.4 MPa"}}
    response = run(plane_case(fields), "flexible")
    bonds = {crack.elevation: crack.joint for crack in response.cracks}
    assert list(bonds) == [20.0, 10.0, 0.0]
    first = min((bond.first_cracking_s, level) for level, bond in bonds.items() if bond.first_cracking_s is not None)
    text = verdict(response)
    assert f"The joint at {first[1]:g} m cracks first of 3, at {first[0]:.2f} s." in text
    for level, bond in bonds.items():
        assert (f"{level:g} m ({bond.cracked_through_s or -1.0:.2f} s)" in text) == (bond.cracked_through_s is not None)
    figures = all_figures(None, response)
    assert "joints" in figures
    (axes, _) = figures["joints"].axes
    marks = [line.get_xdata()[0] for line in axes.lines if line.get_marker() == "o"]
    assert sorted(marks) == sorted(
        bond.first_cracking_s for bond in bonds.values() if bond.first_cracking_s is not None
    )


@pytest.mark.slow
def test_many_joints_that_hold_stand_as_the_intact_dam_does():
    fields = dam()
    del fields["crack"]
    fields["flexible"]["elements_across"] = 2
    fields["section"] = {"height": "100 m", "crest_width": "8 m", "base_width": "80 m"}
    fields["reservoir"]["depth"] = "100 m"
    # Layers that bend more softly than the dam that they make up.
    fields["joints"] = {
        "every": "1.5 m",
        "friction": 1.0,
        "bond": STRONG | {"tensile_strength": "2 MPa", "cohesion": "3 MPa"},
    }
    many = build_flexible_dam(plane_case(fields))
    assert len(many.lines) == 67
    assert many.start.stands
    assert set(many.start.open_contacts) == {0}
    assert np.abs(many.start.slips).max() < 1e-6


def test_joints_that_all_hold_are_one_sentence():
    fields = dam()
    del fields["crack"]
    fields["flexible"]["elements_across"] = 3
    fields["joints"] = {"every": "10 m", "friction": 1.0, "bond": STRONG}
    assert verdict(run(plane_case(fields), "flexible")).startswith("None of the 3 joints cracks.")


@pytest.mark.parametrize("bonded", [0, 1])
def test_a_joint_cracks_beside_a_crack_with_a_friction_law(bonded):
    """The right value is that of constant friction, which a law with equal coefficients is."""
    law = {"name": "slip weakening", "form": "linear", "peak_friction": 0.8, "residual_friction": 0.8, "slip": "9 mm"}
    weakening = law | {"peak_friction": 1.0}
    runs = []
    for friction in ({"friction": 0.8}, {"law": law}, {"law": weakening}):
        fields = dam()
        del fields["crack"]
        fields["flexible"]["elements_across"] = 4
        cracks = [{"elevation": "12 m"}, {"elevation": "0 m"}]
        cracks[bonded] |= {"friction": 1.0, "bond": BOND}
        cracks[1 - bonded] |= friction
        fields["cracks"] = cracks
        runs.append(run(plane_case(fields), "flexible"))
    constant, equal, falls = runs
    assert constant.energy.fracture_j > 100.0
    for one, other in zip(constant.cracks, equal.cracks, strict=True):
        assert other.residual_slip_m == pytest.approx(one.residual_slip_m, rel=1e-9, abs=1e-12)
    assert equal.energy.fracture_j == pytest.approx(constant.energy.fracture_j, rel=1e-9)
    # The other law is one, and is met together with the bond.
    place = [crack.joint is None for crack in falls.cracks].index(True)
    assert abs(falls.cracks[place].residual_slip_m) < 0.99 * abs(constant.cracks[place].residual_slip_m)
    assert falls.summary["contact_residual"] < 1e-8
    assert falls.energy.residual < 1e-9


@pytest.mark.slow
def test_of_many_joints_those_that_crack_most_are_named():
    fields = dam()
    del fields["crack"]
    fields["flexible"]["elements_across"] = 2
    fields["motion"]["sign"] = "recorded"
    fields["joints"] = {"every": "3 m", "friction": 1.0, "bond": BOND | {"tensile_strength": "0.2 MPa"}}
    case = plane_case(fields)
    response = run(case, "flexible")
    assert len(response.cracks) == 10
    cracked = [crack for crack in response.cracks if crack.joint.first_cracking_s is not None]
    assert len(cracked) > 4
    text = verdict(response, brief=True)
    assert text.count("At the crack at") == 4
    assert "At the other 5 cracks it " in text
    for kind, many in (
        ("Cracked through:", [crack for crack in cracked if crack.joint.cracked_through_s is not None]),
        ("Cracked in part:", [crack for crack in cracked if crack.joint.cracked_through_s is None]),
    ):
        assert (kind in text) == bool(many)
        said = text.partition(kind)[2].partition(". ")[0]
        assert (f"{len(many) - 4} more " in said) == (len(many) > 4)
    assert f"The other {10 - len(cracked)} do" in text or len(cracked) >= 9
    console = Console(file=io.StringIO(), width=120)
    print_response(response, console)
    screen = console.file.getvalue()
    rows = [line for line in screen.splitlines() if line.startswith(("flexible dam at", "4 others, at most"))]
    assert len(rows) == 7
    # One warning of the mesh for all of them, and none that takes ways of all cracks together to find.
    assert sum(warning.code == "joint-coarse" for warning in response.warnings) <= 1


def test_of_many_cracks_the_growth_is_that_of_the_one_that_leads_by_itself():
    fields = dam()
    del fields["crack"]
    fields["flexible"]["elements_across"] = 3
    fields["cracks"] = [{"elevation": f"{level} m", "friction": 0.5} for level in (20, 12, 6, 0)]
    fields["reservoir"] = {"depth": "20 m"}
    case = plane_case(fields)
    response = run(case, "flexible")
    alone = build_flexible_dam(case.single_crack_cases[response.asked])
    assert response.self_excitation["growth_1_s"] == growth_of(alone, [0.5])[0]


def test_an_animation_shows_how_the_crack_grows():
    case = plane_case(dam())
    response = run(case, "flexible")
    times = response.histories["time_s"]
    scene = build_scene(case, response, times, None)
    assert scene.statuses == (*STATUSES, *BONDED)
    names = np.array(scene.statuses)[scene.status]
    assert set(names[0]) <= set(BONDED)
    whole = np.isin(names, BONDED) & (scene.status >= 0)
    # A node that has broken is never whole again.
    assert np.all(whole[1:] <= whole[:-1])
    assert np.any(names == "softening")
    assert np.array_equal(whole, response.crack.damage[:, : whole.shape[1]] < 1.0)
    assert page_data(scene, 1.0)["statusNames"][-2:] == ["intact", "softens"]
