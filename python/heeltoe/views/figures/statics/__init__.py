"""Figures of the static checks: the forces, pressures and stresses of each load case, and how far each check is met."""
