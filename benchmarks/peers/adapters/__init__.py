"""One file a peer: how it is given the task, with its own defaults where it has any."""
