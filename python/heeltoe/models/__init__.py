"""The models of one dam: each takes a case and a motion and returns a response."""
