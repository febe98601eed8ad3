"""Response of the flexible model: the fields that it adds to every response."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from heeltoe.result.numbers import (
    AssumedRock,
    BeforeShaking,
    BondState,
    ElasticGive,
    EvidenceNumbers,
    FacePressure,
    Mesh,
    Penetration,
    SelfExcitation,
    Tension,
)
from heeltoe.result.record import CrackResponse, Of
from heeltoe.result.response import Response

# Not at run time: who asks whether a response is one of these need not wait for the elastic parts.
if TYPE_CHECKING:
    from heeltoe.models.flexible.result.envelope import PartEnvelope
    from heeltoe.models.flexible.result.history import CrackHistory

# A crack that lets go for less than this in all [s] moves no dam.
_LETS_GO_S = 0.02


@dataclass(frozen=True, eq=False, kw_only=True)
class ElasticCrackResponse(CrackResponse):
    """Response of one crack of an elastic dam, attributes as in :class:`~heeltoe.result.response.CrackResponse`.

    Attributes
    ----------
    frames
        What crack and parts did, frame by frame.
    """

    frames: CrackHistory

    joint = Of[BondState | None]()
    evidence = Of[EvidenceNumbers | None]()


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class FlexibleResponse(Response):
    """Result of the flexible model, signs and attributes as in :class:`~heeltoe.result.response.Response`.

    Attributes
    ----------
    envelope
        The largest stresses of each part over the run, from the crest down.
    """

    cracks: tuple[ElasticCrackResponse, ...]
    envelope: tuple[PartEnvelope, ...]

    elastic: ClassVar[bool] = True

    penetration_m = Of[Penetration]()
    elastic_give = Of[ElasticGive]()
    peak_normal_force_n = Of[float]()
    periods_s = Of[list[float]]()
    mesh = Of[Mesh]()
    damping = Of[str]()
    damping_ratio = Of[float]()
    damping_ratios = Of[list[float]]()
    rayleigh_mass_1_s = Of[float | None]()
    rayleigh_stiffness_s = Of[float | None]()
    before_shaking = Of[BeforeShaking | None]()
    self_excitation = Of[SelfExcitation | None]()
    assumed_rock = Of[AssumedRock | None]()
    tension = Of[Tension | None]()
    water_pressure = Of[list[FacePressure] | None]()
    contact = Of[str]()
    steps = Of[int]()
    time_step_s = Of[float]()
    contact_iterations_per_step = Of[float]()
    contact_residual = Of[float]()
    evidence = Of[EvidenceNumbers | None]()
    joint = Of[BondState | None]()

    @property
    def crack(self) -> CrackHistory:
        """Frames of the governing crack and the parts."""
        return self.cracks[self.asked].frames

    def lets_go(self) -> bool:
        """Whether there are moments in which the part above the crack slides or rocks as a whole.

        Otherwise the crack slips here and then there, while more than half of what touches holds.
        """
        times = self.time_by_mode_s
        return bool(sum(times.values()) - times.rest >= _LETS_GO_S)
