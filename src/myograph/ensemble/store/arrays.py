"""The empty arrays of a store, as Zarr describes them; `chunks` writes the bytes that belong to this description."""

import zarr
from zarr.codecs import BloscCodec

from myograph.ensemble.store.chunks import case_shape, dimensions
from myograph.fields import FIELDS

_COMPRESSOR = {"typesize": 4, "cname": "zstd", "clevel": 3, "shuffle": "shuffle", "blocksize": 0}


def add_field(group: zarr.Group, field: str, cases: int, nodes: int) -> None:
    """An array without chunks: NaN everywhere."""
    shape = case_shape(field, nodes)
    group.create_array(
        field,
        shape=(cases, *shape),
        chunks=(1, *shape),
        dtype="float32",
        fill_value=float("nan"),
        compressors=BloscCodec(**_COMPRESSOR),
        chunk_key_encoding={"name": "default", "separator": "."},
        dimension_names=dimensions(field),
        attributes={
            "units": FIELDS[field].unit,
            "long_name": FIELDS[field].meaning,
            "components": list(FIELDS[field].components),
        },
    )
