"""Meshes of the parts: our own or by file, and what is wrong with them."""
