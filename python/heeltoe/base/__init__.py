"""Foundations of all rooms: arrays, a cache, files written whole, display of objects."""
