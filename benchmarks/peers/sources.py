"""Checksums of the code behind a row: a row is as old as its code."""

import hashlib
import re
from pathlib import Path

import myograph.learning

HERE = Path(__file__).parent


def code_of_peer(adapter: str) -> str:
    """Of an adapter, of the adapters that it imports from, and of what runs it."""
    files = {HERE / "run_peer.py"}
    waiting = [adapter]
    while waiting:
        file = HERE / "adapters" / f"{waiting.pop()}.py"
        files.add(file)
        imported = re.findall(r"^from adapters\.(\w+) import", file.read_text(), re.MULTILINE)
        waiting += [name for name in imported if HERE / "adapters" / f"{name}.py" not in files]
    return _checksum(files)


def code_of_ours() -> str:
    """Of all that learns in myograph, and of what measures it here."""
    return _checksum({HERE / "ours.py", *Path(myograph.learning.__file__).parent.rglob("*.py")})


def _checksum(files: set[Path]) -> str:
    digest = hashlib.sha256()
    for file in sorted(files):
        digest.update(f"\n{file.name} ".encode() + file.read_bytes())
    return digest.hexdigest()[:16]
