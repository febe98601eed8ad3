"""The triangular dam of the hand calculations, and what is looked up in its checks."""

from __future__ import annotations

from heeltoe import read_case

CLOSE = {"rel": 1e-6}
M = 1e6
SHAKEN = {"seismic_coefficient": 0.1, "vertical_seismic_coefficient": 0.05}
TRIANGLE = [["0 m", "0 m"], ["80 m", "0 m"], ["0 m", "100 m"]]


def dam(depth="90 m", **changes):
    """Return the triangular dam with some blocks changed; a block that is None goes."""
    fields = {
        "gravity": "10 m/s^2",
        "section": {"polygon": TRIANGLE},
        "crack": {"friction": 0.9},
        "reservoir": {"depth": depth},
    } | changes
    return read_case({name: value for name, value in fields.items() if value is not None})


def only(result, name):
    return next(load_case for load_case in result.cases if load_case.name == name)


def check(result, case, name):
    return next(check for check in result.checks if (check.load_case, check.name) == (case, name))
