"""Smooth functions through tabulated values; knows numbers, no muscles."""
