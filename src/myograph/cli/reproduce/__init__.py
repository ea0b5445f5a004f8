"""`myograph reproduce`: the thesis's experiments from simulation to a report."""

from myograph.cli.reproduce.verb import reproduce, run_reproduction

__all__ = ["reproduce", "run_reproduction"]
