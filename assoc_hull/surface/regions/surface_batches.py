"""The surfaces that are handed in, and their patches in batches of one bidegree.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.surface.regions.surface_batches import given_surfaces
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0] = net[:, 1, 1] = 1.0
>>> [surface.degrees for surface in given_surfaces(net)]
[(1, 1)]
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.patches.bernstein_polynomials import (
    cross_polynomials,
    u_derivative,
    v_derivative,
)
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = [
    "Kind",
    "PatchBatch",
    "batches_of",
    "diagonals",
    "given_surfaces",
    "kind_of",
    "name_of",
    "require_area",
]  # fmt: skip

Kind = tuple[int, int, bool]

_FLAT = 1e-12
"""A patch whose |S| stays below this part of the square of its diagonal has no area: rounding."""

_SMALLEST = 1e-6
"""m: what is smaller is no plate, and powers of its size may be too small for numbers."""


@attrs.frozen(eq=False)
class PatchBatch:
    """Patches of one bidegree, all rational or none, and their numbers through all surfaces."""

    patches: Patches
    number: IntArray

    @property
    def kind(self) -> Kind:
        """What the patches have in common."""
        return kind_of(self.patches)


def given_surfaces(
    surfaces: object, where: str = "in curvature_regions"
) -> tuple[SplineSurface, ...]:
    """Take a surface, a sequence of surfaces, or one control net (m + 1, n + 1, 3), m.

    Raises
    ------
    BadInputError, WrongTypeError
        Anything else, no surface at all, a net that makes no surface.
    """
    if isinstance(surfaces, SplineSurface):
        return (surfaces,)
    if isinstance(surfaces, np.ndarray):
        return (SplineSurface.bezier(surfaces),)
    if not isinstance(surfaces, Sequence) or isinstance(surfaces, str | bytes):
        remedy = "give a SplineSurface, a sequence of them, or a control net (m + 1, n + 1, 3)"
        raise WrongTypeError(f"surfaces is {shown(surfaces)}", where, remedy)
    if not surfaces:
        raise BadInputError("surfaces is empty", where, "give at least one surface")
    for number, surface in enumerate(surfaces):
        if not isinstance(surface, SplineSurface):
            what = f"surfaces[{number}] is {shown(surface)}"
            raise WrongTypeError(what, where, "give SplineSurface objects, or one net as an array")
    return tuple(surfaces)


def name_of(surfaces: Sequence[SplineSurface], number: int) -> str:
    """Give what a surface is called in messages: its name, or its number, counted from one."""
    name = surfaces[number].name
    return f"surface {name!r}" if name else f"surface {number + 1}"


def batches_of(surfaces: Sequence[SplineSurface]) -> tuple[PatchBatch, ...]:
    """Cut surfaces into Bezier patches, those of one bidegree together."""
    cut = [surface.patches(number) for number, surface in enumerate(surfaces)]
    first = np.cumsum([0, *(len(patches) for patches in cut)])
    numbers = [np.arange(low, low + len(each)) for low, each in zip(first, cut, strict=False)]
    found = []
    for kind in sorted({kind_of(patches) for patches in cut}):
        own = [i for i, patches in enumerate(cut) if kind_of(patches) == kind]
        patches = Patches.joined([cut[i] for i in own])
        found.append(PatchBatch(patches, np.concatenate([numbers[i] for i in own])))
    return tuple(found)


def kind_of(patches: Patches) -> Kind:
    """Give what patches of one batch have in common: bidegree, and whether they are rational."""
    return (*patches.degrees, patches.weight is not None)


def diagonals(patches: Patches) -> np.typing.NDArray[np.float64]:
    """Give the diagonals of the boxes of control points, (k,), m."""
    flat = patches.net.reshape(len(patches), -1, 3)
    return np.asarray(np.linalg.norm(np.ptp(flat, axis=1), axis=1))


def require_area(surfaces: Sequence[SplineSurface], batches: Sequence[PatchBatch]) -> None:
    """Refuse patches without an area: a point, a line; curvature has no meaning on them.

    Raises
    ------
    BadInputError
        The first such patch; the first surface smaller than a micrometre.
    """
    for number, surface in enumerate(surfaces):
        size = float(np.ptp(surface.net.reshape(-1, 3), axis=0).max())
        if size < _SMALLEST:
            which = f"in {name_of(surfaces, number)}"
            what = f"it measures {size:.3g} m, and has no area to speak of"
            raise BadInputError(what, which, f"give metres; {_SMALLEST:g} m is the least")
    for batch in batches:
        r = batch.patches.components
        normal = np.abs(cross_polynomials(u_derivative(r), v_derivative(r))).max(axis=(1, 2, 3))
        for row in np.flatnonzero(normal <= _FLAT * diagonals(batch.patches) ** 2)[:1]:
            which = name_of(surfaces, int(batch.patches.surface[row]))
            raise BadInputError(
                f"patch {batch.number[row] + 1} has no area: r_u x r_v is nil everywhere",
                f"in {which}",
                "leave it out, or move control points off the line they lie on",
            )
