"""One line of a validation table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

#: Kinds of references: a test in a laboratory; mathematics; what the thesis, or a book, prints; an
#: independent program made for this; what a public program prints; another model or another run of ours; a condition
#: that a result must meet.
Kind = Literal["measured", "closed form", "thesis", "book", "prototype", "program", "own run", "condition"]


class Skipped(Exception):
    """A case cannot run here; the text says why."""


@dataclass(frozen=True)
class Row:
    """A number beside its reference.

    Attributes
    ----------
    what
        Which number, with its unit.
    reference, ours
        The two numbers.
    tolerance
        What the reference is good for: a larger deviation is none of its own doing. None where the reference cannot
        be reproduced and `remark` says why.
    relative
        Whether deviation and tolerance are relative to the reference.
    remark
        Where the reference comes from, why it is good for no more, the reason of a deviation.
    kind
        What kind of reference it is.
    explained
        Largest deviation that `remark` explains, where it is more than the tolerance: it is said, and no failure.
    finer
        Ours with half the step, where there is one and it was tried.
    digits
        How many digits another machine finds too, where these are fewer than the tolerance asks for: a motion that
        rings or is chaotic. None at all with 0.
    spread
        Least and most of ours under 1 % less to 1 % more shaking, where it was tried.
    """

    what: str
    reference: float
    ours: float
    tolerance: float | None
    relative: bool = True
    remark: str = ""
    kind: Kind = "closed form"
    explained: float | None = None
    digits: int | None = None
    finer: float | None = None
    spread: tuple[float, float] | None = None

    @property
    def deviation(self) -> float:
        """Ours less the reference, relative if the row is."""
        difference = self.ours - self.reference
        return difference / abs(self.reference) if self.relative else difference

    @property
    def deviates(self) -> bool:
        """Whether the deviation is more than the reference is good for, but explained."""
        return (
            self.tolerance is not None
            and self.explained is not None
            and self.tolerance < abs(self.deviation) <= self.explained
        )

    @property
    def holds(self) -> bool | None:
        """Whether the deviation is within the tolerance; None where none applies, or where it is explained."""
        if self.tolerance is None or self.deviates:
            return None
        return abs(self.deviation) <= self.tolerance

    @property
    def verdict(self) -> str:
        """The verdict in words."""
        if self.tolerance is None:
            return "no verdict"
        if self.deviates:
            return f"deviates: {self._share(abs(self.deviation))}, reference good for {self._share(self.tolerance)}"
        limit = "exactly" if self.tolerance == 0.0 else f"within {self._share(self.tolerance)}"
        if self.holds:
            return f"ok, {limit}"
        return f"NOT {limit}" if self.explained is None else f"NOT within {self._share(self.explained)}, all explained"

    def _share(self, value: float) -> str:
        if not self.relative:
            return f"{value:.2g}"
        return f"{100.0 * value:.3g}%" if value >= 0.01 else f"{value:.0e}"

    @property
    def reference_text(self) -> str:
        """The reference as printed."""
        return _number(self.reference)

    @property
    def ours_text(self) -> str:
        """Our number as printed."""
        return _number(self.ours)

    @property
    def deviation_text(self) -> str:
        """The deviation as printed."""
        if not self.relative:
            return f"{self.deviation:+.1e}"
        return f"{self.deviation:+.2%}" if abs(self.deviation) >= 1e-4 else f"{self.deviation:+.1e}"


def _number(value: float) -> str:
    return f"{value:.6g}" if abs(value) < 1.0 else f"{value:.8g}"
