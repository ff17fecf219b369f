"""Pages and WebSocket of a live run."""
