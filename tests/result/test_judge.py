"""One judge: n runs are judged as each of them is alone, and a dam that has failed meets no limit."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from heeltoe.kernel.block import OUTCOMES
from heeltoe.models.runner import outcomes_of
from heeltoe.result.judge import LIMITS, judge
from heeltoe.result.outcome import LARGEST_ROTATION, Outcome, decide

KEYS = sorted({key for limit in LIMITS.values() for key in limit.keys})
SIZES = st.floats(0.0, 2.0) | st.just(0.0)
LIMIT_SETS = st.dictionaries(st.sampled_from(sorted(LIMITS)), st.floats(0.0, 2.0))


@st.composite
def rows(draw, cracks: int):
    """One run: an outcome and numbers at each crack, none where the run has none."""
    outcome = draw(st.sampled_from(list(Outcome)))
    known = draw(st.booleans()) or outcome is Outcome.OK
    sign = -1.0 if draw(st.booleans()) else 1.0
    row = {key: [sign * draw(SIZES) if known else math.nan for _ in range(cracks)] for key in KEYS}
    return {"outcome": outcome, "crack_width_m": [1.0] * cracks, **row}


@st.composite
def studies(draw):
    cracks = draw(st.integers(1, 3))
    return draw(st.lists(rows(cracks), min_size=1, max_size=5))


def stack(some):
    return {name: [row[name] for row in some] for name in some[0]}


@given(some=studies(), limits=LIMIT_SETS)
def test_a_study_is_judged_as_each_of_its_runs_is(some, limits):
    assert list(judge(stack(some), limits)) == [judge(stack([row]), limits)[0] for row in some]


@given(some=studies(), limits=LIMIT_SETS)
def test_every_row_by_the_definitions(some, limits):
    """The right values are the definitions of the outcomes, row by row in plain Python."""
    for row, judged in zip(some, judge(stack(some), limits), strict=True):
        far = any(
            max(d, -u) > 1.0 for d, u in zip(row["peak_slip_downstream_m"], row["peak_slip_upstream_m"], strict=True)
        )
        off = far and row["outcome"] in ("ok", "lost", "large rotation")
        failed = off or row["outcome"] in ("overturned", "unstable", "lost", "large rotation", "keeps sliding")
        assert (judged.slid_off, judged.failed) == (off, failed)
        for name, allowed in limits.items():
            most = max((abs(value) for key in LIMITS[name].keys for value in row[key]), default=0.0)
            known = row["outcome"] in ("ok", "overturned") and not math.isnan(most)
            expected = False if failed else bool(most <= allowed) if known else None
            assert judged.met[name] == expected


def test_failures_exceed_every_limit_and_what_is_not_known_is_neither():
    slips = [0.02, -0.02, 0.0, np.nan, np.nan, np.nan, np.nan, np.nan]
    ends = ["ok", "ok", "ok", "overturned", "unstable", "large rotation", "lost", "cycling"]
    exceeds = judge({"outcome": ends, "residual_slip_m": slips}, {}).exceeds("residual_slip", 0.01)
    assert exceeds.tolist()[:7] == [1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0]
    assert np.isnan(exceeds[7])


@pytest.mark.parametrize(
    ("word", "facts", "outcome"),
    [
        ("ok", {}, "ok"),
        ("ok", {"rotation": 0.11}, "large rotation"),
        ("ok", {"rotation": 0.11, "finite": True}, "ok"),
        ("ok", {"rotation": 0.11, "slows": False}, "large rotation"),
        ("ok", {"slows": False}, "keeps sliding"),
        ("ok", {"stands": False, "rotation": 0.11}, "unstable"),
        ("lost", {"stands": False}, "unstable"),
        ("lost", {}, "lost"),
        ("lost", {"rotation": 0.11}, "lost"),
        ("ok", {"off": True}, "lost"),
        ("ok", {"off": True, "rotation": 0.11}, "lost"),
        ("ok", {"off": True, "slows": False}, "lost"),
        ("ok", {"off": True, "stands": False}, "unstable"),
        ("overturned", {"off": True}, "overturned"),
        ("blown up", {"stands": False}, "blown up"),
        ("event limit", {"rotation": 0.11}, "event limit"),
    ],
)
def test_the_first_line_that_applies_is_the_outcome(word, facts, outcome):
    assert decide(word, **facts) == outcome


@given(
    runs=st.lists(
        st.tuples(
            st.sampled_from(OUTCOMES),
            st.sampled_from([0.0, LARGEST_ROTATION, np.nextafter(LARGEST_ROTATION, 1.0), math.nan]),
            st.booleans(),
            st.booleans(),
        ),
        min_size=1,
        max_size=8,
    ),
    finite=st.booleans(),
)
def test_the_outcomes_of_many_runs_are_those_of_each(runs, finite):
    words, turned, off, on = zip(*runs, strict=True)
    table = {
        "rotation_min": -np.array(turned),
        "rotation_max": np.zeros(len(runs)),
        "slip_min": np.zeros(len(runs)),
        "slip_max": np.where(off, 3.0, 1.0),
        "keeps_sliding": np.array(on, dtype=np.float64),
    }
    each = [
        decide(word, rotation=turn, finite=finite, off=leaves, slows=not slides) for word, turn, leaves, slides in runs
    ]
    many = outcomes_of(words, [table], [2.0], finite=finite).tolist()
    assert all(outcome is alone for outcome, alone in zip(many, each, strict=True))
