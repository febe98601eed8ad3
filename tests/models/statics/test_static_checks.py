"""What the static checks say: sentences, warnings, criteria, examples, the command."""

from __future__ import annotations

import json

import pytest

import heeltoe
from heeltoe import read_case
from heeltoe.models.statics.criteria import CRITERIA, chosen
from shared.command import command
from shared.dams import ALL_EXAMPLES, BASE, BLOCK, ENDS, ROOT, SLENDER
from shared.statics import CLOSE, check, dam, only

# What fails, and by how much


def test_sentences():
    result = heeltoe.statics(dam(statics={"flood_depth": "95 m", "compressive_strength": "4 MPa"}))
    assert not result.ok
    # 0.9 x (96 - 38) / 45.125 = 1.1568
    assert str(check(result, "flood", "sliding factor").sentence) == (
        "flood: sliding factor 1.16 is 0.54 below the 1.70 of USACE EM 1110-2-2100 (2005), paragraph 3-7, table 3-2"
    )
    # e = 6.91667, B/6 = 13.3333
    assert str(check(result, "usual", "resultant").sentence) == (
        "usual: resultant 6.92 m downstream of the middle is 6.42 m inside the middle third of "
        "USACE EM 1110-2-2100 (2005), table 3-5"
    )
    # 1.1390625 against 0.3 x 4
    assert str(check(result, "usual", "compression").sentence) == (
        "usual: compression 1.14 MPa is 0.06 MPa below the 1.20 MPa (0.3 of the strength) of "
        "USACE EM 1110-2-2200 (1995), table 4-1"
    )
    assert str(check(result, "usual", "equilibrium").sentence) == "usual: the block stands"
    failed = [item for item in result.checks if not item.met]
    assert {item.name for item in failed} == {"sliding factor"}


def test_a_difference_of_little_is_not_rounded_to_nothing():
    # 0.9 x 60 / 40.5 against 4/3: a friction a little less than what 2.0 takes, 1.35
    result = heeltoe.statics(dam(crack={"friction": 1.3499}))
    assert "1.9999 is 0.0001 below the 2.00" in str(check(result, "usual", "sliding factor").sentence)
    assert check(heeltoe.statics(dam(crack={"friction": 1.35})), "usual", "sliding factor").met


def test_a_crack_that_goes_through():
    slim = {"polygon": [["0 m", "0 m"], ["50 m", "0 m"], ["0 m", "100 m"]]}
    result = heeltoe.statics(dam("100 m", section=slim))
    outcome = only(result, "usual")
    # Full pressure on all of the base: N = 60 - 50, about the heel 60 x 50/3 + 50 x 100/3 - 50 x 25 = 1416.6667
    assert outcome.outcome == "cracks through"
    assert outcome.sliding_factor == pytest.approx(0.9 * 10.0 / 50.0, **CLOSE)
    assert outcome.resultant_from_heel_m == pytest.approx(141.66667, **CLOSE)
    assert outcome.heel_stress_pa is outcome.toe_stress_pa is None
    assert str(check(result, "usual", "equilibrium").sentence) == (
        "usual: the crack opens through from the heel; the resultant is 91.67 m beyond the toe"
    )
    assert not check(result, "usual", "equilibrium").met
    assert not check(result, "usual", "resultant").met
    strong = heeltoe.statics(dam("100 m", section=slim, statics={"compressive_strength": "20 MPa"}))
    assert "no stress to compare" in str(check(strong, "usual", "compression").sentence)


def test_a_block_that_floats():
    result = heeltoe.statics(dam("100 m", uplift={"pattern": "uniform"}, concrete={"density": "1900 kg/m^3"}))
    outcome = only(result, "usual")
    assert outcome.outcome == "floats"
    assert (outcome.sliding_factor, outcome.resultant_from_heel_m) == (0.0, None)
    # W = 76 under U = 80
    assert str(check(result, "usual", "equilibrium").sentence) == (
        "usual: the water lifts the block with 4000 kN/m more than holds it down"
    )
    assert "floats" in str(check(result, "usual", "resultant").sentence)


def test_a_block_that_has_slid_off_its_crack():
    result = heeltoe.statics(dam(), 80.0)
    assert [item.name for item in result.cases] == ["usual"]
    assert str(result.checks[-1].sentence) == (
        "post-seismic: a slip of 80.00 m leaves nothing of the 80.00 m that the block stood on"
    )
    assert not result.ok


def test_a_slip_that_nobody_knows_is_said_to_be_zero():
    result = heeltoe.statics(dam(statics={"residual_friction": 0.8}))
    assert result.slip_m == 0.0
    assert any("no slip is given" in text for text in map(str, result.warnings))
    given_ = heeltoe.statics(dam(statics={"residual_friction": 0.8}), 0.1)
    assert (given_.slip_source, given_.warnings) == ("given", ())


def test_a_crack_that_the_usual_loads_open_is_warned_about():
    assert "open the crack by 32.50 m" in str(heeltoe.statics(dam("100 m")).warnings[0])
    assert heeltoe.statics(dam()).warnings == ()


def test_water_as_deep_on_both_sides_pushes_nothing():
    # Faces of several edges, whose pressures sum up to the same but for rounding.
    corners = [(0.0, 0.0), (15.3, 0.0), (9.18, 8.35), (6.12, 16.7), (2.7, 16.7), (1.1, 5.9)]
    water = {"depth": "14.83 m"}
    for scale in (1.0, 1.1, 1.3, 1.7):
        case = heeltoe.read_case(
            {
                "section": {"polygon": [[f"{scale * x!r} m", f"{scale * z!r} m"] for x, z in corners]},
                "crack": {"friction": 0.8},
                "reservoir": water,
                "tailwater": water,
            }
        )
        assert heeltoe.build_block(case).sliding_safety_factor is None
        assert only(heeltoe.statics(case), "usual").sliding_factor is None


def test_the_earthquake_finds_no_bond_where_the_usual_loads_have_opened_the_toe():
    # Water downstream alone lifts the toe; the earthquake that closes it again does not bond it.
    case = heeltoe.read_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["10 m", "0 m"], ["8 m", "20 m"], ["1 m", "20 m"]]},
            "crack": {"friction": 0.8},
            "tailwater": {"depth": "15 m"},
            "statics": {"bonded": 0.4, "cohesion": "1 MPa", "seismic_coefficient": 0.2},
        }
    )
    result = heeltoe.statics(case)
    opened = only(result, "usual")
    assert (opened.cracked_from, opened.cracked_length_m > 1.0) == ("toe", True)
    closed = only(result, "pseudo-static downstream")
    assert closed.cracked_length_m == 0.0
    assert closed.cohesive_force_n == pytest.approx(1e6 * (4.0 - opened.cracked_length_m), rel=1e-9)


@pytest.mark.parametrize(
    ("choice", "words"),
    [
        ({"flood_depth": "30 m"}, "the flood is lower than the"),
        ({"residual_friction": 1.7}, "more than the friction of the crack before"),
    ],
)
def test_choices_that_hardly_can_be_meant(choice, words):
    assert any(words in text for text in map(str, heeltoe.statics(dam(statics=choice), 0.0).warnings))


def test_anchors_that_gain_by_slip_are_warned_about():
    anchor = {"distance": "10 m", "prestress": "1 MN/m", "shear_stiffness": "10 MN/m/m"}
    result = heeltoe.statics(dam(anchors=[anchor]), 0.1)
    assert any(
        text.startswith("anchors: the static checks count their prestress") for text in map(str, result.warnings)
    )
    assert any("prestress" in text for text in map(str, only(result, "post-seismic").assumptions))


# Criteria


def test_every_row_names_its_paragraph():
    for rows in CRITERIA.values():
        for row in rows:
            assert row.document
            assert row.paragraph
            assert row.required > 0.0
            assert row.note


def criteria_lines(name):
    """Return the rows of a table of docs/statics.md, whose heading names the first document."""
    groups, first = {}, CRITERIA[name][0].document
    for row in CRITERIA[name]:
        cohesion = {True: "with cohesion", False: "without cohesion", None: None}[row.cohesion]
        kind = ", ".join(text for text in (row.structure, row.site_information, cohesion) if text) or "all"
        source = row.paragraph if row.document == first else row.source
        groups.setdefault((row.check, kind, source), {})[row.loads] = row.required
    for (check_, kind, source), values in groups.items():
        cells = [f"{values[item]:.3g}" if item in values else "-" for item in LOADS]
        yield f"| {check_} | {kind} | {' | '.join(cells)} | {source} |"


LOADS = ("usual", "unusual", "extreme", "earthquake", "post-earthquake")


@pytest.mark.parametrize("name", list(CRITERIA))
def test_the_documentation_has_the_tables(name):
    text = (ROOT / "docs" / "statics.md").read_text()
    for line in criteria_lines(name):
        assert line in text


@pytest.mark.parametrize(
    ("name", "loads", "choice", "factor"),
    [
        ("USACE", "usual", {}, 2.0),
        ("USACE", "unusual", {}, 1.7),
        ("USACE", "earthquake", {}, 1.3),
        ("USACE", "usual", {"site_information": "well defined"}, 1.7),
        ("USACE", "extreme", {"structure": "normal"}, 1.1),
        ("USACE", "usual", {"structure": "normal", "site_information": "limited"}, 3.0),
        ("USBR", "usual", {"cohesion": True}, 3.0),
        ("USBR", "earthquake", {}, 1.0),
        ("FERC", "usual", {}, 1.5),
        ("FERC", "usual", {"cohesion": True}, 3.0),
        ("FERC", "unusual", {"cohesion": True, "structure": "normal"}, 1.25),
        ("FERC", "post-earthquake", {}, 1.3),
        ("CDA", "usual", {}, 1.5),
        ("CDA", "usual", {"cohesion": True}, 3.0),
        ("CDA", "unusual", {"cohesion": True, "site_information": "well defined"}, 1.5),
        ("CDA", "earthquake", {}, 1.0),
        ("CDA", "post-earthquake", {}, 1.1),
    ],
)
def test_required_sliding_factors(name, loads, choice, factor):
    rows = [row for row in chosen(CRITERIA[name], loads, **choice) if row.check == "sliding"]
    assert [row.required for row in rows] == [factor]


def test_every_choice_has_one_sliding_factor():
    for name in CRITERIA:
        for loads in ("usual", "unusual", "extreme", "earthquake", "post-earthquake"):
            for structure in ("critical", "normal"):
                for information in ("well defined", "ordinary", "limited"):
                    for cohesion in (False, True):
                        rows = chosen(
                            CRITERIA[name], loads, cohesion=cohesion, structure=structure, site_information=information
                        )
                        count = sum(row.check == "sliding" for row in rows)
                        refused = name == "USACE" and structure == "critical" and information == "limited"
                        none = refused or (name == "FERC" and loads == "earthquake")
                        assert count == (0 if none else 1), (name, loads, structure, information, cohesion)


def test_cohesion_is_judged_by_its_own_factors():
    bonded = {"criteria": "FERC", "bonded": 0.5, "cohesion": "0.5 MPa"}
    with_, without = heeltoe.statics(dam(statics=bonded)), heeltoe.statics(dam(statics={"criteria": "FERC"}))
    assert check(with_, "usual", "sliding factor").required == 3.0
    assert check(without, "usual", "sliding factor").required == 1.5
    # After the earthquake the cohesion is gone, and so are its factors.
    after = heeltoe.statics(dam(statics=bonded), 0.1)
    assert check(after, "post-seismic", "sliding factor").source.endswith("table 2A")


def test_an_extreme_flood():
    choice = {"flood_depth": "95 m", "flood_rarity": "extreme"}
    assert check(heeltoe.statics(dam(statics=choice)), "flood", "sliding factor").required == 1.3


# Faces


EACH = [("USACE", path) for path in ALL_EXAMPLES] + [(name, BASE) for name in CRITERIA if name != "USACE"]
ALL = [(name, path) for name in CRITERIA for path in ALL_EXAMPLES]


@pytest.mark.parametrize(
    ("name", "example"),
    [
        pytest.param(*pair, marks=() if pair in EACH else pytest.mark.slow, id=f"{pair[0]}-{pair[1].stem}")
        for pair in ALL
    ],
)
def test_examples(example, name):
    case = read_case(example, [f"statics.criteria={name}", "statics.seismic_coefficient=0.1"])
    result = heeltoe.statics(case, 0.05)
    data = result.to_json()
    flood = [] if case.statics.flood_depth is None else ["flood"]
    assert [item["name"] for item in data["cases"]] == [
        "usual",
        *flood,
        "pseudo-static downstream",
        "pseudo-static upstream",
        "post-seismic",
    ]
    assert all(item["sentence"].startswith(item["load_case"]) for item in data["checks"])
    numbers = json.dumps(data, allow_nan=True)
    assert "NaN" not in numbers
    assert result.references


def test_the_command():
    shown = command(
        "statics",
        BASE,
        "--slip",
        "0.15m",
        "--criteria",
        "CDA",
        "--set",
        "statics.seismic_coefficient=0.1",
        "--details",
    )
    assert shown.returncode == 0, shown.stderr
    seen = " ".join(shown.stdout.split())
    for words in ("CDA", "sliding factor", "post-seismic", "150.0 mm", "--slip", "Verdict", "fail"):
        assert words in seen, words


def test_the_command_runs_the_rigid_model_for_the_slip():
    shown = command("statics", BLOCK, "--json", "-")
    assert shown.returncode == 0, shown.stderr
    data = json.loads(shown.stdout)
    assert data["slip_m"] == pytest.approx(-0.012 * 9.80665, rel=1e-9)
    assert data["slip_source"].startswith("rigid model, ")
    assert data["cases"][-1]["contact_from_m"] == pytest.approx(0.012 * 9.80665, rel=1e-9)
    assert "Verdict" in shown.stderr


def test_the_command_says_when_the_rigid_model_has_no_slip():
    shown = command("statics", BLOCK, "--set", "reservoir.depth=1m", "--json", "-")
    assert shown.returncode == 0, shown.stderr
    assert "unstable" in json.loads(shown.stdout)["slip_source"]


def test_an_overturned_block_does_not_stand_after_the_earthquake():
    pulse = 'motion.points=[["0 s", "-1 g"], ["1 s", "-1 g"], ["1 s", "0 g"], ["6 s", "0 g"]]'
    shown = command("statics", SLENDER, "--set", pulse, "--json", "-")
    assert shown.returncode == 0, shown.stderr
    data = json.loads(shown.stdout)
    assert "post-seismic" not in [item["name"] for item in data["cases"]]
    assert data["checks"][-1]["sentence"] == (
        "post-seismic: the earthquake overturns the block about its toe: nothing stands after it"
    )
    assert not data["ok"]
    assert "nothing stands after it" in shown.stderr


def test_a_slip_that_has_not_ended_is_said_to_go_on():
    shown = command("statics", BLOCK, "--set", "motion.duration=0.15s", "--set", ENDS, "--json", "-")
    assert json.loads(shown.stdout)["slip_source"].endswith(", still moving when the run ends")


def test_the_command_refuses_what_it_does_not_know():
    shown = command("statics", BLOCK, "--criteria", "ICOLD")
    assert shown.returncode == 2
    assert 'statics.criteria: "ICOLD" is not a choice' in shown.stderr
