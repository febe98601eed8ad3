"""What can be wrong with what a user gives: every error once, with its remedy."""
