"""The dam in motion: sliding, rocking, lifting, as a video or as a page that plays in any browser."""
