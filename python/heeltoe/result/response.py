"""Response of a dam: one immutable :class:`Response` with its evidence and warnings."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Self, TypeVar

from heeltoe.base.atomic_files import written
from heeltoe.base.blocks import plain_json
from heeltoe.base.display import Shown
from heeltoe.base.pandas import dataframe
from heeltoe.base.table import table
from heeltoe.errors.sanitize import plain
from heeltoe.kernel.build import build_info
from heeltoe.result.comparison import meaning, ratio
from heeltoe.result.record import ResponseData
from heeltoe.result.verdict import verdict
from heeltoe.result.write import motion_json, static_json, write_table

if TYPE_CHECKING:
    import pyarrow as pa

R = TypeVar("R", bound="Response")


class Change(Protocol):
    """Makes a response of the same kind of one."""

    def __call__(self, response: R, /) -> R: ...


@dataclass(frozen=True, eq=False, kw_only=True)
class Response(ResponseData, Shown):
    """Result of one analysis: its data, and what its JSON, verdict, tables and files say of them."""

    beside: Response | None = None

    def __repr__(self) -> str:
        beside = "" if self.beside is None else f" with the {self.beside.model} one beside it"
        title = self.title or "untitled case"
        shaken = f"{plain(self.motion.name)}, peak {self.motion.pga / self.gravity:.4g} g"
        count = sum(len(response.warnings) for response in self.responses)
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

    def meaning(self, units: str = "si", *, brief: bool = False) -> str:
        """Say in a sentence what the difference to the one beside it means, in units ``"si"`` or ``"us"``; a brief
        meaning leaves out the reason and the source."""
        return "" if self.beside is None else meaning(self, self.beside, units, brief=brief)

    def to_json(self) -> dict[str, Any]:
        """Return the contract: a dictionary of plain numbers, strings and lists."""
        several = {}
        if self.several:
            several = {"governing_crack": self.governing_crack, "cracks": [crack.to_json() for crack in self.cracks]}
        return {
            "model": self.model,
            "chosen": None if self.chosen is None else self.chosen.to_json(),
            "title": self.title,
            "outcome": self.outcome,
            "advice": None if self.advice is None else str(self.advice),
            "verdict": verdict(self),
            "warnings": [notice.to_json() for notice in self.warnings],
            **plain_json(self.summary),
            **several,
            **({} if self.crest is None else {"crest": self.crest.to_json()}),
            "silence_s": self.silence_s,
            **static_json(self.static),
            "energy": None if self.energy is None else self.energy.to_json(),
            **({} if self.spread is None else {"spread": self.spread.to_json()}),
            **({"sequence": [stage.to_json() for stage in self.sequence]} if self.sequence else {}),
            **({"signs": [way.to_json() for way in self.signs]} if self.signs else {}),
            **({} if self.friction_band is None else {"friction_band": self.friction_band.to_json()}),
            **({} if self.friction_effect is None else {"friction_effect": self.friction_effect.to_json()}),
            "limits": [check.to_json() for check in self.limits],
            "motion": motion_json(self.motion, self.gravity),
            "vertical_motion": motion_json(self.vertical, self.gravity) if self.vertical else None,
            **({} if self.cross is None else {"cross_valley_motion": motion_json(self.cross, self.gravity)}),
            "references": list(self.references),
            "build": build_info(),
            **({} if self.beside is None else self._side_by_side(self.beside)),
        }

    def _side_by_side(self, beside: Response) -> dict[str, object]:
        return {"ratio": self.ratio(), "meaning": self.meaning(), "beside": beside.to_json()}

    def to_table(self) -> pa.Table:
        """Return the histories with the mode as a table."""
        return table({**self.histories, "mode": list(self.mode)})

    def to_pandas(self) -> Any:
        """Return the histories with the mode as a ``pandas.DataFrame``."""
        return dataframe({**self.histories, "mode": list(self.mode)})

    def events_table(self) -> pa.Table:
        """Return the events as a table."""
        return table(dict(self.event_log))

    def write_histories(self, path: Path) -> None:
        """Write the histories to `path`: CSV if it ends so, else Parquet."""
        with written(path) as fresh:
            write_table(self.to_table(), fresh)

    def write_events(self, path: Path) -> None:
        """Write the events to `path`: CSV if it ends so, else Parquet."""
        with written(path) as fresh:
            write_table(self.events_table(), fresh)
