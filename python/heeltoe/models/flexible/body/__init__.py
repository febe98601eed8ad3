"""The two elastic parts: mesh to modes, damping, water, loads, and where they start to rock."""
