"""What a reader of a result must know: every warning once, with how grave it is."""
