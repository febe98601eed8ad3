"""Answers of a study: fragility, sensitivity, comparisons of its models."""
