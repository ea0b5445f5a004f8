"""`myograph train`: from cases and a few lines of TOML to a trained method and its errors."""

from myograph.cli.train.verb import train

__all__ = ["train"]
