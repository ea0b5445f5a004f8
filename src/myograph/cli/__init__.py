"""The command line: the only room that knows all the others."""

from myograph.cli.app import main

__all__ = ["main"]
