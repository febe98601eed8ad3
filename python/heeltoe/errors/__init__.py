"""Errors in the user's input: each once, with its remedy."""
