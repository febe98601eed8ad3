"""Stability before, during and after the earthquake: load cases, the section that cracks, criteria."""
