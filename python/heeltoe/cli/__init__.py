"""The command line: options in, one call of the package, files and words out."""
