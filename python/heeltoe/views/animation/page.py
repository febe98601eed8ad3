"""The scene as the player takes it, and as one HTML page with the player and everything else in it: nothing is loaded
from anywhere."""

from __future__ import annotations

import json
import re
from base64 import b64encode
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.views.animation import look
from heeltoe.views.animation.bodies import Part
from heeltoe.views.animation.frames import ARROW, CUT, Scene
from heeltoe.views.figures.panels import kind_of

# What plays the moving dam, on this page and in the app, which serves these files.
_PLAYER = files("heeltoe.views.animation").joinpath("player")
# In the order in which each finds what it needs; without their imports they are one module.
_MODULES = ("element.js", "scene.js", "canvas.js", "dam.js", "player.js", "page.js")
_IMPORT = re.compile(r"^import .*\n", re.MULTILINE)
# Samples of a trace that a page of any size can show.
_MOST_SAMPLES = 8000


def write_page(scene: Scene, speed: float, path: Path) -> None:
    """Write a scene as a page that starts at this speed."""

    def text(name: str) -> str:
        return _PLAYER.joinpath(name).read_text(encoding="utf-8")

    # In one pass over the template, so that nothing that is put in is taken for a place.
    content = {
        "TITLE": escape(scene.title),
        "SUBTITLE": escape(scene.subtitle),
        "STYLE": text("page.css") + text("player.css"),
        "SCENE": _script_text(page_data(scene, speed)),
        "SCRIPT": "\n".join(_IMPORT.sub("", text(name)) for name in _MODULES),
    }
    pieces = text("page.html").split("%%")
    path.write_text("".join(content.get(piece, piece) for piece in pieces), encoding="utf-8")


def page_data(scene: Scene, speed: float) -> dict[str, object]:
    """Return what the page shows: the scene, the histories beside it, and how fast it starts."""
    every = max(1, -(-scene.history_times.size // _MOST_SAMPLES))
    return scene_data(scene) | {
        "title": scene.title,
        "speed": speed,
        "historyTimes": packed(scene.history_times[::every], "float32"),
        "historyMode": packed(scene.history_mode[::every], "int8"),
        "traces": [
            {
                "role": trace.role,
                "chart": trace.chart,
                "label": trace.label,
                "unit": trace.unit,
                "values": packed(trace.values[::every], "float32"),
            }
            for trace in scene.traces
        ],
    }


def scene_data(scene: Scene) -> dict[str, object]:
    """Return what the player draws: plain numbers and texts, and arrays as :func:`packed`."""
    ground = scene.traces[0].values
    peak = float(np.abs(ground).max()) or 1.0
    return {
        "times": packed(scene.times, "float32"),
        "exaggeration": scene.exaggeration,
        "relativeTo": scene.relative_to,
        "parts": [_part_data(part) for part in scene.parts],
        "above": scene.above,
        "ground": packed(np.interp(scene.times, scene.history_times, ground) / peak, "float32"),
        "forces": packed(scene.forces, "float32"),
        "forceScale": scene.force_scale,
        "forceText": look.force_text(scene.force_scale, scene.force_unit, CUT),
        "arrow": ARROW,
        "cut": CUT,
        "status": packed(scene.status, "int8"),
        "statuses": list(scene.statuses),
        "statusNames": list(look.STATUS_NAMES[: len(scene.statuses)]),
        "mode": packed(scene.mode, "int8"),
        "modes": [{"name": mode, "kind": kind_of(mode)} for mode in scene.modes],
        "base": scene.base,
        "water": scene.water,
        "tailwater": scene.tailwater,
        "anchors": [
            {"foot": anchor.foot, "head": anchor.head, "part": anchor.part, "point": anchor.point}
            for anchor in scene.anchors
        ],
        "views": [list(view) for view in scene.views],
    }


def _part_data(part: Part) -> dict[str, Any]:
    """Return one part of the dam and its motion, with arrays as :func:`packed`."""
    floats = {name: getattr(part, name) for name in ("points", "shapes", "amplitudes")}
    places = {name: getattr(part, name) for name in ("outline", "grid", "upstream", "downstream", "crack")}
    return {name: packed(values, "float32") for name, values in floats.items()} | {
        name: packed(values, "int32") for name, values in places.items()
    }


def packed(values: NDArray[Any], kind: str) -> dict[str, object]:
    """Return an array as text: its kind, its shape, and its numbers, little-endian, in base64."""
    plain = np.ascontiguousarray(values, dtype=np.dtype(kind).newbyteorder("<"))
    return {"kind": kind, "shape": list(values.shape), "data": b64encode(plain.tobytes()).decode("ascii")}


def _script_text(data: dict[str, object]) -> str:
    """Return JSON in which no text can end the script that it stands in."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
