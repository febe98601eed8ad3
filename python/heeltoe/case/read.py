"""Read a case: a file in TOML or JSON, or a dictionary, with changes of single fields, to a
:class:`Case` that is sound.

The models are in :mod:`heeltoe.case.model`, what changes do in :mod:`heeltoe.case.changes`, the way from complaints to
one plain sentence in :mod:`heeltoe.case.sentences`."""

from __future__ import annotations

import copy
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from heeltoe.case.changes import Changes, apply
from heeltoe.case.distribution import Distribution
from heeltoe.case.fields_file import read_fields
from heeltoe.case.joints import JOINTS, JOINTS_MEANING, Joints
from heeltoe.case.lists import CRACKS, CRACKS_MEANING, motions_as_blocks
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError

#: Source of a case: a file, or its fields.
Source = str | os.PathLike[str] | Mapping[str, object]


def read_case(source: Source, changes: Changes = ()) -> Case:
    """Read and check a case.

    Parameters
    ----------
    source
        Path of a TOML or JSON file (told apart by what is in it), or the fields themselves.
    changes
        What wins over `source`: ``"crack.friction=1.0"`` or ``"reservoir.depth=95m"``, a list of such texts, or a
        dictionary of the same paths, ``{"crack.friction": 1.0}``; see :meth:`heeltoe.Case.with_`.

    Returns
    -------
    Case
        A case in which crack, water and section agree.

    Raises
    ------
    InputError
        The first thing that is wrong, with the others.
    """
    if isinstance(source, Mapping):
        fields, directory = copy.deepcopy(dict(source)), Path()
    elif isinstance(source, str | os.PathLike):
        path = Path(source)
        fields, directory = read_fields(path), path.parent
        if "section" not in fields and not fields.keys().isdisjoint(("case", "cases")):
            raise InputError(
                "another-kind", str(path), "a study", wanted="a case", remedy='run it with "heeltoe study"'
            )
    else:
        raise InputError("case-source", "source", kind=type(source).__name__)
    # Changes by path find the motions as blocks; cracks stay as they are written.
    fields = motions_as_blocks(fields)
    return Case.of(fields, directory, apply(fields, changes, directory))


def case_schema() -> dict[str, object]:
    """Return the JSON schema of a case: its cracks stand in one list, in the blocks `crack` and `further_cracks`, or as
    `joints`."""
    schema = Case.model_json_schema()
    cracks = {"type": "array", "minItems": 1, "items": {"$ref": "#/$defs/Crack"}, "description": CRACKS_MEANING}
    joints = Joints.model_json_schema()
    schema["$defs"] |= joints.pop("$defs")
    joints |= {"description": JOINTS_MEANING}
    properties: dict[str, Any] = {}
    for name, field in schema["properties"].items():
        properties |= {CRACKS: cracks, JOINTS: joints, name: field} if name == "crack" else {name: field}
    # Values that reading puts in the place of a distribution.
    drawn = Distribution.model_json_schema()["properties"]
    schema["$defs"]["Band"]["properties"] |= {name: drawn[name] for name in drawn if name != "count"}
    required = [name for name in schema["required"] if name != "crack"]
    forms = [{"required": [name]} for name in (CRACKS, "crack", JOINTS)]
    return schema | {"properties": properties, "required": required, "oneOf": forms}
