"""The bond of a joint that is not cracked: the block ``[crack.bond]``."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from heeltoe.case.fields import Fields
from heeltoe.case.quantities import DimensionlessNumber, FractureEnergy, Pressure


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
    dynamic_factor: Annotated[DimensionlessNumber, Field(ge=1.0, le=3.0)] = 1.0
    """Factor on both strengths during the earthquake; 1 takes the static ones."""
