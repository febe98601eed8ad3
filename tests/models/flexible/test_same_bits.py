"""The same dam has the same bits in every process, however many cores its linear algebra may use."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from heeltoe.base.blas import one_blas_thread
from shared.dams import ROOT

# Of dams that bounce and slide so much that the last bit of a mode would show in the slip.
_RUN = """
import heeltoe
case = heeltoe.read_case({file!r}, ["motion.pga=0.6g", "motion.duration=2s", "motion.sign=recorded"])
changes = {{"flexible.evidence": "none"}}
print(heeltoe.{model}(case.with_(changes)).residual_slip_m.hex())
"""


@pytest.mark.parametrize(
    ("name", "model"),
    [("two-cracks", "flexible"), pytest.param("koyna-top", "decoupled", marks=pytest.mark.slow)],
)
def test_the_threads_of_the_linear_algebra_change_no_bit(name, model):
    code = _RUN.format(file=str(ROOT / "examples" / f"{name}.toml"), model=model)
    slips = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "OPENBLAS_NUM_THREADS": threads},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for threads in ("1", "2")
    }
    assert len(slips) == 1


# Both signs of the motion and all of the evidence, with rock and water, of which much is built and run side by side.
_ALL = """
import heeltoe, json
case = heeltoe.read_case({file!r}, ["motion.duration=0.5s", "flexible.elements_across=3"])
print(json.dumps(heeltoe.run(case).to_json()))
"""


@pytest.mark.slow
def test_what_runs_side_by_side_changes_no_bit():
    code = _ALL.format(file=str(ROOT / "examples" / "on-rock.toml"))
    results = []
    for threads in ("1", "2"):
        env = {**os.environ, "OPENBLAS_NUM_THREADS": threads}
        ran = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, check=True)
        results.append(json.loads(ran.stdout))
    one, other = ({**result, "seconds": 0.0} for result in results)
    assert one == other


def test_the_last_of_several_restores_the_threads():
    # Its own library counts from the beginning: one that is loaded within the limits knows nothing of them.
    import scipy.linalg  # noqa: F401
    from threadpoolctl import threadpool_info, threadpool_limits

    def threads():
        return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}

    with threadpool_limits(2, "blas"):
        with one_blas_thread():
            with one_blas_thread():
                assert threads() == {1}
            assert threads() == {1}
        assert threads() == {2}
