"""Names of the motions of a study."""

from __future__ import annotations


def alone(name: str) -> str:
    """Return the name of a motion along the stream that is run without that across the valley, too."""
    return f"{name} alone"
