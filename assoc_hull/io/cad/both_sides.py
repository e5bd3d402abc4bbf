"""The half of a hull to port and its image to starboard.

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.cad.both_sides import both_sides
>>> side = SplineSurface.bezier([[[0, 1, 0], [0, 1, 2]], [[5, 1, 0], [5, 1, 2]]], "side")
>>> port, starboard = both_sides([side])
>>> starboard.name, starboard.at(0.0, 1.0).tolist()
('side, starboard', [5.0, -1.0, 2.0])
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["both_sides", "mirrored", "off_centre"]

_ACROSS = np.array([1.0, -1.0, 1.0])


def both_sides(surfaces: Sequence[SplineSurface]) -> list[SplineSurface]:
    """Give surfaces to port, and their images to starboard, which are named so."""
    port = [attrs.evolve(each, name=_named(each, "port")) for each in surfaces]
    return port + [mirrored(each, _named(each, "starboard")) for each in surfaces]


def off_centre(surfaces: Sequence[SplineSurface]) -> tuple[float, str]:
    """Say how far off the centre plane the nearest side of all is (m), and whose it is.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.io.cad.both_sides import off_centre
    >>> side = SplineSurface.bezier([[[0, 1, 0], [0, 2, 2]], [[5, 1, 0], [5, 2, 2]]], "side")
    >>> off_centre([side])
    (1.0, 'side')
    """
    found = []
    for each in surfaces:
        off = np.abs(each.restricted(*each.domain).net[..., 1])
        sides = (off[0], off[-1], off[:, 0], off[:, -1])
        found.append((min(float(side.max()) for side in sides), each.name))
    return min(found)


def _named(surface: SplineSurface, side: str) -> str:
    return f"{surface.name}, {side}" if surface.name else side


def mirrored(surface: SplineSurface, name: str) -> SplineSurface:
    """Give the image of a surface in the centre plane, its normal on the same side of the hull.

    Parameters
    ----------
    surface : SplineSurface
        The surface.
    name : str
        What to call its image.

    Notes
    -----
    y changes its sign, and u its sense: of the two each alone would turn the normals in.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.io.cad.both_sides import mirrored
    >>> side = SplineSurface.bezier([[[0, 1, 0], [0, 1, 2]], [[5, 1, 0], [5, 1, 2]]], "side")
    >>> mirrored(side, "other").net[0].tolist()
    [[5.0, -1.0, 0.0], [5.0, -1.0, 2.0]]
    """
    knots = surface.knots_u
    net = surface.net[::-1] * _ACROSS + 0.0
    weights = None if surface.weights is None else surface.weights[::-1].copy()
    turned = (knots[0] + knots[-1]) - knots[::-1]
    return SplineSurface(name, surface.degrees, turned, surface.knots_v, net, weights)
