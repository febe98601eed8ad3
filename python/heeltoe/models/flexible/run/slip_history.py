"""History of slip of a crack with a friction law, contact by contact, by the names of the contract."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.case.crack.law import Law
from heeltoe.case.model import Case
from heeltoe.kernel.dam import DamRun
from heeltoe.kernel.friction import shear_stress
from heeltoe.mechanics.friction import friction_of, law_of, range_of
from heeltoe.models.flexible.body.reduced import FlexibleDam
from heeltoe.result.numbers import ElasticFrictionLaw
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

#: A smaller part of a crack beyond the range of its law is not told.
_PART = 0.05


def sliding_friction(alone: Case, place: int, dam: FlexibleDam) -> float:
    """Return the coefficient with which a crack slips, of the case with it `alone`; by a law, what all slip leaves
    under the static loads."""
    force = float(dam.crack_forces[place][1].sum())
    return friction_of(alone.crack, force, dam.sections[place].crack_width)[1]


@dataclass(frozen=True, eq=False)
class Worn:
    """The contacts of a crack with a law that are there from the beginning; n contacts.

    Attributes
    ----------
    law
        That of the case.
    length
        (n,) their shares of the length of the crack [m].
    stress
        (n,) normal stress under the static loads [Pa].
    path, path_before
        (n,) slipped to and fro, in the end and before the earthquake [m].
    bonded, bonded_before
        (n,) whether the bond is whole but for that.
    """

    law: Law
    length: Floats
    stress: Floats
    path: Floats
    path_before: Floats
    bonded: Floats
    bonded_before: Floats

    @property
    def pressed(self) -> NDArray[np.bool_]:
        """Which of them the static loads press."""
        return self.stress > 0.0

    def mean(self, values: Floats) -> float:
        """Return a mean over the length of the crack."""
        return float(self.length @ values / self.length.sum())

    def borne(self, path: Floats, bonded: Floats) -> Floats:
        """Return the shear stress that each bears at rest under the static loads [Pa]."""
        borne: Floats = shear_stress(law_of(self.law), self.stress, path, 0.0, bonded)[0]
        return borne

    def apparent(self, path: Floats, bonded: Floats) -> tuple[float, list[float]]:
        """Return the ratio of shear strength to normal force of the crack, and the least and largest of a pressed
        contact."""
        borne, pressed = self.borne(path, bonded), self.pressed
        friction = borne[pressed] / self.stress[pressed]
        whole = float(self.length @ borne) / max(float(self.length @ self.stress), 1.0)
        return whole, [float(friction.min()), float(friction.max())] if friction.size else [whole, whole]


def worn_of(alone: Case, place: int, dam: FlexibleDam, run: DamRun) -> Worn | None:
    """Return what the contacts of a crack have been through, of the case with it `alone`; None of constant
    coefficients."""
    if alone.crack.law is None:
        return None
    column = run.worked
    # Ends and corners that come in place of others are no more of the crack.
    own = (column.crack == place) & (column.double == 0.0)
    length, force = column.length[own], column.normal_force_before[own]
    if not dam.start.stands:
        # There are no forces of a state in which nothing moves.
        force = length * max(float(dam.crack_forces[place][1].sum()), 0.0) / length.sum()
    through = (column.path, column.path_before, column.bonded, column.bonded_before)
    return Worn(alone.crack.law, length, np.maximum(force, 0.0) / length, *(values[own] for values in through))


def law_result(worn: Worn, run: DamRun, place: int) -> ElasticFrictionLaw:
    """Return the state of a friction law at the end: slip distance of the crack, and its friction under the static
    loads before and after it, as a whole and by contact."""
    path = worn.path - worn.path_before
    before, range_before = worn.apparent(worn.path_before, worn.bonded_before)
    after, range_after = worn.apparent(worn.path, worn.bonded)
    left = worn.borne(worn.path, worn.bonded) - worn.borne(worn.path, np.zeros_like(worn.path))
    cohesive = worn.law.cohesion is not None
    return ElasticFrictionLaw(
        name=worn.law.name,
        slip_path_m=worn.mean(path),
        slip_path_range_m=[float(path.min()), float(path.max())],
        normal_stress_pa=worn.mean(worn.stress),
        normal_stress_range_pa=[float(worn.stress.min()), float(worn.stress.max())],
        apparent_friction_before=before,
        apparent_friction_before_range=range_before,
        apparent_friction_after=after,
        apparent_friction_after_range=range_after,
        cohesion_left_pa=worn.mean(left) if cohesive else None,
        bond_energy_j=run.summaries[place].bond_energy if cohesive else None,
        surface=worn.law.surface,
    )


def law_warnings(worn: Worn, where: Sentence | str = "") -> list[Notice]:
    """Say where a friction law is used beyond what it was made for: under the mean of the static loads, or at more than
    a twentieth of the crack; `where` tells it from other cracks."""
    mean = worn.mean(worn.stress)
    why = range_of(worn.law, mean)
    if why is not None:
        return [Notice("law-range", "mean", stress_pa=mean, why=why, where=where)]
    outside: dict[str, float] = {}
    for stress, length in zip(worn.stress[worn.pressed], worn.length[worn.pressed], strict=True):
        why = range_of(worn.law, float(stress))
        if why is not None:
            outside[why] = outside.get(why, 0.0) + float(length) / float(worn.length.sum())
    return [
        Notice("law-range", "part", share=share, why=why, where=where)
        for why, share in outside.items()
        if share > _PART
    ]
