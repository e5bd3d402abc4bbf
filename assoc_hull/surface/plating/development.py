"""The approximate development of a plate: its grid laid flat, and the strain that forming needs.

The surface is covered by a grid of nearly equal steps, the longer way first.
This is a geometric estimate: no thickness, no springback, no plasticity, no order of work.

A grid of points of a surface laid flat, so that lengths between neighbours change least.

Springs run along, across and on both diagonals, with the length of the geodesic, not of the chord.
The search starts from the least-squares conformal figure (Levy and others 2002), which is the
answer for a developable surface; damped Gauss-Newton steps follow.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, eye_array
from scipy.sparse.linalg import splu

from assoc_hull.arguments import instance, integer, shown
from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = [
    "LABEL",
    "Development",
    "EqualGrid",
    "FlatGrid",
    "Springs",
    "development",
    "equal_grid",
    "flatten_grid",
    "springs_of",
]

_SHORT = 1e-7
"""A spring below this part of the mean joins points that are one, as at a pole."""


@attrs.frozen(eq=False)
class Springs:
    """The springs of a grid of r by c nodes; node (i, j) has the number i c + j.

    Attributes
    ----------
    along : (r - 1, c), m
        Length from (i, j) to (i + 1, j).
    across : (r, c - 1), m
        Length from (i, j) to (i, j + 1).
    falling : (r - 1, c - 1), m
        Length from (i, j) to (i + 1, j + 1).
    rising : (r - 1, c - 1), m
        Length from (i + 1, j) to (i, j + 1).
    cell : (r - 1, c - 1), m2
        Area of each cell.
    """

    along: FloatArray
    across: FloatArray
    falling: FloatArray
    rising: FloatArray
    cell: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.along, self.across, self.falling, self.rising, self.cell)

    @property
    def shape(self) -> tuple[int, int]:
        """The numbers of nodes along and across."""
        return self.across.shape[0], self.along.shape[1]

    @property
    def length(self) -> FloatArray:
        """All lengths (s,), m: along, across, falling, rising."""
        return _in_a_row(self.along, self.across, self.falling, self.rising)

    @property
    def ends(self) -> IntArray:
        """The nodes that each spring joins, (2, s)."""
        node = np.arange(self.along.shape[1] * self.across.shape[0]).reshape(self.shape)
        first = _in_a_row(node[:-1], node[:, :-1], node[:-1, :-1], node[1:, :-1])
        second = _in_a_row(node[1:], node[:, 1:], node[1:, 1:], node[:-1, 1:])
        return np.stack([first, second])

    @property
    def weight(self) -> FloatArray:
        """The area that each spring stands for, (s,), m2: half of each cell beside it."""
        along, across = np.zeros_like(self.along), np.zeros_like(self.across)
        along[:, :-1] += 0.5 * self.cell
        along[:, 1:] += 0.5 * self.cell
        across[:-1] += 0.5 * self.cell
        across[1:] += 0.5 * self.cell
        return _in_a_row(along, across, self.cell, self.cell)

    @property
    def short(self) -> NDArray[np.bool_]:
        """Which join points that are one, (s,) bool."""
        length = self.length
        return np.asarray(length <= _SHORT * length.mean())

    def parted(self, values: FloatArray) -> tuple[FloatArray, ...]:
        """Give values of all springs (s,) as arrays of along, across, falling, rising."""
        (r, c), found, at = self.shape, [], 0
        for shape in ((r - 1, c), (r, c - 1), (r - 1, c - 1), (r - 1, c - 1)):
            size = shape[0] * shape[1]
            found.append(values[at : at + size].reshape(shape))
            at += size
        return tuple(found)


def springs_of(fine: FloatArray) -> Springs:
    """Give the springs of every other point of a fine grid (2r - 1, 2c - 1, 3), m, of a surface.

    The points between the nodes say how it bends there.
    """
    normal = _normals(fine)
    node = fine[::2, ::2]
    middle, there = fine[1::2, 1::2], normal[1::2, 1::2]
    return Springs(
        along=_lengths(node[:-1], node[1:], fine[1::2, ::2], normal[1::2, ::2]),
        across=_lengths(node[:, :-1], node[:, 1:], fine[::2, 1::2], normal[::2, 1::2]),
        falling=_lengths(node[:-1, :-1], node[1:, 1:], middle, there),
        rising=_lengths(node[1:, :-1], node[:-1, 1:], middle, there),
        cell=_cell_areas(fine),
    )


def _in_a_row(*parts: NDArray[Any]) -> NDArray[Any]:
    """Lay arrays of along, across, falling, rising one behind the other."""
    found: NDArray[Any] = np.concatenate([part.ravel() for part in parts])
    return found


def _normals(fine: FloatArray) -> FloatArray:
    """Give unit normals at all points of a grid; zero where there is none."""
    normal = np.cross(np.gradient(fine, axis=0), np.gradient(fine, axis=1))
    size = np.linalg.norm(normal, axis=-1, keepdims=True)
    return np.asarray(np.divide(normal, size, out=np.zeros_like(normal), where=size > 0.0))


def _lengths(
    start: FloatArray, end: FloatArray, middle: FloatArray, normal: FloatArray
) -> FloatArray:
    """Give geodesic lengths from chords and what the surface stands off their middles.

    With c the chord and d the normal distance of the surface from its middle, c + 8 d**2 / (3 c) is
    exact but for the fourth power of the step. A chord would make every curved plate a little too
    small, and unevenly where rulings run askew to the grid.
    """
    chord = np.linalg.norm(end - start, axis=-1)
    off = ((middle - 0.5 * (start + end)) * normal).sum(axis=-1)
    more = np.divide(8.0 * off**2, 3.0 * chord, out=np.zeros_like(chord), where=chord > 0.0)
    return np.asarray(chord + more)


def _cell_areas(fine: FloatArray) -> FloatArray:
    """Give the area of each cell: its own quadrangle and the four in it, extrapolated."""
    four = _quadrangles(fine)
    r, c = four.shape
    sums = four.reshape(r // 2, 2, c // 2, 2).sum(axis=(1, 3))
    return np.asarray((4.0 * sums - _quadrangles(fine[::2, ::2])) / 3.0)


def _quadrangles(place: FloatArray) -> FloatArray:
    """Give half the cross products of the diagonals of all cells of a grid, m2."""
    one, other = place[1:, 1:] - place[:-1, :-1], place[:-1, 1:] - place[1:, :-1]
    return np.asarray(0.5 * np.linalg.norm(np.cross(one, other), axis=-1))


# --------------------------------------------------------------------------------------
# The search. Least is the sum of squared relative changes of length, each weighted with the area
# that its spring stands for. With square cells the four directions of springs together weigh all
# directions alike, as a sheet with a Poisson's ratio of 1/3 does.

ComplexArray = NDArray[np.complex128]

_STEPS = 40
"""Gauss-Newton steps at most; six are usual."""

_STILL = 1e-11
"""The search ends with a step below this part of the size of the figure."""

_GAIN = 1e-10
"""It ends, too, with a step that lessens the sum of squares by no more than this part of it."""

_DAMPING = 1e-9
"""Part of the mean diagonal of the normal equations that is added to all of it: the figure is free
to move in its plane."""


@attrs.frozen(eq=False)
class FlatGrid:
    """A grid laid flat, its first axis along +x.

    Attributes
    ----------
    place : (r, c, 2), m
        Where each node lies.
    strain : (s,)
        What forming must put into each spring: its length on the surface over that in the
        plane, less one. Positive where the plate is to be stretched; zero at a pole.
    settled : bool
        Whether the search came to rest.
    """

    place: FloatArray
    strain: FloatArray
    settled: bool

    def __attrs_post_init__(self) -> None:
        freeze(self.place, self.strain)


def flatten_grid(springs: Springs) -> FlatGrid:
    """Lay a grid flat with the least change of lengths; also give the strain of each spring."""
    node = _nodes(springs)
    kept = ~springs.short
    first, second = node[springs.ends[:, kept]]
    length, weight = springs.length[kept], springs.weight[kept]
    z, settled = _relaxed(_conformal(springs, node), first, second, length, weight)
    z = _laid(z[node].reshape(springs.shape))
    strain = np.zeros(len(kept))
    ends = z.ravel()[springs.ends[:, kept]]
    apart = np.abs(ends[1] - ends[0])
    strain[kept] = np.divide(length, apart, out=np.ones_like(length), where=apart > 0.0) - 1.0
    return FlatGrid(np.stack([z.real, z.imag], axis=-1), strain, settled)


def _nodes(springs: Springs) -> IntArray:
    """Give the number of the point that each node is; nodes at a pole are one."""
    found = np.arange(springs.shape[0] * springs.shape[1])
    first, second = springs.ends[:, springs.short]
    while (found[first] != found[second]).any():
        np.minimum.at(found, second, found[first])
        np.minimum.at(found, first, found[second])
    return found


def _conformal(springs: Springs, node: IntArray) -> ComplexArray:
    """Give the figure whose triangles are as nearly alike to those of the surface as can be.

    Of a developable surface it is the answer already, also where the surface is rolled up and a
    projection onto a plane would overlap. Source: B. Levy and others, "Least Squares Conformal
    Maps", ACM Trans. Graphics 21(3), 2002.
    """
    corners, a, b, c = _triangles(springs)
    # The triangle with its first side on the real axis; sides opposite to the three corners.
    x = 0.5 * (a**2 + c**2 - b**2) / a
    y = np.sqrt(np.maximum(c**2 - x**2, 0.0))
    fit = y > 1e-6 * a
    corners, a, apex = node[corners[:, fit]], a[fit], (x + 1j * y)[fit]
    sides = np.stack([apex - a, -apex, a + 0j]) / np.sqrt(a * y[fit])
    rows = np.broadcast_to(np.arange(len(a)), corners.shape)
    matrix = coo_array(
        (sides.ravel(), (rows.ravel(), corners.ravel())), (len(a), len(node))
    ).tocsc()
    pins = node[np.array([springs.shape[1] // 2, -1 - springs.shape[1] // 2])]
    z = _pinned(matrix, pins, float(springs.along.mean(axis=1).sum()))
    apart = np.abs(z[node[springs.ends[0]]] - z[node[springs.ends[1]]]).sum()
    if not 0.0 < apart < np.inf:  # folded beyond all likeness: any start is as good
        along, across = springs.along.mean(axis=1), springs.across.mean(axis=0)
        return np.asarray(np.add.outer(_summed_steps(along), 1j * _summed_steps(across)).ravel())
    return np.asarray(z * (springs.length.sum() / apart))


def _summed_steps(steps: FloatArray) -> FloatArray:
    """Give where some steps lead, from 0."""
    return np.concatenate([[0.0], np.cumsum(steps)])


def _triangles(springs: Springs) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
    """Give corners (3, t), and sides from first to second, second to third, third to first."""
    node = np.arange(springs.shape[0] * springs.shape[1]).reshape(springs.shape)
    near, far, ahead, beyond = node[:-1, :-1], node[:-1, 1:], node[1:, :-1], node[1:, 1:]
    lower = (near, ahead, beyond), (springs.along[:, :-1], springs.across[1:], springs.falling)
    upper = (far, near, beyond), (springs.across[:-1], springs.falling, springs.along[:, 1:])
    corners = [
        np.concatenate([p.ravel(), q.ravel()]) for p, q in zip(lower[0], upper[0], strict=True)
    ]
    sides = [
        np.concatenate([p.ravel(), q.ravel()]) for p, q in zip(lower[1], upper[1], strict=True)
    ]
    whole = np.minimum.reduce(sides) > 1e-7 * springs.length.mean()
    return np.stack(corners)[:, whole], *(side[whole] for side in sides)


def _pinned(matrix: csc_array, pins: IntArray, apart: float) -> ComplexArray:
    """Solve matrix z = 0 by least squares, with two points held at 0 and at a distance."""
    free = np.ones(matrix.shape[1], bool)
    free[pins] = False
    free &= np.diff(matrix.indptr) > 0
    left = matrix[:, free]
    right = -matrix[:, pins[1:]].toarray()[:, 0] * apart
    adjoint = left.conj().T
    normal = (adjoint @ left).tocsc()
    z = np.zeros(matrix.shape[1], np.complex128)
    z[pins[1]] = apart
    with suppress(RuntimeError):  # a singular matrix: triangles that are lines
        z[free] = splu(normal).solve(adjoint @ right)
    return z


def _relaxed(
    z: ComplexArray, first: IntArray, second: IntArray, length: FloatArray, weight: FloatArray
) -> tuple[ComplexArray, bool]:
    """Make Gauss-Newton steps until they are still."""
    root = np.sqrt(weight / weight.sum()) / length
    size = np.abs(z).max()

    def residual(at: ComplexArray) -> FloatArray:
        found: FloatArray = root * (np.abs(at[second] - at[first]) - length)
        return found

    off = residual(z)
    least = float(off @ off)
    for _ in range(_STEPS):
        step = _step(z, first, second, root, off)
        part = 1.0
        while part > 1e-4 and (residual(z + part * step) ** 2).sum() > least:
            part *= 0.5
        z = z + part * step
        off, before = residual(z), least
        least = float(off @ off)
        still = part * np.abs(step).max() <= _STILL * size
        if still or 0.0 <= before - least <= _GAIN * before:
            return z, True
    return z, False


def _step(
    z: ComplexArray, first: IntArray, second: IntArray, root: FloatArray, off: FloatArray
) -> ComplexArray:
    """Give the step that would be the last if lengths were linear in places."""
    side = z[second] - z[first]
    size = np.abs(side)
    ahead = np.divide(root, size, out=np.zeros_like(root), where=size > 0.0) * side
    row, count = np.arange(len(off)), len(z)
    slope = coo_array(
        (
            np.concatenate([ahead.real, -ahead.real, ahead.imag, -ahead.imag]),
            (np.tile(row, 4), np.concatenate([second, first, second + count, first + count])),
        ),
        (len(off), 2 * count),
    ).tocsr()
    normal = slope.T @ slope
    damped = normal + _DAMPING * normal.diagonal().mean() * eye_array(2 * count)
    step = splu(damped.tocsc(), permc_spec="MMD_AT_PLUS_A").solve(-(slope.T @ off))
    return np.asarray(step[:count] + 1j * step[count:])


def _laid(z: ComplexArray) -> ComplexArray:
    """Lay the figure with its centre at the origin and its first axis along +x."""
    along = z[-1].mean() - z[0].mean()
    size = np.abs(along)
    return np.asarray((z - z.mean()) * (np.conj(along) / size if size > 0.0 else 1.0))


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
