"""The thesis's experiments: what each asks, what the thesis found, and how ours are shown beside it."""
