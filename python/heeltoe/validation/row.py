"""One line of a validation table."""

from __future__ import annotations

from dataclasses import dataclass


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
        Largest deviation allowed; None where the reference cannot be reproduced and `remark` says why.
    relative
        Whether deviation and tolerance are relative to the reference.
    remark
        Where the reference comes from, or the reason of a deviation.
    """

    what: str
    reference: float
    ours: float
    tolerance: float | None
    relative: bool = True
    remark: str = ""

    @property
    def deviation(self) -> float:
        """Ours less the reference, relative if the row is."""
        difference = self.ours - self.reference
        return difference / abs(self.reference) if self.relative else difference

    @property
    def holds(self) -> bool | None:
        """Whether the deviation is within the tolerance; None where none applies."""
        return None if self.tolerance is None else abs(self.deviation) <= self.tolerance

    @property
    def verdict(self) -> str:
        """The verdict in words."""
        if self.tolerance is None:
            return "no verdict"
        if self.tolerance == 0.0:
            limit = "exactly"
        else:
            limit = f"within {self.tolerance:.0%}" if self.tolerance >= 0.01 else f"within {self.tolerance:.0e}"
        return f"ok, {limit}" if self.holds else f"NOT {limit}"

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
