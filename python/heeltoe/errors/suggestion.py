"""Names that were nearly hit."""

from __future__ import annotations

from collections.abc import Iterable


def near(name: str, known: Iterable[str]) -> str:
    """Return ``, did you mean "..."?`` for a name that is not known, or nothing where none that is known is near."""
    # Not at the top: what imports the package need not wait for it.
    from difflib import get_close_matches

    names = list(known)
    matches = (
        get_close_matches(name, names, n=1)
        or [candidate for candidate in names if name and candidate.startswith(f"{name}_")][:1]
    )
    return f', did you mean "{matches[0]}"?' if matches else ""
