"""Every field of the schema, changed by itself under every model: the numbers change, or somebody says why not."""

from __future__ import annotations

import functools
import json
from collections.abc import Callable, Sequence
from typing import Any

import ezdxf
import pytest

from heeltoe import InputError, read_case, run, statics_of_sections
from heeltoe.case.field_usage import READ_BY, unused_fields
from heeltoe.case.joints import Joints
from heeltoe.warnings.notice import Notice
from shared.every_field import CROSS, GONE, Fields, leaves, pair, put
from shared.record_samples import GAL, csmip

Skip = Callable[[str, list[str]], bool]

SILENT = {"fields-unused", "fields-idle", "value-unused"}


def _in_threes(words: list[str]) -> list[str]:
    return [" ".join(words[k : k + 3]) for k in range(0, len(words) - len(words) % 3, 3)]


@pytest.fixture(scope="module")
def records(tmp_path_factory) -> dict[str, tuple[Fields, Any]]:
    """What fields of records need: files."""
    place = tmp_path_factory.mktemp("records")
    bare = " ".join(f"{3.0 * value / 981.0:.6f}" for value in GAL)
    for name, text in {
        "three.V2": csmip({"90 DEG": GAL, "UP": -0.5 * GAL, "0 DEG": 0.8 * GAL}),
        "bare.txt": bare.replace(" ", "\n"),
        "stepless.txt": "# units: [g]\n" + bare.replace(" ", "\n"),
        "rows.txt": "# time step: 0.01 s\n# units: [g]\n" + "\n".join(_in_threes(bare.split())),
        "factor.txt": "# factor: 0.5\n# time step: 0.01 s\n# units: [g]\n" + bare.replace(" ", "\n"),
        "a.txt": "# time step: 0.01 s\n# units: [g]\n" + bare.replace(" ", "\n"),
        "b.txt": "# time step: 0.011 s\n# units: [g]\n" + bare.replace(" ", "\n"),
    }.items():
        (place / name).write_text(text)
    result: dict[str, tuple[Fields, Any]] = {}
    flat = [["0 s", "0 g"], ["1 s", "0 g"]]
    for block in ("motion", "motion.vertical", "motion.cross_valley"):
        own = CROSS if block == "motion.cross_valley" else {}
        source = {**own, f"{block}.points": GONE}
        result |= {
            f"{block}.file": ({**source, f"{block}.file": str(place / "a.txt")}, str(place / "b.txt")),
            f"{block}.channel": ({**source, f"{block}.file": str(place / "three.V2"), f"{block}.channel": 1}, 3),
            f"{block}.unit": (
                {
                    **source,
                    f"{block}.file": str(place / "bare.txt"),
                    f"{block}.unit": "g",
                    f"{block}.time_step": "0.01 s",
                },
                "m/s^2",
            ),
            f"{block}.time_step": (
                {**source, f"{block}.file": str(place / "stepless.txt"), f"{block}.time_step": "0.01 s"},
                "0.012 s",
            ),
            f"{block}.layout": (
                {**source, f"{block}.file": str(place / "rows.txt"), f"{block}.channel": 1, f"{block}.layout": "rows"},
                "columns",
            ),
            f"{block}.factor": ({**source, f"{block}.file": str(place / "factor.txt"), f"{block}.factor": 1.0}, 0.5),
            f"{block}.points": (own, [["0 s", "0 g"], ["0.2 s", "0.5 g"], ["0.4 s", "0 g"]]),
            f"{block}.pga": (own, "0.5 g"),
        }
    for name, text in {
        "a.csv": "x [m],z [m]\n0,0\n26,0\n5,30\n0,30\n",
        "b.csv": "x [m],z [m]\n-2,0\n26,0\n5,30\n0,30\n",
        "bare.csv": "0,0\n26,0\n5,30\n0,30\n",
    }.items():
        (place / name).write_text(text)
    drawing = ezdxf.new("R2010", units=6)
    for layer, base in (("A", 26.0), ("B", 27.0)):
        corners = [(0.0, 0.0), (base, 0.0), (5.0, 30.0), (0.0, 30.0)]
        drawing.modelspace().add_lwpolyline(corners, close=True, dxfattribs={"layer": layer})
    drawing.saveas(place / "two.dxf")
    result["section.file"] = ({"section": {"file": str(place / "a.csv")}}, str(place / "b.csv"))
    result["section.layer"] = ({"section": {"file": str(place / "two.dxf"), "layer": "A"}}, "B")
    result["section.unit"] = ({"section": {"file": str(place / "bare.csv"), "unit": "m"}}, "dam")
    for name, friction in (("a.toml", 0.6), ("b.toml", 0.5)):
        (place / name).write_text(f"[crack]\nfriction = {friction}\n")
    of_coefficients = {"crack.static_friction": GONE, "crack.kinetic_friction": GONE}
    result["crack.fit"] = ({**of_coefficients, "crack.fit": str(place / "a.toml")}, str(place / "b.toml"))
    result["motion.duration"] = ({}, "0.35 s")
    result["motion.allow_zero"] = ({"motion": {"points": flat}}, True)
    return result


# Blocks whose fields are those of another one.
AGAIN = ("further_cracks", "motions", "aftershocks")
# What everything is shown in changes no number; tests/views/test_units.py looks at what is shown.
# Each friction law has fields of its own: tests/models/rigid/test_friction_laws.py changes its name.
ALL = {path: field for path, field in leaves() if path not in ("units", "crack.law.name", "further_cracks[0].law.name")}


@functools.cache
def outcome(model: str, written: str) -> tuple[Any, list[str], list[str]]:
    """Return the numbers of a run of a case in JSON, all that it warns of, and which fields it says have no effect."""
    try:
        case = read_case(json.loads(written))
        result = statics_of_sections(case) if model == "statics" else run(case, model)
    except InputError as error:
        return str(error), [str(error)], []
    numbers = json.loads(json.dumps(result.to_json()))
    for item in (numbers, *(section["statics"] for section in numbers.get("sections", ()))):
        for name in ("warnings", "build", "seconds"):
            item.pop(name, None)
    return numbers, [str(warning) for warning in result.warnings], idle(result.warnings)


def idle(warnings: Sequence[Notice]) -> list[str]:
    """Return the fields that warnings say have no effect."""
    message = [dict(warning.quantities).get("fields", warning.field) for warning in warnings if warning.code in SILENT]
    return [path for text in message for path in text.split(", ")]


def idle_fields(model: str, fields: Fields) -> list[str]:
    """Return the fields of a case that are said to have no effect, without a run."""
    try:
        return idle(unused_fields(read_case(fields), [model]))
    except InputError:
        return []


def faults(model: str, records: dict[str, tuple[Fields, Any]], skip: Skip, *, brief: bool = False) -> list[str]:
    """Return what fields are silent about, and what is untrue about them; the base must run wherever it can.

    A `brief` run ends with the ground motion, where the field is not about what comes after.
    """
    result = []
    for path, field in ALL.items():
        before, after, written = pair(path, field, records)
        if brief and not path.startswith("analysis."):
            for item in (before, after):
                put(item, "analysis.silence", "0 s")
        if skip(path, idle_fields(model, after)):
            continue
        old, _, _ = outcome(model, json.dumps(before))
        if isinstance(old, str) and old.startswith("further_cracks: "):
            assert model == "decoupled"
            continue
        if isinstance(old, str) and path.startswith("rock.") and old.startswith("crack.elevation: 0 m is at the base"):
            assert model == "decoupled"
            continue  # rock is below a base, a chain below a crack above it
        new, message, unread = outcome(model, json.dumps(after))
        if isinstance(old, str) and old.startswith("crack.roughness: ") and new == old:
            continue  # the flexible model knows no rough crack, and says so
        if isinstance(old, str) and old.startswith("further_cracks[0].law: "):
            assert model == "rigid"
            continue
        if isinstance(old, str) and old.startswith("further_cracks[0].bond: "):
            assert model == "rigid"
            continue  # two blocks know no bond, and say so
        if isinstance(old, str) and old.startswith("motion.cross_valley: "):
            assert model == "decoupled"
            continue  # the chain moves in the plane of the section, and says so
        if isinstance(old, str) and path != "motion.allow_zero":
            result.append(f"{path}: {old}")
        # Fields of the static checks are for `heeltoe statics`.
        if path.startswith("statics.") and model != "statics":
            assert new == old
            continue
        if new == old and not any(written in text for text in message):
            result.append(f"{path} changes nothing, and no one says so")
        if new != old and written in unread:
            result.append(f"{path} changes something, though it is said to have no effect")
    return result


@pytest.mark.product
@pytest.mark.parametrize("model", ["rigid", "decoupled", "flexible", "statics"])
def test_every_field_changes_something_or_is_told(model, records):
    assert faults(model, records, lambda path, said: False) == []


def test_every_field_changes_something_or_is_told_under_the_rigid_model(records):
    """A further crack or motion has its turn in the slow part, the time after the motion in the product."""
    assert faults("rigid", records, lambda path, said: path.startswith(AGAIN), brief=True) == []


@pytest.mark.slow
def test_every_field_of_a_further_crack_or_motion_does_under_the_rigid_model(records):
    assert faults("rigid", records, lambda path, said: not path.startswith(AGAIN)) == []


@pytest.mark.slow
@pytest.mark.parametrize("model", ["decoupled", pytest.param("flexible", marks=pytest.mark.product), "statics"])
def test_what_is_not_told_to_be_idle_changes_something(model, records):
    """The quick form: without motions, which are the same for all models, and without runs to prove what is told."""
    assert faults(model, records, lambda path, said: path.startswith("motion.") or path in said, brief=True) == []


def test_what_is_known_of_fields_is_of_fields_that_there_are():
    # Lift joints at equal distances are written instead of cracks, and are cracks in the case.
    plain = {path.replace("[0]", "") for path in ALL} | {f"joints.{name}" for name in Joints.model_fields}
    # The bond of all joints has the fields of that of a crack.
    plain |= {path.replace("crack.bond.", "joints.bond.") for path in plain if path.startswith("crack.bond.")}
    for known in READ_BY:
        assert any(path == known or path.startswith(f"{known}.") for path in plain), known
