"""The headline numbers of every result: what they are called, which way they count, and what is next to nothing.

Terminal, report, notebook, models side by side, spread and tables of runs all read them here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.result.numbers import SlipByMode, TimeByMode

# Not at run time: a response takes these names.
if TYPE_CHECKING:
    from heeltoe.kernel.shaking import Shaking
    from heeltoe.result.response import Numbered


@dataclass(frozen=True)
class Quantity:
    """A headline number.

    Attributes
    ----------
    key
        Its name in the JSON.
    label
        What people call it.
    heading
        The same above a narrow column.
    kind
        ``"slip"`` or ``"opening"`` [m], or ``"rotation"`` [rad].
    way
        -1 where the number is negative the way that its label says, and is shown turned round; else 1.
    signed
        Whether it goes both ways, positive downstream.
    least
        What is less than this is next to nothing, in its unit.
    column
        What the kernels call it. A block has no openings, but rotations of a base that stays straight.
    sense
        -1 where the kernels count it the other way.
    """

    key: str
    label: str
    heading: str
    kind: Literal["slip", "rotation", "opening"]
    way: Literal[1, -1]
    signed: bool
    least: float
    column: str
    sense: Literal[1, -1] = 1

    def of(self, crack: Numbered) -> float:
        """Return this number of a crack, or of the crack of ``[crack]`` of a response."""
        return float(getattr(crack, self.key))

    @property
    def full(self) -> str:
        """Its label, with which way is positive."""
        return f"{self.label}, + downstream" if self.signed else self.label


#: A hundredth of a millimetre and a thousandth of a milliradian: nobody measures less on a dam.
LEAST_M, LEAST_RAD = 1e-5, 1e-6
#: What a joint meter on a dam is read to: slips that differ by less differ by nothing, and both ends of the crack of an
#: elastic dam shift by hundredths of a millimetre in every earthquake, with nothing happening to the dam.
JOINT_METER_M = 1e-4
#: So much slip is more than grout and bore hole leave a tendon that crosses the crack.
SHEARS_M = 0.01

HEADLINES = (
    Quantity("residual_slip_m", "residual slip", "residual", "slip", 1, True, LEAST_M, "slip"),
    Quantity("peak_slip_downstream_m", "peak slip downstream", "peak\ndown", "slip", 1, False, LEAST_M, "slip_max"),
    Quantity("peak_slip_upstream_m", "peak slip upstream", "peak\nup", "slip", -1, False, LEAST_M, "slip_min"),
    Quantity(
        "rocking_downstream_rad",
        "rotation downstream",
        "rotation\ndown",
        "rotation",
        1,
        False,
        LEAST_RAD,
        "rotation_min",
        -1,
    ),
    Quantity(
        "rocking_upstream_rad", "rotation upstream", "rotation\nup", "rotation", 1, False, LEAST_RAD, "rotation_max"
    ),
    Quantity(
        "opening_upstream_m",
        "opening, upstream face",
        "opening\nupstream",
        "opening",
        1,
        False,
        LEAST_M,
        "opening_heel",
    ),
    Quantity(
        "opening_downstream_m",
        "opening, downstream face",
        "opening\ndownstr.",
        "opening",
        1,
        False,
        LEAST_M,
        "opening_toe",
    ),
)
"""In the order in which they are shown."""

#: What is cracked in the end: of a bonded joint what the earthquake cracks, of a crack its width.
CRACKED = "cracked_length_m"


def slip_by_mode(row: Mapping[str, float]) -> SlipByMode:
    """Return the slips by mode that a row of a kernel has."""
    return SlipByMode(**{name: row[f"slip_{name}"] for name in SlipByMode.names()})


def time_by_mode(row: Mapping[str, float]) -> TimeByMode:
    """Return the times by mode that a row of a kernel has."""
    return TimeByMode(**{name: row[f"time_{name}"] for name in TimeByMode.names()})


def headlines(table: Mapping[str, Floats]) -> dict[str, Floats]:
    """Return those headline numbers of many runs that a kernel's table has, (n,) by their names in the JSON."""
    # Adding zero makes a negative zero a plain one.
    return {
        headline.key: headline.sense * table[headline.column] + 0.0
        for headline in HEADLINES
        if headline.column in table
    }


def ground_histories(shaking: Shaking, moments: Floats) -> dict[str, Floats]:
    """Return the first columns of all histories: the moments (n,) [s], and how the ground accelerates then [m/s2]."""
    horizontal = np.interp(moments, shaking.time, shaking.horizontal)
    histories = {"time_s": moments, "ground_acceleration_m_s2": horizontal}
    if shaking.up is not None:
        histories["vertical_ground_acceleration_m_s2"] = np.interp(moments, shaking.time, shaking.up)
    return histories
