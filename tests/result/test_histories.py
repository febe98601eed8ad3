"""Columns of histories: each an attribute and a row that says its unit."""

import copy
import pickle

import numpy as np
import pytest

from heeltoe import run
from heeltoe.result.histories import EventLog, Histories, columns_of
from shared.dams import example


def test_columns_are_attributes():
    histories = Histories({"time_s": np.array([0.0, 1.0])})
    assert histories.time_s is histories["time_s"]
    assert pickle.loads(pickle.dumps(histories)).time_s.tolist() == [0.0, 1.0]
    assert copy.deepcopy(histories).time_s.tolist() == [0.0, 1.0]
    with pytest.raises(AttributeError, match="no column 'slip_m'"):
        histories.slip_m  # noqa: B018


@pytest.mark.parametrize("model", ["rigid", "decoupled"])
def test_each_column_of_a_run_has_a_row(model):
    response = run(example("typical-height", "motion.duration=0.4 s"), model)
    assert set(response.histories) <= set(columns_of(Histories))
    assert set(response.event_log) <= set(columns_of(EventLog))
