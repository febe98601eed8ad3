"""Several runs of one case: grids, spreads, comparisons of models, maps of overturning."""
