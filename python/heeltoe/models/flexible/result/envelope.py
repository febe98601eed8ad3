"""The envelope of the principal stresses over a run, and its largest tension."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.frozen import ReadOnlyArrays
from heeltoe.kernel.dam import DamRun
from heeltoe.models.flexible.body.elastic import principal, stresses
from heeltoe.models.flexible.body.reduced import FlexibleDam


@dataclass(frozen=True, eq=False)
class PartEnvelope(ReadOnlyArrays):
    """The largest stresses of one part over a run, at p corners of its elements; tension is positive.

    Attributes
    ----------
    nodes
        (p,) of the mesh of the part.
    tension, compression
        (p,) largest and least principal stress [Pa].
    tension_time, compression_time
        (p,) when [s].
    direction
        (p,) of the largest tension, from x downstream towards z up [rad]; a crack would open across it.
    before
        (p,) largest principal stress under the static loads, before the earthquake [Pa].
    bounded
        (p,) whether the stress has a bound as the mesh gets finer, see
        :func:`heeltoe.models.flexible.body.stress_places.bounded`.
    """

    nodes: Integers
    tension: Floats
    tension_time: Floats
    compression: Floats
    compression_time: Floats
    direction: Floats
    before: Floats
    bounded: NDArray[np.bool_]


@dataclass(frozen=True)
class Peak:
    """A largest tension or compression.

    Attributes
    ----------
    stress
        [Pa], tension positive.
    time
        [s].
    part, index
        Place of the part, upper first, and of the point in its envelope.
    """

    stress: float
    time: float
    part: int
    index: int


def envelope_of(dam: FlexibleDam, run: DamRun) -> tuple[PartEnvelope, ...]:
    """Return the envelope of a run, part by part."""
    result = []
    for body, places, static, raw in zip(dam.bodies, dam.stress_places, dam.static, run.extremes, strict=True):
        at_rest, _, _ = principal(stresses(body, static)[places.nodes])
        result.append(
            PartEnvelope(
                nodes=places.nodes,
                tension=raw.tension,
                tension_time=raw.tension_time,
                compression=raw.compression,
                compression_time=raw.compression_time,
                direction=np.arctan2(2.0 * raw.xz, raw.xx - raw.zz) / 2.0,
                before=at_rest,
                bounded=places.bounded,
            )
        )
    return tuple(result)


def largest_tension(parts: Sequence[PartEnvelope]) -> Peak | None:
    """Return the largest tension among points where it is bounded; None where every point is too close to a singular
    one."""
    return _largest([np.where(item.bounded, item.tension, -np.inf) for item in parts], parts, "tension")


def largest_compression(parts: Sequence[PartEnvelope]) -> Peak | None:
    """Return the largest compression, as :func:`largest_tension`."""
    return _largest([np.where(item.bounded, -item.compression, -np.inf) for item in parts], parts, "compression")


def _largest(values: list[Floats], parts: Sequence[PartEnvelope], name: str) -> Peak | None:
    part = int(np.argmax([value.max(initial=-np.inf) for value in values]))
    if not values[part].size or values[part].max() == -np.inf:
        return None
    index = int(values[part].argmax())
    result = parts[part]
    return Peak(float(getattr(result, name)[index]), float(getattr(result, f"{name}_time")[index]), part, index)


def tension_before(parts: Sequence[PartEnvelope]) -> float:
    """Return the largest tension before the earthquake, where it has a bound [Pa]."""
    return max(float(item.before[item.bounded].max(initial=-np.inf)) for item in parts)
