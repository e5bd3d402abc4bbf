"""Meshes as text, and as bytes; a scene, which no reader takes."""

from __future__ import annotations

import functools
import io
import struct
import zlib
from random import Random

from assoc_hull.geometry.surfaces.triangles import Triangles
from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.text import change_bytes, change_text
from tests.meshes import wigley_half

__all__ = ["GLB", "OBJ", "PLY", "STL", "text_ply", "unchanged_stl"]

OPTIONS: tuple[list[str], ...] = (
    [], ["--scale", "10"], ["--axes", "+x+y+z"], ["--unit", "mm"], ["--draught", "5"],
    ["--accept"], ["--accept", "--json"], ["--strict"], ["--length", "100", "--accept"],
)  # fmt: skip
CUTS = ["--stations", "3", "--waterlines", "2", "--buttocks", "1"]


@functools.cache
def half() -> Triangles:
    """Half a hull, of few triangles, yet enough that it is taken."""
    return wigley_half(25, 9)


@functools.cache
def _corners() -> list[list[list[float]]]:
    """The triangles of half a hull."""
    corners: list[list[list[float]]] = half().corners.tolist()
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
    mesh = half()
    rows = ["# hull", *(f"v {x:g} {y:g} {z:g}" for x, y, z in mesh.xyz.tolist())]
    rows += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh.face.tolist()]
    return "\n".join([*rows, ""])


def text_ply() -> bytes:
    """The mesh as a PLY of text."""
    return _ply(binary=False)


def unchanged_stl() -> bytes:
    """The mesh as it is."""
    return _binary()


def make_stl(rng: Random) -> bytes:
    """A changed STL, as text or as bytes."""
    return change_text(rng, _stl()) if rng.random() < 0.6 else change_bytes(rng, _binary())


def make_obj(rng: Random) -> bytes:
    """A changed OBJ."""
    return change_text(rng, _obj())


@functools.cache
def _ply(binary: bool) -> bytes:
    return _filed("ply", encoding="binary" if binary else "ascii")


@functools.cache
def _glb() -> bytes:
    return _filed("glb")


def _filed(form: str, **options: str) -> bytes:
    """The mesh as trimesh writes it."""
    import trimesh

    mesh = half()
    data = trimesh.Trimesh(mesh.xyz, mesh.face, process=False).export(
        io.BytesIO(), file_type=form, **options
    )
    return data.encode() if isinstance(data, str) else bytes(data)


def make_ply(rng: Random) -> bytes:
    """A changed PLY, as text or as bytes."""
    if rng.random() < 0.5:
        return change_text(rng, _ply(binary=False).decode("ascii"))
    return change_bytes(rng, _ply(binary=True))


def make_glb(rng: Random) -> bytes:
    """A changed scene: any bytes, or the lengths that it tells."""
    if rng.random() < 0.6:
        return change_bytes(rng, _glb())
    found = bytearray(_glb())
    at = rng.choice((8, 12))
    found[at : at + 4] = struct.pack("<I", rng.choice((0, 1, 2**31, 2**32 - 1, len(found) + 1)))
    return bytes(found)


def of_ply(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "hull.ply", "-o", TARGET, *CUTS, *OPTIONS[zlib.crc32(data) % len(OPTIONS)]]]


def of_glb(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "hull.glb", "-o", TARGET, *CUTS, *OPTIONS[zlib.crc32(data) % len(OPTIONS)]]]


def of_stl(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "hull.stl", "-o", TARGET, *CUTS, *OPTIONS[zlib.crc32(data) % len(OPTIONS)]]]


def of_obj(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "hull.obj", "-o", TARGET, *CUTS, *OPTIONS[zlib.crc32(data) % len(OPTIONS)]]]


STL = Kind("stl", "hull.stl", make_stl, of_stl, weight=1)
GLB = Kind("glb", "hull.glb", make_glb, of_glb, weight=1)
PLY = Kind("ply", "hull.ply", make_ply, of_ply, weight=1)
OBJ = Kind("obj", "hull.obj", make_obj, of_obj, weight=1)
