"""Results of a run of the elastic dam: numbers, histories, stresses."""
