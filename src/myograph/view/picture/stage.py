"""Panels side by side, off screen: lights and cameras stay, solids are drawn anew for every image.

All panels are seen from one direction on one scale, so that they can be compared; a film keeps its first scale.
"""

import io
import math
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, UInt8

from myograph.errors import InputError, MissingPackageError
from myograph.view.palette import INK, SKY
from myograph.view.picture.solid import Colours, Panel, Solid
from myograph.view.scene import Camera

MAP = "viridis"
LETTER = 11.0
"""Width of a title's letter [pixels]."""
FAR, MARGIN, FOOT = 2000.0, 1.12, 0.16
"""Distance of the viewer [mm]; room around the solids; share of the height that the colour bar takes."""
LEAST_SIZE, LARGEST_SIZE = 64, 8192
Image = UInt8[np.ndarray, "height width 3"]


@dataclass(frozen=True)
class Setting:
    """What all images share.

    Parameters
    ----------
    camera
        Where from.
    size
        Width and height of the image [pixels].
    columns
        Panels in a row.
    """

    camera: Camera
    size: tuple[int, int]
    columns: int = 1


class Stage:
    """Draws panels; to be closed.

    Parameters
    ----------
    panels
        The first ones: their number stays.
    colours
        The bar of all values; None for no field.
    around
        Further points [mm] that must be in view.
    """

    def __init__(
        self,
        panels: Sequence[Panel],
        setting: Setting,
        colours: Colours | None = None,
        around: Float[np.ndarray, "points 3"] | None = None,
    ) -> None:
        _check(panels, setting)
        pyvista = _pyvista()
        rows = math.ceil(len(panels) / setting.columns)
        self._letters = max(8, int(setting.size[0] / setting.columns / LETTER))
        self._colours, self._count = colours, len(panels)
        self._plotter: Any = pyvista.Plotter(
            off_screen=True, shape=(rows, setting.columns), window_size=list(setting.size), border=False
        )
        self._plotter.set_background(SKY)
        self._places = [divmod(number, setting.columns) for number in range(len(panels))]
        seen = [_seen(panel) for panel in panels] if around is None else [around] * len(panels)
        shape = setting.size[0] / setting.columns, setting.size[1] / rows
        self._look(seen, setting.camera, shape)

    def _look(self, seen: list[np.ndarray], camera: Camera, shape: tuple[float, float]) -> None:
        """The same scale everywhere; each panel about the middle of what it shows."""
        boxes = [camera.project(points) for points in seen]
        spans = np.max([np.ptp(box, axis=0) for box in boxes], axis=0)
        free = 1 - (FOOT if self._colours is not None else 0.08)
        scale = MARGIN / 2 * max(spans[1] / free, spans[0] * shape[1] / shape[0])
        frame = np.stack([camera.right, camera.up, camera.towards])
        for place, box in zip(self._places, boxes, strict=True):
            self._plotter.subplot(*place)
            middle = (box.min(axis=0) + box.max(axis=0)) / 2
            middle[1] -= scale * (1 - free - 0.06)
            focus = middle @ frame
            view = self._plotter.camera
            view.focal_point, view.position, view.up = focus, focus + FAR * camera.towards, camera.up
            view.parallel_projection, view.parallel_scale = True, scale
            view.clipping_range = (FAR / 10, 2 * FAR)

    def image(self, panels: Sequence[Panel]) -> Image:
        """The panels as pixels; raises InputError for another number of panels than the first."""
        if len(panels) != self._count:
            raise InputError(f"picture: expected {self._count} panels, as before, got {len(panels)}")
        for number, (panel, place) in enumerate(zip(panels, self._places, strict=True)):
            self._plotter.subplot(*place)
            self._plotter.add_text(
                self._wrapped(panel.title),
                position="upper_edge",
                font_size=9,
                color=INK,
                name=f"title {number}",
                render=False,
            )
            for solid in panel.solids:
                self._add(solid, f"{number} {solid.name}")
        if self._colours is not None:
            self._bar()
        self._plotter.render()
        return np.asarray(self._plotter.screenshot(return_img=True))[..., :3]

    def _wrapped(self, title: str) -> str:
        """In lines that fit into a panel."""
        return "\n".join(part for line in title.split("\n") for part in textwrap.wrap(line, self._letters))

    def _add(self, solid: Solid, name: str) -> None:
        mesh = _pyvista().PolyData(solid.points.astype(np.float32), faces=_faces(solid.quads))
        shared = {"name": name, "smooth_shading": True, "reset_camera": False, "render": False, "specular": 0.15}
        if solid.values is None or self._colours is None:
            self._plotter.add_mesh(mesh, color=solid.colour, **shared)
            return
        limits = (self._colours.least, self._colours.largest)
        values = np.clip(solid.values, *limits) if self._colours.logarithmic else solid.values
        self._plotter.add_mesh(
            mesh,
            scalars=values.astype(np.float32),
            cmap=MAP,
            clim=limits,
            log_scale=self._colours.logarithmic,
            show_scalar_bar=False,
            **shared,
        )

    def _bar(self) -> None:
        """One colour bar, in the first panel of the last row."""
        assert self._colours is not None
        row = self._places[-1][0]
        self._plotter.subplot(row, 0)
        mapper = next(
            actor.mapper for actor in self._plotter.renderer.actors.values() if _has_values(actor, self._colours)
        )
        title = f"{self._colours.title}\n"  # VTK writes it over the numbers without a line between
        if title in self._plotter.scalar_bars:
            self._plotter.remove_scalar_bar(title, render=False)
        self._plotter.add_scalar_bar(
            title, mapper=mapper, n_labels=5, fmt="%.3g", color=INK, position_x=0.12, position_y=0.01, width=0.76,
            height=0.12, title_font_size=14, label_font_size=12, render=False,
        )  # fmt: skip

    def close(self) -> None:
        """Let go of the window."""
        self._plotter.close()


def png_bytes(image: Image) -> bytes:
    """The pixels as a PNG file; raises MissingPackageError without Pillow."""
    try:
        from PIL import Image as Pillow
    except ImportError:
        raise MissingPackageError("pillow", "view", "writing a picture") from None
    buffer = io.BytesIO()
    Pillow.fromarray(image).save(buffer, format="png", optimize=True)
    return buffer.getvalue()


def _check(panels: Sequence[Panel], setting: Setting) -> None:
    if not panels or not all(panel.solids for panel in panels):
        raise InputError(f"picture: expected panels with solids, got {len(panels)}")
    if not all(LEAST_SIZE <= pixels <= LARGEST_SIZE for pixels in setting.size):
        raise InputError(f"picture: expected {LEAST_SIZE} to {LARGEST_SIZE} pixels a side, got {setting.size}")


def _pyvista() -> Any:
    try:
        import pyvista
    except ImportError:
        raise MissingPackageError("pyvista", "view", "a picture in three dimensions") from None
    return pyvista


def _seen(panel: Panel) -> np.ndarray:
    return np.concatenate([solid.points[np.unique(solid.quads)] for solid in panel.solids])


def _faces(quads: np.ndarray) -> np.ndarray:
    """As VTK has them; a triangle repeats its last corner."""
    if (quads[:, 2] != quads[:, 3]).all():
        return np.column_stack([np.full(len(quads), 4), quads]).ravel()
    return np.concatenate([[3, *quad[:3]] if quad[2] == quad[3] else [4, *quad] for quad in quads.tolist()])


def _has_values(actor: Any, colours: Colours) -> bool:
    if not getattr(getattr(actor, "mapper", None), "scalar_visibility", False):
        return False
    return np.allclose(actor.mapper.scalar_range, (colours.least, colours.largest))
