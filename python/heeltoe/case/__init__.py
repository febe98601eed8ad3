"""The user's input: dam, crack, water and motion, read and checked; an error is one sentence."""
