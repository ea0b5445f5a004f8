"""The limb over time: activations from files, equilibria one after the other, forward dynamics."""
