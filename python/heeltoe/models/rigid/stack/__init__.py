"""A dam that is cracked at two levels as two rigid blocks, one on the other."""
