"""Content of reports and the terminal: one tree of blocks, and the builders that make it from results."""
