"""Display of a case, a motion and a result in a notebook: a small table with units, and a drawing."""

from __future__ import annotations

from functools import singledispatch
from html import escape

import numpy as np
import shapely

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.errors.sanitize import plain
from heeltoe.mechanics.section_shapes import section_shapes
from heeltoe.models.statics.model import Statics
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.contract import HEADLINES
from heeltoe.result.response import Response
from heeltoe.result.verdict import verdict
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.write import digits
from heeltoe.views.words.fields import fields
from heeltoe.views.words.numbers import Numbers, Value
from heeltoe.views.words.response import listed

_WIDTH, _HEIGHT = 420, 90
_LOOKS = {
    "water": 'fill="#CFE6F5"',
    "silt": 'fill="#C9B27C"',
    "ice": 'fill="#FFFFFF" stroke="#6A4C93"',
    "ground": 'fill="#E0DACB"',
    "below": 'fill="#B8B8B8" stroke="#000"',
    "above": 'fill="#D0D0D0" stroke="#000"',
}
# A column of pixels shows no more than the least and the most in it.
_COLUMNS = 420
# Of what stands in one cell, a verdict for example.
_LONGEST = 5000
_TABLE = '<table style="border-collapse:collapse;text-align:left">'
_CELL = '<td style="text-align:left;vertical-align:top;padding:1px 14px 1px 0{}">{}</td>'


@singledispatch
def html(thing: object) -> str:
    """Return a thing as HTML: by default what Python calls it."""
    return f"<pre>{escape(repr(thing))}</pre>"


@html.register
def _(case: Case) -> str:
    """Show what a case gives, with units, and its section."""
    rows = [
        (path, value)
        for path, value, _, _ in fields(case, case.model_dump(mode="json"), units=case.units, given=True)
        if path not in ("title", "units")
    ]
    return _page(case.title or "Untitled case", rows, _section(case))


@html.register
def _(motion: GroundMotion) -> str:
    """Show the peaks of a ground motion, and its acceleration over time."""
    rows = [
        ("peak acceleration", f"{digits(motion.pga / STANDARD_GRAVITY, 4)} g"),
        ("peak velocity", f"{digits(motion.pgv, 3)} m/s"),
        ("peak displacement", f"{digits(motion.pgd, 3)} m"),
        ("duration", f"{digits(motion.duration, 4)} s, {motion.time.size} samples"),
        ("origin", ", ".join(part for part in (motion.event, motion.station, motion.component) if part)),
        ("processing", "; ".join(motion.processing)),
    ]
    label = f"acceleration over {digits(motion.duration, 4)} s"
    return _page(motion.name, [row for row in rows if row[1]], line(motion.time, motion.acceleration, label))


@html.register
def _(response: Response) -> str:
    """Show verdict, warnings and key numbers of a response and of the one beside it, and the slip over time."""
    numbers = Numbers(response.to_json())
    rows = [("model", response.model), ("verdict", verdict(response))]
    if response.beside is not None:
        rows += [(f"{response.beside.model} beside it", response.meaning())]
    rows += [("warning", text) for text in listed(response.responses)]
    for headline in HEADLINES:
        texts = []
        for run in reversed(response.responses):
            cell = numbers(headline.key if run is response else f"beside.{headline.key}", sign=headline.way)
            if isinstance(cell, Value):
                texts.append(cell.text if response.beside is None else f"{cell.text} ({run.model})")
        if texts:
            rows.append((headline.full, ", ".join(texts)))
    drawing = ""
    if response.histories:
        time = response.histories.time_s
        drawing = line(time, response.histories.slip_m, f"slip, + downstream, over {digits(float(time[-1]), 2)} s")
    return _page(response.title or "Untitled case", rows, drawing)


@html.register
def _(statics: Statics) -> str:
    """Show which static checks are not met, and the warnings."""
    missed = [str(check.sentence) for check in statics.checks if not check.met]
    rows = [
        ("criteria", statics.criteria),
        ("checks", f"{len(statics.checks) - len(missed)} of {len(statics.checks)} are met"),
    ]
    rows += [("not met", text) for text in missed]
    rows += [("warning", str(warning)) for warning in statics.warnings]
    return _page(statics.title or "Untitled case", rows, "")


def line(x: Floats, y: Floats, label: str) -> str:
    """Return a curve as an inline SVG with its zero line; the label says what it is."""
    if len(x) < 2 or not np.ptp(x) > 0.0 or not np.isfinite(y).all():
        return ""
    if len(x) > 4 * _COLUMNS:
        parts = np.array_split(np.arange(len(x)), _COLUMNS)
        keep = np.unique([k for part in parts for k in (part[np.argmin(y[part])], part[np.argmax(y[part])])])
        x, y = x[keep], y[keep]
    low, high = min(0.0, float(y.min())), max(0.0, float(y.max()))
    height = (high - low) or 1.0
    across = (x - x[0]) / np.ptp(x) * _WIDTH
    down = 2.0 + (high - y) / height * (_HEIGHT - 4.0)
    zero = 2.0 + high / height * (_HEIGHT - 4.0)
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(across, down, strict=True))
    return (
        f'<figure style="margin:6px 0"><svg width="{_WIDTH}" height="{_HEIGHT}" viewBox="0 0 {_WIDTH} {_HEIGHT}" '
        f'role="img" aria-label="{escape(label)}"><line x1="0" x2="{_WIDTH}" y1="{zero:.1f}" y2="{zero:.1f}" '
        f'stroke="#999" stroke-width="0.7"/><polyline points="{points}" fill="none" stroke="#0072B2"/></svg>'
        f"<figcaption>{escape(label)}</figcaption></figure>"
    )


def _section(case: Case) -> str:
    """Return the section of the dam with its water, silt and ice, and its cracks as an inline SVG."""
    left, base, right, crest = case.outline.bounds
    size = max(right - left, crest - base)
    scale = 160.0 / size

    def place(points: Floats) -> str:
        return " ".join(f"{60 + (x - left) * scale:.1f},{165 - (z - base) * scale:.1f}" for x, z in points)

    bodies = "".join(
        f'<polygon points="{place(shapely.get_coordinates(part))}" {_LOOKS[kind]}/>'
        for kind, shape in section_shapes(case)
        for part in shapely.get_parts(shape)
    )
    cracks = "".join(
        f'<polyline points="{place(alone.crack_line)}" fill="none" stroke="#B22222" stroke-width="2"/>'
        for alone in case.single_crack_cases
    )
    return (
        f'<svg style="display:block" width="240" height="172" viewBox="0 0 240 172" role="img" '
        f'aria-label="section of the dam">{bodies}{cracks}</svg>'
    )


def _page(title: str, rows: list[tuple[str, str]], drawing: str) -> str:
    cells = "".join(
        f"<tr>{_CELL.format(';white-space:nowrap', escape(name))}{_CELL.format('', escape(value))}</tr>"
        for name, value in ((name, plain(value, _LONGEST)) for name, value in rows)
    )
    return f"<div><strong>{escape(plain(title))}</strong>{drawing}{_TABLE}{cells}</table></div>"
