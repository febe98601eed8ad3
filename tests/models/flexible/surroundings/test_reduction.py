"""What the reduction of rock and water need not do twice: sums of matrices at every rate, and rates of shapes that are
too few."""

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
    stiffness.data[::7] = 0.0
    return LinearBody(mass, damping @ sparse.identity(size, format="csc"), stiffness)


def test_the_operator_is_the_sum_of_the_matrices_to_the_last_bit():
    one = body()
    before = [matrix.copy() for matrix in (one.mass, one.damping, one.stiffness)]
    for rate in RATES:
        plain = sparse.csc_matrix(one.stiffness + rate * one.damping + rate**2 * one.mass)
        plain.sort_indices()
        operator = one.operator(rate)
        # The order of elimination depends on where entries are.
        assert np.array_equal(operator.indptr, plain.indptr)
        assert np.array_equal(operator.indices, plain.indices)
        assert np.array_equal(operator.data, plain.data)
    for old, new in zip(before, (one.mass, one.damping, one.stiffness), strict=True):
        assert np.array_equal(old.toarray(), new.toarray())


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
