"""Meanings of all names: fields of a case and of a study, keys of the JSON, columns of the tables."""
