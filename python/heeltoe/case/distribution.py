"""Values that are drawn: how a study varies a field, and how a band has a friction that is distributed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import ConfigDict, Field, model_validator

from heeltoe.base.arrays import Floats
from heeltoe.case.fields import Fields
from heeltoe.case.quantities import DimensionlessNumber
from heeltoe.case.sentences import gathered
from heeltoe.errors.error import InputError, shown

#: A value of some field as a case file has it; which quantity it is depends on the field.
Value = str | int | float
#: Fields of a distribution that are values of what it is of.
PLACES = ("from", "mode", "to", "mean", "std", "median", "lower", "upper")


class Distribution(Fields):
    """Values that are drawn. Quantities have units as in a case file."""

    model_config = ConfigDict(populate_by_name=True)

    distribution: Literal["uniform", "normal", "lognormal", "triangular"] = "uniform"
    """How the values are distributed."""
    from_: Value | None = Field(default=None, alias="from")
    """Lowest value of `uniform` and `triangular`."""
    to: Value | None = None
    """Highest value of `uniform` and `triangular`."""
    mode: Value | None = None
    """Most likely value of `triangular`."""
    mean: Value | None = None
    """Mean of `normal`, before it is cut."""
    std: Value | None = None
    """Standard deviation of `normal`, before it is cut."""
    median: Value | None = None
    """Median of `lognormal`, before it is cut."""
    dispersion: Annotated[DimensionlessNumber, Field(gt=0.0, le=3.0)] | None = None
    """Standard deviation of the logarithm of `lognormal`, before it is cut."""
    lower: Value | None = None
    """Cuts `normal` and `lognormal` below: nothing less is drawn, and the rest in proportion more often."""
    upper: Value | None = None
    """Cuts `normal` and `lognormal` above."""
    count: Annotated[int, Field(strict=True, ge=2, le=10_000)] | None = None
    """How many equally likely values a `grid` or `one at a time` takes of it; of a uniform one both ends are among
    them."""

    @model_validator(mode="after")
    @gathered
    def _complete(self) -> Iterator[InputError]:
        needed = {
            "uniform": ("from", "to"),
            "triangular": ("from", "mode", "to"),
            "normal": ("mean", "std"),
            "lognormal": ("median", "dispersion"),
        }[self.distribution]
        also = ("lower", "upper") if self.distribution in ("normal", "lognormal") else ()
        fields = {
            name: getattr(self, "from_" if name == "from" else name)
            for name in ("from", "to", "mode", "mean", "std", "median", "dispersion", "lower", "upper")
        }
        for name, value in fields.items():
            if value is None and name in needed:
                yield InputError("option-missing", name, owner=f"the distribution {self.distribution}")
            if value is not None and name not in (*needed, *also):
                yield InputError(
                    "option-foreign",
                    name,
                    owner=f"the distribution {self.distribution}",
                    remedy=f"; that has {', '.join((*needed, *also))}",
                )


def distributed(distribution: Distribution, numbers: Mapping[str, float], field: str) -> Any:
    """Return a distribution in SI units, as scipy has them.

    Parameters
    ----------
    distribution
        As it is written.
    numbers
        Its :data:`PLACES` that are given, SI.
    field
        Where the distribution stands.

    Raises
    ------
    InputError
        Where its numbers do not make one.
    """
    from scipy import stats

    if distribution.distribution in ("uniform", "triangular"):
        low, high = numbers["from"], numbers["to"]
        if low >= high:
            least = shown(distribution.from_)
            raise InputError("out-of-range", f"{field}.to", shown(distribution.to), bound=f"above {least}")
        if distribution.distribution == "uniform":
            return stats.uniform(low, high - low)
        middle = numbers["mode"]
        if not low <= middle <= high:
            raise InputError(
                "out-of-range", f"{field}.mode", shown(distribution.mode), bound="between the lowest and the highest"
            )
        return stats.triang((middle - low) / (high - low), low, high - low)
    low, high = numbers.get("lower", -np.inf), numbers.get("upper", np.inf)
    if low >= high:
        least = shown(distribution.lower)
        raise InputError("out-of-range", f"{field}.upper", shown(distribution.upper), bound=f"above {least}")
    if distribution.distribution == "normal":
        mean, std = numbers["mean"], numbers["std"]
        if std <= 0.0:
            raise InputError("out-of-range", f"{field}.std", shown(distribution.std), bound="above 0")
        return stats.truncnorm((low - mean) / std, (high - mean) / std, mean, std)
    median, dispersion = numbers["median"], distribution.dispersion
    assert dispersion is not None
    if median <= 0.0 or high <= 0.0:
        raise InputError("out-of-range", f"{field}.median", shown(distribution.median), bound="above 0")
    logarithms = [np.log(bound / median) / dispersion if bound > 0.0 else -np.inf for bound in (low, high)]
    return _CutLognormal(median, dispersion, *logarithms)


class _CutLognormal:
    """The lognormal distribution between two bounds, which scipy has not; what is used of it."""

    def __init__(self, median: float, dispersion: float, low: float, high: float) -> None:
        from scipy import stats

        self._normal = stats.truncnorm(low, high, 0.0, 1.0)
        self._median, self._dispersion = median, dispersion

    def ppf(self, share: Floats) -> Floats:
        """Return the values below which these shares of all draws lie."""
        return np.asarray(self._median * np.exp(self._dispersion * self._normal.ppf(share)), dtype=np.float64)

    def support(self) -> tuple[float, float]:
        """Return the bounds, infinite where there is none: zero is never drawn."""
        low, high = (float(end) for end in self._normal.support())
        scaled = [self._median * np.exp(self._dispersion * end) if np.isfinite(end) else end for end in (low, high)]
        return float(scaled[0]), float(scaled[1])
