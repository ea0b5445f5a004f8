"""The finite-element truth of one muscle; the only room that imports ngsolve."""
