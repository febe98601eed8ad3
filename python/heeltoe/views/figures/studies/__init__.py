"""What a study answers, drawn: curves over the strength of the motion, parts of the whole, what matters most."""
