"""The time of the largest slip: of a block on a flat crack in a rectangular pulse it is when friction stops it."""

import pytest

from heeltoe import read_case, rigid
from heeltoe.result.quantity import peak_time
from shared.dams import example

# Newmark's block (1965): with the pulse A for t0 and friction mu g it stops at t0 A / (mu g).
BLOCK = {
    "section": {"polygon": [["0 m", "0 m"], ["40 m", "0 m"], ["40 m", "4 m"], ["0 m", "4 m"]]},
    "crack": {"friction": 0.5},
    "gravity": "9.81 m/s^2",
    "motion": {"points": [["0 s", "0.8 g"], ["0.1 s", "0.8 g"], ["0.1 s", "0 g"], ["2 s", "0 g"]], "sign": "recorded"},
}


def test_a_block_slips_farthest_when_friction_stops_it():
    response = rigid(read_case(BLOCK), output_step=0.001)
    assert response.to_json()["time_of_peak_slip_s"] == pytest.approx(0.1 * 0.8 / 0.5, abs=0.001)


def test_of_a_dam_it_is_that_of_its_histories():
    response = rigid(example("typical-base", "motion.duration=3 s"))
    assert response.numbers.time_of_peak_slip_s == peak_time(response.histories["time_s"], response.histories["slip_m"])
