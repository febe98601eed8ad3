"""What reports and the terminal show: one tree of blocks, and the builders that make it from results."""
