"""Results of an analysis, their verdict in one sentence, and the files they are written to."""
