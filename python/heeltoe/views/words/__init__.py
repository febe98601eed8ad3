"""Words and numbers that several views share."""
