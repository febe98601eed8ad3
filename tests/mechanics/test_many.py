"""Blocks from columns against the same dams one by one, and what is refused."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from heeltoe import InputError, build_block, read_case
from heeltoe.case.columns import COLUMNS
from heeltoe.case.dam import UPLIFT_OPTIONS
from heeltoe.case.paths import quantity_of
from heeltoe.kernel.block import BLOCK
from heeltoe.mechanics.many import block_columns, crack_widths, sound_blocks
from heeltoe.units.parse import DIMENSIONS
from shared.dams import ALL_EXAMPLES, EXAMPLES, TYPICAL, TYPICAL_SECTION, example, polygon
from shared.outlines import dams

ROUNDING = 1e-14
ANCHOR = {"distance": "1 m", "inclination": "10 deg", "prestress": "1 MN/m"}
# Ledges on both faces; a base that slopes; a crest that ends in a point, or has a dip.
LEDGES = [(0.0, 0.0), (60.0, 0.0), (60.0, 20.0), (45.0, 20.0), (10.0, 70.0), (2.0, 70.0), (2.0, 20.0), (0.0, 20.0)]
SLOPING = [(0.0, 0.0), (50.0, -4.0), (10.0, 66.0), (0.0, 66.0)]
POINTED = [(-5.0, 0.0), (50.0, 0.0), (4.0, 70.0), (-5.0, 20.0)]
DIPPED = [(-5.0, 0.0), (50.0, 0.0), (10.0, 60.0), (10.0, 70.0), (8.0, 70.0), (7.0, 68.0), (5.0, 70.0), (4.0, 70.0)]


def row_of(columns, row):
    """Return a row as the changes of a case, as a file has them."""
    changes = {}
    for path, values in columns.items():
        value = values[row]
        if isinstance(value, str):
            changes[path] = value
        elif not np.isnan(value):
            unit = DIMENSIONS[quantity_of(path)].unit
            changes[path] = f"{float(value)!r} {unit}" if unit else float(value)
    return changes


def sizes_of(block):
    """Return how large the terms are that the numbers of a block are sums of."""
    force = sum(abs(item.horizontal) + abs(item.vertical) for item in block.forces)
    long = max(block.width, block.section.height)
    mass, weighed = block.mass_horizontal, block.mass_horizontal + force / block.gravity
    masses, moved, followed = (np.array([item, item, item * long]) for item in (mass, mass, weighed))
    forces = np.array([force, force, force * long])
    lengths, ones, coupling = np.full(3, long), np.ones(3), masses * [1.0, long, 1.0]
    return np.concatenate([masses * [1.0, 1.0, long], lengths, forces, moved, followed, ones, coupling, [1.0]])


def compare(case, columns, piece=3):
    result = block_columns(case, columns)
    count = len(next(iter(columns.values())))
    assert result.shape == (count, len(BLOCK))
    for row, numbers in enumerate(result):
        alone = build_block(case.with_(row_of(columns, row)))
        assert np.max(np.abs(numbers - alone.parameters()) / sizes_of(alone)) < ROUNDING
        assert crack_widths(result)[row] == pytest.approx(alone.width, rel=1e-13)
    # The same bits whatever else is in the columns.
    pieces = [
        block_columns(case, {path: values[start : start + piece] for path, values in columns.items()})
        for start in range(0, count, piece)
    ]
    assert np.array_equal(result, np.concatenate(pieces))


def drawn(height, count, seed=1, **others):
    """Return columns of everything that goes with water on both sides, silt and ice."""
    rng = np.random.default_rng(seed)
    pattern = rng.choice(["none", "uniform", "triangular", "cut-off", "drained"], count)
    ranges = {
        "gravity": (9.0, 10.0),
        "concrete.density": (2200.0, 2700.0),
        "crack.friction": (0.5, 1.5),
        "crack.restitution": (0.0, 1.0),
        "reservoir.depth": (0.3 * height, height),
        "reservoir.density": (990.0, 1100.0),
        "tailwater.depth": (0.0, height),
        "tailwater.density": (990.0, 1100.0),
        "silt.depth": (0.0, height),
        "silt.horizontal_density": (300.0, 400.0),
        "silt.vertical_density": (800.0, 1000.0),
        "ice.force": (1e3, 2e5),
        "ice.depth": (0.0, 0.2),
        "uplift.intensity": (0.0, 1.2),
    }
    result = {path: rng.uniform(*ends, count) for path, ends in ranges.items()}
    for option, owner in UPLIFT_OPTIONS.items():
        if option != "points":
            result[f"uplift.{option}"] = np.where(pattern == owner, rng.uniform(0.1, 0.9, count), np.nan)
    return result | {"uplift.pattern": pattern} | others


@pytest.mark.parametrize("path", ALL_EXAMPLES, ids=lambda path: path.relative_to(EXAMPLES).as_posix())
def test_examples(path):
    case = read_case(path)
    if case.further_cracks or case.crack.kinks or case.crack.bond:
        lacking = "several cracks" if case.further_cracks else "kinks" if case.crack.kinks else "a bonded joint"
        with pytest.raises(InputError, match=f"a table of blocks does not support {lacking}"):
            block_columns(case, {"crack.friction": [0.5]})
        return
    height = case.cut.crest_elevation - case.cut.base_elevation
    columns = drawn(height, 12)
    if case.uplift.during_shaking != "constant":
        refused(case, {"uplift.pattern": ["uniform", "none"]}, 1)
        columns = {path: values for path, values in columns.items() if not path.startswith("uplift.")}
    if not case.anchors:
        columns["crack.elevation"] = np.linspace(0.0, 0.8 * height, 12)
    compare(case, columns)


@pytest.mark.parametrize("corners", [LEDGES, POINTED, DIPPED])
@pytest.mark.parametrize(("nappe", "pressure"), [("none", "westergaard"), ("weight", "zangar"), ("falling", "zangar")])
def test_water_above_the_crest_of_some_rows(corners, nappe, pressure):
    top = max(z for _, z in corners)
    above = {"depth": "1 m", "nappe": nappe, "hydrodynamic": pressure, "follows_vertical_motion": True}
    below = {"depth": "1 m", "hydrodynamic": pressure}
    fields = {"section": polygon(corners), "crack": {"friction": 1.0}, "reservoir": above, "tailwater": below}
    columns = {
        "crack.elevation": np.linspace(0.0, 0.7 * top, 9),
        "reservoir.depth": np.linspace(1.9, 0.2, 9) * top,
        "tailwater.depth": np.linspace(0.0, 1.4, 9) * top,
    }
    compare(read_case(fields), columns)


@settings(max_examples=10, deadline=None)
@given(dams(), st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.0, 4.0, -6.0]), st.booleans(), st.booleans())
def test_any_section(corners, seed, inclination, anchored, follows):
    # At any elevation, at corners, and so close to one that it counts as there.
    levels = sorted({z for _, z in corners})
    rng = np.random.default_rng(seed)
    elevations = np.append(rng.uniform(0.0, 0.7 * levels[-1], 4), [0.0, 1e-9, levels[-2], levels[-2] * (1.0 + 1e-11)])
    fields = {
        "section": polygon(corners),
        "crack": {"friction": 1.0, "inclination": f"{inclination} deg", "elevation": f"{0.4 * levels[-1]} m"},
        "reservoir": {"depth": "0.5 m", "follows_vertical_motion": follows},
        "uplift": {"pattern": "profile", "points": [[0, "20 m"], [0.3, "10 m"], [0.3, "8 m"], [1, "0 m"]]},
        "anchors": [ANCHOR | {"distance": "0 m"}] if anchored else [],
    }
    try:
        case = read_case(fields)
    except InputError:
        # Under an overhang an inclined line may not cut the section in two.
        assume(False)
    columns = drawn(levels[-1], elevations.size, seed, **{"crack.elevation": elevations})
    kept = [row for row in range(elevations.size) if stands(case, row_of(columns, row))]
    for row in set(range(elevations.size)) - set(kept):
        refused(case, {path: values[row : row + 1] for path, values in columns.items()}, 0)
    if kept:
        compare(case, {path: values[kept] for path, values in columns.items()})


def stands(case, changes):
    try:
        return bool(case.with_(changes))
    except InputError:
        return False


@pytest.mark.parametrize("corners", [LEDGES, SLOPING, POINTED, DIPPED])
def test_sections_of_odd_shapes(corners):
    crack = {"friction": 1.0, "elevation": "30 m"}
    elevations = np.array([5.0, 20.0, 20.000000005, 35.0, 5.0, 44.0, 65.0])
    case = read_case({"section": polygon(corners), "crack": crack, "anchors": [ANCHOR]})
    compare(case, drawn(70.0, elevations.size, **{"crack.elevation": elevations}))


def test_water_before_a_slope_or_beyond_the_dam_in_some_rows_alone():
    # The upstream face is vertical up to 30 m and leans back above.
    bent = [(0.0, 0.0), (60.0, 0.0), (20.0, 70.0), (12.0, 70.0), (0.0, 30.0)]
    depths = np.random.default_rng(5).uniform(0.0, 70.0, 200)
    light = {"concrete": {"density": "100 kg/m^3"}}
    case = read_case({"section": polygon(bent), "crack": {"friction": 1.0}} | light)
    compare(case, {"reservoir.depth": depths}, piece=1)
    compare(case, {"reservoir.depth": depths, "tailwater.depth": np.where(depths > 20.0, 0.0, depths[::-1])}, piece=1)


def test_a_static_friction_of_its_own():
    columns = {"crack.static_friction": [0.9, 1.2, 1.0], "crack.kinetic_friction": [0.9, 0.8, 1.0]}
    compare(example("typical-base"), columns)
    compare(example("typical-base", "crack.static_friction=1.3", "crack.kinetic_friction=0.9"), columns)
    compare(example("typical-base", "crack.static_friction=1.3", "crack.kinetic_friction=0.9"), {"crack.friction": [1]})


def test_no_water_where_the_case_has_none():
    compare(read_case({"section": TYPICAL_SECTION, "crack": {"friction": 1.0}}), {"reservoir.depth": [0.0, 40.0]})


def test_a_profile_and_no_columns():
    case = example("typical-base")
    assert np.array_equal(block_columns(case, {}), [build_block(case).parameters()])
    assert block_columns(case, {"crack.friction": []}).shape == (0, len(BLOCK))


def refused(case, columns, row):
    """Check that a row is refused as it is alone."""
    with pytest.raises(InputError) as alone:
        case.with_(row_of(columns, row))
    with pytest.raises(InputError) as among:
        block_columns(case, columns)
    assert str(among.value) == str(alone.value)


@pytest.mark.parametrize(
    ("columns", "row"),
    [
        ({"crack.friction": [1.0, 11.0, -1.0]}, 1),
        ({"crack.friction": [1.0, float("inf")]}, 1),
        ({"crack.static_friction": [1.0, 0.7], "crack.kinetic_friction": [0.8, 0.8]}, 1),
        ({"crack.friction": [1.0], "crack.static_friction": [1.0]}, 0),
        ({"crack.static_friction": [1.0]}, 0),
        ({"crack.restitution": [0.0, 1.0, 1.0000001]}, 2),
        ({"crack.elevation": [10.0, 99.0, 100.0, 120.0]}, 2),
        ({"crack.elevation": [10.0, -1.0]}, 1),
        ({"concrete.density": [2400.0, 24.0]}, 1),
        ({"reservoir.depth": [110.0, 201.0, 202.0]}, 1),
        ({"tailwater.depth": [10.0, 110.0, 201.0]}, 2),
        ({"silt.depth": [10.0, 101.0]}, 1),
        ({"reservoir.depth": [10.0, 0.2], "ice.force": [1e3, 1e3]}, 1),
        ({"gravity": [9.81, 0.0]}, 1),
        ({"uplift.pattern": ["none", "triangular", "drain"]}, 2),
        ({"uplift.pattern": ["none", "drained"]}, 1),
        ({"uplift.pattern": ["drained", "none"], "uplift.drain_position": [0.1, 0.1]}, 0),
        ({"uplift.drain_efficiency": [float("nan"), 0.5]}, 1),
        # Of several patterns the row that comes first, not the pattern.
        ({"uplift.pattern": ["uniform", "none", "triangular"], "crack.friction": [1.0, 1.0, 20.0]}, 2),
        ({"uplift.pattern": ["uniform", "none", "triangular"], "crack.friction": [1.0, 12.0, 20.0]}, 1),
        ({"uplift.pattern": ["uniform", "none", "none"], "crack.friction": [30.0, 12.0, 20.0]}, 0),
    ],
    ids=str,
)
def test_the_first_row_that_is_no_case_is_refused_as_it_is_alone(columns, row):
    refused(read_case({"section": polygon(TYPICAL), "crack": {"friction": 1.0}}), columns, row)


def test_anchors_beyond_the_toe_of_a_crack_at_a_height():
    case = read_case(
        {"section": polygon(TYPICAL), "crack": {"friction": 1.0}, "anchors": [ANCHOR | {"distance": "50 m"}]}
    )
    refused(case, {"crack.elevation": [0.0, 30.0, 60.0]}, 2)


def test_a_ledge_that_leaves_no_crack():
    case = read_case({"section": polygon(LEDGES), "crack": {"friction": 1.0}})
    refused(case, {"crack.elevation": [10.0, 70.0]}, 1)


def test_rows_that_are_no_cases_are_left_out_where_that_is_asked_for():
    rng = np.random.default_rng(3)
    columns = {
        "crack.static_friction": rng.uniform(0.7, 1.2, 60),
        "crack.kinetic_friction": rng.uniform(0.5, 1.0, 60),
        "reservoir.depth": rng.uniform(-2.0, 110.0, 60),
        "crack.elevation": rng.uniform(0.0, 105.0, 60),
        "uplift.pattern": rng.choice(["none", "uniform", "triangular", "drained"], 60),
        "uplift.drain_position": np.where(rng.random(60) < 0.5, 0.1, np.nan),
        "uplift.drain_efficiency": np.full(60, np.nan),
    }
    columns["uplift.drain_efficiency"][columns["uplift.pattern"] == "drained"] = 0.5
    case = read_case({"section": polygon(TYPICAL), "crack": {"friction": 1.0}})
    alone = [stands(case, row_of(columns, row)) for row in range(60)]
    assert 5 < sum(alone) < 30
    numbers, sound = sound_blocks(case, columns)
    assert sound.tolist() == alone
    assert np.isnan(numbers[~sound]).all()
    assert np.array_equal(numbers[sound], block_columns(case, {path: each[sound] for path, each in columns.items()}))


@pytest.mark.parametrize("columns", [{"silt.depth": [1.0, 2.0]}, {"crack.static_friction": [1.0, 2.0]}])
def test_of_what_stands_in_no_row_there_is_no_block(columns):
    numbers, sound = sound_blocks(read_case({"section": TYPICAL_SECTION, "crack": {"friction": 1.0}}), columns)
    assert (sound.any(), numbers.shape) == (False, (2, len(BLOCK)))


def test_a_ledge_that_leaves_no_crack_at_some_height():
    # A spur of the upstream face that ends in the air.
    spur = [(0.0, 0.0), (60.0, 0.0), (10.0, 70.0), (0.0, 70.0), (0.0, 40.0), (-5.0, 30.0), (-5.0, 50.0), (-8.0, 50.0)]
    spur += [(-8.0, 25.0), (0.0, 25.0)]
    case = read_case({"section": polygon(spur), "crack": {"friction": 1.0}})
    elevations = np.array([10.0, 35.0, 60.0, 45.0])
    alone = [stands(case, {"crack.elevation": f"{elevation} m"}) for elevation in elevations]
    assert alone == [True, False, True, False]
    assert sound_blocks(case, {"crack.elevation": elevations})[1].tolist() == alone
    refused(case, {"crack.elevation": elevations}, 1)


@pytest.mark.parametrize(
    ("columns", "said"),
    [
        ({"section.height": [90.0]}, "section.height: cannot be a column; give single cases"),
        ({"crack.friction": [1.0, 2.0], "reservoir.depth": [3.0]}, "reservoir.depth: 1 for 2 blocks"),
        ({"crack.friction": 1.0}, "crack.friction: one number for 1 blocks"),
        ({"crack.friction": [[1.0], [2.0]]}, "crack.friction: 2 x 1 for 2 blocks"),
        (
            {"reservoir.depth": ["90 m"]},
            'reservoir.depth: ["90 m"] is of the wrong type; give a column of numbers in SI',
        ),
    ],
)
def test_what_is_no_column(columns, said):
    with pytest.raises(InputError) as result:
        block_columns(example("typical-base"), columns)
    assert str(result.value).startswith(said)


def test_columns_are_fields_with_quantities():
    assert [path for path in COLUMNS if quantity_of(path) is None] == ["uplift.pattern"]
