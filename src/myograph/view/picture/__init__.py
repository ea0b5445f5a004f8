"""Pictures and films in three dimensions, by PyVista off screen: shaded muscles and bones, fields with a colour bar.

solid     what is drawn
camera    where it is seen from, by name
stage     panels side by side, drawn again and again
film      images into a GIF or an MP4
"""

from myograph.view.picture.camera import CAMERAS, named_camera
from myograph.view.picture.film import write_film
from myograph.view.picture.solid import Colours, Panel, Solid
from myograph.view.picture.stage import Stage, png_bytes

__all__ = ["CAMERAS", "Colours", "Panel", "Solid", "Stage", "named_camera", "png_bytes", "write_film"]
