"""Figures (matplotlib): one visual language, colour-blind safe, readable in black and white, units on every axis."""
