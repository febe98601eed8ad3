"""Water above the crest against forces by hand: trapezoids on the faces, the nappe on the crest."""

from __future__ import annotations

import math

import numpy as np
import pytest

import heeltoe
from heeltoe import InputError, read_case
from heeltoe.mechanics import loads
from heeltoe.mechanics.virtual_water import virtual_mass
from shared.outlines import make

# 4 m of crest, 10 m of height, 7 m of base; upstream vertical; water 12 m deep: 2 m above the crest.
WALL = [(0.0, 0.0), (7.0, 0.0), (4.0, 10.0), (0.0, 10.0)]
G = 9.80665


def wall(elevation=0.0, **more):
    return make(WALL, elevation, **({"reservoir": {"depth": "12 m"}} | more))


@pytest.mark.parametrize("elevation", [0.0, 4.0])
def test_the_upstream_face_feels_a_trapezoid(elevation):
    force = loads.reservoir_pressure(wall(elevation))
    height = 10.0 - elevation
    low, high = 1000 * G * (12.0 - elevation), 1000 * G * 2.0
    assert force.horizontal == pytest.approx((low + high) / 2.0 * height)
    # A rectangle at half the height and a triangle at a third of it
    assert -force.moment == pytest.approx(high * height**2 / 2.0 + (low - high) * height**2 / 6.0)
    assert force.vertical == 0.0


def test_tailwater_above_the_crest_feels_a_trapezoid_and_weighs_on_the_slope():
    force = loads.tailwater_pressure(wall(tailwater={"depth": "11 m"}))
    assert force.horizontal == pytest.approx(-1000 * G * (11.0 + 1.0) / 2.0 * 10.0)
    # Between the slope and the surface, from the toe to the crest's end: 3 m wide, 11 m deep to 1 m.
    assert force.vertical == pytest.approx(-1000 * G * 3.0 * 6.0)


@pytest.mark.parametrize(
    ("nappe", "weight", "arm"),
    [("none", 0.0, None), ("weight", 2.0 * 4.0, 2.0), ("falling", 2.0 * 4.0 / 2.0, 4.0 / 3.0)],
)
def test_the_nappe(nappe, weight, arm):
    case = wall(reservoir={"depth": "12 m", "nappe": nappe})
    force = loads.nappe(case)
    assert force.vertical == pytest.approx(-1000 * G * weight)
    assert force.horizontal == 0.0
    assert ("nappe" in [static_force.name for static_force in loads.static_forces(case)]) == (nappe != "none")
    if arm is not None:
        assert force.moment == pytest.approx(arm * force.vertical)
        assert force.lift_moment == force.moment
        assert force.virial == pytest.approx(10.0 * force.vertical)


def test_there_is_no_nappe_up_to_the_crest():
    case = wall(reservoir={"depth": "10 m", "nappe": "weight"})
    assert "nappe" not in [static_force.name for static_force in loads.static_forces(case)]
    assert loads.nappe(case).vertical == 0.0


@pytest.mark.parametrize("elevation", [0.0, 4.0])
def test_only_the_face_moves_water_whose_depth_is_the_whole(elevation):
    result = virtual_mass(wall(elevation))
    z = elevation + (10.0 - elevation) * (np.arange(200_000) + 0.5) / 200_000
    strip = 7 / 8 * 1000 * np.sqrt(12.0 * (12.0 - z)) * (10.0 - elevation) / 200_000
    assert result.mass == pytest.approx(strip.sum(), rel=1e-9)
    assert result.height == pytest.approx(strip @ (z - elevation) / strip.sum(), rel=1e-9)
    assert result.inertia == pytest.approx(strip @ (z - elevation - result.height) ** 2, rel=1e-6)


def test_the_uplift_takes_the_whole_depth():
    force = loads.uplift(wall(uplift={"pattern": "triangular"}))
    assert force.vertical == pytest.approx(1000 * G * 12.0 * 7.0 / 2.0)


def test_a_flood_above_the_crest_stands_in_its_sheet():
    case = wall(reservoir={"depth": "8 m", "nappe": "falling"}, statics={"flood_depth": "12 m"})
    flood = heeltoe.statics(case).cases[1]
    lines = {line.name: line for line in flood.sheet("toe").lines}
    assert lines["nappe"].vertical_n == pytest.approx(-1000 * G * 4.0)
    assert lines["nappe"].distance_m == pytest.approx(4.0 / 3.0 - 7.0)
    assert str(lines["nappe"].source) == "2 m of water over the upstream edge of the crest, 0 m over the downstream one"
    assert str(flood.assumptions[1]) == 'the water 2 m above the crest presses on it by reservoir.nappe = "falling"'
    assert math.fsum(line.vertical_n for line in lines.values()) == pytest.approx(flood.sheet().sum.vertical_n)


def test_the_nappe_follows_the_vertical_motion_as_its_reservoir_does():
    still = {"depth": "12 m", "nappe": "weight", "follows_vertical_motion": True}
    shaken = {"seismic_coefficient": 0.1, "vertical_seismic_coefficient": 0.2}
    result = heeltoe.statics(wall(reservoir=still, statics=shaken))
    lifting = next(item for item in result.cases if item.name == "pseudo-static downstream, lifting")
    forces = {force.name: force for force in lifting.forces}
    assert forces["nappe in vertical motion"].vertical == pytest.approx(-0.2 * forces["nappe"].vertical)
    assert forces["reservoir in vertical motion"].horizontal == pytest.approx(-0.2 * forces["reservoir"].horizontal)


def test_a_reader_is_told_what_is_left_out():
    texts = [str(warning) for warning in heeltoe.statics(wall()).warnings]
    assert any("the water stands 2 m above the crest" in text and 'reservoir.nappe = "none"' in text for text in texts)


def test_a_run_takes_the_same_loads():
    still = {"motion": {"points": [["0 s", "0 g"], ["0.1 s", "0.2 g"], ["0.2 s", "0 g"]]}}
    result = {}
    for nappe in ("none", "weight"):
        case = wall(reservoir={"depth": "12 m", "nappe": nappe}, uplift={"pattern": "none"}, **still)
        result[nappe] = heeltoe.rigid(case).static["normal_force_n"]
    assert result["weight"] - result["none"] == pytest.approx(1000 * G * 8.0)


def test_ice_above_the_crest_is_refused():
    with pytest.raises(InputError) as error:
        read_case(wall(ice={"force": "100 kN/m"}).model_dump(mode="json", exclude_unset=True))
    assert str(error.value) == (
        "ice.depth: the ice acts at 11.7 m, above the crest at 10 m; leave the ice out, or lower the water"
    )
