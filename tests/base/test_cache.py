"""The keeper of what is dear to build: the last few, once each, for threads too."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from heeltoe.base.cache import Kept, forget_all


def test_the_last_few_are_kept():
    built = []
    kept = Kept(2)

    def get(key):
        return kept.get(key, lambda: built.append(key) or key.upper())

    assert [get(key) for key in "abab"] == ["A", "B", "A", "B"]
    assert built == ["a", "b"]
    # The one asked for longest ago goes.
    get("a")
    get("c")
    assert built == ["a", "b", "c"]
    get("a")
    assert built == ["a", "b", "c"]
    get("b")
    assert built == ["a", "b", "c", "b"]


@pytest.mark.parametrize("at", ["before it is built", "while it is built"])
def test_what_is_interrupted_is_built_by_the_next(at):
    """Ctrl-C comes between any two calls: here while the oldest is put away."""
    kept = Kept(1)

    class Interrupting(dict):
        armed = True

        def __len__(self):
            if self.armed and at.startswith("before"):
                self.armed = False
                raise KeyboardInterrupt
            return super().__len__()

    kept._entries = Interrupting()

    def build():
        if at.startswith("while"):
            raise KeyboardInterrupt
        return "dam"

    with pytest.raises(KeyboardInterrupt):
        kept.get("key", build)
    with ThreadPoolExecutor(1) as pool:
        assert pool.submit(kept.get, "key", lambda: "dam").result(10.0) == "dam"


def test_threads_that_want_the_same_build_it_once():
    kept, built, together = Kept(4), [], threading.Barrier(8)
    go_on = threading.Event()

    def build():
        built.append(1)
        go_on.wait(10.0)
        return object()

    def get():
        together.wait(10.0)
        return kept.get("dam", build)

    with ThreadPoolExecutor(8) as pool:
        waiting = [pool.submit(get) for _ in range(8)]
        go_on.set()
        result = {id(item.result(10.0)) for item in waiting}
    assert len(result) == len(built) == 1


def test_others_need_not_wait():
    kept, inside, go_on = Kept(4), threading.Event(), threading.Event()

    def slow():
        inside.set()
        assert go_on.wait(10.0)
        return "slow"

    with ThreadPoolExecutor(1) as pool:
        waiting = pool.submit(kept.get, "slow", slow)
        assert inside.wait(10.0)
        assert kept.get("quick", lambda: "quick") == "quick"
        go_on.set()
        assert waiting.result(10.0) == "slow"


def test_what_cannot_be_built_is_not_kept():
    kept = Kept(1)

    def fail():
        raise ValueError("no mesh")

    with pytest.raises(ValueError, match="no mesh"):
        kept.get("dam", fail)
    assert kept.get("dam", lambda: "built") == "built"


def test_all_caches_forget():
    first, second = Kept(2), Kept(2)
    first.get("dam", lambda: "old")
    second.get("water", lambda: "old")
    forget_all()
    assert first.get("dam", lambda: "new") == second.get("water", lambda: "new") == "new"
