"""What elastic parts take, measured beside what is estimated before; ``pytest -s`` prints both."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest

from heeltoe.models.flexible.cost import building, part_of, parts_of
from heeltoe.models.flexible.expected import running
from heeltoe.models.flexible.reduced import _build
from heeltoe.models.flexible.shaken import ShakenDam
from heeltoe.models.run import earthquake
from shared.dams import example


def factor(measured, estimated):
    return max(measured / estimated, estimated / measured)


@pytest.mark.parametrize("name", ["typical-base", "typical-height"])
@pytest.mark.parametrize("across", [4, 8, 16])
def test_the_parts_are_as_expected(name, across):
    case = example(name, f"flexible.elements_across={across}")
    dam = _build(case)
    for part, body, modes in zip(parts_of(case), dam.bodies, dam.modes, strict=True):
        assert factor(body.mesh.nodes.size, part.freedoms) < 1.6
        # Some modes more where the crack asks for them.
        assert factor(modes.omega_squared.size, replace(part, freedoms=body.mesh.nodes.size).modes) < 1.3
    meshed = building([part_of(case, body.mesh.crack.size, body.mesh.nodes.size) for body in dam.bodies])
    assert factor(meshed.seconds, building(parts_of(case)).seconds) < 1.6


@pytest.mark.slow
@pytest.mark.parametrize("name", ["typical-base", "typical-height"])
@pytest.mark.parametrize("across", [8, 16, 32])
def test_time(name, across):
    """Other work on the machine, and its make, are in the factor."""
    case = example(name, f"flexible.elements_across={across}", "motion.duration=6s", "flexible.evidence=none")
    begun = time.process_time()
    dam = _build(case)
    built = time.process_time()
    shaken = ShakenDam(case, dam, earthquake(case).shaking)
    shaken.run(shaken.first_step(), 0.01)
    ran = time.process_time()
    for said, measured, estimated in (
        ("building", built - begun, building(parts_of(case)).seconds),
        ("running", ran - built, running(case, 6.0, 0.01).seconds),
    ):
        print(f"{name}, {across} across, {said}: {measured:.2f} s, estimated {estimated:.2f} s")
        assert factor(measured, estimated) < 6.0
