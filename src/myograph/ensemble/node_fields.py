"""The fields of a muscle that are stored for every case."""

NODE_FIELDS = ("position", "cauchy_stress", "von_mises", "fibre_stretch", "pressure")
