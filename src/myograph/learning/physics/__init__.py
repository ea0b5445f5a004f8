"""What is known of a muscle without any case: it keeps its volume, and its clamped end stays where it is.

config   how much of it a training minds
points   places inside the elements, and derivatives of fields there
terms    the terms of a loss
"""
