"""Cracks of a case: their place, their friction and its loss."""
