"""What a study runs: its file, what varies, samples and motions."""
