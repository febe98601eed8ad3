"""Many runs at once are those of each block by itself, and what is no block is refused by its row."""

import numpy as np
import pytest

from heeltoe import InputError, build_block, read_case, rigid, rigid_many
from heeltoe.kernel.block import BLOCK, MODES, OUTCOMES, Limits, run_block, run_blocks
from heeltoe.kernel.shaking import Shaking
from heeltoe.motion.ground_motion import GroundMotion
from shared.dams import SLENDER, example

PUSH = GroundMotion.from_points([0.0, 1.0, 1.0, 6.0], [-5.0, -5.0, 0.0, 0.0])
UP = GroundMotion.from_points([0.0, 0.5, 1.0], [0.0, 2.0, 0.0])
DAM = build_block(example("typical-base")).parameters()


def refused(numbers=None, motions=(PUSH,), **more):
    with pytest.raises(InputError) as caught:
        rigid_many(np.tile(DAM, (3, 1)) if numbers is None else numbers, list(motions), **more)
    return str(caught.value)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("name", BLOCK)
def test_a_number_that_is_none_is_refused(name, value):
    numbers = np.tile(DAM, (3, 1))
    numbers[1, BLOCK.index(name)] = value
    assert refused(numbers).startswith(f"blocks[1].{name}: {value:g} is out of range; give a value of")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("mass_horizontal", -1.0),
        ("mass_vertical", 0.0),
        ("inertia", -1e3),
        ("toe_distance", -1e3),
        ("friction_static", -0.1),
        ("friction_kinetic", -0.1),
        ("friction_kinetic", 9.0),
        ("restitution", 1.5),
        ("restitution", -0.5),
    ],
)
def test_a_number_out_of_its_range_is_refused(name, value):
    numbers = np.tile(DAM, (3, 1))
    numbers[2, BLOCK.index(name)] = value
    assert refused(numbers).startswith(f"blocks[2].{name}: {value:g} is out of range; give a value of")


def test_what_goes_with_the_blocks_is_checked():
    assert refused(scales=[1.0, np.nan, 1.0]).startswith("scales[1]: nan is out of range")
    assert refused(scales=[[1.0, 1.0], [1.0, 1.0], [np.inf, 1.0]]).startswith("scales[2]: inf")
    assert refused(scales=[1.0]).startswith("scales: 1 for 3 blocks")
    assert refused(motion_of=[0, 0]).startswith("motion_of: 2 for 3 blocks")
    assert refused(motion_of=[0, 1, 0]).startswith("motion_of[1]: 1 is not one of the motions; give 0 to 0")
    assert refused(motion_of=[0, 0, 0.5]).startswith("motion_of[2]: 0.5")
    assert refused(motions=[]).startswith("motion_of[0]: 0 is not one of the motions; give a motion")
    assert refused(motions=["taft"]).startswith("motions[0]: str is not one of the motions")
    assert refused(np.tile(DAM[:-1], (3, 1))).startswith("blocks: 3 x 21 of float64 is not a table")
    assert refused(["a dam"]).startswith("blocks[0]: str is not a table")
    assert refused(limits=Limits(settle=np.nan)).startswith("limits.settle: nan is out of range")
    assert refused(limits=Limits(event_limit=0)).startswith("limits.event_limit: 0 is out of range")


VARYING = {
    "any rotation": ["analysis.rotation=finite", "crack.restitution=0.2"],
    "P-Delta": ["analysis.rotation=p-delta"],
    "nothing": [],
}


@pytest.mark.parametrize("made", [build_block, lambda case: case], ids=["blocks", "cases"])
def test_what_changes_as_blocks_move_is_not_left_out(made):
    cases = [read_case(SLENDER, changes) for changes in VARYING.values()]
    table = rigid_many([made(case) for case in cases], [PUSH, (PUSH, UP)], motion_of=[0, 1, 1], scales=[1.0, 0.9, 0.8])
    for row, (case, scale) in enumerate(zip(cases, (1.0, 0.9, 0.8), strict=True)):
        one = rigid(case, PUSH.scaled(scale), UP.scaled(scale) if row else None)
        assert OUTCOMES[int(table["outcome"][row])] == one.outcome
        assert table["slip"][row] == one.summary["residual_slip_m"]
        assert -table["rotation_min"][row] == one.summary["rocking_downstream_rad"]
    assert OUTCOMES[int(table["outcome"][0])] == "overturned"


def test_uplift_and_anchors_that_change_are_not_left_out():
    changes = ["uplift.during_shaking=zero while open", "motion.duration=4s"]
    case = example("koyna-top", *changes, "analysis.event_limit=50")
    anchored = case.model_copy(update={"anchors": read_case(SLENDER).anchors})
    one = rigid(case)
    table = rigid_many([case, anchored, build_block(case)], [one.motion])
    assert OUTCOMES[int(table["outcome"][0])] == one.outcome == "event limit"
    assert (table["slip"] == one.summary["residual_slip_m"]).all()


def test_threads_and_a_bar_change_no_bit():
    case = read_case(SLENDER, ["analysis.rotation=finite"])
    blocks, scales = [build_block(case)] * 5, np.linspace(0.5, 1.0, 5)
    tables = [rigid_many(blocks, [PUSH], scales=scales, threads=n, progress=n == 2) for n in (0, 1, 2)]
    assert all((item[name] == tables[0][name]).all() for item in tables for name in item)
    assert rigid_many([], [PUSH])["slip"].size == 0


def test_what_is_seen_of_a_block_changes_no_bit_of_it():
    """Rest and slides are passed over in stretches where no one looks, rest with all that is seen of it where somebody
    does."""
    time = np.linspace(0.0, 20.0, 2001)
    noise = np.random.default_rng(4).normal(size=time.size)
    shaking = Shaking(time, 4.0 * np.exp(-(((time - 8.0) / 3.0) ** 2)) * noise, np.roll(noise, 100))
    blocks = np.tile(DAM, (20, 1))
    for name, ends in (("restitution", (0.0, 0.9)), ("friction_static", (0.8, 2.0)), ("friction_kinetic", (0.8, 2.0))):
        blocks[:, BLOCK.index(name)] = np.linspace(*ends, 20)
    together = run_blocks(blocks, [shaking], np.zeros(20, np.int64), np.ones((20, 2)))
    assert 0.0 < together["time_rest"].min() < together["time_rest"].max() < 20.0
    assert together["impacts"].max() > 0
    for row, numbers in enumerate(blocks):
        seen = run_block(numbers, shaking, time)
        assert list(seen.summary.by_name().values()) == [column[row] for column in together.values()]
        # Where it rests it holds: no force is missing, and nothing moves.
        rests = seen.mode == MODES.index("rest")
        assert seen.histories.normal_force_heel[rests].min() >= 0.0
        assert not seen.histories.slip_acceleration[rests].any()
