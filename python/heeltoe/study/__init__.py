"""Several runs of one case: grids, spreads, maps of overturning."""
