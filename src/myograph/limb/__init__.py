"""Joint level: tables of muscles, the balance of moments, equilibrium of the elbow."""
