"""Tables of muscles: states at the points of a sparse grid, splines in between, built until they are good enough."""
