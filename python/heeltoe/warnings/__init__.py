"""Warnings for readers of a result: each once, with its severity."""
