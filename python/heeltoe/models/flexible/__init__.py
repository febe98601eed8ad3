"""Two elastic parts with a frictional crack between them."""
