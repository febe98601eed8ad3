"""Which pulses overturn a block: maps over their frequency and amplitude, with the safe gap.

A block may be overturned by a weaker pulse after it has struck once, stand a stronger one, and be overturned by a still
stronger one without a blow: Zhang and Makris (2001). In between lies the safe gap, so that "what is the least
acceleration that overturns it" has no single answer."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block as NumbersBlock
from heeltoe.base.blocks import Number
from heeltoe.base.display import Shown
from heeltoe.base.frozen import ReadOnlyArrays
from heeltoe.case.combinations import check
from heeltoe.case.model import Case
from heeltoe.case.warnings import drawing_text
from heeltoe.errors.error import InputError, expect
from heeltoe.kernel.build import build_info
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block, CriticalAccelerations, build_block
from heeltoe.models.cost import Cost
from heeltoe.models.rigid.walk import walk
from heeltoe.result.outcome import Outcome

if TYPE_CHECKING:
    import pyarrow as pa


#: What a pulse does to a block, by the numbers of a map.
ENDS = ("does not rock", "rocks and stands", "overturns after an impact", "overturns without impact", "no result")
_MOST = 400
_PIECES = 200
# Seconds and bytes of a pulse.
_OF_PULSE = 4e-4, 1e3
# What overturns does so within so many times 1/p, with p of :attr:`OverturningMap.frequency_parameter_1_s`.
_WAIT = 12.0


class SafeGap(NumbersBlock):
    """Pulses that a block stands although weaker ones of the frequency overturn it."""

    frequency_hz: Annotated[float, Number("Frequency of the pulse.", "Hz")]
    from_g: Annotated[float, Number("The least amplitude of the gap.", "g")]
    to_g: Annotated[float, Number("The largest amplitude of the gap.", "g")]


class OverturningMap(Shown, ReadOnlyArrays, NumbersBlock):
    """Ends of a block in pulses of many frequencies and amplitudes."""

    title: Annotated[str, Number("Title of the case.")]
    pulse: Annotated[str, Number("Shape of the pulses: `sine` (one full one), `half-sine` or `cosine` (one full one).")]
    frequency_hz: Annotated[Floats, Number("Their frequencies.", "Hz")]
    amplitude_g: Annotated[Floats, Number("Amplitudes of their acceleration.", "g")]
    ends: Annotated[tuple[str, ...], Number("Possible outcomes of a pulse, in words.")] = ENDS
    end: Annotated[
        NDArray[np.int8], Number("Outcome of each pulse, by frequency and amplitude (f, a), as an index into `ends`.")
    ]
    least_g: Annotated[
        tuple[float | None, ...],
        Number("Least amplitude that overturns the block at each frequency; null where none does.", "g"),
    ]
    safe_gap: Annotated[
        tuple[SafeGap, ...],
        Number("Pulses that the block stands although weaker ones of the frequency overturn it."),
    ]
    frequency_parameter_1_s: Annotated[
        float,
        Number("p of the block about the corner it overturns most easily about, the square root of m g R / I.", "1/s"),
    ]
    slenderness_rad: Annotated[float, Number("Angle at which its centroid is above that corner.", "rad")]
    drawing: Annotated[str, Number("Which outline of a drawing is the dam; empty where the section is not drawn.")] = ""

    def to_json(self) -> dict[str, Any]:
        """Return plain numbers, strings and lists."""
        return {**super().to_json(), "build": build_info()}

    def to_table(self) -> pa.Table:
        """Return the map as a table with a row for each pulse."""
        import pyarrow as pa

        frequency, amplitude = np.meshgrid(self.frequency_hz, self.amplitude_g, indexing="ij")
        return pa.table(
            {
                "frequency_hz": frequency.reshape(-1),
                "amplitude_g": amplitude.reshape(-1),
                "end": [ENDS[k] for k in self.end.reshape(-1)],
            }
        )


def overturning_map(
    case: Case,
    pulse: str = "sine",
    *,
    frequencies_hz: Floats | None = None,
    amplitudes_g: Floats | None = None,
    count: int = 60,
) -> OverturningMap:
    """Run the block of a case through pulses of many frequencies and amplitudes.

    Parameters
    ----------
    case
        Its ``analysis.rotation`` says by which geometry; ``small`` knows no overturning and is taken as ``finite``.
    pulse
        ``sine``, ``half-sine`` or ``cosine``.
    frequencies_hz, amplitudes_g
        (f,) and (a,) ascending; `count` of each where they are not given: w/p from 0.5 to 8, amplitudes from half of
        to ten times that at which the block starts to rock.
    count
        How many of each, 2 to 400.

    Raises
    ------
    InputError
        Where the pulse is none of these, or there are too many, or the block stands not even without a pulse.
    """
    expect(case, Case, "a case", "case")
    if pulse not in ("sine", "half-sine", "cosine"):
        raise InputError("not-a-choice", "pulse", pulse, choices="sine, half-sine or cosine")
    if not 2 <= count <= _MOST:
        raise InputError("out-of-range", "count", count, bound=f"from 2 to {_MOST}")
    if case.analysis.rotation == "small":
        case = case.model_copy(update={"analysis": case.analysis.model_copy(update={"rotation": "finite"})})
    block, critical = _standing(case)
    rate, slenderness = _inverted_pendulum(block)
    if frequencies_hz is None:
        frequencies_hz = np.linspace(0.5, 8.0, count) * rate / (2.0 * math.pi)
    if amplitudes_g is None:
        amplitudes_g = np.linspace(0.5, 10.0, count) * critical.rocking / case.gravity
    # The side on which the block is overturned more easily gets the first push.
    sign = -1.0 if critical.rocking_downstream < critical.rocking_upstream else 1.0

    def column(frequency: float) -> list[int]:
        return [
            _end(case, block, _pulse(pulse, frequency, sign * amplitude * case.gravity, _WAIT / rate))
            for amplitude in amplitudes_g
        ]

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        ends = list(pool.map(column, frequencies_hz))
    end = np.array(ends, dtype=np.int8)
    hertz, sizes = (np.asarray(values, dtype=np.float64) for values in (frequencies_hz, amplitudes_g))
    falls = np.isin(end, [k for k, name in enumerate(ENDS) if name.startswith("overturns")])
    return OverturningMap(
        title=case.title,
        pulse=pulse,
        frequency_hz=hertz,
        amplitude_g=sizes,
        end=end,
        least_g=tuple(float(sizes[np.argmax(column)]) if column.any() else None for column in falls),
        safe_gap=tuple(_safe_gap(hertz, sizes, falls)),
        frequency_parameter_1_s=rate,
        slenderness_rad=slenderness,
        drawing=drawing_text(case),
    )


def map_cost(count: int) -> Cost:
    """Return the cost of a map of `count` frequencies and amplitudes."""
    return Cost(_OF_PULSE[0] * count**2, _OF_PULSE[1] * count**2)


def _safe_gap(frequencies: Floats, amplitudes: Floats, falls: NDArray[np.bool_]) -> Iterator[SafeGap]:
    """Walk the places where the block stands pulses that are stronger than one that overturns it and weaker than
    another one that does."""
    for frequency, column in zip(frequencies.tolist(), falls, strict=True):
        for before, after in pairwise(np.flatnonzero(column)):
            if after - before > 1:
                low, high = float(amplitudes[before + 1]), float(amplitudes[after - 1])
                yield SafeGap(frequency_hz=frequency, from_g=low, to_g=high)


def _standing(case: Case) -> tuple[Block, CriticalAccelerations]:
    """Return a block that stands without a pulse, and what moves it."""
    check(case, "map")
    block = build_block(case)
    critical = block.critical_accelerations()
    if min(critical.rocking, critical.sliding) <= 0.0 or block.normal_force <= 0.0:
        raise InputError("pulse-unstable", "case")
    return block, critical


def _inverted_pendulum(block: Block) -> tuple[float, float]:
    """Return p and the slenderness of the concrete about the nearer corner (Housner 1963)."""
    section = block.section
    x, z = section.in_crack_frame(*section.centroid_from_heel)
    arm = min(x, block.width - x)
    radius = math.hypot(arm, z)
    per_mass = section.polar_inertia / section.area + radius**2
    return math.sqrt(block.gravity * radius / per_mass), math.atan2(arm, z)


def _pulse(kind: str, frequency: float, amplitude: float, wait: float) -> Shaking:
    """Return a pulse and the quiet after it."""
    end = (0.5 if kind == "half-sine" else 1.0) / frequency
    time = np.linspace(0.0, end, _PIECES + 1)
    phase = 2.0 * math.pi * frequency * time
    values: Floats = amplitude * (np.cos(phase) if kind == "cosine" else np.sin(phase))
    if kind != "cosine":
        values[-1] = 0.0
        return Shaking(np.append(time, end + wait), np.append(values, 0.0))
    # It starts and ends with a jump.
    return Shaking(np.concatenate([time, [end, end + wait]]), np.concatenate([values, [0.0, 0.0]]))


def _end(case: Case, block: Block, shaking: Shaking) -> int:
    run = walk(case, block, shaking)
    if run.outcome == Outcome.OVERTURNED:
        return 2 if run.summary.impacts else 3
    if run.outcome != Outcome.OK:
        return 4
    return int(max(run.summary.largest_gap_heel, run.summary.largest_gap_toe) > 0.0)
