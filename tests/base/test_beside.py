"""Two things at once: whose result and whose error counts, and how one that fails ends the other."""

import threading
from concurrent.futures import Future

import pytest

from heeltoe.base.beside import beside, pass_notes


def test_both_run_at_once():
    here, there = threading.Event(), threading.Event()

    def task():
        there.set()
        assert here.wait(10.0)
        return "task"

    with beside(task) as other:
        assert there.wait(10.0)
        here.set()
    assert other.done()
    assert other.result() == "task"


def test_the_error_of_the_body_counts_first_and_ends_the_task():
    ended = threading.Event()

    def task():
        assert ended.wait(10.0)
        raise KeyError("task")

    with pytest.raises(ValueError, match="body"), beside(task, ended.set) as other:
        raise ValueError("body")
    assert isinstance(other.exception(), KeyError)


def test_an_error_of_the_task_is_raised_to_who_asks_for_its_result():
    def task():
        raise KeyError("task")

    with beside(task) as other:
        pass
    with pytest.raises(KeyError):
        other.result()


def failed(*notes):
    task, error = Future(), KeyboardInterrupt()
    for note in notes:
        error.add_note(note)
    task.set_exception(error)
    return task


def test_an_interruption_has_the_notes_of_the_first_task_that_has_any():
    done, cancelled, error = Future(), Future(), KeyboardInterrupt()
    done.set_result(1)
    cancelled.cancel()
    pass_notes([done, cancelled, failed(), failed("here"), failed("there")], error)
    assert error.__notes__ == ["here"]


def test_another_error_has_none():
    error = ValueError()
    pass_notes([failed("here")], error)
    assert not hasattr(error, "__notes__")
