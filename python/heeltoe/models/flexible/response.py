"""What a run of the flexible model returns beside what every run returns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, ClassVar, Self

from heeltoe.arrays import Floats
from heeltoe.result.response import Of, Response

# Not at run time: who asks whether a response is one of these need not wait for the elastic parts.
if TYPE_CHECKING:
    from heeltoe.models.flexible.history import CrackHistory
    from heeltoe.models.flexible.stress.envelope import PartEnvelope
    from heeltoe.result.sequence import Stage

# A crack that lets go for less than this in all [s] moves no dam.
_LETS_GO_S = 0.02


@dataclass(frozen=True, eq=False)
class AtCrack:
    """What one of several cracks did.

    Attributes
    ----------
    elevation
        Of its upstream end above the lowest point of the section [m].
    summary, histories, mode, crack, sequence
        As in :class:`FlexibleResponse`, of this crack.
    """

    elevation: float
    summary: Mapping[str, Any]
    histories: Mapping[str, Floats]
    mode: tuple[str, ...]
    crack: CrackHistory
    sequence: tuple[Stage, ...] = ()


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class FlexibleResponse(Response):
    """Result of the flexible model, signs and attributes as in :class:`~heeltoe.result.response.Response`.

    Attributes
    ----------
    crack
        What crack and parts did, frame by frame.
    envelope
        The largest stresses of each part over the run, from the crest down.
    at_cracks
        Of several cracks what each did, from the crest down; empty where there is one.
    """

    crack: CrackHistory
    envelope: tuple[PartEnvelope, ...]
    at_cracks: tuple[AtCrack, ...] = field(default=())

    def at_crack(self, place: int) -> Self:
        """Return the response with numbers and histories of one of several cracks, from the crest down, in the place of
        those of ``[crack]``; its limits, its spread and what stands beside it are left out."""
        found = self.at_cracks[place]
        return replace(
            self,
            title=f"{self.title or 'Dam'}, crack at {found.elevation:g} m",
            summary={**self.summary, **found.summary},
            histories=found.histories,
            mode=found.mode,
            crack=found.crack,
            sequence=found.sequence,
            at_cracks=(),
            limits=(),
            spread=None,
            beside=None,
        )

    def with_sequences(self, found: Sequence[tuple[Stage, ...]]) -> Self:
        """Return the response with what each motion of a sequence does to each crack, from the crest down."""
        told = [
            {**each, "sequence": [stage.to_json() for stage in stages]}
            for each, stages in zip(self.summary["cracks"], found, strict=True)
        ]
        pairs = zip(self.at_cracks, found, strict=True)
        return replace(
            self,
            sequence=found[self.crack.place],
            summary={**self.summary, "cracks": told},
            at_cracks=tuple(replace(each, sequence=stages) for each, stages in pairs),
        )

    @property
    def place(self) -> int:
        """Which of several cracks is that of ``[crack]``, from the crest down."""
        return self.crack.place

    @property
    def others(self) -> Mapping[str, Self]:
        """The response at each of several cracks but that of ``[crack]``, by name: counted from the crest down."""
        places = [place for place in range(len(self.at_cracks)) if place != self.crack.place]
        return {f"crack-{place + 1}": self.at_crack(place) for place in places}

    elastic: ClassVar[bool] = True

    penetration_m = Of[Mapping[str, float]]("Deepest into the other face: of watched nodes, of any in a frame [m].")
    elastic_give = Of[Mapping[str, float]]("Rotation [rad] and gap [m] from which on it rocks and drifts.")
    peak_normal_force_n = Of[float]("Largest force across the crack [N].")
    periods_s = Of[list[float]]("Of the intact dam with its water, longest first [s].")
    mesh = Of[Mapping[str, Any]]("Elements, nodes and modes of each part, nodes along the crack, error of the basis.")
    damping = Of[str]("What the case says of it.")
    damping_ratio = Of[float]("Of the concrete.")
    damping_ratios = Of[list[float]]("What modes 1 to 5 of the intact dam really get.")
    rayleigh_mass_1_s = Of[float | None]("Rayleigh coefficient of mass [1/s].")
    rayleigh_stiffness_s = Of[float | None]("Rayleigh coefficient of stiffness [s].")
    before_shaking = Of[Mapping[str, Any] | None](
        "Whether the dam stands with its crack let go, what slips and opens then; None with penalties."
    )
    self_excitation = Of[Mapping[str, float | None] | None](
        "How fast a vibration grows as the dam slides; None where it does not slide."
    )
    tension = Of[Mapping[str, Any] | None](
        "The largest tension over the run, where and when, and whether the concrete bears it; None where it has no "
        "bound anywhere."
    )
    contact = Of[str]("What the case says of it.")
    steps = Of[int]("How many.")
    time_step_s = Of[float]("Their length [s].")
    contact_iterations_per_step = Of[float]("Tries until the contact forces are found.")
    contact_residual = Of[float]("Worst violation of the contact conditions, over the impulse.")
    evidence = Of[Mapping[str, Any] | None](
        "How far step, mesh and 1 % of the shaking move it; None where none was wanted."
    )

    @property
    def histories_of_cracks(self) -> tuple[Mapping[str, Floats], ...]:
        """The histories of each crack, from the crest down."""
        return tuple(each.histories for each in self.at_cracks) or (self.histories,)

    def lets_go(self) -> bool:
        """Whether there are moments in which the part above the crack slides or rocks as a whole.

        Otherwise the crack slips here and then there, while more than half of what touches holds.
        """
        return sum(self.time_by_mode_s.values()) - self.time_by_mode_s["rest"] >= _LETS_GO_S
