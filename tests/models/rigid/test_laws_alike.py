"""Every friction law under a mirrored motion, and of a block that is larger."""

from __future__ import annotations

import math

import numpy as np
import pytest

from heeltoe import read_case
from heeltoe.kernel.friction import friction_law
from models.rigid.test_friction_laws import walked
from models.rigid.test_varying import rectangle

FALLS = {"peak": 0.7, "residual": 0.4}
BOND = {"peak": 0.5, "residual": 0.5, "cohesion": 5e3}


def laws(size=1.0):
    """Return each law for a block of this size: ways go with it, stresses too, speeds with its root."""
    return {
        "constant": friction_law("constant", FALLS),
        "linear": friction_law("linear slip weakening", FALLS | {"scale": 0.01 * size}),
        "exponential": friction_law("exponential slip weakening", FALLS | {"scale": 0.01 * size}),
        "speed": friction_law("speed weakening", FALLS | {"scale": 0.1 * math.sqrt(size)}),
        "brittle": friction_law("constant", BOND | {"cohesion": 5e3 * size}),
        "gradual": friction_law("constant", BOND | {"cohesion": 5e3 * size, "loss": 0.02 * size}),
        "barton-bandis": friction_law(
            "barton-bandis", {"roughness": 8.0, "wall_strength": 2e5 * size, "residual_angle": math.radians(20.0)}
        ),
        "lift joint": friction_law("lift joint", {"residual": 0.4}, [(2e4 * size, 0.3), (6e4 * size, 0.15)]),
    }


@pytest.mark.parametrize("name", laws())
@pytest.mark.parametrize("height", [1.0, 3.0])
def test_a_mirrored_motion_mirrors_the_slip(name, height):
    case = read_case(rectangle(4.0, height, 0.6, crack={"restitution": 0.3}))
    rng = np.random.default_rng(3)
    time, ground = np.arange(60) * 0.05, np.append(rng.normal(size=58) * 8.0, [0.0, 0.0])
    one, other = (walked(case, time, way * ground, laws()[name]) for way in (1.0, -1.0))
    assert one.summary.slip != 0.0
    assert one.summary.slip == pytest.approx(-other.summary.slip, rel=1e-9)
    assert one.worn.end == pytest.approx(other.worn.end, rel=1e-9)
    assert one.summary.rotation_max == pytest.approx(-other.summary.rotation_min, rel=1e-9)


@pytest.mark.parametrize("name", laws())
@pytest.mark.parametrize("height", [1.0, 3.0])
def test_a_larger_block_slides_as_much_further(name, height):
    # Lengths and ways times four, times twice, stresses times four.
    rng = np.random.default_rng(5)
    ground = np.append(rng.normal(size=38) * 6.0, [0.0, 0.0])
    result = []
    for size in (1.0, 4.0):
        case = read_case(rectangle(4.0 * size, height * size, 0.6, crack={"restitution": 0.3}))
        time = np.arange(40) * 0.05 * math.sqrt(size)
        result.append(walked(case, time, ground, laws(size)[name]).summary.slip / size)
    assert result[0] != 0.0
    assert result[1] == pytest.approx(result[0], rel=1e-8)
