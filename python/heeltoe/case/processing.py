"""Steps of processing as a case file writes them: ``[[motion.processing]]`` with ``step = "band-pass"`` and so on.

The work is done in :mod:`heeltoe.motion.processing`; here are fields, units and defaults."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from heeltoe.case.fields import Fields, Fraction, Truth
from heeltoe.case.quantities import AccelerationField, DimensionlessNumber, Duration, Frequency, Velocity
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.processing import (
    Ends,
    band_pass,
    baseline,
    cut_significant,
    cut_to_window,
    scale_time,
    scale_to_arias,
    scale_to_spectrum,
    taper,
)

Corner = Annotated[Frequency, Field(gt=0.0, le=1e4)]
Order = Annotated[int, Field(strict=True, ge=1, le=10)]


class Step(Fields):
    """A step of processing."""

    # Whether it multiplies the motion by a number; a vertical component is then multiplied by the same.
    scales: ClassVar[bool] = False


class Baseline(Step):
    """Take a polynomial out of the velocity, so that the motion ends at rest."""

    step: Literal["baseline"]
    """Which step this is."""
    order: Order = 2
    """Degree of the polynomial of velocity over time."""
    displacement: Truth = False
    """Let the displacement end at zero too; wants an order of 2 or more."""

    def apply(self, motion: GroundMotion, gravity: float) -> GroundMotion:
        """Return the processed motion."""
        return baseline(motion, self.order, displacement=self.displacement)


class BandPass(Step):
    """Butterworth filter, forward and backward; with one corner alone a high-pass or a low-pass."""

    step: Literal["band-pass"]
    """Which step this is."""
    low: Corner | None = None
    """Lower corner frequency: slower motion is removed."""
    high: Corner | None = None
    """Upper corner frequency: faster motion is removed."""
    order: Order = 4
    """Order of the filter in each of its two passes."""

    def apply(self, motion: GroundMotion, gravity: float) -> GroundMotion:
        """Return the processed motion."""
        return band_pass(motion, self.low, self.high, self.order)


class Taper(Step):
    """Fade in and out with half a cosine."""

    step: Literal["taper"]
    """Which step this is."""
    share: Fraction = 0.05
    """Part of the duration at each end, up to a half."""
    ends: Ends = "both"
    """Which ends."""

    def apply(self, motion: GroundMotion, gravity: float) -> GroundMotion:
        """Return the processed motion."""
        return taper(motion, self.share, self.ends)


class CutSignificant(Step):
    """Keep the significant duration."""

    step: Literal["cut"]
    """Which step this is."""
    start: Fraction = 0.05
    """Share of the Arias intensity at which the motion begins."""
    end: Fraction = 0.95
    """Share of the Arias intensity at which it ends."""

    def apply(self, motion: GroundMotion, gravity: float) -> GroundMotion:
        """Return the processed motion."""
        return cut_significant(motion, self.start, self.end)


class CutToWindow(Step):
    """Keep what lies between two moments."""

    step: Literal["window"]
    """Which step this is."""
    start: Annotated[Duration, Field(ge=0.0)] = 0.0
    """Where the motion begins, from the begin of the record."""
    end: Annotated[Duration, Field(gt=0.0)] | None = None
    """Where it ends, from the begin of the record; at its end where it is not given."""

    def apply(self, motion: GroundMotion, gravity: float) -> GroundMotion:
        """Return the processed motion."""
        return cut_to_window(motion, self.start, self.end)


class ScaleToArias(Step):
    """Scale to an Arias intensity."""

    scales: ClassVar[bool] = True
    step: Literal["scale-to-arias"]
    """Which step this is."""
    intensity: Annotated[Velocity, Field(gt=0.0)]
    """The Arias intensity."""

    def apply(self, motion: GroundMotion, gravity: float) -> GroundMotion:
        """Return the processed motion."""
        return scale_to_arias(motion, self.intensity, gravity)


class ScaleToSpectrum(Step):
    """Scale to a spectral pseudo-acceleration at one period."""

    scales: ClassVar[bool] = True
    step: Literal["scale-to-spectrum"]
    """Which step this is."""
    period: Annotated[Duration, Field(ge=0.0, le=100.0)]
    """Period of the oscillator."""
    acceleration: AccelerationField
    """The pseudo-acceleration."""
    damping: Annotated[DimensionlessNumber, Field(ge=0.0, lt=1.0)] = 0.05
    """Damping ratio of the oscillator."""

    def apply(self, motion: GroundMotion, gravity: float) -> GroundMotion:
        """Return the processed motion."""
        return scale_to_spectrum(motion, self.period, self.acceleration.si(gravity), self.damping)


class ScaleTime(Step):
    """Stretch time, which changes the frequency content."""

    step: Literal["scale-time"]
    """Which step this is."""
    factor: Annotated[DimensionlessNumber, Field(gt=0.0)]
    """Above 1 the motion becomes longer and slower."""
    allow: Truth = False
    """Say that the change of the frequency content is meant."""

    def apply(self, motion: GroundMotion, gravity: float) -> GroundMotion:
        """Return the processed motion."""
        return scale_time(motion, self.factor, allow=self.allow)


CorrectionStep = Annotated[Baseline | BandPass | Taper | CutToWindow, Field(discriminator="step")]
"""A step that does the same to each component of an earthquake; its field ``step`` names it."""
ProcessingStep = Annotated[
    Baseline | BandPass | Taper | CutSignificant | CutToWindow | ScaleToArias | ScaleToSpectrum | ScaleTime,
    Field(discriminator="step"),
]
"""Any step, told by its field ``step``."""
