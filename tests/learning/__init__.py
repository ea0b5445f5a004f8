"""Loads the room before any test module names torch: beside NGSolve the order matters."""

import myograph.learning

assert myograph.learning
