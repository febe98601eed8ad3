"""The motions of a case as a list: put in, moved, removed, with the pauses between them."""

from __future__ import annotations

import pytest

from heeltoe.app.motion.sequence import listed, moved, paused, with_one, without

A, B, C = ({"file": name} for name in "abc")
FIELDS = {"motion": A, "aftershocks": [{**B, "pause": "5 s"}, C]}


def of(changes):
    return [changes["motion"], *(changes["aftershocks"] or [])]


def test_a_pause_stays_between_its_places():
    assert of(moved(FIELDS, 1, -1)) == [B, {**A, "pause": "5 s"}, C]
    assert of(moved(FIELDS, 0, 2)) == [B, {**C, "pause": "5 s"}, A]
    assert of(paused(FIELDS, 2, "7 s")) == [A, {**B, "pause": "5 s"}, {**C, "pause": "7 s"}]
    assert of(paused(FIELDS, 1, None)) == [A, B, C]


@pytest.mark.parametrize(("place", "left"), [(0, [B, C]), (1, [A, C]), (2, [A, {**B, "pause": "5 s"}])])
def test_a_motion_goes_with_its_pause(place, left):
    assert of(without(FIELDS, place)) == left


def test_a_motion_comes_in_the_place_of_one_or_after_all():
    new = {"file": "d"}
    assert of(with_one(FIELDS, 0, new)) == [new, {**B, "pause": "5 s"}, C]
    assert of(with_one(FIELDS, 1, new)) == [A, {**new, "pause": "5 s"}, C]
    assert of(with_one(FIELDS, 3, new)) == [A, {**B, "pause": "5 s"}, C, new]
    assert with_one({}, 0, new) == {"motion": new, "aftershocks": None}


def test_what_is_shown_is_what_was_typed():
    fields = {"motion": {"points": [], "pga": "0.3 g", "reverse": True}, "aftershocks": [5, {"file": 7, "pause": 3}]}
    wrong = {"aftershocks[1].pause": "no", "motion": "bad", "motions": "other"}
    assert listed(fields, wrong) == [
        {"title": "drawn by points, peak 0.3 g, other sign", "pause": "", "wrong": "bad"},
        {"title": "no record", "pause": "", "wrong": ""},
        {"title": "7", "pause": "3", "wrong": "no"},
    ]
    assert listed({"motion": A, "aftershocks": "x"}) == [{"title": "a", "pause": "", "wrong": ""}]
    assert listed({}) == []
