"""The runs of a study: in batches, stored, resumed, summed up."""
