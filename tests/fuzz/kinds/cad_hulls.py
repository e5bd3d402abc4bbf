"""Hulls as spline surfaces in IGES, and as STEP that OpenCASCADE reads."""

from __future__ import annotations

import functools
import zlib
from random import Random

import attrs
import numpy as np

from assoc_hull.io.iges.write import iges_text
from tests import cad_hulls
from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.kinds.meshes import CUTS
from tests.fuzz.text import change_text

__all__ = ["IGES_HULL", "STEP_HULL"]

OPTIONS: tuple[list[str], ...] = (
    [], ["--scale", "10"], ["--axes", "+x+y+z"], ["--unit", "mm"], ["--draught", "5"],
    ["--join", "0.5"], ["--accept"], ["--accept", "--json"], ["--strict"],
)  # fmt: skip


@functools.cache
def _iges() -> str:
    return iges_text(cad_hulls.port(), "m")


@functools.cache
def _step() -> str:
    from assoc_hull.io.cad.faces import sew_surfaces
    from assoc_hull.io.cad.write import step_bytes

    surfaces = cad_hulls.port()
    return step_bytes(
        sew_surfaces(surfaces), [each.name for each in surfaces], "mm", "hull"
    ).decode()


def _odd(rng: Random) -> str:
    """A sound file of surfaces that are no ship any more."""
    surfaces = cad_hulls.port() + cad_hulls.starboard()[: rng.choice([0, 0, 1, 2])]
    turn = np.array([rng.choice([1.0, 1.0, 1.0, -1.0, 0.0, 1e-3, 1e3]) for _ in range(3)])
    shift = np.array([rng.choice([0.0, 0.0, 5.0, -200.0]) for _ in range(3)])
    order = rng.choice([[0, 1, 2]] * 3 + [[1, 0, 2], [0, 2, 1], [2, 1, 0]])
    found = cad_hulls.moved(surfaces, lambda net: (net * turn + shift)[..., order])
    for _ in range(rng.choice([0, 1, 3])):
        k = rng.randrange(len(found))
        net = found[k].net.copy()
        i, j = rng.randrange(net.shape[0]), rng.randrange(net.shape[1])
        net[i, j] += rng.choice([0.05, 1.0, 30.0, 1e5]) * np.array([rng.gauss(0, 1) for _ in "xyz"])
        found[k] = attrs.evolve(found[k], net=net)
    rng.shuffle(found)
    return iges_text(found[: rng.choice([1, 2, 9, 9])], rng.choice(["m", "m", "mm"]))


def make_iges(rng: Random) -> bytes:
    """A changed IGES file, or one of changed surfaces."""
    if rng.random() < 0.6:
        return _odd(rng).encode()
    return change_text(rng, _iges()).decode("utf-8", "replace").encode("latin-1", "replace")


def make_step(rng: Random) -> bytes:
    """A changed STEP file."""
    return change_text(rng, _step())


def _options(data: bytes) -> list[str]:
    return [*CUTS, *OPTIONS[zlib.crc32(data) % len(OPTIONS)]]


def of_iges(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "hull.igs", "-o", TARGET, *_options(data)]]


def of_step(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "hull.step", "-o", TARGET, *_options(data)]]


IGES_HULL = Kind("iges_hull", "hull.igs", make_iges, of_iges, weight=1)
STEP_HULL = Kind("step_hull", "hull.step", make_step, of_step, weight=1)
