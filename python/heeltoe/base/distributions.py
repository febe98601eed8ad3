"""Functions of distributions, those of scipy, which takes longer to load than most commands run: at the first call."""

from __future__ import annotations

from typing import Any


def ndtr(x: Any) -> Any:
    """Return the standard normal distribution."""
    from scipy import special

    return special.ndtr(x)


def log_ndtr(x: Any) -> Any:
    """Return its logarithm."""
    from scipy import special

    return special.log_ndtr(x)


def ndtri(share: Any) -> Any:
    """Return where the standard normal distribution has a value."""
    from scipy import special

    return special.ndtri(share)


def betaincinv(a: Any, b: Any, share: Any) -> Any:
    """Return a fractile of the beta distribution of two parameters."""
    from scipy import special

    return special.betaincinv(a, b, share)


def stdtrit(degrees: Any, share: Any) -> Any:
    """Return a fractile of Student's distribution with these degrees of freedom."""
    from scipy import special

    return special.stdtrit(degrees, share)
