"""Random dams beside a second program for static checks, :mod:`shared.static_twin`: all patterns of uplift, all three
rules of the water in an earthquake, both signs of the vertical coefficient."""

from __future__ import annotations

import itertools
import math
import random
from typing import Any

import pytest

import heeltoe
from heeltoe import read_case
from shared.attack_page import CASES, SEED
from shared.attacked import Attack
from shared.every_field import Fields
from shared.static_twin import Stand, Wall, Water, stand

GRAVITY, WATER = 9.80665, 1000.0
CLOSE = 1e-8
QUAKES = {
    f"pseudo-static {way}, {vertical}": (along, up)
    for way, along in (("downstream", 1.0), ("upstream", -1.0))
    for vertical, up in (("lifting", 1.0), ("pressing", -1.0))
}


def random_dam(draw: random.Random) -> dict[str, Any]:
    """Return the numbers of a dam, SI, its crack level."""
    height = draw.uniform(10.0, 150.0)
    crack = height * draw.choice((0.0, 0.0, draw.uniform(0.1, 0.6)))
    crest, base, neck = (
        height * draw.uniform(0.04, 0.12),
        height * draw.uniform(0.5, 1.0),
        height * draw.uniform(0.7, 0.95),
    )
    batter = draw.choice((0.0, draw.uniform(0.02, 0.2)))
    shaken = batter == 0.0
    pattern = draw.choice(("none", "uniform", "triangular", "cut-off", "drained", "profile"))
    uplift: Fields = {"pattern": pattern, "intensity": draw.choice((1.0, 1.0, 0.6, 1.2))}
    if pattern == "cut-off":
        uplift["extent"] = draw.uniform(0.1, 0.95)
    elif pattern == "drained":
        uplift |= {"drain_position": draw.uniform(0.03, 0.4), "drain_efficiency": draw.uniform(0.0, 1.0)}
    elif pattern == "profile":
        heads = sorted((draw.uniform(0.0, 0.9) * height for _ in range(4)), reverse=True)
        uplift["heads"] = list(zip((0.0, draw.uniform(0.05, 0.4), draw.uniform(0.5, 0.9), 1.0), heads, strict=True))
    return {
        "height": height,
        "crack": crack,
        "corners": [
            (0.0, 0.0),
            (base, 0.0),
            (batter * height + crest, neck),
            (batter * height + crest, height),
            (batter * height, height),
        ],
        "density": draw.uniform(2200.0, 2600.0),
        "friction": draw.uniform(0.5, 1.3),
        "depth": crack + (height - crack) * draw.uniform(0.1, 1.0),
        "tail": crack + (height - crack) * draw.uniform(0.02, 0.5) if not shaken and draw.random() < 0.7 else 0.0,
        "flood": height * draw.uniform(0.97, 1.0),
        "ice": draw.choice((0.0, draw.uniform(10e3, 400e3))),
        "uplift": uplift,
        "quake": (draw.uniform(0.05, 0.5), draw.uniform(0.02, 0.3)) if shaken else None,
        "rule": draw.choice(("unchanged", "zero", "full")),
    }


def surely(outcome: str, draw: random.Random) -> dict[str, Any]:
    """Return a random dam that ends so under its usual loads, whatever else is drawn."""
    dam = random_dam(draw) | {"crack": 0.0, "tail": 0.0, "ice": 0.0}
    height, base = dam["height"], dam["corners"][1][0]
    if outcome == "stands":  # nearly dry
        return dam | {"uplift": {"pattern": "none"}, "depth": 0.02 * height}
    dam["depth"] = height
    if outcome == "cracks through":
        # Overturned: its weight has at most 2.6 x 0.2 x 0.2 = 0.10 of moment about the toe, the water 1/6.
        crest = 0.1 * height
        corners = [(0.0, 0.0), (0.2 * height, 0.0), (crest, 0.8 * height), (crest, height), (0.0, height)]
        return dam | {"corners": corners, "uplift": {"pattern": "none"}}
    # Lifted by more than its weight and the water on its face.
    wall, _ = wall_of(dam)
    unit = WATER * GRAVITY
    _, pressing, _ = wall.pressed(wall.upstream, lambda z: unit * (height - z), height, 1.0)
    least = (wall.weight()[0] - pressing) / (unit * height * base)
    return dam | {"uplift": {"pattern": "uniform", "intensity": draw.uniform(1.01, 1.5) * least}}


def case_of(dam: dict[str, Any]) -> heeltoe.Case:
    """Return the case of a dam, for heeltoe."""
    uplift = {name: value for name, value in dam["uplift"].items() if name != "heads"}
    if "heads" in dam["uplift"]:
        uplift["points"] = [[share, f"{head!r} m"] for share, head in dam["uplift"]["heads"]]
    statics: Fields = {"flood_depth": f"{dam['flood']!r} m"}
    if dam["tail"]:
        statics["flood_tailwater"] = f"{dam['tail']!r} m"
    if dam["quake"]:
        names = ("seismic_coefficient", "vertical_seismic_coefficient")
        statics |= dict(zip(names, dam["quake"], strict=True)) | {"uplift_in_earthquake": dam["rule"]}
    fields: Fields = {
        "section": {"polygon": [[f"{x!r} m", f"{z!r} m"] for x, z in dam["corners"]]},
        "concrete": {"density": f"{dam['density']!r} kg/m^3"},
        "crack": {"elevation": f"{dam['crack']!r} m", "friction": dam["friction"]},
        "reservoir": {"depth": f"{dam['depth']!r} m"},
        "uplift": uplift,
        "statics": statics,
    }
    if dam["tail"]:
        fields["tailwater"] = {"depth": f"{dam['tail']!r} m"}
    if dam["ice"] and dam["depth"] - 0.3 > dam["crack"]:
        fields["ice"] = {"force": f"{dam['ice']!r} N/m"}
    return read_case(fields)


def wall_of(dam: dict[str, Any]) -> tuple[Wall, float]:
    """Return what stands above the crack, for the twin, and x of its heel in the dam."""
    (_, _), (base, _), (shoulder, neck), (back, height), (front, _) = dam["corners"]
    crack, up, down = dam["crack"], [(0.0, 0.0), (height, front)], [(0.0, base), (neck, shoulder), (height, back)]

    def above(face: list[tuple[float, float]]) -> list[tuple[float, float]]:
        for (low, x0), (high, x1) in itertools.pairwise(face):
            if low <= crack < high:
                first = (crack, x0 + (x1 - x0) * (crack - low) / (high - low))
                return [first, *(corner for corner in face if corner[0] > crack)]
        raise AssertionError

    upstream, downstream = above(up), above(down)
    heel = upstream[0][1]
    faces = (tuple((z - crack, x - heel) for z, x in face) for face in (upstream, downstream))
    return Wall(*faces, density=dam["density"], gravity=GRAVITY), heel


def twin(dam: dict[str, Any]) -> dict[str, tuple[Stand, float]]:
    """Return how the block stands under each load case, and the force along the crack."""
    wall, _ = wall_of(dam)
    unit = WATER * GRAVITY
    weight, x, z = wall.weight()
    own = (0.0, -weight, -weight * x)

    def still(depth: float, tail: float, ice: float) -> tuple[tuple[float, float, float], Water]:
        surface, back = max(0.0, depth - dam["crack"]), max(0.0, tail - dam["crack"])
        forces = [
            own,
            wall.pressed(wall.upstream, lambda z: unit * (surface - z), surface, 1.0),
            wall.pressed(wall.downstream, lambda z: unit * (back - z), back, -1.0),
        ]
        level = surface - 0.3
        if ice and level > 0.0:
            forces.append((ice, 0.0, -level * ice))
        total = tuple(math.fsum(force[k] for force in forces) for k in range(3))
        return total, Water(unit * surface, unit * back, dam["uplift"], wall.base, unit)

    stands: dict[str, tuple[Stand, float]] = {}
    loads, water = still(dam["depth"], dam["tail"], dam["ice"])
    bends = [place for place, _ in water.points()]
    usual = stand(wall.base, loads, water.open, bends)
    stands["usual"] = usual, loads[0]
    flood, high = still(dam["flood"], dam["tail"], 0.0)
    stands["flood"] = stand(wall.base, flood, high.open, bends), flood[0]
    if dam["quake"] is None:
        return stands
    shake, lift = dam["quake"]
    before = water.open(usual.from_heel, usual.from_toe)
    depth, surface = dam["depth"], dam["depth"] - dam["crack"]
    # Westergaard: 7/8 of the square root of the whole depth times the depth below the surface.
    westergaard = (
        wall.pressed(wall.upstream, lambda z: 0.0, surface, 1.0) if surface <= 0.0 else _westergaard(depth, surface)
    )
    for name, (along, up) in QUAKES.items():
        inertia = (along * shake * weight, up * lift * weight)
        forces = (
            loads,
            (*inertia, x * inertia[1] - z * inertia[0]),
            tuple(along * shake * value for value in westergaard),
        )
        total = tuple(math.fsum(force[k] for force in forces) for k in range(3))

        def opened(from_heel: float, from_toe: float) -> list[tuple[float, float]]:
            old = usual.from_heel, usual.from_toe
            further = from_heel > old[0] or from_toe > old[1]
            if dam["rule"] == "unchanged" or not further or sum(old) >= wall.base:
                return before
            if dam["rule"] == "full":
                return water.open(max(from_heel, old[0]), max(from_toe, old[1]))
            low, end = (old[0], from_heel) if from_heel > old[0] else (wall.base - from_toe, wall.base - old[1])
            return _emptied(before, low, end)

        stands[name] = stand(wall.base, total, opened, [*bends, *(place for place, _ in before)]), total[0]
    return stands


def _westergaard(depth: float, surface: float) -> tuple[float, float, float]:
    """Return force and moment about the heel for an acceleration of one g, in closed form: the pressure is
    7/8 rho g sqrt(D y), y the depth below the surface, down to the crack."""
    pressure = 7.0 / 8.0 * WATER * GRAVITY * math.sqrt(depth)
    force = pressure * surface**1.5 / 1.5
    # At 3/5 of the way down from the surface.
    return force, 0.0, -0.4 * surface * force


def _emptied(points: list[tuple[float, float]], low: float, high: float) -> list[tuple[float, float]]:
    """Return pressures without those between two places."""
    from shared.static_twin import _at

    kept = [point for point in points if point[0] <= low]
    if kept[-1][0] < low:
        kept.append((low, _at(points, low, -1)))
    rest = [point for point in points if point[0] >= high]
    if not rest or rest[0][0] > high:
        rest = [(high, _at(points, high, 1)), *rest]
    return [*kept, (low, 0.0), (high, 0.0), *rest]


def compare(dam: dict[str, Any]) -> list[str]:
    """Return where heeltoe and the twin differ."""
    ours = {case.name: case for case in heeltoe.statics(case_of(dam)).cases}
    wrong = []
    for name, (theirs, along) in twin(dam).items():
        own = ours[name]
        scale = max(abs(force.vertical) for force in own.forces)
        base = own.contact_width_m
        pairs = [("shear", own.shear_force_n, along, scale), ("normal", own.normal_force_n, theirs.normal, scale)]
        if own.outcome != theirs.outcome:
            wrong.append(f"{name}: {own.outcome}, the twin {theirs.outcome}")
            continue
        if own.outcome == "stands":
            pairs += [
                ("cracked", own.cracked_length_m, theirs.from_heel + theirs.from_toe, base),
                ("resultant", own.resultant_from_heel_m, theirs.position, base),
                ("heel", own.heel_stress_pa, theirs.heel_stress, scale / base),
                ("toe", own.toe_stress_pa, theirs.toe_stress, scale / base),
            ]
        wrong += [f"{name}, {what}: {a!r}, the twin {b!r}" for what, a, b, size in pairs if abs(a - b) > CLOSE * size]
    return wrong


OUTCOMES = ("stands", "cracks through", "floats")


def attack(seeds: range, record_property: Any) -> None:
    """Compare random dams, and first one of each outcome."""
    twins, first = Attack("static twins, load cases"), seeds[0]
    dams = {
        f"surely({outcome!r}, random.Random({first}))": surely(outcome, random.Random(first)) for outcome in OUTCOMES
    }
    usual = [twin(dam)["usual"][0].outcome for dam in dams.values()]
    assert usual == list(OUTCOMES)
    dams |= {f"random_dam(random.Random({seed}))": random_dam(random.Random(seed)) for seed in seeds}
    for name, dam in dams.items():
        differences, count = compare(dam), len(twin(dam))
        twins.ends["defect"] += min(len(differences), count)
        twins.ends["accepted"] += count - min(len(differences), count)
        twins.defects += [f"{name}, {dam['uplift']}, {dam['rule']}: {difference}" for difference in differences]
    twins.report(record_property)


def test_some_static_twins(record_property):
    attack(range(36_000, 36_006), record_property)


@pytest.mark.product
def test_static_twins(record_property):
    first = SEED * 1_000_000 + 950_000
    attack(range(first, first + max(50, CASES // 10)), record_property)


@pytest.mark.product
@pytest.mark.parametrize("outcome", OUTCOMES)
def test_dams_of_each_outcome(outcome):
    for seed in range(20):
        assert twin(surely(outcome, random.Random(seed)))["usual"][0].outcome == outcome
