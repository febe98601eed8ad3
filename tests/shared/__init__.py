"""What several tests share: dams, motions, runs, and readers of what heeltoe writes."""
