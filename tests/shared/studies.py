"""Small studies: a folder of short earthquakes of three events, a case, and study files on them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

#: Events with their components; the last has one only.
EVENTS = {"quake-a": ("000", "090", "up"), "quake-b": ("000", "090", "up"), "quake-c": ("180",)}


#: Slender enough to rock.
BLOCK = """
title = "A block"
[section]
polygon = [["0 m", "0 m"], ["4 m", "0 m"], ["4 m", "10 m"], ["0 m", "10 m"]]
[crack]
friction = 0.6
[motion]
points = [["0 s", "0.8 g"], ["0.1 s", "0.8 g"], ["0.1 s", "0 g"], ["0.4 s", "0 g"]]
"""


def earthquakes(folder: Path) -> Path:
    """Write records of three events, each of some seconds of noise under an envelope."""
    folder.mkdir(parents=True, exist_ok=True)
    for place, (event, components) in enumerate(EVENTS.items()):
        for number, component in enumerate(components):
            random = np.random.default_rng([place, number])
            time = 0.02 * np.arange(150)
            values = 0.2 * random.standard_normal(time.size) * time * np.exp(1.0 - time / 0.7)
            lines = ["# time step: 0.02 s", "# units: acceleration [g], one value a line", *map(str, values.tolist())]
            (folder / f"{event}-{component}.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder


def study_file(folder: Path, text: str, name: str = "study.toml", case: str | None = None) -> Path:
    """Write a study with its case and its earthquakes into a folder."""
    earthquakes(folder / "quakes")
    (folder / "case.toml").write_text(case or BLOCK, encoding="utf-8")
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


GRID = """
case = "case.toml"
[vary]
"crack.friction" = [0.3, 0.5]
"crack.restitution" = { from = 0.2, to = 0.8, count = 3 }
[motions]
both_signs = false
folder = "quakes"
scale = { measure = "pga", values = ["0.3 g", "0.9 g"] }
"""

DRAWN = """
case = "case.toml"
method = "latin hypercube"
samples = 60
seed = 7
[vary]
"crack.friction" = { distribution = "lognormal", median = 0.4, dispersion = 0.2, upper = 1.0 }
"concrete.density" = { distribution = "normal", mean = "2400 kg/m^3", std = "50 kg/m^3", lower = "2200 kg/m^3" }
"crack.restitution" = { distribution = "triangular", from = 0.1, mode = 0.4, to = 0.9 }
[motions]
folder = "quakes"
both_signs = true
scale = { measure = "sa", period = "0.3 s", values = { from = "0.2 g", to = "2 g" } }
[fragility]
limits = { residual_slip = ["1 mm", "50 mm"], rotation = [0.01] }
measure = "pga"
"""


def rows(study: Any) -> list[dict[str, Any]]:
    """Return the runs of a study, by name."""
    table: list[dict[str, Any]] = study.to_table().to_pylist()
    return table
