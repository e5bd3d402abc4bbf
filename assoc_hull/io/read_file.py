"""Bytes of files before anybody looks at them: packed ones unpacked, UTF-16 as UTF-8.

No more than a bound is unpacked, since what is packed may unpack to anything.

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

__all__ = ["as_utf8", "too_large", "unpacked"]

_PART = 1 << 20

_MARKS = ((b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be"))
_HEAD = 4000
_MOSTLY = 0.8
"""Of a text in UTF-16 so many of every second bytes are 0, and none of the others."""


def as_utf8(data: bytes) -> bytes:
    r"""Give a text that is UTF-16, as spreadsheets save "Unicode text", in UTF-8; else what it is.

    Examples
    --------
    >>> from assoc_hull.io.read_file import as_utf8
    >>> as_utf8("line,x".encode("utf-16")), as_utf8(b"line,x")
    (b'line,x', b'line,x')
    """
    for mark, name in _MARKS:
        if data.startswith(mark):
            return data[2:].decode(name, "replace").encode()
    head = data[:_HEAD]
    first, second = head[::2], head[1::2]
    for zeros, others, name in ((second, first, "utf-16-le"), (first, second, "utf-16-be")):
        if zeros.count(0) > _MOSTLY * len(zeros) > 0.0 and not others.count(0):
            return data.decode(name, "replace").encode()
    return data


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
