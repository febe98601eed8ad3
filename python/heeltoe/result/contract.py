"""The headline numbers of every result: what they are called, which way they count, and what is next to nothing.

Terminal, report, notebook, models side by side, spread and tables of runs all read them here.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.result.histories import GROUND, GROUND_UP
from heeltoe.result.numbers import CrackNumbers, SlipByMode, TimeByMode
from heeltoe.result.quantity import LEAST_M as LEAST_M
from heeltoe.result.quantity import LEAST_RAD as LEAST_RAD
from heeltoe.result.quantity import quantities_of

# Not at run time: a response takes these names.
if TYPE_CHECKING:
    from heeltoe.kernel.shaking import Shaking


N = TypeVar("N", float, Floats)

#: What a joint meter on a dam is read to: slips that differ by less differ by nothing, and both ends of the crack of an
#: elastic dam shift by hundredths of a millimetre in every earthquake, with nothing happening to the dam.
JOINT_METER_M = 1e-4
#: So much slip is more than grout and bore hole leave a tendon that crosses the crack.
SHEARS_M = 0.01

#: The headline numbers, in the order in which they are shown.
HEADLINES = tuple(item for item in quantities_of(CrackNumbers) if item.short)
#: Those of them that are lengths, which a narrow table has.
LENGTHS = tuple(item for item in HEADLINES if item.kind != "rotation")
#: That by which a dam is judged first.
RESIDUAL_SLIP = HEADLINES[0]
#: The openings, of the upstream face before the downstream one.
OPENINGS = tuple(item for item in HEADLINES if item.kind == "opening")

#: The peak slips and the rotations, downstream before upstream.
PEAKS = tuple(item.key for item in HEADLINES[1:] if item.kind == "slip")
ROTATIONS = tuple(item.key for item in HEADLINES if item.kind == "rotation")
#: The width of a crack.
WIDTH = "crack_width_m"
#: Columns of slips and of times by the mode of motion, in tables of runs.
SLIPS_BY_MODE = tuple(f"slip_{name}_m" for name in SlipByMode.names())
TIMES_BY_MODE = tuple(f"time_{name}_s" for name in TimeByMode.names())
#: What the earthquake has cracked of a bonded joint in the end; zero of a crack without a bond.
CRACKED = "cracked_length_m"


def slip_by_mode(row: Mapping[str, float]) -> SlipByMode:
    """Return the slips by mode that a row of a kernel has."""
    return SlipByMode(**{name: row[f"slip_{name}"] for name in SlipByMode.names()})


def time_by_mode(row: Mapping[str, float]) -> TimeByMode:
    """Return the times by mode that a row of a kernel has."""
    return TimeByMode(**{name: row[f"time_{name}"] for name in TimeByMode.names()})


def headlines(table: Mapping[str, N]) -> dict[str, N]:
    """Return the headline numbers of a run, or (n,) of many, that a kernel's table has, by their names in the JSON."""
    # Adding zero makes a negative zero a plain one.
    return {
        headline.key: headline.sense * table[headline.column] + 0.0
        for headline in HEADLINES
        if headline.column in table
    }


def ground_histories(shaking: Shaking, moments: Floats) -> dict[str, Floats]:
    """Return the first columns of all histories: the moments (n,) [s], and how the ground accelerates then [m/s2]."""
    horizontal = np.interp(moments, shaking.time, shaking.horizontal)
    histories = {"time_s": moments, GROUND: horizontal}
    if shaking.up is not None:
        histories[GROUND_UP] = np.interp(moments, shaking.time, shaking.up)
    if shaking.cross is not None:
        histories["cross_ground_acceleration_m_s2"] = np.interp(moments, shaking.time, shaking.cross)
    return histories
