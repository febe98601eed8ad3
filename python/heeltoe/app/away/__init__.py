"""The page of what is taken away: results, reports and figures as files, and the words that make them elsewhere."""
