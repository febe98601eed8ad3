"""Results as files: tables, JSON, VTK."""
