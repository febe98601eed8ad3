"""What each name of heeltoe means: fields of a case and of a study, keys of the JSON, columns of the tables."""
