"""The input of many runs, checked before any of them: no result may be made of an invalid number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.combinations import check
from heeltoe.case.model import Case
from heeltoe.case.options import LONGEST_SILENCE
from heeltoe.errors.error import InputError, expect
from heeltoe.kernel.block import BLOCK, Limits
from heeltoe.mechanics.block import Block, build_block
from heeltoe.motion.ground_motion import GroundMotion

_POSITIVE = ("mass_horizontal", "mass_vertical", "inertia")


@dataclass(frozen=True, eq=False)
class Rows:
    """Runs, one a row.

    Attributes
    ----------
    numbers
        (n, 22) of the blocks, in the order of :data:`heeltoe.kernel.block.BLOCK`.
    blocks
        (n,) blocks; none where only their numbers are known.
    which
        (n,) motion that each of them meets.
    scales
        (n, 2) factor on the horizontal and on the vertical one.
    crest
        (n, 3) how far slip, heel gap and toe gap move the crest downstream; None where no one asks how it moves.
    """

    numbers: Floats
    blocks: Sequence[Block]
    which: Integers
    scales: Floats
    crest: Floats | None = None

    def twins(self, places: Integers, factor: float) -> Rows:
        """Return some of them with all motions scaled, without their crest."""
        blocks = [self.blocks[place] for place in places.tolist()] if self.blocks else ()
        return Rows(self.numbers[places], blocks, self.which[places], factor * self.scales[places])


def rows_of(
    blocks: Sequence[Block | Case] | Floats,
    motions: Sequence[object],
    motion_of: Sequence[int] | Integers | None,
    scales: Sequence[float] | Floats | None,
) -> Rows:
    """Return what is to be run.

    Raises
    ------
    InputError
        Naming field, row and value, where something cannot be used.
    """
    expect(motions, Sequence, "a list", "motions")
    for place, motion in enumerate(motions):
        parts = motion if isinstance(motion, tuple) else (motion,)
        if not 1 <= len(parts) <= 2 or not all(isinstance(part, GroundMotion) for part in parts):
            kind = type(motion).__name__
            raise InputError("blocks-motion", f"motions[{place}]", kind, bounds="ground motions or pairs of them")
    built: list[Block] = []
    if isinstance(blocks, np.ndarray):
        numbers = blocks
    else:
        expect(blocks, Sequence, "a list", "blocks")
        built = [_built(block, row) for row, block in enumerate(blocks)]
        numbers = np.array([block.parameters() for block in built]).reshape(-1, len(BLOCK))
    if numbers.ndim != 2 or numbers.shape[1] != len(BLOCK) or numbers.dtype.kind not in "fiu":
        raise InputError("blocks-shape", "blocks", f"{_shape(numbers)} of {numbers.dtype}", columns=len(BLOCK))
    numbers = np.ascontiguousarray(numbers, dtype=np.float64)
    _check_numbers(numbers)
    count = len(numbers)
    return Rows(numbers, built, _which(motion_of, count, len(motions)), _scales(scales, count))


def check_limits(limits: Limits) -> None:
    """Refuse limits that end nothing."""
    if not (np.isfinite(limits.settle) and limits.settle >= 0.0):
        raise InputError("out-of-range", "limits.settle", limits.settle, bound="of 0 or more, finite")
    if not 0.0 <= limits.silence <= LONGEST_SILENCE:
        bound = f"from 0 to {LONGEST_SILENCE:g} s"
        raise InputError("out-of-range", "limits.silence", f"{limits.silence:g}", bound=bound)
    if limits.event_limit < 1:
        raise InputError("out-of-range", "limits.event_limit", limits.event_limit, bound="of 1 or more")


def _built(entry: Block | Case, row: int) -> Block:
    if isinstance(entry, Case):
        check(entry, "table")
        return build_block(entry)
    if not isinstance(entry, Block):
        raise InputError("blocks-shape", f"blocks[{row}]", type(entry).__name__, columns=len(BLOCK))
    return entry


def _check_numbers(numbers: Floats) -> None:
    """Refuse the first block whose numbers are those of none."""
    column = dict(zip(BLOCK, numbers.T, strict=True))
    friction, kinetic, bounce = (column[name] for name in ("friction_static", "friction_kinetic", "restitution"))
    wrong = [(name, ~np.isfinite(column[name]), "a finite number") for name in BLOCK]
    wrong += [(name, column[name] <= 0.0, "more than 0") for name in _POSITIVE]
    wrong += [
        ("toe_distance", column["heel_distance"] + column["toe_distance"] <= 0.0, "one downstream of the heel"),
        ("friction_static", friction < 0.0, "0 or more"),
        ("friction_kinetic", (kinetic < 0.0) | (kinetic > friction), "0 to friction_static"),
        ("restitution", (bounce < 0.0) | (bounce > 1.0), "0 to 1"),
        ("rocking_loss", (column["rocking_loss"] < 0.0) | (column["rocking_loss"] > 1.0), "0 to 1"),
    ]
    failures = [(int(bad.argmax()), order) for order, (_, bad, _) in enumerate(wrong) if bad.any()]
    if failures:
        row, order = min(failures)
        name, _, bounds = wrong[order]
        raise InputError("out-of-range", f"blocks[{row}].{name}", f"{column[name][row]:g}", bound=f"of {bounds}")


def _which(motion_of: Sequence[int] | Integers | None, count: int, motions: int) -> Integers:
    chosen = np.zeros(count, dtype=np.int64) if motion_of is None else np.asarray(motion_of)
    if chosen.shape != (count,):
        raise InputError("blocks-many", "motion_of", _shape(chosen), count=count)
    bad = np.flatnonzero(~((chosen >= 0) & (chosen < motions) & (chosen == np.floor(chosen))))
    if bad.size:
        bounds = f"0 to {motions - 1}" if motions else "a motion"
        raise InputError("blocks-motion", f"motion_of[{bad[0]}]", f"{chosen[bad[0]]:g}", bounds=bounds)
    return np.ascontiguousarray(chosen, dtype=np.int64)


def _scales(scales: Sequence[float] | Floats | None, count: int) -> Floats:
    factors = np.ones(count) if scales is None else np.asarray(scales, dtype=np.float64)
    if factors.shape not in ((count,), (count, 2)):
        raise InputError("blocks-many", "scales", _shape(factors), count=count)
    pairs = np.column_stack([factors, factors]) if factors.ndim == 1 else np.ascontiguousarray(factors)
    bad = np.argwhere(~np.isfinite(pairs))
    if bad.size:
        row, column = bad[0]
        raise InputError("out-of-range", f"scales[{row}]", f"{pairs[row, column]:g}", bound="that is finite")
    return pairs


def _shape(array: NDArray[Any]) -> str:
    return " x ".join(map(str, array.shape)) or "one number"
