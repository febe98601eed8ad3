"""The runs of a search for a value at which a limit is just met, and what they show."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from heeltoe.base.blocks import Block, Number
from heeltoe.base.display import Shown
from heeltoe.kernel.build import build_info

if TYPE_CHECKING:
    import pyarrow as pa


class Point(Block):
    """Result of a value of the field."""

    value: Annotated[float, Number("Value of the field.")]
    result_m: Annotated[float | None, Number("Limited result, by the worse sign; null without a result.", "m")]
    uncertainty_m: Annotated[float, Number("How far that may be off by its evidence.", "m")] = 0.0
    met: Annotated[bool, Number("Whether the limit is met.")]
    sign: Annotated[str, Number("The sign that governs; empty where the case names it.")]
    outcome: Annotated[str, Number("How the run ends.")]


class Crossing(Block):
    """A value at which the limit is just met."""

    value: Annotated[float, Number("The end of the bracket at which the limit is met.")]
    give_or_take: Annotated[
        float | None,
        Number(
            "How far it may be off: the width of the bracket, and what the evidence of the result makes of it by the "
            "slope of the curve; null where the result jumps, so that there is no slope."
        ),
    ]
    met_at: Annotated[float, Number("End of the bracket where the limit is met.")]
    missed_at: Annotated[float, Number("End of the bracket where it is not.")]
    last: Annotated[Point, Number("The run at the value, with its evidence, as one of `points`.")]


class Solved(Shown, Block):
    """The values of a field at which a limit is just met.

    Attributes
    ----------
    quantity
        Quantity that the field holds, a key of :data:`heeltoe.units.parse.DIMENSIONS`.
    """

    title: Annotated[str, Number("Title of the case.")]
    model: Annotated[str, Number("Which model answers.")]
    field: Annotated[str, Number("The field that is solved for.")]
    quantity: str
    unit: Annotated[str, Number("SI unit of its values; empty of a number.")]
    limit: Annotated[str, Number("The field of limits that is to be just met.")]
    allowed_m: Annotated[float, Number("Value of the limit.", "m")]
    crossings: Annotated[
        tuple[Crossing, ...],
        Number(
            "Values at which the limit is just met, the least first; none where it is met, or not met, in the whole "
            "range."
        ),
    ]
    one_way: Annotated[bool, Number("Whether the result goes one way with the field, as far as the scan shows.")]
    points: Annotated[
        tuple[Point, ...],
        Number("The runs: the scan, and those that closed in the crossings, in the order of their values."),
    ]
    refused: Annotated[tuple[float, ...], Number("Values of the scan that the case refuses.")]
    drawing: Annotated[str, Number("Which outline of a drawing is the dam; empty where the section is not drawn.")] = ""

    def to_json(self) -> dict[str, Any]:
        """Return plain numbers, strings and lists."""
        return {**super().to_json(), "build": build_info()}

    def to_table(self) -> pa.Table:
        """Return the runs as an Arrow table, in the order of their values."""
        import pyarrow as pa

        return pa.Table.from_pylist([point.to_json() for point in self.points])
