"""A ground motion and all that is done to one: measures, spectra, processing, matching, making to order."""
