"""What a study says: fragility, sensitivity, comparisons of its models."""
