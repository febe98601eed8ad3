"""A friction law as the kernels know it: they alone have its formulas, whoever asks for a number."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.kernel import _kernel

FrictionLaw = _kernel.FrictionLaw
#: Names of the laws, as the kernels have them.
LAWS = tuple(_kernel.LAWS)
#: Names of their numbers, in the order of the kernels.
LAW = tuple(_kernel.LAW_FIELDS)


def friction_law(shape: str, numbers: Mapping[str, float], points: Sequence[tuple[float, float]] = ()) -> FrictionLaw:
    """Return a law of a shape of :data:`LAWS`, with its numbers by the names of :data:`LAW`, those not given zero.

    Raises
    ------
    KeyError
        Where a name is none of :data:`LAW`.
    """
    unknown = set(numbers) - set(LAW)
    if unknown:
        raise KeyError(f"no such number of a law: {unknown}")
    row = np.array([numbers.get(name, 0.0) for name in LAW], dtype=np.float64)
    return FrictionLaw(shape, row, np.array(points, dtype=np.float64).reshape(-1, 2))


def shear_stress(
    law: FrictionLaw,
    stress: Floats | float,
    path: Floats | float = 0.0,
    speed: Floats | float = 0.0,
    bonded: Floats | float = 1.0,
) -> Floats:
    """Return the shear stresses that a law bears at rest and sliding, (2, ...) [Pa], at normal stresses [Pa], paths
    slipped [m] and speeds [m/s], with the bond whole or broken."""
    every = np.broadcast_arrays(stress, speed, path, bonded)
    flat = [np.ascontiguousarray(array, dtype=np.float64).reshape(-1) for array in every]
    return law.shear_stress(*flat).T.reshape(2, *every[0].shape)
