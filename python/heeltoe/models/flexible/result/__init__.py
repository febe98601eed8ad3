"""What a run of the elastic dam returns: numbers, histories, stresses."""
