"""The dam as a beam, beside the elastic parts that it stands in for."""

import numpy as np
import pytest

from heeltoe import dam_periods, read_case
from heeltoe.mechanics.beam import beam
from shared.dams import example, polygon


def test_a_slender_wall_swings_as_a_cantilever():
    """Euler and Bernoulli: 3.5160 and 22.034 sqrt(E I / m) / h^2."""
    case = read_case({"section": polygon([(0, 0), (1, 0), (1, 100), (0, 100)]), "crack": {"friction": 1.0}})
    circular = np.array([3.5160, 22.034]) * np.sqrt(1.0 / 12.0 / 2400.0) / 100.0**2
    assert beam(case).periods[:2] == pytest.approx(2.0 * np.pi / circular, rel=0.01)


@pytest.mark.parametrize("name", ["typical-base", "typical-height", "triangular", "koyna", "anchored"])
def test_dams_swing_about_as_their_elastic_parts_do(name):
    case = example(name, "flexible.elements_across=3")
    about = beam(case).periods[0] / np.sqrt(case.concrete.modulus)
    assert about == pytest.approx(dam_periods(case, 1).intact[0], rel=0.125)
