"""The approximate development of a plate: its outline laid flat, and the strain that forming needs.

The surface is covered by a grid of nearly equal steps, the longer way first.
This is a geometric estimate: no thickness, no springback, no plasticity, no order of work.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import instance, integer, shown
from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.grid_flattening import FlatGrid, Springs, flatten_grid, springs_of

__all__ = [
    "LABEL",
    "Development",
    "EqualGrid",
    "development",
    "equal_grid",
]


_ACROSS = 17
"""Nodes across by default."""

_LEAST, _MOST = 17, 145
"""Nodes along by default: as many as make square cells, within these."""

_LOOKS = 129
"""Places each way at which lengths are measured."""


@attrs.frozen(eq=False)
class EqualGrid:
    """A grid of r by c nodes on a surface, and the points half-way between them.

    Parameters are chosen so that the mean lengths of the pieces of the lines between them are the
    same. The longer way comes first; seen from the side that r_u x r_v points to, the second axis
    lies to the left of the first.

    Attributes
    ----------
    u, v : (2r - 1, 2c - 1)
        Parameters; nodes are every other one.
    fine : (2r - 1, 2c - 1, 3), m
        Points of the surface there.
    sides : (2,), m
        Mean lengths of the surface along and across.
    """

    u: FloatArray
    v: FloatArray
    fine: FloatArray
    sides: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.u, self.v, self.fine, self.sides)

    @property
    def shape(self) -> tuple[int, int]:
        """The numbers r and c of nodes along and across."""
        return self.place.shape[0], self.place.shape[1]

    @property
    def place(self) -> FloatArray:
        """The nodes, (r, c, 3), m."""
        return self.fine[::2, ::2]


def equal_grid(surface: SplineSurface, count: tuple[int, int] | None = None) -> EqualGrid:
    """Lay a grid on a surface: by default 17 nodes across and as many along as make square cells.

    Raises BadInputError for a surface without length one way.
    """
    (u0, u1), (v0, v1) = surface.domain
    u, v = np.linspace(u0, u1, _LOOKS), np.linspace(v0, v1, _LOOKS)
    point = surface.at(u[:, None], v)
    along_u = _travelled(point)
    along_v = _travelled(np.swapaxes(point, 0, 1))
    turned = bool(along_v[-1] > along_u[-1])
    sides = np.array([along_u[-1], along_v[-1]])[:: -1 if turned else 1]
    if not sides[1] > 1e-9 * sides[0]:
        raise BadInputError(
            f"it is {sides[0]:.3g} m long and {sides[1]:.3g} m broad", surface.where,
            "give a surface, not a line",
        )  # fmt: skip
    r, c = count if count is not None else _counts(sides)
    counts = (c, r) if turned else (r, c)
    u = np.interp(_even(counts[0], along_u[-1]), along_u, u)
    v = np.interp(_even(counts[1], along_v[-1]), along_v, v)
    uu, vv = np.meshgrid(u, v, indexing="ij")
    if turned:  # (v, -u) is as right-handed as (u, v)
        uu, vv = uu.T[:, ::-1], vv.T[:, ::-1]
    return EqualGrid(uu, vv, surface.at(uu, vv), sides)


def _travelled(point: FloatArray) -> FloatArray:
    """Give the mean way along the first axis from its start, (n,), m."""
    steps = np.linalg.norm(np.diff(point, axis=0), axis=-1).mean(axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _even(count: int, length: float) -> FloatArray:
    """Give even steps of a way, with those half-way."""
    return np.linspace(0.0, length, 2 * count - 1)


def _counts(sides: FloatArray) -> tuple[int, int]:
    """Give the numbers of nodes that make square cells."""
    along = round(float(sides[0] / sides[1]) * (_ACROSS - 1)) + 1
    return min(max(along, _LEAST), _MOST), _ACROSS


# --------------------------------------------------------------------------------------
# The development. A strip of breadth b and constant curvature K shows strains along it that range
# over |K| b**2 / 8, from -K b**2 / 12 at its edges to K b**2 / 24 in its middle.
# Source: the idea of strain maps for the forming of plates is that of "Curvature Region Analysis
# for Application of Plates Forming", J. SNAK; springs, lengths and search are our own.

LABEL = "geometric estimate, no springback, no plasticity"
"""What every picture and table of a development has to say."""

_WHERE = "in development"
_MOST_NODES = 257


@attrs.frozen(eq=False, repr=False)
class Development(ShownAsText):
    """A surface laid flat, as a grid of r nodes along and c across.

    All strains are what forming must put in: length on the surface over length in the plane, less
    one. Positive where the flat plate is to be stretched, negative where it is to be shrunk.

    Attributes
    ----------
    name : str
        The name of the surface.
    u, v : (r, c)
        Parameters of the nodes.
    place : (r, c, 3), m
        The nodes on the surface.
    flat : (r, c, 2), m
        The nodes in the plane, as seen from the side that r_u x r_v points to; the longer way
        runs along +x, the centre lies at the origin.
    longitudinal : (r - 1, c)
        Strain from node to node along.
    transverse : (r, c - 1)
        Strain from node to node across.
    diagonal : (2, r - 1, c - 1)
        Strain of both diagonals of each cell, from (i, j) to (i + 1, j + 1) and from (i + 1, j)
        to (i, j + 1).
    area, flat_area : float, m2
        Of the surface, from its grid, and of the plane figure.
    notes : tuple of str
        What is to be known, each a sentence.
    """

    name: str
    u: FloatArray
    v: FloatArray
    place: FloatArray
    flat: FloatArray
    longitudinal: FloatArray
    transverse: FloatArray
    diagonal: FloatArray
    area: float
    flat_area: float
    notes: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.u, self.v, self.place, self.flat)
        freeze(self.longitudinal, self.transverse, self.diagonal)

    @property
    def largest_strain(self) -> float:
        """The largest amount of all strains along and across."""
        return float(max(np.abs(self.longitudinal).max(), np.abs(self.transverse).max()))

    @property
    def area_change(self) -> float:
        """What forming adds to the area, as a part of that of the plane figure."""
        return self.area / self.flat_area - 1.0

    @property
    def size(self) -> FloatArray:
        """How long and how broad the plane figure is, (2,), m."""
        return np.asarray(np.ptp(self.flat.reshape(-1, 2), axis=0))

    @property
    def outline(self) -> FloatArray:
        """The border of the plane figure, (2 (r + c) - 4, 2), m, counter-clockwise, not closed."""
        return _border(self.flat)

    @property
    def outline_on_surface(self) -> FloatArray:
        """The same nodes on the surface, (2 (r + c) - 4, 3), m."""
        return _border(self.place)

    def __str__(self) -> str:
        long, broad = self.size
        return (
            f"{self.name or 'plate'}: {long:.2f} x {broad:.2f} m flat, "
            f"largest strain {self.largest_strain:.1e} ({LABEL})"
        )


def development(surface: SplineSurface, grid: tuple[int, int] | None = None) -> Development:
    """Lay a surface flat and tell the strain that makes the flat plate the surface.

    Parameters
    ----------
    surface : SplineSurface
        The surface, a plate.
    grid : (along, across), optional
        Nodes of the grid, 3 to 257 each. By default 17 across and as many along as make square
        cells (17 to 145): 49 by 17 for a plate of 6 by 2 m.

    Returns
    -------
    Development
        The plane figure, its outline and the strains.

    Raises
    ------
    BadInputError, WrongTypeError
        No surface, another grid; a surface that is a line.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.surface.plating.development import development
    >>> x, y = np.mgrid[-1:1:3j, -1:1:3j]
    >>> net = np.stack([3 * x, y, 0.3 * x * y], axis=-1)
    >>> flat = development(SplineSurface.bezier(net, "hypar"))
    >>> bool(flat.longitudinal[24, 0] > 0 > flat.longitudinal[24, 8])
    True
    """
    instance(surface, SplineSurface, "surface", _WHERE)
    points = equal_grid(surface, _checked_grid(grid))
    springs = springs_of(points.fine)
    flat = flatten_grid(springs)
    along, across, falling, rising = springs.parted(flat.strain)
    cells = _cells(flat.place)
    return Development(
        surface.name, points.u[::2, ::2].copy(), points.v[::2, ::2].copy(), points.place.copy(),
        flat.place, along, across, np.stack([falling, rising]), float(springs.cell.sum()),
        float(cells.sum()), _notes(surface, points, springs, flat, cells),
    )  # fmt: skip


def _checked_grid(grid: object) -> tuple[int, int] | None:
    """Check the numbers of nodes along and across; None for the default."""
    if grid is None:
        return None
    if not isinstance(grid, tuple | list) or len(grid) != 2:
        remedy = "give the numbers of nodes along and across, or None"
        raise BadInputError(f"grid is {shown(grid)}", _WHERE, remedy)
    along, across = (
        integer(each, "a number of grid", _WHERE, least=3, most=_MOST_NODES) for each in grid
    )
    return along, across


def _cells(flat: FloatArray) -> FloatArray:
    """Give the signed area of each cell of the plane figure, (r - 1, c - 1), m2."""
    one, other = flat[1:, 1:] - flat[:-1, :-1], flat[:-1, 1:] - flat[1:, :-1]
    found: FloatArray = 0.5 * (one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])
    return found


def _border(values: FloatArray) -> FloatArray:
    """Give what stands at the border of a grid, once around."""
    sides = values[:-1, 0], values[-1, :-1], values[:0:-1, -1], values[0, :0:-1]
    return np.concatenate(sides)


def _notes(
    surface: SplineSurface, grid: EqualGrid, springs: Springs, flat: FlatGrid, cells: FloatArray
) -> tuple[str, ...]:
    """Say what is to be known of the figure."""
    found, who = [], surface.name or "the plate"
    if not flat.settled:
        found.append(f"The development of {who} did not come to rest; do not use it.")
    if over := int((cells < 0.0).sum()):
        found.append(
            f"In the development of {who} {over} of {cells.size} cells are turned over; "
            "cut the plate into smaller ones."
        )
    if poles := int(springs.short.sum()):
        found.append(
            f"{who} has a border or spot of no length; {poles} springs there are left out."
        )
    shape = np.array(grid.shape) - 1.0
    step = grid.sides / shape
    if not 0.2 < step[0] / step[1] < 5.0:
        found.append(
            f"The cells of the grid of {who} are {step[0]:.3g} by {step[1]:.3g} m; strains along "
            "and across are not weighed alike."
        )
    return tuple(found)
