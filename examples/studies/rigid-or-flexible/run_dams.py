"""Run the dams of docs/rigid-or-flexible.md under all three models: 1,152 flexible runs, half an hour on two cores.

    python examples/studies/rigid-or-flexible/run_dams.py OUT

The records are those of the folder `ensemble` in the directory that HEELTOE_RECORDS names: two horizontal components of
each event. Dams and events go in two halves, which never meet: one for the fit, one to check it by. What was run before
is not run again.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

from heeltoe import run_study

# What each dam is called, its half, and its section; lengths [m].
DAMS: dict[str, tuple[str, dict[str, float] | list[tuple[float, float]]]] = {
    "20 m": ("fit", {"height": 20.0}),
    "30 m": ("check", {"height": 30.0}),
    "45 m": ("fit", {"height": 45.0}),
    "60 m": ("check", {"height": 60.0}),
    "battered, 55 m": ("fit", [(0.0, 0.0), (46.0, 0.0), (8.5, 47.5), (8.5, 55.0), (2.75, 55.0)]),
    "triangle, 121.92 m": ("check", [(0.0, 0.0), (97.536, 0.0), (0.0, 121.92)]),
    "80 m": ("fit", {"height": 80.0}),
    "100 m": ("check", {"height": 100.0}),
    "120 m": ("fit", {"height": 120.0}),
    "thick top, 103 m": ("check", [(0.0, 0.0), (70.2, 0.0), (20.36, 66.5), (14.8, 103.0), (0.0, 103.0)]),
    "180 m": ("fit", {"height": 180.0}),
    "150 m": ("check", {"height": 150.0}),
}
# Runs of each dam cracked at its base, and at a height.
SAMPLES = {"base": 40, "height": 56}


def main(out: Path) -> None:
    """Run all studies."""
    records = sorted(Path(os.environ["HEELTOE_RECORDS"], "ensemble").glob("*.txt"))
    events = sorted({path.stem.rpartition("-")[0] for path in records})
    for place in SAMPLES:
        for number, (name, (half, section)) in enumerate(DAMS.items()):
            mine = events[half == "check" :: 2]
            files = [str(path.resolve()) for path in records if path.stem.rpartition("-")[0] in mine]
            directory = out / half / f"{name}, {place}"
            directory.mkdir(parents=True, exist_ok=True)
            case, study = _files(name, section, place, number, files)
            (directory / "case.toml").write_text(case, encoding="utf-8")
            (directory / "study.toml").write_text(study, encoding="utf-8")
            answer = run_study(directory / "study.toml", directory / "runs", resume=True)
            print(f"{half:5}  {name}, {place}: {len(answer.to_table())} runs", flush=True)


def _files(
    name: str, section: dict[str, float] | list[tuple[float, float]], place: str, seed: int, files: list[str]
) -> tuple[str, str]:
    """Return the case and the study of a dam, as text."""
    vary: dict[str, str] = {}
    if isinstance(section, dict):
        height = section["height"]
        crest = max(4.0, 0.08 * height)
        shape = f'height = "{height} m"\ncrest_width = "{crest} m"\nneck_height = "{0.9 * height} m"\n'
        shape += f'neck_width = "{1.2 * crest} m"\nbase_width = "{0.8 * height} m"'
        vary["section.base_width"] = _from_to(0.68 * height, 0.95 * height, " m")
        vary["section.neck_height"] = _from_to(0.86 * height, 0.94 * height, " m")
        vary["section.neck_width"] = _from_to(crest, 1.6 * crest, " m")
    else:
        height = max(z for _, z in section)
        shape = "polygon = [" + ", ".join(f'["{x} m", "{z} m"]' for x, z in section) + "]"
    vary["concrete.modulus"] = _from_to(12, 40, " GPa")
    vary["concrete.damping"] = _from_to(0.03, 0.08)
    if place == "height":
        vary["crack.elevation"] = _from_to(0.1 * height, (0.7 if len(section) == 3 else 0.85) * height, " m")
    vary["crack.friction"] = _from_to(0.6, 1.2)
    vary["crack.restitution"] = _from_to(0.0, 0.6)
    vary["reservoir.depth"] = _from_to(0.6 * height, height, " m")
    vary["uplift.intensity"] = _from_to(0.0, 1.0)
    pga = {
        "base": 'median = "0.45 g", dispersion = 0.5, lower = "0.1 g", upper = "1.2 g"',
        "height": 'median = "0.6 g", dispersion = 0.5, lower = "0.1 g", upper = "1.5 g"',
    }[place]
    models = ["rigid", "flexible"] if place == "base" else ["rigid", "decoupled", "flexible"]
    case = f"""title = "{name}"
rock = "rigid"

[section]
{shape}

[concrete]
modulus = "20 GPa"

[crack]
elevation = "{0.0 if place == "base" else 0.5 * height} m"
friction = 1.0

[reservoir]
depth = "{0.9 * height} m"
compressible = false

[uplift]
intensity = 0.5

[flexible]
evidence = "none"
"""
    fields = "\n".join(f'"{path}" = {values}' for path, values in vary.items())
    study = f"""case = "case.toml"
model = {models}
method = "latin hypercube"
samples = {SAMPLES[place]}
seed = {seed}

[vary]
{fields}

[motions]
files = {files}
both_signs = true
scale = {{ measure = "pga", values = {{ distribution = "lognormal", {pga} }} }}
"""
    return case, study


def _from_to(low: float, high: float, unit: str = "") -> str:
    return f'{{ from = "{low:g}{unit}", to = "{high:g}{unit}" }}' if unit else f"{{ from = {low:g}, to = {high:g} }}"


if __name__ == "__main__":
    main(Path(sys.argv[1]))
