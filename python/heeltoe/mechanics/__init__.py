"""The forces on the part above the crack, and that part as a block."""
