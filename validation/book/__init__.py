"""The validation book: a page for each reference case and the matrix of all, made from what the cases declare."""
