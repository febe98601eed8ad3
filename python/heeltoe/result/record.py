"""The result of an analysis: one immutable record of plain data, which verdict, limits and comparison read."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Generic, Self, TypeVar, overload

from heeltoe.base.blocks import Block
from heeltoe.base.frozen import FrozenDict
from heeltoe.mechanics.block import StaticState
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.crest import CrestMotion
from heeltoe.result.histories import EventLog, Histories
from heeltoe.result.judge import LimitCheck, leading_crack
from heeltoe.result.numbers import (
    OF_SEVERAL,
    AnchorForce,
    BlockBond,
    Chosen,
    CrackNumbers,
    CrossValley,
    Energy,
    FrictionBand,
    FrictionEffect,
    FrictionLawState,
    Roughness,
    SignNumbers,
    SlipByMode,
    Spread,
    Stage,
    TimeByMode,
)
from heeltoe.result.outcome import Outcome
from heeltoe.result.quantity import quantities_of
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

T = TypeVar("T")


class Of(Generic[T]):
    """A number of a crack, or of the dam, as an attribute by the same name; none where the run never started."""

    def __init__(self, name: str = "") -> None:
        self._name = name

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, response: None, owner: type) -> Self: ...
    @overload
    def __get__(self, response: Numbered, owner: type) -> T: ...
    def __get__(self, response: Numbered | None, owner: type) -> Self | T:
        if response is None:
            return self
        numbers = response.numbers
        block = numbers if numbers is None or hasattr(numbers, self._name) else response.of_dam
        if block is not None and hasattr(block, self._name):
            value: T = getattr(block, self._name)
            return value
        raise AttributeError(f"a {owner.__name__} without a run, or of another model, has no {self._name!r}")


class Numbered(ABC):
    """A holder of the numbers of a crack, each an attribute by its JSON name, with the meaning that
    :mod:`heeltoe.result.numbers` states."""

    @property
    @abstractmethod
    def numbers(self) -> CrackNumbers | None:
        """The numbers of the crack, by their JSON names (SI); None where the run never started."""

    @property
    def scatters(self) -> bool:
        """Whether single runs of the crack scatter, so that its headline numbers are means."""
        evidence = getattr(self.numbers, "evidence", None)
        return evidence is not None and bool(evidence.scatters)

    @property
    def of_dam(self) -> Block | None:
        """Numbers of the dam as a whole; None for a block."""
        return None

    residual_slip_m = Of[float]()
    peak_slip_downstream_m = Of[float]()
    peak_slip_upstream_m = Of[float]()
    rocking_downstream_rad = Of[float]()
    rocking_upstream_rad = Of[float]()
    opening_upstream_m = Of[float]()
    opening_downstream_m = Of[float]()
    largest_gap_heel_m = Of[float]()
    largest_gap_toe_m = Of[float]()
    slip_by_mode_m = Of[SlipByMode]()
    time_by_mode_s = Of[TimeByMode]()
    impacts = Of[int]()
    largest_impact_velocity_m_s = Of[float]()
    final_mode = Of[str]()
    final_slip_velocity_m_s = Of[float]()
    end_time_s = Of[float]()
    crack_width_m = Of[float]()
    uplift_during_shaking = Of[str]()
    anchors = Of[list[AnchorForce] | None]()
    events = Of[int]()
    rotation = Of[str]()
    friction_law = Of[FrictionLawState | None]()
    roughness = Of[Roughness | None]()
    bond = Of[BlockBond | None]()
    cross_valley = Of[CrossValley | None]()
    drainage_by_motion = Of[list[float] | None]()
    overturned_about = Of[str | None]()


# The field of a quantity is its row: it needs no other to be an attribute.
for _quantity in quantities_of(CrackNumbers):
    if not hasattr(Numbered, _quantity.key):
        setattr(Numbered, _quantity.key, Of[float](_quantity.key))


@dataclass(frozen=True, eq=False, kw_only=True)
class CrackResponse(Numbered):
    """The result of one crack.

    Attributes
    ----------
    elevation
        Of its upstream end above the lowest point of the section [m].
    of_crack
        Its numbers, by their JSON names (SI); None where the run never started.
    histories
        Columns of equal length, by name with unit; the first is ``time_s``.
    mode
        Mode of motion at each moment of the histories, by name.
    event_log
        Columns of equal length: every event with time, kind, modes, state, impulses.
    static
        State under the static loads: safety factors, resultant, critical accelerations.
    sequence
        What each motion does to it where the dam meets several, one after the other.
    """

    elevation: float
    of_crack: CrackNumbers | None
    histories: Histories
    mode: tuple[str, ...]
    event_log: EventLog
    static: StaticState
    sequence: tuple[Stage, ...] = ()

    def __post_init__(self) -> None:
        for name, kind in (("histories", Histories), ("event_log", EventLog)):
            if not isinstance(columns := getattr(self, name), kind):
                object.__setattr__(self, name, kind(columns))

    @property
    def numbers(self) -> CrackNumbers | None:
        """The numbers of the crack, by their JSON names (SI); None where the run never started."""
        return self.of_crack

    def __getitem__(self, name: str) -> Any:
        """Return a number by its JSON name."""
        return self.to_json()[name]

    def to_json(self) -> dict[str, Any]:
        """Return what the JSON has of one of several cracks."""
        numbers = {} if self.of_crack is None else self.of_crack.to_json()
        stages = {"sequence": [stage.to_json() for stage in self.sequence]} if self.sequence else {}
        return {"elevation_m": self.elevation, **numbers, **stages}


@dataclass(frozen=True, eq=False, kw_only=True)
class ResponseData(Numbered):
    """Data of one analysis. Signs: slip is positive downstream, rotation positive counter-clockwise (upstream).

    Attributes
    ----------
    model
        ``"rigid"``, ``"decoupled"`` or ``"flexible"``.
    title
        Title of the case.
    outcome, advice
        How the run ended, and what to do about it where there is no result.
    warnings
        Everything a reader must know before using the numbers.
    energy
        The ledger; None where the run never started.
    motion, vertical, cross
        The ground motions, as used: along the stream, upward and across the valley.
    gravity
        One g of the case [m/s2].
    cracks
        What each crack did, from the crest down: one or many.
    asked
        Which of them leads, as it slips most: its numbers, histories and static state are those of the response.
    dam
        What the dam did as a whole, beside its cracks; None of a block.
    references
        Sources of the methods used.
    spread
        The same run with slightly weaker and stronger shaking, where that was asked for.
    limits
        The results beside the limits that the user has set; none of a block beside a better model, which is judged.
    chosen
        Why it is this model.
    beside
        What a simpler model makes of the same case and motion, where that was run, too.
    seconds
        How long it took to compute [s]; building the elastic parts is part of it.
    silence_s
        How long the run goes on after the ground motion has ended, until the dam is at rest [s].
    signs
        What the motion does as recorded and reversed, where both were run: the response is that of the worse way.
    friction_band
        Results with other frictions of the crack, where the case has a band of them.
    friction_effect
        The result with a little less friction, where it has none.
    crest
        How the crest moves; None where the model does not say.
    """

    model: str
    title: str
    outcome: Outcome
    advice: Sentence | None
    warnings: tuple[Notice, ...]
    energy: Energy | None
    motion: GroundMotion
    vertical: GroundMotion | None
    cross: GroundMotion | None = None
    gravity: float
    cracks: tuple[CrackResponse, ...]
    asked: int = 0
    dam: Block | None = None
    references: tuple[str, ...] = field(default=())
    spread: Spread | None = None
    limits: tuple[LimitCheck, ...] = ()
    chosen: Chosen | None = None
    beside: ResponseData | None = None
    seconds: float = 0.0
    silence_s: float = 0.0
    signs: tuple[SignNumbers, ...] = ()
    friction_band: FrictionBand | None = None
    friction_effect: FrictionEffect | None = None
    crest: CrestMotion | None = None

    #: Whether the parts of the dam are elastic, so that both ends of a crack shift with nothing happening to the dam.
    elastic: ClassVar[bool] = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "outcome", Outcome(self.outcome))

    def __getstate__(self) -> dict[str, object]:
        """Return the fields alone: what is made of them can be made again."""
        return {name: value for name, value in vars(self).items() if name != "summary"}

    @property
    def ok(self) -> bool:
        """Whether the run ended with a result to trust."""
        return self.outcome.has_result

    @property
    def components(self) -> tuple[GroundMotion | None, ...]:
        """The ground motions, as used: along the stream, upward and, where there is one, across the valley."""
        return (self.motion, self.vertical) if self.cross is None else (self.motion, self.vertical, self.cross)

    @property
    def started(self) -> bool:
        """Whether there was a run: a dam that does not stand is not run."""
        return self.numbers is not None

    @property
    def numbers(self) -> CrackNumbers | None:
        """The numbers of the crack that leads, by their JSON names (SI); None where the run never started."""
        return self.cracks[self.asked].of_crack

    @property
    def of_dam(self) -> Block | None:
        """The numbers of the dam as a whole; None of a block."""
        return self.dam

    @cached_property
    def summary(self) -> Mapping[str, Any]:
        """All numbers of the crack that leads and of the dam, by their JSON names; empty where no run started."""
        if self.numbers is None:
            return {}
        of_crack = {name: value for name, value in self.numbers.items() if name not in OF_SEVERAL}
        return FrozenDict({**of_crack, **(self.dam or {})})

    @property
    def histories(self) -> Histories:
        """Columns of equal length, by name with unit; the first is ``time_s``."""
        return self.cracks[self.asked].histories

    @property
    def mode(self) -> tuple[str, ...]:
        """Mode of motion at each moment of the histories, by name."""
        return self.cracks[self.asked].mode

    @property
    def event_log(self) -> EventLog:
        """Columns of equal length: every event with time, kind, modes, state, impulses."""
        return self.cracks[self.asked].event_log

    @property
    def static(self) -> StaticState:
        """State under the static loads: safety factors, resultant, critical accelerations."""
        return self.cracks[self.asked].static

    @property
    def sequence(self) -> tuple[Stage, ...]:
        """The result of each motion where the dam meets several, one after the other."""
        return self.cracks[self.asked].sequence

    @property
    def several(self) -> bool:
        """Whether the dam has several cracks, and there was a run."""
        return self.started and len(self.cracks) > 1

    @property
    def governing_crack(self) -> int:
        """Which of several cracks slips most, from the crest down; its numbers are those of the response."""
        return leading_crack([crack.residual_slip_m for crack in self.cracks])

    @property
    def others(self) -> Mapping[str, Self]:
        """The response at each of several cracks but the one that leads, by name: counted from the crest down."""
        places = range(len(self.cracks)) if self.several else ()
        return {f"crack-{place + 1}": self.at_crack(place) for place in places if place != self.asked}

    def at_crack(self, place: int) -> Self:
        """Return the response of one of several cracks alone, from the crest down; its limits, its spread and what
        stands beside it are left out."""
        crack = self.cracks[place]
        title = f"{self.title or 'Dam'}, crack at {crack.elevation:g} m"
        return replace(self, title=title, cracks=(crack,), asked=0, limits=(), spread=None, beside=None)

    def with_crack(self, place: int | None = None, **changes: Any) -> Self:
        """Return the response with other fields of one of its cracks: the one that leads where none is named."""
        at = self.asked if place is None else place
        cracks = [replace(crack, **changes) if k == at else crack for k, crack in enumerate(self.cracks)]
        return replace(self, cracks=tuple(cracks))

    def lets_go(self) -> bool:
        """Whether there are moments in which the whole dam can slide; a block slides as a whole or not at all."""
        return True

    def citation(self) -> tuple[str, ...]:
        """Return the references for exactly the methods and options this result used."""
        return self.references
