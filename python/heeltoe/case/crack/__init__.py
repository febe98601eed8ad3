"""What the user says about cracks: where they run, what friction they have and how it is lost."""
