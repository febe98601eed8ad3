"""A dam in the files of other programs: one module for each."""
