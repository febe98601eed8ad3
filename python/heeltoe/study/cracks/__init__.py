"""Several cracks in a study."""
