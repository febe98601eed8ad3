"""Figures of the stresses in an elastic dam."""
