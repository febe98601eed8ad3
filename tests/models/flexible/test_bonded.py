"""Dams share what they have in common: nothing else, and the same bits as if each were built by itself."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import InputError, build_flexible_dam
from heeltoe.models.flexible.body import bonded, reduced
from shared.dams import example, plane_case
from shared.every_field import GONE, leaves, pair

BASE = ["flexible.elements_across=4"]


@pytest.fixture(autouse=True)
def forgotten(monkeypatch):
    for module in (bonded, reduced):
        monkeypatch.setattr(module, "_KEPT", type(module._KEPT)(4))


def typical(*changes):
    return example("typical-base", *BASE, *changes)


@pytest.mark.parametrize("change", ["crack.friction=0.7", "concrete.damping=0.02", 'flexible.damping="stiffness"'])
def test_dams_share_their_modes_and_are_those_built_alone(change, monkeypatch):
    one, other = build_flexible_dam(typical()), build_flexible_dam(typical(change))
    assert other is not one
    assert other.modes is one.modes
    monkeypatch.setattr(bonded, "_KEPT", type(bonded._KEPT)(4))
    alone = reduced._build(typical(change))
    assert alone.modes is not other.modes
    ground, scales = np.tile([[3.0, 0.0], [-3.0, 0.0]], (200, 1)).repeat(20, axis=0), np.ones((1, 2))
    runs = [item.kernel.run_many(ground, 2e-4, 0.52, scales, threads=1)[0] for item in (other, alone)]
    assert {name: values.tolist() for name, values in runs[0].items()} == {
        name: values.tolist() for name, values in runs[1].items()
    }


@pytest.mark.parametrize("change", ["crack.restitution=0.1", "flexible.time_step='0.1 ms'", "limits.peak_slip='1 m'"])
def test_what_plays_no_part_builds_nothing(change):
    assert build_flexible_dam(typical(change)) is build_flexible_dam(typical())


@pytest.mark.parametrize("change", ["reservoir.depth='90 m'", "concrete.modulus='30 GPa'", "uplift.pattern='none'"])
def test_what_bends_a_dam_otherwise_is_built_anew(change):
    assert build_flexible_dam(typical(change)).modes is not build_flexible_dam(typical()).modes


@pytest.mark.slow
def test_no_field_that_is_left_out_changes_the_modes(tmp_path):
    # What is built is held by what is told of it: each dam is built once, and every change against it.
    seen, built = [], {}
    files = [tmp_path / "a.csv", tmp_path / "b.csv"]
    for file, toe in zip(files, (26, 27), strict=True):
        file.write_text(f"0,0\n{toe},0\n5,30\n0,30\n")
    drawn = {"section": {"file": str(files[0]), "unit": "m"}}
    helped = {"section.file": (drawn, str(files[1])), "section.unit": (drawn, "ft"), "section.layer": (drawn, "A")}
    fits = [tmp_path / "a.toml", tmp_path / "b.toml"]
    for fit, friction in zip(fits, (0.6, 0.5), strict=True):
        fit.write_text(f"[crack]\nfriction = {friction}\n")
    of_fit = {"crack.static_friction": GONE, "crack.kinetic_friction": GONE, "crack.fit": str(fits[0])}
    helped["crack.fit"] = (of_fit, str(fits[1]))
    for path, field in leaves():
        if path.startswith(("motion", "analysis")):
            continue
        before, after, _ = pair(path, field, helped)
        try:
            cases = plane_case(before), plane_case(after)
        except InputError:
            continue
        answer, other = (bonded.case_key(case, bonded.NOT_OF_MODES) for case in cases)
        if answer == other:
            seen.append(path)
            if answer not in built:
                built[answer] = _numbers(cases[0])
            assert _numbers(cases[1]) == built[answer], path
    assert {"crack.friction", "crack.static_friction", "concrete.damping", "flexible.contactors"} <= set(seen)


def _numbers(case):
    dam = bonded._build(case)
    bodies = [(body.load.tobytes(), body.load_per_vertical.tobytes()) for body in dam.bodies]
    return bodies, [modes.shapes.tobytes() for modes in dam.modes], dam.bonded_forces[0].tobytes()
