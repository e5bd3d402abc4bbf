"""Reading packed files: no more than a bound, since what is packed may unpack to anything.

Examples
--------
>>> import gzip
>>> from assoc_hull.io.read_file import unpacked
>>> unpacked(gzip.compress(b"solid"), 100, "at hull.stl.gz")
b'solid'
"""

from __future__ import annotations

import gzip
import io
import zlib
from pathlib import Path

from assoc_hull.errors import BadInputError

__all__ = ["too_large", "unpacked"]

_PART = 1 << 20


def unpacked(data: bytes, most: int, where: str) -> bytes:
    """Unpack what gzip packed, up to a number of bytes; what is not packed comes back.

    Raises
    ------
    BadInputError
        There is more in it, or it is damaged.
    """
    if data[:2] != b"\x1f\x8b":
        return data
    parts: list[bytes] = []
    size = 0
    try:
        with gzip.GzipFile(fileobj=io.BytesIO(data)) as packed:
            # Part by part: what is too much is never held as a whole.
            while part := packed.read(_PART):
                parts.append(part)
                size += len(part)
                if size > most:
                    raise too_large(most, where)
    except (OSError, EOFError, zlib.error) as error:
        what = f"the file cannot be unpacked ({error})"
        raise BadInputError(what, where, "copy it again, whole, or unpack it first") from error
    return b"".join(parts)


def too_large(most: int, where: str | Path) -> BadInputError:
    """Say that a file holds more than can be read."""
    what = f"it holds more than {most / 1e6:g} MB unpacked"
    return BadInputError(what, f"{where}", "export fewer triangles, or the hull only")
