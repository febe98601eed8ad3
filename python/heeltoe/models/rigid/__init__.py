"""The part above the crack as a rigid block, exact between events."""
