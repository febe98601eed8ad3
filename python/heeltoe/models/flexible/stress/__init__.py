"""The largest stresses of an elastic dam over a run, and whether they crack it further."""
