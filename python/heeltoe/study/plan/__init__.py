"""The plan of a study: file, varied fields, samples and motions."""
