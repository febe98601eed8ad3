"""The page "Export": results, reports and figures as files, and the commands that make them elsewhere."""
