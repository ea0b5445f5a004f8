"""Where on the skin of a muscle a prediction errs (figures 6.2 c, f, g of the thesis)."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.view.canvas import new_figure, png
from myograph.view.palette import INK, SKY, UNKNOWN
from myograph.view.scene import PaintedSurface, draw_surfaces, side_camera
from myograph.view.stage import draw_scale_bar, extent_of, panel_width, set_stage

if TYPE_CHECKING:
    from matplotlib.cm import ScalarMappable


def draw_heat_maps(
    points: Float[np.ndarray, "nodes 3"],
    quads: Int[np.ndarray, "facets 4"],
    errors: Mapping[str, Float[np.ndarray, " asked"]],
    unit: str = "mm",
) -> bytes:
    """PNG of errors on the skin of a muscle: a column per method, seen from both sides, all on one colour scale.

    Parameters
    ----------
    points
        Positions of all nodes [mm].
    errors
        Method -> error of each node; NaN where a node was not asked, drawn grey.
    unit
        Of the errors: 'mm' or 'MPa'.
    """
    if not errors:
        raise InputError("heat maps: expected the errors of at least one method, got none")
    skin = np.unique(quads)
    for method, values in errors.items():
        if len(values) != len(points) or not np.isfinite(values[skin]).any():
            raise InputError(
                f"heat map of '{method}': expected errors of {len(points)} nodes, some of them finite on the skin, "
                f"got {len(values)}, {np.count_nonzero(np.isfinite(values))} of them finite"
            )
    sides = {"lateral side": side_camera(), "medial side": side_camera(turn=np.pi - 0.3)}
    extents = _equally_wide([extent_of([camera.project(points[skin])]) for camera in sides.values()])
    figure = new_figure(1.6 + 1.3 * len(errors) * panel_width(extents[0], 4.4), 9.6, SKY)
    scale = _colour_scale(max(float(np.nanmax(values[skin])) for values in errors.values()))
    panels = figure.subplots(2, len(errors), squeeze=False)
    for axes, (method, values) in zip(panels[0], errors.items(), strict=True):
        axes.set_title(f"{method}\nmean {np.nanmean(values):.3g} {unit}", color=INK, fontsize=10)
    for row, (side, camera), extent in zip(panels, sides.items(), extents, strict=True):
        for axes, values in zip(row, errors.values(), strict=True):
            set_stage(axes, extent)
            draw_surfaces(axes, camera, [PaintedSurface(points, quads, scale.to_rgba(values)[:, :3])], relief=0.4)
        row[0].text(-0.08, 0.5, side, rotation=90, va="center", color=INK, fontsize=10, transform=row[0].transAxes)
        draw_scale_bar(row[-1], extent)
    bar = figure.colorbar(scale, ax=panels, shrink=0.5, aspect=28, pad=0.03)
    bar.set_label(f"mean error of a node [{unit}]", color=INK)
    return png(figure)


def _equally_wide(extents: list[Float[np.ndarray, "2 2"]]) -> list[Float[np.ndarray, "2 2"]]:
    """Extents about the same centres, all as wide as the widest, so that columns of panels line up."""
    half = max(extent[1, 0] - extent[0, 0] for extent in extents) / 2
    middles = [extent[:, 0].mean() for extent in extents]
    return [
        np.array([[middle - half, extent[0, 1]], [middle + half, extent[1, 1]]])
        for middle, extent in zip(middles, extents, strict=True)
    ]


def _colour_scale(worst: float) -> "ScalarMappable":
    """Pale yellow for no error, dark red for the worst, grey for NaN."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    return ScalarMappable(Normalize(0.0, worst), colormaps["YlOrRd"].with_extremes(bad=UNKNOWN))
