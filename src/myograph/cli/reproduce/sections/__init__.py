"""The sections of the reproduction, a file each."""
