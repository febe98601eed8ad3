"""The step that the program chooses goes with what happens in the cracks."""

from __future__ import annotations

import pytest

from heeltoe.models.flexible.run.dam_runner import short_step, usual_step
from shared import features
from shared.dams import example

LONG, SHORT = 0.2, 0.012
PLANE, ROCK = (), ("rock.modulus=20 GPa",)
LAW = ({"crack.friction": None, "crack.law": features.LAW},)
BOND = ({"crack.friction": None, "crack.law": features.BOND},)


@pytest.mark.parametrize(
    ("name", "changes", "period", "step"),
    [
        # Sliding at the base, striking above it, and small dams: whole parts of half the frames' spacing.
        ("typical-base", PLANE, LONG, 0.005 / 6),
        ("typical-base", PLANE, SHORT, 0.005 / 42),
        ("typical-height", PLANE, LONG, 0.005 / 12),
        ("typical-height", PLANE, SHORT, 0.005 / 21),
        ("typical-base", LAW, LONG, 0.005 / 13),
        # Shorter steps.
        ("typical-base", ("reservoir.compressible=true",), LONG, 2e-4),
        ("typical-base", (*ROCK, "rock.damping=0"), LONG, 2e-4),
        ("typical-base", (*ROCK, *LAW), LONG, 2e-4),
        ("typical-base", BOND, LONG, 2e-4),
        ("two-cracks", PLANE, LONG, 2e-4),
        ("stepped-crack", PLANE, LONG, 2e-4),
        ("typical-base", ('crack.side_gap="3 mm"',), LONG, 2e-4),
        ("typical-base", ('uplift.during_shaking="full while open"',), LONG, 2e-4),
        # Rock through which waves leave.
        ("typical-base", ROCK, LONG, 8e-4),
        ("typical-base", ROCK, SHORT, SHORT / 100),
        ("typical-height", ROCK, LONG, 8e-4),
        ("two-cracks", ROCK, LONG, 8e-4),
    ],
)
def test_a_crack_that_slides_takes_longer_steps(name, changes, period, step):
    assert usual_step(example(name, *changes), period) == pytest.approx(step)


@pytest.mark.parametrize(
    ("name", "changes", "period", "step"),
    [
        ("typical-base", PLANE, LONG, 2e-4),
        ("typical-base", PLANE, SHORT, SHORT / 100),
        ("typical-height", PLANE, LONG, 2e-4),
        ("two-cracks", PLANE, LONG, 2e-4),
        ("typical-base", ROCK, LONG, 8e-4),
        ("two-cracks", ROCK, LONG, 8e-4),
    ],
)
def test_the_short_step_goes_with_the_part_that_vibrates_fastest(name, changes, period, step):
    assert short_step(example(name, *changes), period) == pytest.approx(step)
