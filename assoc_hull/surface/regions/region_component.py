"""One connected piece of the lines along which the Gaussian curvature has a value.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.surface.regions.region_component import Component
>>> line = np.array([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0]])
>>> piece = Component("open", 0.0, 0, (0,), (line[:, :2],), (line,), 2, ())
>>> piece.length, piece.singular
(5.0, False)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Component"]


@attrs.frozen(eq=False)
class Component:
    """A piece of the lines K = constant of a surface.

    Attributes
    ----------
    kind : {"closed", "open", "junction", "isolated", "edge_line"}
        A loop; a line from border to border (or to a knot where K jumps); lines that meet in an
        unresolved spot; a spot without lines, which may hold a point contact, a loop that is too
        small, or a double line; a border of a patch along which K has the value.
    level : float, 1/m2
        The value of K.
    surface : int
        The number of the surface, from 0.
    patches : tuple of int
        The numbers of the patches it passes, counted through all surfaces.
    uv : tuple of (n, 2)
        Polylines in parameters of the surface; of a loop the last point is the first again, of an
        isolated spot the only point is its middle.
    xyz : tuple of (n, 3), m
        The same points in space; each lies on the line, the chords stray by no more than the
        tolerance.
    ends : int
        Of a junction, how many lines lead to it; of an open line 2, else 0.
    tags : tuple of str
        "singular": the surface has no tangent plane there, and the piece is none of the shape.
        "knot-line": an end lies on a knot, where K jumps. "tangent": a line was followed through
        cells that were not resolved, and in which it is proven to be one line. "flat": it meets
        cells in which K has the value throughout, within what control points are known to. "gap":
        it was followed where K has the value within rounding.
    spots : (s, 3), m
        Where unresolved cells, or such in which K counts as nil, belong to it: a point for each
        group of cells that touch.
    """

    kind: str
    level: float
    surface: int
    patches: tuple[int, ...]
    uv: tuple[FloatArray, ...] = attrs.field(repr=False)
    xyz: tuple[FloatArray, ...] = attrs.field(repr=False)
    ends: int
    tags: tuple[str, ...]
    spots: FloatArray = attrs.field(factory=lambda: np.zeros((0, 3)), repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(self.spots, *self.uv, *self.xyz)

    @property
    def singular(self) -> bool:
        """Whether it is a spot where the surface has no tangent plane."""
        return "singular" in self.tags

    @property
    def length(self) -> float:
        """The length of its polylines, m."""
        steps = (np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in self.xyz)
        return float(sum(steps))
