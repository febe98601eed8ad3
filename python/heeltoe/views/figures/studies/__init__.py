"""Figures of a study: curves over the strength of the motion, shares, and the most important fields."""
