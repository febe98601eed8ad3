"""Where things are, and dams that several tests use."""

from pathlib import Path

ROOT = Path(__file__).parents[2]

PLAIN = {
    "section": {"height": "100 m", "crest_width": "10 m", "base_width": "80 m"},
    "crack": {"elevation": "0 m", "friction": 1.0},
}
