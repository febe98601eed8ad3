"""The section and the line that cracks it: corners, areas, axes along and across the crack. Knows no case."""
