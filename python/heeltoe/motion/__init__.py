"""Ground motions and their tools: measures, spectra, processing, matching, making to order."""
