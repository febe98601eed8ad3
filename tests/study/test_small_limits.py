"""A table of runs shows what its limits and its runs without a result are, and its exit code says so."""

import json

from shared.command import command
from shared.dams import BLOCK


def test_limits_and_failures_of_a_table():
    vary = ("--vary", "crack.friction=0.2,0.3,0.01", "--set", "limits.residual_slip=100 mm")
    result = command("run", BLOCK, *vary, "--set", "crack.inclination=1 deg", "--json", "-", columns=80)
    assert result.returncode == 3
    runs = json.loads(result.stdout)["runs"]
    assert [run["outcome"] for run in runs] == ["ok", "ok", "unstable"]
    assert [[check["met"] for check in run["limits"]] for run in runs] == [[False], [True], [False]]
    for words in ("limits", "kept", "NO", "yes", "1 of 3 runs meet the limits, each as a rigid block"):
        assert words in result.stderr, words
    assert "1 of 3 runs have no result to trust" in " ".join(result.stderr.split())
