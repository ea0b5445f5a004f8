"""An arm as one glTF 2.0 file (.glb): modes as morph targets, bones that turn, and a movement.

frame       from mm with z up to the metres with Y up that glTF wants
shaped      a muscle's mean shape and morph targets, with normals
rigid       a bone
buffers     numbers into one binary buffer, and how they are read
document    nodes, meshes, materials and the animation
"""

from myograph.export.gltf.document import Scene, write_gltf
from myograph.export.gltf.rigid import Rigid, Turning
from myograph.export.gltf.shaped import Keys, Shaped, shaped_muscle

__all__ = ["Keys", "Rigid", "Scene", "Shaped", "Turning", "shaped_muscle", "write_gltf"]
