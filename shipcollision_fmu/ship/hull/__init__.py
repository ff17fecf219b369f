"""hull."""
