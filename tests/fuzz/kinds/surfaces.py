"""Surfaces of plates: control nets as tables and as JSON, and IGES whose columns count."""

from __future__ import annotations

import copy
import functools
import json
import zlib
from random import Random
from typing import Any

import numpy as np

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.iges.write import iges_text
from assoc_hull.io.surfaces.control_nets import table_of_nets
from assoc_hull.io.surfaces.surface_json import json_of_surfaces
from tests.curved_patches import patch
from tests.fuzz.kind import Kind
from tests.fuzz.text import change_text
from tests.fuzz.values import change_value
from tests.iges_files import face, iges, matrix, surface

__all__ = ["SURFACES"]

OPTIONS: tuple[list[str], ...] = (
    [], ["--json"], ["--unit", "mm"], ["-o", "plates.json"], ["--breadth", "own", "--json"],
    ["--zero", "exact", "--seams-u", "0.5"],
)  # fmt: skip
SEEN = "0123456789,;.-+EDH SGPT"


@functools.cache
def shell() -> SplineSurface:
    """A rational surface of two patches, of degree 2 by 1."""
    net = np.array([[[2.0 * i, j, 0.1 * i * i * (1 + j)] for j in (0, 1)] for i in range(4)])
    knots = np.array([0.0, 0, 0, 0.5, 1, 1, 1]), np.array([0.0, 0, 1, 1])
    weights = np.array([[1.0, 1.0], [0.9, 1.0], [1.0, 1.1], [1.0, 1.0]])
    return SplineSurface("shell", (2, 1), *knots, net, weights)


@functools.cache
def bases() -> tuple[tuple[str, str], ...]:
    """Good inputs, and what each is."""
    deck = SplineSurface.bezier(patch("P09_bow_plate"), "bow")
    moved = [surface(moved=3, label="a"), matrix(np.eye(3), (0.0, 0.0, 1.0), moved=5)]
    moved.append(matrix(np.eye(3), (0.0, 0.0, 1.0)))
    return (
        ("table", table_of_nets([deck])), ("json", json_of_surfaces([shell(), deck])),
        ("iges", iges_text([shell()], "mm")), ("iges", iges(face())), ("iges", iges(moved)),
        ("iges", iges(face(kind=510))), ("iges", iges(face(kind=143))),
    )  # fmt: skip


def make(rng: Random) -> bytes:
    """A changed file: letters in their columns, values in their places, or anything."""
    form, text = rng.choice(bases())
    if form == "json" and rng.random() < 0.7:
        return _changed_values(rng, json.loads(text))
    if form == "iges" and rng.random() < 0.7:
        return _changed_letters(rng, text)
    return change_text(rng, text)


def _changed_values(rng: Random, document: Any) -> bytes:
    found = change_value(rng, copy.deepcopy(document), rng.choice((1, 1, 2, 3)))
    try:
        return json.dumps(found).encode("utf-8", "surrogatepass")
    except RecursionError:
        return b"[" * 3000 + b"]" * 3000


def _changed_letters(rng: Random, text: str) -> bytes:
    found = list(text)
    for _ in range(rng.choice((1, 1, 2, 5, 20))):
        at = rng.randrange(len(found))
        if found[at] != "\n":
            found[at] = rng.choice(SEEN)
    return "".join(found).encode()


def commands(data: bytes) -> list[list[str]]:
    """Tell of the plates; always the same for the same input."""
    return [["plates", "surfaces.dat", *OPTIONS[zlib.crc32(data) % len(OPTIONS)]]]


SURFACES = Kind("surfaces", "surfaces.dat", make, commands, extra=("plates.json",))
