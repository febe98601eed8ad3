"""What an analysis returns: one immutable :class:`Response` with its evidence and warnings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, ClassVar, Generic, Protocol, Self, TypeVar, overload

import pyarrow as pa

from heeltoe.arrays import Floats
from heeltoe.dataframe import dataframe
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.plain import plain
from heeltoe.result.beside import meaning, ratio
from heeltoe.result.contract import TOO_FAR
from heeltoe.result.limits import LimitCheck
from heeltoe.result.sequence import Stage
from heeltoe.result.verdict import verdict
from heeltoe.result.write import build_info, motion_json, static_json, write_table
from heeltoe.shown import Shown
from heeltoe.units.sentences import Sentence
from heeltoe.warnings import Notice
from heeltoe.whole import written

T = TypeVar("T")
R = TypeVar("R", bound="Response")

#: Outcomes of a run; only the first two come with a result to trust.
OUTCOMES = ("ok", "overturned", "unstable", "paradox", "event limit", "cycling", "lost", "blown up", TOO_FAR)


@dataclass(frozen=True)
class Energy:
    """The energy ledger of a run, per metre of dam.

    Attributes
    ----------
    input_j
        Work of water, weight, uplift and the ground's inertia force on the motion relative to the ground.
    friction_j, impact_j
        Energy lost in friction and in impacts, both positive.
    kinetic_j
        Kinetic energy left at the end; of elastic parts with their strain energy, less that at the start.
    residual
        What is left of the balance of all others, over the turnover; rounding if the run is sound.
    damping_j, numerical_j
        Lost in the concrete's damping, and by the time stepping itself; zero for a rigid block.
    gained_j
        Sum of what contact added in steps in which its work was positive; it should be nothing.
    """

    input_j: float
    friction_j: float
    impact_j: float
    kinetic_j: float
    residual: float
    damping_j: float = 0.0
    numerical_j: float = 0.0
    gained_j: float = 0.0


@dataclass(frozen=True)
class Chosen:
    """How a model came to be the one that the numbers are from.

    Attributes
    ----------
    asked
        What was asked for: a model, two of them, or ``"auto"``.
    why
        Why it is this model.
    """

    asked: str
    why: str


class Of(Generic[T]):
    """A number of the summary as an attribute of its response, by the same name; none where the run never started."""

    def __init__(self, doc: str) -> None:
        self.__doc__ = doc

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, response: None, owner: type) -> Self: ...
    @overload
    def __get__(self, response: Response, owner: type) -> T: ...
    def __get__(self, response: Response | None, owner: type) -> Self | T:
        if response is None:
            return self
        try:
            found: T = response.summary[self._name]
        except KeyError:
            said = f"a {owner.__name__} with outcome {response.outcome!r} has no {self._name!r}"
            raise AttributeError(said) from None
        return found


class Change(Protocol):
    """Makes a response of the same kind of one."""

    def __call__(self, response: R, /) -> R: ...


@dataclass(frozen=True, eq=False)
class Response(Shown):
    """Result of one analysis. Signs: slip is positive downstream, rotation positive counter-clockwise (upstream).

    Attributes
    ----------
    model
        ``"rigid"``, ``"decoupled"`` or ``"flexible"``.
    title
        Of the case.
    outcome, advice
        ``"ok"``, or what stopped the run and what to do about it.
    warnings
        Everything a reader must know before using the numbers.
    summary
        The numbers of the contract, by their JSON names (SI). Empty where the run never started.
    energy
        The ledger; None where the run never started.
    motion, vertical
        The ground motions, as used.
    gravity
        One g of the case [m/s2].
    histories
        Columns of equal length, by name with unit; the first is ``time_s``.
    mode
        Mode of motion at each moment of the histories, by name.
    event_log
        Columns of equal length: every event with time, kind, modes, state, impulses.
    static
        State under the static loads: safety factors, resultant, critical accelerations.
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
    sequence
        What each motion does where the dam meets several, one after the other.
    """

    model: str
    title: str
    outcome: str
    advice: Sentence | None
    warnings: tuple[Notice, ...]
    summary: Mapping[str, Any]
    energy: Energy | None
    motion: GroundMotion
    vertical: GroundMotion | None
    gravity: float
    histories: Mapping[str, Floats]
    mode: tuple[str, ...]
    event_log: Mapping[str, Any]
    static: Mapping[str, Any]
    references: tuple[str, ...] = field(default=())
    spread: Mapping[str, Any] | None = None
    limits: tuple[LimitCheck, ...] = ()
    chosen: Chosen | None = None
    beside: Response | None = None
    seconds: float = 0.0
    silence_s: float = 0.0
    sequence: tuple[Stage, ...] = ()

    def __post_init__(self) -> None:
        for name in ("summary", "histories", "event_log", "static"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))

    residual_slip_m = Of[float]("Slip at the end, positive downstream [m].")
    peak_slip_downstream_m = Of[float]("Largest slip on the way [m].")
    peak_slip_upstream_m = Of[float]("Least slip on the way: negative where it is upstream of the start [m].")
    rocking_downstream_rad = Of[float]("Largest rotation about the toe [rad].")
    rocking_upstream_rad = Of[float]("Largest rotation about the heel [rad].")
    opening_upstream_m = Of[float]("Largest opening of the crack at the upstream face [m].")
    opening_downstream_m = Of[float]("Largest opening of the crack at the downstream face [m].")
    largest_gap_heel_m = Of[float]("Largest gap at the heel, in the air included [m].")
    largest_gap_toe_m = Of[float]("Largest gap at the toe, in the air included [m].")
    slip_by_mode_m = Of[Mapping[str, float]]("Slip while sliding, in slide-rocking and in the air [m].")
    time_by_mode_s = Of[Mapping[str, float]]("How long each mode of motion lasts in all [s].")
    impacts = Of[int]("Blows; of an elastic dam those of the nodes of its crack.")
    largest_impact_velocity_m_s = Of[float]("Of approach [m/s].")
    final_mode = Of[str]("Mode of motion at the end.")
    final_slip_velocity_m_s = Of[float]("Positive downstream [m/s].")
    end_time_s = Of[float]("When the run ended [s].")
    crack_width_m = Of[float]("Width of the crack [m].")
    uplift_during_shaking = Of[str]("What the case says of it.")
    anchors = Of[list[dict[str, float | None]]]("Of each anchor: place, largest tension and capacity.")
    events = Of[int]("Changes of mode and impacts of a block.")
    rotation = Of[str]("Geometry of a block: small, p-delta or finite.")
    friction_law = Of[dict[str, Any] | None]("What the friction law of a crack has come to; null of coefficients.")
    roughness = Of[dict[str, Any] | None]("What the asperities of a rough crack have come to; null of a flat one.")
    drainage_by_motion = Of[list[float] | None](
        "Share of the drains' work that each motion of a sequence finds; null where it stays."
    )
    overturned_about = Of[str | None]("Corner about which a block has overturned.")
    cracks = Of[list[dict[str, Any]]]("What each of several cracks did, from the crest down.")
    governing_crack = Of[int]("Which of several cracks slips most, from the crest down.")

    #: Whether the parts of the dam are elastic, so that both ends of a crack shift with nothing happening to the dam.
    elastic: ClassVar[bool] = False

    def __repr__(self) -> str:
        beside = "" if self.beside is None else f" with the {self.beside.model} one beside it"
        title = self.title or "untitled case"
        shaken = f"{plain(self.motion.name)}, peak {self.motion.pga / self.gravity:.4g} g"
        count = sum(len(each.warnings) for each in self.responses)
        warned = f"\n  {count} warning{'s' if count > 1 else ''} in .warnings" if count else ""
        return f"<{type(self).__name__}: {self.model} model{beside}, {title!r}, {shaken}\n  {verdict(self)}{warned}>"

    @property
    def responses(self) -> tuple[Response, ...]:
        """Itself, after the one beside it."""
        return (self,) if self.beside is None else (self.beside, self)

    def with_responses(self, change: Change) -> Self:
        """Return itself changed, and the one beside it."""
        return replace(change(self), beside=None if self.beside is None else change(self.beside))

    def ratio(self) -> dict[str, float | None]:
        """Return this over the one beside it for slips, rotations and openings; None where that is next to nothing.

        There is none where there is nothing beside it.
        """
        return {} if self.beside is None else ratio(self, self.beside)

    def meaning(self, units: str = "si") -> str:
        """Say in a sentence what the difference to the one beside it means, in units ``"si"`` or ``"us"``."""
        return "" if self.beside is None else meaning(self, self.beside, units)

    @property
    def ok(self) -> bool:
        """Whether the run ended with a result to trust."""
        return self.outcome in ("ok", "overturned")

    @property
    def histories_of_cracks(self) -> tuple[Mapping[str, Floats], ...]:
        """The histories of each crack, from the crest down."""
        return (self.histories,)

    @property
    def place(self) -> int:
        """Which of several cracks is that of ``[crack]``, from the crest down."""
        return 0

    @property
    def others(self) -> Mapping[str, Response]:
        """The response at each of several cracks but that of ``[crack]``, by name: counted from the crest down."""
        return {}

    @property
    def event_logs(self) -> tuple[Mapping[str, Any], ...]:
        """The events of each crack, from the crest down."""
        return (self.event_log,)

    @property
    def final_modes(self) -> tuple[str, ...]:
        """The mode of motion of each crack at the end, from the crest down."""
        return (self.final_mode,)

    def lets_go(self) -> bool:
        """Whether there are moments in which the whole dam can slide; a block slides as a whole or not at all."""
        return True

    def citation(self) -> tuple[str, ...]:
        """Return the references for exactly the methods and options this result used."""
        return self.references

    def to_json(self) -> dict[str, Any]:
        """Return the contract: a dictionary of plain numbers, strings and lists."""
        energy = None
        if self.energy is not None:
            energy = asdict(self.energy)
        return {
            "model": self.model,
            "chosen": None if self.chosen is None else asdict(self.chosen),
            "title": self.title,
            "outcome": self.outcome,
            "advice": None if self.advice is None else str(self.advice),
            "verdict": verdict(self),
            "warnings": [each.to_json() for each in self.warnings],
            **self.summary,
            "silence_s": self.silence_s,
            **static_json(self.static),
            "energy": energy,
            **({} if self.spread is None else {"spread": dict(self.spread)}),
            **({"sequence": [each.to_json() for each in self.sequence]} if self.sequence else {}),
            "limits": [check.to_json() for check in self.limits],
            "motion": motion_json(self.motion, self.gravity),
            "vertical_motion": motion_json(self.vertical, self.gravity) if self.vertical else None,
            "references": list(self.references),
            "build": build_info(),
            **({} if self.beside is None else self._side_by_side(self.beside)),
        }

    def _side_by_side(self, beside: Response) -> dict[str, Any]:
        return {"ratio": self.ratio(), "meaning": self.meaning(), "beside": beside.to_json()}

    def to_table(self) -> pa.Table:
        """Return the histories with the mode as a table."""
        return pa.table({**self.histories, "mode": list(self.mode)})

    def to_pandas(self) -> Any:
        """Return the histories with the mode as a ``pandas.DataFrame``."""
        return dataframe({**self.histories, "mode": list(self.mode)})

    def events_table(self) -> pa.Table:
        """Return the events as a table."""
        return pa.table(dict(self.event_log))

    def write_histories(self, path: Path) -> None:
        """Write the histories to `path`: CSV if it ends so, else Parquet."""
        with written(path) as fresh:
            write_table(self.to_table(), fresh)

    def write_events(self, path: Path) -> None:
        """Write the events to `path`: CSV if it ends so, else Parquet."""
        with written(path) as fresh:
            write_table(self.events_table(), fresh)
