"""Data of other programs as a store: points and arrays of each case, and the activations that belong to them.

A TOML file, the mapping, says which file, array and unit is what; docs/datasets.md has an example. What does not fit
is refused before anything is written.
"""
