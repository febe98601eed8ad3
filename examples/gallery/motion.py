"""A record before it is used.

Acceleration, velocity and displacement of El Centro 1940, and its response spectrum.
"""

from matplotlib.figure import Figure

import heeltoe


def picture() -> Figure:
    """Read the record and draw it."""
    return heeltoe.read_record("elcentro-1940-180-nga").plot()


if __name__ == "__main__":
    picture().savefig("motion.png")
