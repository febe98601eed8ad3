"""Answer of a solve: the value of a field at which a limit is just met, in a sentence, and the runs behind it."""

from __future__ import annotations

from heeltoe.result.judge import LIMITS
from heeltoe.study.small.solved import Crossing, Solved
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.systems import Scale, unit_system
from heeltoe.units.write import NOTHING, digits, length, number
from heeltoe.views.content.tree import Block, Code, Notes, Table, paragraph
from heeltoe.views.words.numbers import Amount, in_one_unit


def field_scale(solved: Solved, units: str) -> Scale:
    """Return the unit in which people read the field: accelerations in g everywhere."""
    if solved.quantity == "acceleration":
        return Scale(1.0 / STANDARD_GRAVITY, "g")
    if solved.quantity == "length":
        return unit_system(units).scale("length", max((abs(point.value) for point in solved.points), default=1.0))
    return Scale(1.0, solved.unit)


def solve_answer(solved: Solved, units: str) -> tuple[Block, ...]:
    """Return what the field must be, in sentences."""
    scale, limit = field_scale(solved, units), f"{LIMITS[solved.limit].label} of {length(solved.allowed_m, units)}"
    blocks: list[Block] = []
    if not solved.crossings:
        met = all(point.met for point in solved.points)
        ends = f"{_value(solved.points[0].value, scale)} to {_value(solved.points[-1].value, scale)}"
        word = "met" if met else "not met"
        text = f"The {limit} is {word} in the whole range, {ends}: search another one with --between."
        blocks.append(Notes("failure", "No answer in the range", ((text,),)))
    for crossing in solved.crossings:
        text = f"The {limit} is just met at "
        blocks.append(paragraph(text, Code(solved.field), f" = {_crossing(crossing, scale, units)}"))
    if not solved.one_way:
        text = (
            f"The {LIMITS[solved.limit].label} is not monotonic in {solved.field}: a value beyond a crossing may be "
            "worse again, and a crossing between two values of the scan may be missed. Look at the curve (--out)."
        )
        blocks.append(Notes("warning", "Not monotonic", ((text,),)))
    if solved.refused:
        values = ", ".join(_value(value, scale) for value in solved.refused[:4])
        blocks.append(paragraph(f"The case refuses {len(solved.refused)} values of the range: {values}."))
    return tuple(blocks)


def solve_table(solved: Solved, units: str) -> Table:
    """Return the runs, in the order of their values."""
    scale = field_scale(solved, units)
    results = in_one_unit([[Amount(point.result_m, zero="0")] for point in solved.points], units)
    rows = tuple(
        (
            _value(point.value, scale),
            result if point.result_m is not None else NOTHING,
            "yes" if point.met else "NO",
            point.sign or NOTHING,
            point.outcome,
        )
        for point, (result,) in zip(solved.points, results, strict=True)
    )
    caption = f"The runs of the {solved.model} model, each by its worse sign."
    return Table((solved.field, LIMITS[solved.limit].label, "met", "sign", "outcome"), rows, caption, "rrlll")


def _value(value: float, scale: Scale) -> str:
    return f"{digits(scale(value), 5)} {scale.unit}".strip()


def _crossing(crossing: Crossing, scale: Scale, units: str) -> str:
    """Say at which value the limit is just met, with its error, on which side it holds, and the result of the run
    there."""
    give = crossing.give_or_take
    text = _value(crossing.value, scale)
    text += ", where the result jumps" if give is None else f" ± {number(scale(give), 2)} {scale.unit}".rstrip()
    side = "below" if crossing.met_at < crossing.missed_at else "above"
    last = crossing.last
    sign = f" with the motion {last.sign}" if last.sign else ""
    has = "" if last.result_m is None else f"; at this value the run{sign} gives {length(last.result_m, units)}"
    uncertain = f", uncertain by {length(last.uncertainty_m, units)}" if last.uncertainty_m else ""
    return f"{text}. The limit is met {side} it{has}{uncertain}."
