"""Arrays and facts in one piece of bytes, as a hull file keeps them.

One line of JSON, ``{"facts": ..., "arrays": [[name, type, shape], ...]}``, then the arrays one
behind the other, little end first: all of it as one zlib stream, or behind two letters, ``AH``, as
it is. A ``.npz`` would do the same and spends 250 bytes on each array, which is as much as many an
array of an edit holds.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.hull_file.packed_arrays import pack_arrays, unpack_arrays
>>> arrays, facts = unpack_arrays(pack_arrays({"knot": np.array([0.0, 1.5])}, {"curve": "WL 1"}))
>>> arrays["knot"].tolist(), facts
([0.0, 1.5], {'curve': 'WL 1'})
"""

from __future__ import annotations

import json
import math
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assoc_hull.io.hull_file.guard import MOST_TEXT, parse_json

__all__ = ["pack_arrays", "unpack_arrays"]

_TYPES = ("|u1", "|i1", "<i4", "<i8", "<f8")
_PLAIN = b"AH"
"""What a piece begins with that is not compressed: no zlib stream does."""

_LEVEL = 6
_LARGEST = 1 << 28
"""No piece unpacks to more bytes; what claims to was not written here."""


def pack_arrays(
    arrays: Mapping[str, NDArray[Any]], facts: object = None, level: int = _LEVEL
) -> bytes:
    """Put arrays and facts into one piece of bytes.

    Parameters
    ----------
    arrays : dict of str to array
        uint8, int8, int32, int64 or float64.
    facts : object
        What JSON can say.
    level : int
        How hard zlib tries; 0 leaves the bytes as they are.
    """
    ready = {name: _little(array) for name, array in arrays.items()}
    listed = [[name, each.dtype.str, list(each.shape)] for name, each in ready.items()]
    head = json.dumps({"facts": facts, "arrays": listed}, separators=(",", ":"))
    body = b"".join(each.tobytes() for each in ready.values())
    whole = head.encode() + b"\n" + body
    return zlib.compress(whole, level) if level else _PLAIN + whole


def _little(array: NDArray[Any]) -> NDArray[Any]:
    found: NDArray[Any] = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
    if found.dtype.str not in _TYPES:
        raise TypeError(f"an array of {array.dtype} cannot be packed")
    return found


def unpack_arrays(data: bytes, most: int = _LARGEST) -> tuple[dict[str, NDArray[Any]], Any]:
    """Take arrays and facts out again, of at most so many bytes; the arrays are frozen.

    Raises
    ------
    ValueError
        It is not what `pack_arrays` gives.
    """
    try:
        if data[: len(_PLAIN)] == _PLAIN:
            return _unpack_plain(data, most)
        stream = zlib.decompressobj()
        first = stream.decompress(data, max(min(most, MOST_TEXT), 1))  # 0 would be no bound
        head, found, body = first.partition(b"\n")
        if not found:
            raise ValueError("it does not say what it holds")
        said = parse_json(head)
        size = _size(said["arrays"])
        if size > most:
            raise ValueError(f"it names {size} bytes, and at most {most} are")
        if size > len(body):  # no more than it names, and the byte that says that there is none
            body += stream.decompress(stream.unconsumed_tail, size - len(body) + 1)
        if not stream.eof:
            body += stream.decompress(stream.unconsumed_tail, 1)
        if not stream.eof or stream.unused_data:
            raise ValueError("it ends too early, or goes on behind its end")
        return _split(body, said["arrays"]), said["facts"]
    except (zlib.error, KeyError, TypeError, OverflowError) as error:
        raise ValueError(f"it is no packed piece ({error})") from error


def _unpack_plain(data: bytes, most: int) -> tuple[dict[str, NDArray[Any]], Any]:
    """Take arrays and facts out of a piece that is not compressed."""
    first = data.find(b"\n", len(_PLAIN), MOST_TEXT)
    if first < 0:
        raise ValueError("it does not say what it holds")
    said = parse_json(data[len(_PLAIN) : first])
    size = _size(said["arrays"])
    if size != len(data) - first - 1 or size > most:
        raise ValueError(f"it holds {len(data) - first - 1} bytes, and names {size}")
    return _split(data[first + 1 :], said["arrays"]), said["facts"]


def _size(listed: list[list[Any]]) -> int:
    """Give how many bytes the named arrays have together."""
    size = 0
    for name, kind, shape in listed:
        if kind not in _TYPES:
            raise ValueError(f"{name} is of the type {kind!r}")
        if not all(type(each) is int and each >= 0 for each in shape):
            raise ValueError(f"{name} has no shape")
        size += int(kind[2:]) * math.prod(shape)
    return size


def _split(body: bytes, listed: list[list[Any]]) -> dict[str, NDArray[Any]]:
    found: dict[str, NDArray[Any]] = {}
    first = 0
    for name, kind, shape in listed:
        array = np.frombuffer(body, kind, math.prod(shape), first).reshape(shape)
        first += array.nbytes
        found[name] = array
    if first != len(body):
        raise ValueError(f"it holds {len(body)} bytes, and names {first}")
    return found
