"""The store of an ensemble: one folder, a Zarr group inside, safe to write side by side and to be killed at any time.

ensemble.json      what is computed: cases, simulator, muscles, checksums of all that never changes; written once
provenance.json    who made it: versions, command
cases/             Zarr group: activation, load, angle, moments, state of all cases; written at the end of a run
MUSCLE/            Zarr group: the reference body, and a chunk for each case and field
rows/000123.json   what became of a case, with the checksums of its chunks; written after them
.runner            who works on the store now
.aside/            files in the making
"""
