"""The checksum of everything in a store."""

import hashlib


def checksum(data: bytes) -> str:
    """BLAKE2b of 16 bytes, as text."""
    return hashlib.blake2b(data, digest_size=16).hexdigest()
