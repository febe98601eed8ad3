"""What an analysis returns, what is said of it in one sentence, and how it is written."""
