"""Maps of overturning: the branches of the linearised slender block, the safe gap, files, refusals."""

import json

import numpy as np
import pytest

from heeltoe import InputError, overturning_map, read_case
from heeltoe.base.atomic_files import LISTED
from heeltoe.study.small.overturning import ENDS
from shared.command import command

SLENDER = {
    "gravity": "9.81 m/s^2",
    "section": {"polygon": [["0 m", "0 m"], ["1 m", "0 m"], ["1 m", "4 m"], ["0 m", "4 m"]]},
    "crack": {"friction": 2.0, "restitution": 0.0},
}


def test_the_branch_without_impact_and_the_safe_gap_below_it():
    case = read_case(SLENDER | {"analysis": {"rotation": "p-delta"}})
    # Frequency of w/p = 5 and least amplitude 7.16813 alpha g, alpha = B / H = 1/4, p by the linearised block.
    rate = np.sqrt(9.81 * 2.0 / (17.0 / 12.0 + 4.25))
    amplitudes = 0.25 * np.array([2.0, 4.0, 6.0, 7.0, 7.15, 7.19, 8.0])
    overturning = overturning_map(case, frequencies_hz=np.array([5.0 * rate / (2.0 * np.pi)]), amplitudes_g=amplitudes)
    assert [ENDS[k] for k in overturning.end[0]] == [
        "rocks and stands",
        "overturns after an impact",
        "overturns after an impact",
        "rocks and stands",
        "rocks and stands",
        "overturns without impact",
        "overturns without impact",
    ]
    (gap,) = overturning.safe_gap
    assert (gap.from_g, gap.to_g) == (pytest.approx(1.75), pytest.approx(1.7875))
    assert overturning.least_g == (1.0,)


def test_small_rotations_are_taken_as_finite():
    overturning = overturning_map(read_case(SLENDER), "half-sine", count=6)
    again = overturning_map(read_case(SLENDER | {"analysis": {"rotation": "finite"}}), "half-sine", count=6)
    assert (overturning.end == again.end).all()
    assert (overturning.end >= 2).any()


def test_weak_pulses_do_nothing():
    overturning = overturning_map(read_case(SLENDER), "cosine", count=3, amplitudes_g=np.array([0.1, 0.2]))
    assert (overturning.end == 0).all()
    assert overturning.least_g == (None, None, None)
    assert overturning.safe_gap == ()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"pulse": "square"}, "pulse: square is not a choice; choose sine, half-sine or cosine"),
        ({"count": 1}, "count: 1 is out of range; give a value from 2 to 400"),
    ],
)
def test_refused(options, message):
    with pytest.raises(InputError) as caught:
        overturning_map(read_case(SLENDER), **options)
    assert str(caught.value) == message


def test_a_dam_that_does_not_stand_is_refused():
    flooded = SLENDER | {"reservoir": {"depth": "4 m"}, "crack": {"friction": 0.1}}
    with pytest.raises(InputError, match="does not even stand"):
        overturning_map(read_case(flooded))


def test_on_the_command_line(tmp_path):
    case = tmp_path / "block.toml"
    case.write_text(
        '[section]\npolygon = [["0 m", "0 m"], ["1 m", "0 m"], ["1 m", "4 m"], ["0 m", "4 m"]]\n'
        "[crack]\nfriction = 2.0\nrestitution = 0.0\n"
    )
    out = tmp_path / "out"
    result = command("overturning", case, "--count", "8", "--out", out, "--json", tmp_path / "map.json")
    assert result.returncode == 0, result.stderr
    assert "safe gap" in result.stdout
    assert sorted(path.name for path in out.iterdir()) == [
        LISTED,
        "overturning.csv",
        "overturning.png",
        "overturning.svg",
    ]
    data = json.loads((tmp_path / "map.json").read_text())
    assert np.array(data["end"]).shape == (8, 8)
    assert len((out / "overturning.csv").read_text().splitlines()) == 65
