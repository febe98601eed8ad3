"""The chain: the elastic part below the crack shakes the rigid part above it."""
