"""Moments at which no more than the place of a block is wanted: the block is where it is when they are wanted whole."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import build_block, read_case
from heeltoe.kernel.block import run_block
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.rigid.stack import walk_two_blocks
from heeltoe.models.rigid.walk import walk
from heeltoe.models.run import earthquake
from models.rigid.test_varying import rectangle
from shared.dams import PULSE as POINTS
from shared.dams import example

MOMENTS = np.linspace(0.0, 1.2, 61)
WHOLE = np.arange(61) % 3 == 1
SWING = 9.0 * np.sin(0.12 * np.arange(121))
LAW = {"name": "slip weakening", "peak_friction": 0.6, "residual_friction": 0.3, "slip": "50 mm"}
ROUGH = {"asperity_height": "10 mm", "wave_length": "100 mm", "wear": "0 m^2/J"}
SLIDES = {"crack": {"law": LAW}}
CASES = {
    "rocks and slides": rectangle(2.0, 6.0, 0.6),
    "slides by a law": rectangle(20.0, 1.0) | SLIDES,
    "rocks by a law": rectangle(2.0, 6.0) | SLIDES,
    "slides on a rough crack": rectangle(20.0, 1.0, 0.4, crack={"roughness": ROUGH}),
}


def shaking(*, cross: bool = False) -> Shaking:
    time = 0.01 * np.arange(121)
    return Shaking(time, SWING, cross=0.5 * SWING[::-1] if cross else None)


def same(some, every) -> None:
    """Compare a run with the moments of WHOLE with one that has all of them whole."""
    places = np.column_stack([every.histories.slip, every.histories.gap_heel, every.histories.gap_toe])
    assert np.ptp(places, axis=0).max() > 1e-3
    assert np.array_equal(some.places, places)
    assert every.places.shape == (0, 3)
    whole = WHOLE[: len(places)]
    for name, column in every.histories.by_name().items():
        assert np.array_equal(getattr(some.histories, name), column[whole]), name
    assert np.array_equal(some.mode, every.mode[whole])
    assert some.summary == every.summary
    if every.worn is not None:
        assert np.array_equal(some.worn.path, every.worn.path[whole])
        assert np.array_equal(some.worn.bonded, every.worn.bonded[whole])
    for part in ("rough", "crossing"):
        if getattr(every, part) is not None:
            assert np.array_equal(getattr(some, part).kept, getattr(every, part).kept[whole])


@pytest.mark.parametrize(
    ("name", "cross"), [*((name, False) for name in CASES), *((name, True) for name in list(CASES)[:2])]
)
def test_a_block_is_in_the_same_places(name, cross):
    case = read_case(CASES[name])
    block, shakes = build_block(case), shaking(cross=cross)
    some, every = (walk(case, block, shakes, MOMENTS, whole=whole) for whole in (WHOLE, None))
    assert (every.crossing is not None) == cross
    assert (every.worn is not None) == (name != "rocks and slides")
    same(some, every)


def test_two_blocks_are_in_the_same_places():
    case = example("two-cracks")
    some, every = (walk_two_blocks(case, shaking(), MOMENTS, whole)[1].cracks for whole in (WHOLE, None))
    for one, other in zip(some, every, strict=True):
        same(one, other)


def test_a_block_is_in_the_same_places_in_all_stages_of_a_sequence():
    pulse = POINTS | {"pga": "0.6 g"}
    case = read_case(
        {
            "section": {"height": "40 m", "crest_width": "5 m", "base_width": "38 m"},
            "crack": {"friction": 0.6},
            "reservoir": {"depth": "30 m"},
            "uplift": {"pattern": "drained", "drain_x": "4 m", "drain_efficiency": 0.6},
            "statics": {"drain_diameter": "75 mm"},
            "motion": pulse,
            "aftershocks": [pulse | {"pause": "0.3 s"}],
        }
    )
    block, shakes = build_block(case), earthquake(case).shaking
    moments = np.linspace(0.0, shakes.time[-1], 61)
    some, every = (walk(case, block, shakes, moments, whole=whole) for whole in (WHOLE, None))
    same(some, every)


def test_each_moment_needs_to_be_whole_or_not():
    block = build_block(read_case(CASES["rocks and slides"]))
    with pytest.raises(ValueError, match="61 moments need a flag each, not 3"):
        run_block(block.parameters(), shaking(), MOMENTS, whole=WHOLE[:3])
