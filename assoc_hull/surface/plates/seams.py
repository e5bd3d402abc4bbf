"""Seams: lines of constant parameter that cut a surface into plates.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.surface.plates.seams import cut_at, Seams
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 6.0, 2.0
>>> shell = SplineSurface.bezier(net, "shell")
>>> [plate.name for plate in cut_at(shell, Seams(u=(0.25, 0.5)))]
['shell 1', 'shell 2', 'shell 3']
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import numbers, shown
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["Seams", "cut_at", "seams_of"]


def _parameters(value: object, name: str) -> tuple[float, ...]:
    """Take parameters that rise."""
    found = np.atleast_1d(numbers(value, name, "in Seams"))
    if (np.diff(found) <= 0.0).any():
        remedy = "give parameters that rise, each once"
        raise BadInputError(f"{name} is {shown(value)}", "in Seams", remedy)
    return tuple(found.tolist())


def _along_u(value: Any) -> tuple[float, ...]:
    return _parameters(value, "u")


def _along_v(value: Any) -> tuple[float, ...]:
    return _parameters(value, "v")


@attrs.frozen
class Seams:
    """Where a surface is cut into plates.

    Attributes
    ----------
    u, v : tuple of float
        Parameters of the surface at which it is cut, rising, within its domain.

    Raises
    ------
    BadInputError
        Numbers that are none, or do not rise.

    Examples
    --------
    >>> from assoc_hull.surface.plates.seams import Seams
    >>> Seams(u=0.5).u
    (0.5,)
    """

    u: tuple[float, ...] = attrs.field(default=(), converter=_along_u)
    v: tuple[float, ...] = attrs.field(default=(), converter=_along_v)

    def __bool__(self) -> bool:
        """Whether anything is cut."""
        return bool(self.u or self.v)


def seams_of(
    seams: object, surfaces: Sequence[SplineSurface], where: str = "in plates"
) -> tuple[Seams, ...]:
    """Give the seams of each surface.

    Parameters
    ----------
    seams : Seams, sequence of Seams or None, or None
        For all surfaces, or for each.
    surfaces : sequence of SplineSurface
        The surfaces.
    where : str
        Where they were given, for messages.

    Raises
    ------
    BadInputError, WrongTypeError
        Anything else; seams for more or fewer surfaces.
    """
    if seams is None or isinstance(seams, Seams):
        return (seams or Seams(),) * len(surfaces)
    if not isinstance(seams, Sequence) or isinstance(seams, str | bytes):
        remedy = "give Seams, one for all surfaces or a list with one for each"
        raise WrongTypeError(f"seams is {shown(seams)}", where, remedy)
    if len(seams) != len(surfaces):
        what = f"there are {len(seams)} seams for {len(surfaces)} surfaces"
        raise BadInputError(what, where, "give one for each surface, None where nothing is cut")
    for each in seams:
        if each is not None and not isinstance(each, Seams):
            raise WrongTypeError(f"an item of seams is {shown(each)}", where, "give Seams or None")
    return tuple(each or Seams() for each in seams)


def cut_at(surface: SplineSurface, seams: Seams) -> tuple[SplineSurface, ...]:
    """Cut a surface into plates.

    Parameters
    ----------
    surface : SplineSurface
        The surface.
    seams : Seams
        Where.

    Returns
    -------
    tuple of SplineSurface
        The plates, those with rising v one behind the other; each keeps its parameters and is
        called as the surface, with the numbers of its place along u and v.

    Raises
    ------
    BadInputError
        A seam that does not lie inside the domain.
    """
    if not seams:
        return (surface,)
    u, v = (
        list(pairwise((low, *_within(surface, name, at, low, high), high)))
        for name, at, (low, high) in zip("uv", (seams.u, seams.v), surface.domain, strict=True)
    )
    return tuple(
        surface.restricted(along, across, f"{surface.name} {_place(i, j, seams)}".strip())
        for i, along in enumerate(u, start=1)
        for j, across in enumerate(v, start=1)
    )


def _within(
    surface: SplineSurface, name: str, at: tuple[float, ...], low: float, high: float
) -> tuple[float, ...]:
    """Take seams that lie inside the domain of a surface."""
    for each in at:
        if not low < each < high:
            what = f"the seam at {name} = {each:g} does not cut it"
            remedy = f"give a parameter between {low:g} and {high:g}"
            raise BadInputError(what, surface.where, remedy)
    return at


def _place(i: int, j: int, seams: Seams) -> str:
    """Give the number of a plate: along u, along v, or both."""
    if not seams.v:
        return f"{i}"
    return f"{i}.{j}" if seams.u else f"{j}"
