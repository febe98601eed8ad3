"""Decks for other programs: sums of loads and masses are closed forms, faces meet, and what differs is named."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import InputError, read_case
from heeltoe.models.flexible.deck import build_deck
from heeltoe.models.run import earthquake
from shared.dams import BASE, COARSE, EXAMPLES, HEIGHT

GRAVITY = 9.80665
# Dam of 100 m, full reservoir: area [m2], density [kg/m3].
AREA, DENSITY = 8.0 * 10.0 + (80.0 + 8.0) / 2.0 * 90.0, 2650.0


@pytest.fixture(scope="module", params=[BASE, HEIGHT], ids=["base", "height"])
def deck(request):
    case = read_case(request.param, [*COARSE, "reservoir.depth=100 m"])
    return build_deck(case, earthquake(case))


def test_loads_and_masses_are_closed_forms(deck):
    water = 1000.0 * GRAVITY * 100.0**2 / 2.0
    # Uplift of a crack above the base is between the two parts.
    uplift = 1000.0 * GRAVITY * 100.0 * 80.0 / 2.0 if len(deck.parts) == 1 else 0.0
    assert deck.resultant == pytest.approx((water, uplift - AREA * DENSITY * GRAVITY), rel=1e-9)
    assert deck.concrete_masses.sum(axis=0) == pytest.approx([AREA * DENSITY] * 2, rel=1e-9)
    # Westergaard's 7/8 rho sqrt(H y) over the height, along x alone before an upright face.
    added = 7.0 / 12.0 * 1000.0 * 100.0**2
    assert deck.water_masses.sum(axis=0) == pytest.approx([added, 0.0], rel=1e-9)
    assert deck.along_x.sum(axis=0) == pytest.approx([-AREA * DENSITY - added, 0.0], rel=1e-9)
    assert deck.along_y.sum(axis=0) == pytest.approx([0.0, -AREA * DENSITY], rel=1e-9)
    elements = np.unique(np.concatenate([part.elements.reshape(-1) for part in deck.parts]))
    assert deck.masses[elements].min() > 0.0
    assert not deck.masses[deck.ground].any()


def test_faces_meet_along_the_crack(deck):
    (crack,) = deck.cracks
    assert deck.nodes[crack.upper] == pytest.approx(deck.nodes[crack.lower], abs=1e-9)
    heel, toe = deck.nodes[crack.upper[[0, -1]]]
    assert crack.lengths.sum() == pytest.approx(np.hypot(*(toe - heel)), rel=1e-12)
    assert (crack.normal, crack.along, crack.friction) == ((0.0, 1.0), (1.0, 0.0), 1.0)
    held = set(deck.held.tolist())
    grounded = len(deck.parts) == 1
    assert held.issuperset(crack.lower.tolist()) == grounded
    assert deck.ground.size == (crack.lower.size if grounded else 0)


@pytest.mark.parametrize("path", [BASE, HEIGHT])
def test_periods_come_closer_to_those_of_consistent_masses_with_finer_elements(path):
    errors = []
    for across in (4, 8):
        deck = build_deck(read_case(path, [f"flexible.elements_across={across}"]), None)
        errors.append(np.abs(deck.periods / deck.own_periods - 1.0)[:3])
    assert np.all(errors[1] < 0.5 * errors[0])
    assert errors[1].max() < 0.005


def test_what_differs_from_the_case_is_named():
    case = read_case(BASE, COARSE)
    notes = " ".join(build_deck(case, None).notes)
    for words in ("assumed rock of 20 GPa", "Sound travels", 'damping "relative"', "reversed motion"):
        assert words in notes
    plain = ["rock=rigid", "reservoir.compressible=false", "flexible.damping=stiffness", "motion.sign=recorded"]
    (note,) = build_deck(read_case(BASE, [*COARSE, *plain]), None).notes
    assert note.startswith("Masses are on the nodes")
    anchored = read_case(
        EXAMPLES / "anchored.toml", [*COARSE, "crack.kinetic_friction=0.5", "crack.static_friction=0.6"]
    )
    notes = " ".join(build_deck(anchored, None).notes)
    for words in ("Anchors of the case have a stiffness", 'Uplift is "follows opening"', "Friction at rest"):
        assert words in notes
    shaken = read_case(
        BASE, [*COARSE, 'motion.cross_valley={file="elcentro-1940-270-nga"}', "crack.band={low=0.8, high=1.1}"]
    )
    notes = " ".join(build_deck(shaken, None).notes)
    for words in ("across the valley, too", "band of frictions"):
        assert words in notes
    sloping = read_case(EXAMPLES / "pine-flat.toml", COARSE)
    assert "what couples the two" in " ".join(build_deck(sloping, None).notes)


@pytest.mark.parametrize(
    ("name", "field"),
    [("stepped-crack", "crack.kinks"), ("bonded-joint", "crack.bond"), ("rough-crack", "crack.roughness")],
)
def test_other_contact_is_refused(name, field):
    case = read_case(EXAMPLES / f"{name}.toml", COARSE)
    with pytest.raises(InputError, match=f"{field}: does not belong to an exported crack"):
        build_deck(case, None)


def test_faces_whose_nodes_do_not_meet_are_refused():
    case = read_case(HEIGHT, [*COARSE, "flexible.elements_across_below=4"])
    with pytest.raises(InputError, match=r"flexible.elements_across_below: is 9 nodes .* node by node"):
        build_deck(case, None)


def test_vertical_motion_presses_with_the_water_that_follows_it():
    points = {"points": [["0 s", "0 g"], ["0.1 s", "0.1 g"], ["0.2 s", "0 g"]]}
    shaken = {"motion": {**points, "vertical": points}, "reservoir.compressible": False}
    decks = []
    for follows in (True, False):
        changes = [*COARSE, shaken, {"reservoir.follows_vertical_motion": follows}]
        case = read_case(EXAMPLES / "pine-flat.toml", changes)
        decks.append(build_deck(case, earthquake(case)))
    pushed = decks[0].along_y - decks[1].along_y
    assert pushed == pytest.approx(decks[0].loads["reservoir"] / case.gravity, abs=1e-6)
    assert np.abs(pushed).sum() > 1e6
