"""Short runs that several tests of the faces show: of a block, and of an elastic dam."""

from __future__ import annotations

import numpy as np
import pytest

import heeltoe
from heeltoe import GroundMotion
from shared.dams import example
from shared.scenes import SMALL


def shaken(name, model):
    """Run an example coarsely, with 1 s of shaking that make it slide both ways and open."""
    case = example(name, *SMALL)
    time = np.linspace(0.0, 1.0, 101)
    motion = GroundMotion("sine", time, 9.0 * np.sin(2.0 * np.pi * 2.5 * time))
    return case, getattr(heeltoe, model)(case, motion)


@pytest.fixture(scope="session")
def block():
    return shaken("koyna-top", "rigid")


@pytest.fixture(scope="session")
def elastic():
    return shaken("typical-height", "flexible")


@pytest.fixture(scope="session")
def pair(request, block, elastic):
    return {"rigid": block, "flexible": elastic}[request.param]
