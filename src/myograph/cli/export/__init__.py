"""`myograph export`: a model or a dataset as files of other programs and languages."""

import typer

from myograph.cli.export.c import c
from myograph.cli.export.gltf import gltf
from myograph.cli.export.onnx import onnx
from myograph.cli.export.stl import stl
from myograph.cli.export.vtkhdf import vtkhdf

app = typer.Typer(
    name="export", help="A model or a dataset as files of other programs and languages.", no_args_is_help=True
)
for verb in (onnx, c, gltf, vtkhdf, stl):
    app.command()(verb)

__all__ = ["app"]
