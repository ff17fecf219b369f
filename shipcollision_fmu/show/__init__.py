"""A run made visible. See README.md beside this file."""
