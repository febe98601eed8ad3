"""Print the table of docs/friction.md on laws that are fitted to made shear tests: `python -m docs.law_draws`."""

from __future__ import annotations

from functools import partial

from validation.made_shear_tests import MADE, coverage, curves, falls_found, speeds

DRAWS = 100
#: A fall that is small beside the scatter.
SMALL = 0.05


def main() -> None:
    """Print in how many draws intervals have the true number, and falls are found."""
    for name, made in MADE.items():
        counts = ", ".join(f"`{number}` {hits}" for number, hits in coverage(made, DRAWS).items())
        print(f"| {name} | {counts} |", flush=True)
    for name, make in (("slip", curves), ("speed", speeds)):
        none, small = (falls_found(partial(make, fall=fall), DRAWS) for fall in (0.0, SMALL))
        print(f"| fall with {name} | none there: {none} found; {SMALL:g} there: {small} found |", flush=True)


if __name__ == "__main__":
    main()
