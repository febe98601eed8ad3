"""Figures (matplotlib): one visual language, colour-blind safe, readable in black and white, units on every axis."""

#: Figures that each of several cracks has.
OF_CRACKS = ("response", "slip-by-mode", "friction", "forces", "bearing", "path", "joint", "crack", "pressure")
