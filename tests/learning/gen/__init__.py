"""Graph element networks."""
