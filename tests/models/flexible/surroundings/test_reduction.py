"""Answers of large bodies against those of their full matrices, and rates at which too few shapes are tried."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from heeltoe.models.flexible.surroundings.reduction import LinearBody, Projected, enough_shapes

RATES = (0.3 + 2.0j, 5.0j, 1.5 + 0.0j)


def body(size=40):
    """Return a body whose matrices have entries at different places, some of them zero, and not in order."""
    rng = np.random.default_rng(3)

    def matrix(share):
        part = sparse.random(size, size, share, rng=rng)
        return sparse.csc_matrix(part @ part.T)

    stiffness, damping, mass = (matrix(share) for share in (0.1, 0.04, 0.06))
    mass = mass + sparse.identity(size, format="csc")
    rows = np.repeat(np.arange(size), np.diff(stiffness.indptr))
    stiffness.data[(rows + stiffness.indices) % 7 == 0] = 0.0
    return LinearBody(mass, damping @ sparse.identity(size, format="csc"), stiffness)


def test_moments_are_those_of_the_full_matrices():
    one = body()
    before = [matrix.toarray() for matrix in (one.mass, one.damping, one.stiffness)]
    mass, damping, stiffness = before
    forces = np.random.default_rng(4).normal(size=(len(mass), 5))
    for rate in RATES:
        operator, slope = stiffness + rate * damping + rate**2 * mass, damping + 2.0 * rate * mass
        first = np.linalg.solve(operator, forces)
        second = np.linalg.solve(operator, -slope @ first)
        third = np.linalg.solve(operator, -slope @ second - mass @ first)
        for term, wanted in zip(one.moments(rate, forces, 2), (first, second, third), strict=True):
            assert np.abs(term - wanted).max() < 1e-9 * np.abs(wanted).max()
    for old, new in zip(before, (one.mass, one.damping, one.stiffness), strict=True):
        assert np.array_equal(old, new.toarray())


def test_forces_that_last_bend_a_body_by_its_stiffness_alone():
    one = body()
    stiff = LinearBody(one.mass, one.damping, sparse.csc_matrix(one.stiffness + 2.0 * sparse.identity(40)))
    forces = np.random.default_rng(5).normal(size=(40, 3))
    wanted = np.linalg.solve(stiff.stiffness.toarray(), forces)
    assert np.abs(stiff.at_rest(forces) - wanted).max() < 1e-12 * np.abs(wanted).max()


def test_shapes_that_are_too_few_at_one_rate_are_not_tried_at_others(monkeypatch):
    size, inputs = 12, np.ones((12, 1))
    squares = np.arange(1.0, size + 1.0)
    whole = Projected(np.eye(size), np.eye(size), np.zeros((size, size)), np.diag(squares))
    exact = {rate: inputs.T @ whole.response(rate, inputs) for rate in RATES}
    asked = []
    plain = Projected.response
    monkeypatch.setattr(Projected, "response", lambda self, *given: asked.append(len(self.mass)) or plain(self, *given))
    kept, error = enough_shapes(whole, inputs, exact, 1e-9, 1)
    assert len(kept.mass) == size
    assert error < 1e-9
    assert all(asked.count(count) == 1 for count in set(asked) - {size})
    assert len(set(asked)) > 1
