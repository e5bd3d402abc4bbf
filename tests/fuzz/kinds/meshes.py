"""Meshes as text, and as bytes."""

from __future__ import annotations

import functools
import struct
import zlib
from random import Random

from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.text import change_bytes, change_text
from tests.meshes import wigley_half

__all__ = ["OBJ", "STL"]

OPTIONS: tuple[list[str], ...] = (
    [], ["--scale", "10"], ["--axes", "+x+y+z"], ["--unit", "mm"], ["--draught", "5"],
)  # fmt: skip
CUTS = ["--stations", "3", "--waterlines", "2", "--buttocks", "1"]


@functools.cache
def _corners() -> list[list[list[float]]]:
    """The triangles of half a hull."""
    corners: list[list[list[float]]] = wigley_half(7, 4).corners.tolist()
    return corners


@functools.cache
def _stl() -> str:
    rows = ["solid hull"]
    for triangle in _corners():
        rows += [" facet normal 0 0 0", "  outer loop"]
        rows += ["   vertex " + " ".join(f"{each:g}" for each in corner) for corner in triangle]
        rows += ["  endloop", " endfacet"]
    return "\n".join([*rows, "endsolid hull", ""])


@functools.cache
def _binary() -> bytes:
    data = b"\0" * 80 + struct.pack("<I", len(_corners()))
    for triangle in _corners():
        data += struct.pack("<12fH", 0, 0, 0, *(each for corner in triangle for each in corner), 0)
    return data


@functools.cache
def _obj() -> str:
    mesh = wigley_half(7, 4)
    rows = ["# hull", *(f"v {x:g} {y:g} {z:g}" for x, y, z in mesh.xyz.tolist())]
    rows += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh.face.tolist()]
    return "\n".join([*rows, ""])


def make_stl(rng: Random) -> bytes:
    """A changed STL, as text or as bytes."""
    return change_text(rng, _stl()) if rng.random() < 0.6 else change_bytes(rng, _binary())


def make_obj(rng: Random) -> bytes:
    """A changed OBJ."""
    return change_text(rng, _obj())


def of_stl(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "hull.stl", "-o", TARGET, *CUTS, *OPTIONS[zlib.crc32(data) % len(OPTIONS)]]]


def of_obj(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "hull.obj", "-o", TARGET, *CUTS, *OPTIONS[zlib.crc32(data) % len(OPTIONS)]]]


STL = Kind("stl", "hull.stl", make_stl, of_stl, weight=1)
OBJ = Kind("obj", "hull.obj", make_obj, of_obj, weight=1)
