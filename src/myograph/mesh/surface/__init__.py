"""Closed triangulated surfaces: read, checked, drawn anew with good triangles, and the quadratic skin of a mesh."""

from myograph.mesh.surface.attachments import Attachment, Attachments
from myograph.mesh.surface.closed import ClosedSurface, closed_surface, read_surface, skin_of

__all__ = ["Attachment", "Attachments", "ClosedSurface", "closed_surface", "read_surface", "skin_of"]
