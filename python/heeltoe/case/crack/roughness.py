"""A rough crack: the block ``[crack.roughness]``."""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import Field

from heeltoe.case.fields import Fields
from heeltoe.case.quantities import Length, WearCoefficient


class Roughness(Fields):
    """Asperities of the crack: a sawtooth on both faces, mated before the earthquake."""

    asperity_height: Annotated[Length, Field(ge=0.0, le=10.0)]
    """Height of the asperities, from valley to peak: how far the crack dilates at most."""
    wave_length: Annotated[Length, Field(gt=0.0, le=1000.0)]
    """From peak to peak; the flanks rise by twice the height over this."""
    wear: Annotated[WearCoefficient, Field(ge=0.0, le=1.0)] = Field(default="0 m^2/J", validate_default=True)
    """Loss of the angle of the flanks per plastic work: c in i = i0 exp(-c W), W the work of friction per area of the
    crack. Without it nothing wears."""

    @property
    def slope(self) -> float:
        """Slope of the flanks before anything has worn them."""
        return 2.0 * self.asperity_height / self.wave_length

    @property
    def angle(self) -> float:
        """Angle of the flanks before anything has worn them [rad]."""
        return math.atan(self.slope)

    def worn(self, work: float) -> float:
        """Return the angle after this much plastic work [J/m^2]."""
        return self.angle * math.exp(-self.wear * work)
