"""The fields of a case as a form shows them, from the schema of the case, and what is typed into them, as a case file
would have it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from functools import cache
from typing import Any

from heeltoe.base.payload import Json
from heeltoe.case.crack.law import LAW_FIELDS
from heeltoe.case.model import Case
from heeltoe.case.thesis import THESIS_FIELDS
from heeltoe.units.parse import DIMENSIONS, parse

# What a plain number means, by the system of units that is chosen; both where there is one alone.
_UNITS = {
    "length": ("m", "ft"),
    "density": ("kg/m^3", "lb/ft^3"),
    "pressure": ("MPa", "psi"),
    "acceleration": ("g", "g"),
    "velocity": ("m/s", "ft/s"),
    "angle": ("deg", "deg"),
    "line force": ("kN/m", "kip/ft"),
    "fracture energy": ("N/m", "lbf/ft"),
    "stiffness": ("MN/m/m", "kip/ft/ft"),
    "wear coefficient": ("m^2/J", "m^2/J"),
    "memory": ("GB", "GB"),
}
_LABELS = {
    "": "The case",
    "pga": "Peak acceleration",
    "statics": "Static checks",
    "flexible": "Flexible model",
    "decoupled": "Decoupled chain",
    "law": "Friction law",
    "jrc": "JRC",
    "jcs": "JCS",
}
_CELLS = {
    "section.polygon": ("x", "z"),
    "section.upstream": ("Elevation", "Slope"),
    "section.downstream": ("Elevation", "Slope"),
    "uplift.points": ("Distance", "Head"),
    "motion.points": ("Time", "Acceleration"),
    "crack.kinks": ("Distance from the heel", "Height above the line"),
    "crack.law.roughness_friction": ("Normal stress", "Coefficient"),
    "further_cracks[].kinks": ("Distance from the heel", "Height above the line"),
    "further_cracks[].law.roughness_friction": ("Normal stress", "Coefficient"),
}
# Blocks for suites of records, which the page does not run one by one.
_OF_SUITES = ("motions", "suite")
# Motions, of which all have the same fields.
_MOTIONS = re.compile(r"^(motion\.(vertical|cross_valley)|aftershocks\[\](\.(vertical|cross_valley))?)")
_OF_LISTS = re.compile(r"\[\d+\]")

Schema = Mapping[str, Any]


@dataclass(frozen=True)
class Field:
    """One field.

    Attributes
    ----------
    path
        In the case; ``[]`` stands for the place in a list.
    label, meaning
        What people call it, and what it says.
    kind
        ``"quantity"``, ``"text"``, ``"whole"``, ``"truth"``, ``"choice"``, ``"pairs"`` (rows of two cells),
        ``"blocks"`` (a list of blocks) or ``"block"`` (one in a list of others).
    quantity
        A key of :data:`heeltoe.units.parse.DIMENSIONS`; empty where it holds none.
    choices
        Of a choice.
    default, example
        What holds where nothing is said, and what could be said.
    needed
        Whether something must be said.
    inner
        The two cells of a pair, or the fields of a block.
    blocks
        Of a list of blocks of several kinds: the fields by the kind, which stands in the first of them.
    only
        The names of its block for which it means something; empty where it does for all.
    thesis
        Whether only a comparison with Zhu (2004) needs it: the page shows it where the case sets it.
    """

    path: str
    label: str
    meaning: str
    kind: str
    quantity: str = ""
    choices: tuple[str, ...] = ()
    default: str = ""
    example: str = ""
    needed: bool = False
    inner: tuple[Field, ...] = ()
    blocks: tuple[tuple[str, tuple[Field, ...]], ...] = ()
    only: tuple[str, ...] = ()
    thesis: bool = False


@dataclass(frozen=True)
class Block:
    """A block of fields; `optional` ones may be missing."""

    path: str
    label: str
    meaning: str
    optional: bool
    fields: tuple[Field, ...]


def unit_of(field: Field, units: str) -> str:
    """Return the unit of a number without one; empty where there is none."""
    if field.path == "gravity":
        return "m/s^2" if units == "si" else "ft/s^2"
    if field.quantity in _UNITS:
        return _UNITS[field.quantity][units == "us"]
    return DIMENSIONS[field.quantity].unit if field.quantity else ""


def form(units: str) -> list[Json]:
    """Return all blocks as the page shows them, with defaults and examples in the units that are chosen."""
    shown = []
    for block in blocks():
        row = asdict(block)
        row["fields"] = [_shown(field, units) for field in block.fields]
        shown.append(row)
    return shown


def _shown(field: Field, units: str) -> Json:
    row = asdict(field)
    unit = unit_of(field, units)
    row["unit"] = unit
    for name, digits in (("default", 6), ("example", 3)):
        if unit and row[name]:
            row[name] = in_unit(parse(row[name], field.quantity, field.path), field, units, digits)
    row["inner"] = [_shown(inner, units) for inner in field.inner]
    row["blocks"] = {name: [_shown(inner, units) for inner in fields] for name, fields in field.blocks}
    return row


def in_unit(value: float, field: Field, units: str, digits: int = 6) -> str:
    """Return a value in SI as it is typed in the units that are chosen."""
    unit = unit_of(field, units)
    return f"{value / parse(f'1 {unit}', field.quantity, field.path):.{digits}g} {unit}"


def field_of(path: str) -> Field | None:
    """Return the field at a path, with or without places in lists; None where there is none."""
    return _by_path().get(_OF_LISTS.sub("[]", path))


@cache
def _by_path() -> dict[str, Field]:
    return {inner.path: inner for block in blocks() for field in block.fields for inner in _all(field)}


def _all(field: Field) -> Iterator[Field]:
    yield field
    if field.kind in ("blocks", "block"):
        for nested in (*field.inner, *(inner for _, fields in field.blocks for inner in fields)):
            yield from _all(nested)


@cache
def blocks() -> tuple[Block, ...]:
    """Return the blocks of a case in their order, that of its own fields first."""
    schema = Case.model_json_schema()
    return tuple(_walk(schema, schema, "", optional=False, meaning=""))


def _walk(here: Schema, schema: Schema, path: str, *, optional: bool, meaning: str) -> Iterator[Block]:
    own: list[Field] = []
    others: list[Iterable[Block]] = []
    for name, entry in here["properties"].items():
        if path == "" and name in _OF_SUITES:
            continue
        at = f"{path}.{name}" if path else name
        inner = _block_in(entry, schema)
        if inner is None:
            field = _field(entry, schema, at, needed=name in here.get("required", ()))
            if field.kind == "blocks" and not path:
                others.append([Block(field.path, field.label, field.meaning, False, (field,))])
            else:
                own.append(field)
        else:
            may_miss = any(option.get("type") == "null" for option in entry.get("anyOf", ()))
            others.append(_walk(inner, schema, at, optional=may_miss, meaning=_description(entry)))
    yield Block(path, _label(path), meaning, optional, tuple(own))
    for inner_blocks in others:
        yield from inner_blocks


def _block_in(entry: Schema, schema: Schema) -> Schema | None:
    """Return the block that a field holds; None of one that holds a value."""
    for option in (entry, *entry.get("anyOf", ())):
        target = _named(option["$ref"], schema) if "$ref" in option else {}
        if "properties" in target:
            return target
    return None


def _field(entry: Schema, schema: Schema, path: str, *, needed: bool) -> Field:
    meant = next((option for option in entry.get("anyOf", ()) if option.get("type") != "null"), entry)
    # Only what stands in a list comes here with a block: others are blocks of the form.
    held = _block_in(entry, schema)
    kind, quantity = "block" if held else _kind(meant), str(meant.get("quantity", ""))
    inner: tuple[Field, ...] = ()
    kinds: tuple[tuple[str, tuple[Field, ...]], ...] = ()
    if kind == "pairs":
        labels = _CELLS.get(_MOTIONS.sub("motion", path), ("First", "Second"))
        inner = tuple(
            replace(_field(cell, schema, f"{path}[][{place}]", needed=True), label=label)
            for place, (label, cell) in enumerate(zip(labels, meant["items"]["prefixItems"], strict=True))
        )
    elif held is not None:
        inner = _fields_of(held, schema, path)
    elif kind == "blocks" and "$ref" in meant["items"]:
        inner = _fields_of(_named(meant["items"]["$ref"], schema), schema, f"{path}[]")
    elif kind == "blocks":
        mapping = meant["items"]["discriminator"]["mapping"]
        kinds = tuple(
            (name, _fields_of(_named(reference, schema), schema, f"{path}[]"))
            for name, reference in sorted(mapping.items())
        )
    choices = tuple(map(str, meant.get("enum", (meant["const"],) if "const" in meant else ())))
    default = entry.get("default")
    return Field(
        path, _label(path), _description(entry), kind, quantity, choices, _default(default, quantity),
        str(next(iter(meant.get("examples", ())), "")), needed, inner, kinds, _only(path),
        path in THESIS_FIELDS,
    )  # fmt: skip


def _fields_of(block: Schema, schema: Schema, path: str) -> tuple[Field, ...]:
    return tuple(
        _field(entry, schema, f"{path}.{name}", needed=name in block.get("required", ()))
        for name, entry in block["properties"].items()
    )


def _named(reference: str, schema: Schema) -> Schema:
    definition: Schema = schema["$defs"][reference.rpartition("/")[2]]
    return definition


def _only(path: str) -> tuple[str, ...]:
    """Return the names of the block of a field for which it means something; none where it does for all."""
    block, _, name = path.rpartition(".")
    if block.rpartition(".")[2] != "law" or name == "name":
        return ()
    return tuple(law for law, (needed, allowed) in LAW_FIELDS.items() if name in (*needed, *allowed))


def _kind(meant: Schema) -> str:
    if "enum" in meant or "const" in meant:
        return "choice"
    if "quantity" in meant:
        return "quantity"
    if meant.get("type") == "array":
        return "pairs" if "prefixItems" in meant["items"] else "blocks"
    return {"boolean": "truth", "integer": "whole"}.get(str(meant.get("type")), "text")


def _default(value: object, quantity: str) -> str:
    if value is None or value == [] or value == "":
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    # Without a unit it is of the SI.
    unit = DIMENSIONS[quantity].unit if quantity else ""
    return f"{value:.10g} {unit}".strip() if isinstance(value, int | float) else str(value)


def _label(path: str) -> str:
    name = path.rpartition(".")[2]
    if path == "motion.vertical":
        return "Vertical motion"
    if path == "motion.cross_valley":
        return "Motion across the valley"
    return _LABELS.get(name) or name.replace("_", " ").capitalize()


def _description(entry: Schema) -> str:
    return " ".join(str(entry.get("description", "")).replace("`", "").split())


NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_WHOLE = re.compile(r"[+-]?\d{1,15}")
_TRUTHS = {"yes": True, "no": False}


def typed(entry: object, field: Field, units: str) -> Any:
    """Return what stands in the case where this is typed; None where nothing is.

    A number without a unit is in the units that are chosen. What cannot be read stays as it is, for the readers of the
    package to say why."""
    if isinstance(entry, list):
        return _list(entry, field, units)
    if isinstance(entry, Mapping) and field.kind == "block":
        return _block(entry, field, units)
    if not isinstance(entry, str):
        return entry
    text = entry.strip()
    if field.kind == "text":
        return entry if text else None
    if not text:
        return None
    if field.kind == "whole" and _WHOLE.fullmatch(text):
        return int(text)
    if field.kind == "truth":
        return _TRUTHS.get(text, text)
    if field.kind == "quantity" and NUMBER.fullmatch(text):
        unit = unit_of(field, units)
        return f"{text} {unit}" if unit else float(text)
    return text


def _list(entries: list[Any], field: Field, units: str) -> Any:
    if field.kind == "pairs":
        rows = [
            [_cell(cell, inner, units) for cell, inner in zip(row, field.inner, strict=False)]
            if isinstance(row, list)
            else row
            for row in entries
        ]
        return rows or None
    if field.kind == "blocks":
        return [_block(entry, field, units) if isinstance(entry, Mapping) else entry for entry in entries] or None
    return entries


def _cell(entry: object, field: Field, units: str) -> Any:
    value = typed(entry, field, units)
    # A cell that is empty is one that is missing, and must not move the next one to its place.
    return "" if value is None else value


def _block(entries: Mapping[str, object], field: Field, units: str) -> Json:
    fields = dict(field.blocks).get(str(entries.get("step")), ()) if field.blocks else field.inner
    known = {field.path.rpartition(".")[2]: field for field in fields}
    made = {name: typed(value, known[name], units) if name in known else value for name, value in entries.items()}
    return {name: value for name, value in made.items() if value is not None}
