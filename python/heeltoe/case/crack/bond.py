"""The bond of a joint that is not cracked: the block ``[crack.bond]``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field, model_validator

from heeltoe.case.fields import Fields
from heeltoe.case.quantities import DimensionlessNumber, FractureEnergy, Pressure
from heeltoe.case.sentences import gathered
from heeltoe.errors.error import InputError


class Bond(Fields):
    """The bond of a joint: with it the crack is not there before the earthquake breaks it. No value has a default: the
    strength of lift joints and of the base differs from dam to dam, and cores give it."""

    tensile_strength: Annotated[Pressure, Field(ge=1.0, le=1e9)]
    """Static tensile strength across the joint; that of the mass concrete itself is 1 to 3 MPa, that of a joint
    less."""
    cohesion: Annotated[Pressure, Field(ge=1.0, le=1e9)]
    """Static shear strength without normal stress; at least friction times the tensile strength, where the line of the
    shear strength ends."""
    fracture_energy: Annotated[FractureEnergy, Field(ge=1e-3, le=1e7)]
    """Energy for each area that opens; mass concrete takes 100 to 300 N/m, a joint less."""
    shear_energy: Annotated[FractureEnergy, Field(ge=1e-3, le=1e7)]
    """Energy for each area that is sheared off, beside friction."""
    initial_energy: Annotated[FractureEnergy, Field(ge=1e-3, le=1e7)] | None = None
    """Energy below the first of two straight lines of softening, were it to go on to zero; they meet at a quarter of
    the strength. In concrete it is 40 % of `fracture_energy`. Without it there is one line. Shear softens alike."""
    dynamic_factor: Annotated[DimensionlessNumber, Field(ge=1.0, le=3.0)] = 1.0
    """Factor on both strengths during the earthquake; 1 takes the static ones."""

    @property
    def first_share(self) -> float:
        """Share of the energies that belongs to the first line of softening; 1 where there is one line."""
        return 1.0 if self.initial_energy is None else self.initial_energy / self.fracture_energy

    @model_validator(mode="after")
    @gathered
    def _initial_within_all(self) -> Iterator[InputError]:
        if self.first_share > 1.0:
            bound = f"of at most fracture_energy, {self.fracture_energy:g} N/m"
            yield InputError("out-of-range", "initial_energy", f"{self.initial_energy:g} N/m", bound=bound)
