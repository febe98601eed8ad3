"""What a run of two blocks returns beside what every run returns."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

from heeltoe.arrays import Floats
from heeltoe.result.response import Response


@dataclass(frozen=True, eq=False)
class AtBlock:
    """What one of two cracks did.

    Attributes
    ----------
    elevation
        Of its upstream end above the lowest point of the section [m].
    summary, histories, mode, event_log, static
        As in :class:`~heeltoe.result.response.Response`, of this crack.
    """

    elevation: float
    summary: Mapping[str, Any]
    histories: Mapping[str, Floats]
    mode: tuple[str, ...]
    event_log: Mapping[str, Any]
    static: Mapping[str, Any]


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class StackResponse(Response):
    """Result of two rigid blocks; signs and attributes as in :class:`~heeltoe.result.response.Response`.

    Attributes
    ----------
    at_cracks
        What each crack did, from the crest down; empty where the run never started.
    asked
        Which of them is that of ``[crack]``.
    """

    at_cracks: tuple[AtBlock, ...] = field(default=())
    asked: int = 0

    def at_crack(self, place: int) -> Self:
        """Return the response with numbers, histories and events of one of the cracks, from the crest down, in the
        place of those of ``[crack]``; its limits and spread are left out."""
        found = self.at_cracks[place]
        return replace(
            self,
            title=f"{self.title or 'Dam'}, crack at {found.elevation:g} m",
            summary={**self.summary, **found.summary},
            histories=found.histories,
            mode=found.mode,
            event_log=found.event_log,
            static=found.static,
            at_cracks=(),
            limits=(),
            spread=None,
        )

    @property
    def place(self) -> int:
        """Which crack is that of ``[crack]``, from the crest down."""
        return self.asked

    @property
    def others(self) -> Mapping[str, Response]:
        """The response at each crack but that of ``[crack]``, by name: counted from the crest down."""
        places = [place for place in range(len(self.at_cracks)) if place != self.asked]
        return {f"crack-{place + 1}": self.at_crack(place) for place in places}

    @property
    def histories_of_cracks(self) -> tuple[Mapping[str, Floats], ...]:
        """The histories of each crack, from the crest down."""
        return tuple(each.histories for each in self.at_cracks) or (self.histories,)

    @property
    def event_logs(self) -> tuple[Mapping[str, Any], ...]:
        """The events of each crack, from the crest down."""
        return tuple(each.event_log for each in self.at_cracks) or (self.event_log,)

    @property
    def final_modes(self) -> tuple[str, ...]:
        """The mode of motion of each crack at the end, from the crest down."""
        return tuple(each.summary["final_mode"] for each in self.at_cracks) or (self.final_mode,)
