"""`myograph demo`: the main job from nothing to a report."""

from myograph.cli.demo.verb import demo, run_demo

__all__ = ["demo", "run_demo"]
