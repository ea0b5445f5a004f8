"""Bodies become meshes: structured hexahedra for parametric muscles."""
