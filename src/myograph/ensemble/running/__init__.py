"""Running an ensemble: batches of cases on Dask's workers, each with a process of its own for the simulator.

    runner -> Dask scheduler -> worker (one thread) -> simulator's process -> the store

Results never travel: the simulator's process writes them to the store; what comes back is a few words. `chains` and
`child` know no Dask; the others need the extra `simulate`.
"""
