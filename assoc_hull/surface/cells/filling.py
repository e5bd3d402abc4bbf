"""Cells filled with small four-sided elements that fit together along every edge.

A cell of four sides is a Coons patch, one of k sides is divided into k of them, one of two is a
ladder. What is filled in is the height over a cubic polynomial in a frame at the mean normal.
Source: S. A. Coons, Surfaces for computer-aided design of space forms, MIT, MAC-TR-41, 1967.
"""

from __future__ import annotations

from itertools import pairwise

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.surface.cells.net_faces import NetCells, half_edge_origins

__all__ = [
    "FilledCells",
    "LocalFrames",
    "fill_cells",
    "local_frames",
]

# The height of a smooth surface over a cell of its net is close to a cubic polynomial. What is
# filled in between the edges is what they differ from it by, which is next to nothing.

_RIDGE = 1e-4
_NORMALS = 0.5
"""Weight of the slopes at the nodes, beside points on the edges."""

_STEEP = 0.3
"""With a smaller cosine between the normal of a node and the mean no heights are fitted."""

_LEVEL = 1e-7
"""Of the size of a cell: points so near to a plane lie in it, and so small heights are none."""

_MISSED = 0.07
"""Of the size of a cell: a cubic that misses its edges by more says nothing of the cell."""

_TOUCH, _ALONG = 1e-5, 0.999
"""Corners within this part of the length of the hull of a flat touch it, where the normal has at
least this cosine with that of the flat."""

_POWERS = np.array([(i, j) for i in range(4) for j in range(4 - i)])


@attrs.frozen(eq=False)
class LocalFrames:
    """A frame for each of some cells.

    Attributes
    ----------
    origin : (c, 3), m
        In the midst of each cell.
    axes : (c, 3, 3), 1/m
        Rows: two across the mean normal, and that normal, by the size of the cell.
    height : (c, 10)
        The cubic polynomial of the height; zero where the cell is bent too much.
    bent : (c,) bool
        Cells of four lines that are bent so much that a polynomial misses these.
    """

    origin: FloatArray
    axes: FloatArray
    height: FloatArray
    bent: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.origin, self.axes, self.height, self.bent)

    def flattened(self, place: FloatArray) -> FloatArray:
        """Give two places across and what is left of the height, (c, k, 3), of points (c, k, 3)."""
        found = _seen(self.origin, self.axes, place)
        found[..., 2] -= _value(self.height, found[..., :2])
        return found

    def restored(self, flat: FloatArray) -> FloatArray:
        """Give the points, (c, k, 3), m, from what `flattened` gives."""
        flat = flat.copy()
        flat[..., 2] += _value(self.height, flat[..., :2])
        # The rows of the axes are at right angles and of one length.
        size = dot(self.axes[:, 0], self.axes[:, 0])[:, None, None]
        found = self.origin[:, None] + np.einsum("ckj,cji->cki", flat, self.axes) / size
        return np.asarray(found)


def local_frames(
    rim: FloatArray, corner: FloatArray, normal: FloatArray, four: NDArray[np.bool_] | bool = False
) -> LocalFrames:
    """Lay a frame over each of some cells with equally many corners.

    Heights are fitted to points `rim` (c, r, 3), m, on the edges and to the slopes that unit
    normals (c, k, 3) of the hull have at the corners (c, k, 3), m. Cells of `four` lines (c,) can
    do without.
    """
    mean = normal.sum(axis=1)
    size = np.sqrt(dot(mean, mean))
    up = np.where(size[:, None] > 1e-6, mean / np.maximum(size, 1e-6)[:, None], [0.0, 0.0, 1.0])
    # The axis that is least along the normal: its cross product with that is longest.
    least = np.abs(up).argmin(axis=1)
    across = np.cross(np.eye(3)[least], up)
    across /= np.sqrt(dot(across, across))[:, None]
    origin = rim.mean(axis=1)
    away = rim - origin[:, None]
    reach = np.maximum(np.sqrt(dot(away, away)).max(axis=1), 1e-12)
    unit = np.stack([across, np.cross(up, across), up], axis=1)
    axes = unit / reach[:, None, None]
    tilted = np.einsum("cki,cji->ckj", normal, unit)
    good = (size > 1e-6) & (tilted[..., 2] >= _STEEP).all(axis=1)
    height = np.zeros((len(rim), len(_POWERS)))
    height[good] = _fitted(
        _seen(origin, axes, rim)[good], _seen(origin, axes, corner)[good], tilted[good]
    )
    # A cell from keel to deck between two stations is large and round: a cubic off its own edges
    # would bulge out of the hull between them.
    seen = _seen(origin, axes, rim)
    missed = np.abs(seen[..., 2] - _value(height, seen[..., :2])).max(axis=1) > _MISSED
    missed &= four
    height[missed] = 0.0
    # A cell of a flat is flat, though the hull may leave its border at an angle, and the normal
    # there be that of both.
    bent = (np.abs(height[:, 1:]).max(axis=1) > _LEVEL) & good
    height[np.flatnonzero(bent)[_in_one_plane(away[bent], reach[bent])]] = 0.0
    return LocalFrames(origin, axes, height, missed)


def _in_one_plane(away: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
    """Tell of which cells all points (c, r, 3), m from their mean, lie in a plane, (c,)."""
    spread = np.einsum("cri,crj->cij", away, away) / reach[:, None, None] ** 2
    normal = np.linalg.eigh(spread)[1][..., 0]
    off: FloatArray = np.abs(np.einsum("cri,ci->cr", away, normal)).max(axis=1)
    return np.asarray(off <= _LEVEL * reach)


def _seen(origin: FloatArray, axes: FloatArray, place: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("cki,cji->ckj", place - origin[:, None], axes))


def _terms(ab: FloatArray) -> FloatArray:
    """Give the ten terms, (c, k, 10), at places (c, k, 2)."""
    power = ab[..., None, :] ** np.arange(4)[:, None]
    return np.asarray(power[..., _POWERS[:, 0], 0] * power[..., _POWERS[:, 1], 1])


def _value(height: FloatArray, ab: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("ckt,ct->ck", _terms(ab), height))


def _slopes(ab: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the derivatives of the terms in both directions, (c, k, 10) each."""
    power = ab[..., None, :] ** np.arange(4)[:, None]
    rate = np.zeros_like(power)
    rate[..., 1:, :] = power[..., :-1, :] * np.arange(1, 4)[:, None]
    i, j = _POWERS.T
    return rate[..., i, 0] * power[..., j, 1], power[..., i, 0] * rate[..., j, 1]


def _fitted(rim: FloatArray, corner: FloatArray, normal: FloatArray) -> FloatArray:
    """Fit heights, (c, 10)."""
    along, up = _slopes(corner[..., :2])
    row = np.concatenate([_terms(rim[..., :2]), _NORMALS * along, _NORMALS * up], axis=1)
    slope = -normal[..., :2] / normal[..., 2:]
    wanted = np.concatenate(
        [rim[..., 2], _NORMALS * slope[..., 0], _NORMALS * slope[..., 1]], axis=1
    )
    normal_matrix = np.einsum("crs,crt->cst", row, row) + _RIDGE * np.eye(row.shape[2])
    return np.asarray(
        np.linalg.solve(normal_matrix, np.einsum("crs,cr->cs", row, wanted)[..., None])[..., 0]
    )


# --------------------------------------------------------------------------------------
# Both cells at an edge share its points. A cell of k sides is divided by lines from the middles of
# its sides to its own middle.


@attrs.frozen(eq=False)
class FilledCells:
    """The cells of a half hull, filled.

    Attributes
    ----------
    cells : NetCells
        The cells.
    steps : int
        Into how many parts each edge is cut.
    xyz : (v, 3), m
        Vertices: nodes of the net first, then points on edges, then points within cells.
    quad : (q, 4) int
        Vertices of the elements, counter-clockwise from outside. Those with two equal corners
        are triangles.
    cell : (q,) int
        The cell of each.
    """

    cells: NetCells
    steps: int
    xyz: FloatArray
    quad: IntArray
    cell: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz, self.quad, self.cell)

    def along(self, half: IntArray) -> IntArray:
        """Give the vertices along half-edges, (h, steps + 1)."""
        found = edge_vertices(self.cells, self.steps)[half >> 1]
        back = (half & 1) == 1
        found[back] = found[back, ::-1]
        return np.asarray(found)

    def triangles(self) -> tuple[IntArray, IntArray]:
        """Cut the elements along diagonals; give the triangles and their cells.

        The shorter one is taken, but at a node of two edges that from the node: the other would
        belong to both cells there, or to both halves of the hull.
        """
        a, b, c, d = self.quad.T
        one, other = (self.xyz[p] - self.xyz[q] for p, q in ((a, c), (b, d)))
        bare = np.append(self.cells.graph.degree == 2, False)
        bare = bare[np.minimum(self.quad, len(bare) - 1)]
        first = (dot(one, one) <= dot(other, other)) | bare[:, 0] | bare[:, 2]
        first &= ~(bare[:, 1] | bare[:, 3])
        # An element with two equal corners has one diagonal only, from one of these.
        first |= (a == b) | (c == d)
        return _cut(self.quad, first, self.cell)


def _cut(quad: IntArray, first: NDArray[np.bool_], cell: IntArray) -> tuple[IntArray, IntArray]:
    """Cut elements from their first corner to their third, or from the second to the fourth."""
    one = quad[:, [[0, 1, 2], [0, 2, 3]]]
    other = quad[:, [[0, 1, 3], [1, 2, 3]]]
    cut = np.where(first[:, None, None], one, other).reshape(-1, 3)
    real = (cut != np.roll(cut, 1, axis=1)).all(axis=1)
    return cut[real], cell.repeat(2)[real]


def edge_vertices(cells: NetCells, steps: int) -> IntArray:
    """Give the vertices along every edge, (e, steps + 1)."""
    edge, nodes = cells.graph.edge, len(cells.graph.place)
    inner = nodes + np.arange(len(edge) * (steps - 1)).reshape(len(edge), steps - 1)
    return np.concatenate([edge[:, :1], inner, edge[:, 1:]], axis=1)


def fill_cells(cells: NetCells, steps: int) -> FilledCells:
    """Fill the cells of a net.

    Parameters
    ----------
    cells : NetCells
        The cells.
    steps : int
        Into how many parts each edge is cut; even.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.curve_net import gather_net
    >>> from assoc_hull.surface.cells.net_faces import find_cells
    >>> from assoc_hull.surface.cells.filling import fill_cells
    >>> from assoc_hull.surface.cells.net_graph import net_graph
    >>> found = fill_cells(find_cells(net_graph(gather_net(ah.examples.wigley().state))), 2)
    >>> found.quad.shape, found.triangles()[0].shape  # 220 cells of 2 x 2 elements
    ((880, 4), (1760, 3))
    """
    graph = cells.graph
    edge_points = graph.points(steps)[:, 1:-1].reshape(-1, 3)
    start = FilledCells(
        cells, steps, np.concatenate([graph.place, edge_points]),
        np.empty((0, 4), np.int64), np.empty(0, np.int64),
    )  # fmt: skip
    xyz, quad, owner, used = [start.xyz], [start.quad], [start.cell], len(start.xyz)
    for sides in np.unique(cells.sides).tolist():
        chosen = np.flatnonzero(cells.sides == sides)
        inner, quads = _filled(start, chosen, sides, used)
        xyz.append(inner)
        used += len(inner)
        quad.append(quads.reshape(-1, 4))
        owner.append(chosen.repeat(quads.shape[1]))
    return FilledCells(
        cells, steps, np.concatenate(xyz), np.concatenate(quad), np.concatenate(owner)
    )


def _filled(
    start: FilledCells, chosen: IntArray, sides: int, used: int
) -> tuple[FloatArray, IntArray]:
    """Give the inner points of cells with equally many sides, and their elements (c, q, 4)."""
    half = start.cells.half[start.cells.start[chosen][:, None] + np.arange(sides)]
    rim = start.along(half.ravel()).reshape(*half.shape, -1)
    if sides == 2:
        return np.empty((0, 3)), _grid_quads(np.stack([rim[:, 0], rim[:, 1, ::-1]], axis=2))
    frames = _frames(start, half, rim)
    flat = frames.flattened(start.xyz[rim].reshape(len(rim), -1, 3)).reshape(*rim.shape, 3)
    if sides == 4:
        point, quads = _four_sided(rim, flat, used)
    else:
        point, quads = _many_sided(rim, flat, used)
    place = frames.restored(point)
    if sides > 4:
        turns = _turns(start, half)
        for cell in np.flatnonzero(frames.bent & (turns.sum(axis=1) == 4)).tolist():
            place[cell] = _as_four_sided(start.xyz[rim[cell]], np.flatnonzero(turns[cell]))
    return _inside(place, *_bounds(start, half, rim)).reshape(-1, 3), quads


def _turns(start: FilledCells, half: IntArray) -> NDArray[np.bool_]:
    """Tell at which corners of cells the border goes on along another line, (c, k)."""
    curve = start.cells.graph.curve[half >> 1]
    return np.asarray(curve != np.roll(curve, 1, axis=1))


def _as_four_sided(rim: FloatArray, corner: IntArray) -> FloatArray:
    """Give inner points of a cell of four lines, on some of which others end, (p, 3), m.

    Of the Coons patch between the four lines, by arcs along each; `rim` is (k, steps + 1, 3).
    """
    turn = int(corner[0])
    rim, begin = np.roll(rim, -turn, axis=0), [*(corner - turn).tolist(), len(rim)]
    square = np.empty((*rim.shape[:2], 2))
    sides = []
    for i, (first, last) in enumerate(pairwise(begin)):
        line = np.concatenate([rim[first, :1], rim[first:last, 1:].reshape(-1, 3)])
        step = np.diff(line, axis=0)
        arc = np.concatenate([[0.0], np.cumsum(np.sqrt(dot(step, step)))])
        arc /= max(float(arc[-1]), 1e-300)
        part = np.stack([arc[each * (rim.shape[1] - 1) :][: rim.shape[1]]
                         for each in range(last - first)])  # fmt: skip
        square[first:last] = _CORNERS[i] + part[..., None] * (_CORNERS[(i + 1) % 4] - _CORNERS[i])
        sides.append((arc, line))
    number = np.zeros(rim.shape[:2], np.int64)
    uv = np.roll(square, turn, axis=0)
    u, v = _many_sided(number[None], uv[None], 0)[0][0].T
    across = (1.0 - v)[:, None] * _along(sides[0], u) + v[:, None] * _along(sides[2], 1.0 - u)
    along = (1.0 - u)[:, None] * _along(sides[3], 1.0 - v) + u[:, None] * _along(sides[1], v)
    a, b, c, d = (line[0] for _, line in sides)
    low = (1.0 - u)[:, None] * a + u[:, None] * b
    high = (1.0 - u)[:, None] * d + u[:, None] * c
    return np.asarray(across + along - (1.0 - v)[:, None] * low - v[:, None] * high)


_CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
"""Of the square that a cell of four lines is laid on."""


def _along(side: tuple[FloatArray, FloatArray], part: FloatArray) -> FloatArray:
    """Give places on a line by arcs from its begin, parts of its length, (p, 3), m."""
    arc, line = side
    return np.stack([np.interp(part, arc, line[:, k]) for k in range(3)], axis=1)


def _bounds(start: FilledCells, half: IntArray, rim: IntArray) -> tuple[FloatArray, FloatArray]:
    """Give the least z and the greatest y of cells that touch a flat there, (c,), m; else none.

    Such a cell has two corners or more at one height, the lowest, where the hull is level; or as
    far out, where it stands upright. Nothing of it lies beyond its edges there.
    """
    graph = start.cells.graph
    node = half_edge_origins(graph)[half]
    place, normal, edge = graph.place[node], graph.normal[node], start.xyz[rim]
    near = _TOUCH * float(np.ptp(graph.place[:, 0]))
    found = []
    for axis, sign in ((2, -1.0), (1, 1.0)):
        # Measured outward: the bottom looks down, the side to port.
        reach = sign * place[..., axis]
        most = (sign * edge[..., axis]).max(axis=(1, 2))
        touch = reach >= reach.max(axis=1, keepdims=True) - near
        touch &= sign * normal[..., axis] >= _ALONG
        found.append(sign * np.where(touch.sum(axis=1) >= 2, most, np.inf))
    return found[0], found[1]


def _inside(point: FloatArray, floor: FloatArray, wall: FloatArray) -> FloatArray:
    """Lay points (c, p, 3) that fall through the flat of their cell onto it.

    Where a cell is a part of the flat and a part not, the border goes through it undrawn: what
    Coons's patch has beyond the plane there is the flat.
    """
    found = point.copy()
    found[..., 2] = np.maximum(point[..., 2], floor[:, None])
    found[..., 1] = np.minimum(point[..., 1], wall[:, None])
    return found


def _frames(start: FilledCells, half: IntArray, rim: IntArray) -> LocalFrames:
    graph = start.cells.graph
    node = half_edge_origins(graph)[half]
    round_it = start.xyz[rim[:, :, :-1].reshape(len(rim), -1)]
    four = _turns(start, half).sum(axis=1) <= 4
    return local_frames(round_it, graph.place[node], graph.normal[node], four)


def _four_sided(rim: IntArray, flat: FloatArray, used: int) -> tuple[FloatArray, IntArray]:
    """Fill cells of four sides: points (c, p, 3) and elements (c, q, 4)."""
    count, steps = len(rim), rim.shape[2] - 1
    inner = _coons(flat[:, 0], flat[:, 1], flat[:, 2, ::-1], flat[:, 3, ::-1])
    number = used + np.arange(count * (steps - 1) ** 2).reshape(count, steps - 1, steps - 1)
    grid = _framed(number, rim[:, 0], rim[:, 1], rim[:, 2, ::-1], rim[:, 3, ::-1])
    return inner.reshape(count, -1, 3), _grid_quads(grid)


def _many_sided(rim: IntArray, flat: FloatArray, used: int) -> tuple[FloatArray, IntArray]:
    """Fill cells of other numbers of sides by one patch at each corner."""
    count, sides, steps = len(rim), rim.shape[1], rim.shape[2] - 1
    part = steps // 2
    middle = flat[:, :, part]
    centre = middle.mean(axis=1)
    share = np.linspace(0.0, 1.0, part + 1)[:, None]
    spoke = middle[:, :, None] * (1.0 - share) + centre[:, None, None] * share
    patch = [
        _coons(
            flat[:, i, : part + 1], spoke[:, i], spoke[:, i - 1], flat[:, i - 1, : part - 1 : -1]
        )
        for i in range(sides)
    ]
    # Inner points: the centre, then those on spokes, then those of the patches.
    inner = [each.reshape(count, -1, flat.shape[-1]) for each in (spoke[:, :, 1:-1], *patch)]
    point = np.concatenate([centre[:, None], *inner], axis=1)
    number = used + np.arange(count * point.shape[1]).reshape(count, -1)
    spokes = number[:, 1 : 1 + sides * (part - 1)].reshape(count, sides, part - 1)
    spokes = np.concatenate(
        [rim[:, :, part, None], spokes, number[:, None, :1].repeat(sides, axis=1)], axis=2
    )
    own = number[:, 1 + sides * (part - 1) :].reshape(count, sides, part - 1, part - 1)
    quads = [
        _grid_quads(
            _framed(
                own[:, i], rim[:, i, : part + 1], spokes[:, i], spokes[:, i - 1],
                rim[:, i - 1, : part - 1 : -1],
            )
        )
        for i in range(sides)
    ]  # fmt: skip
    return point, np.concatenate(quads, axis=1)


def _coons(bottom: FloatArray, right: FloatArray, top: FloatArray, left: FloatArray) -> FloatArray:
    """Give the inner points of Coons patches, (c, m - 1, m - 1, 3), from sides (c, m + 1, 3).

    Bottom and top run with the first index, left and right with the second.
    """
    u = np.linspace(0.0, 1.0, bottom.shape[1])[1:-1, None, None]
    v = np.linspace(0.0, 1.0, left.shape[1])[1:-1, None]
    across = (1.0 - v) * bottom[:, 1:-1, None] + v * top[:, 1:-1, None]
    along = (1.0 - u) * left[:, None, 1:-1] + u * right[:, None, 1:-1]
    low = (1.0 - u) * bottom[:, None, None, 0] + u * bottom[:, None, None, -1]
    high = (1.0 - u) * top[:, None, None, 0] + u * top[:, None, None, -1]
    return np.asarray(across + along - (1.0 - v) * low - v * high)


def _framed(
    inner: IntArray, bottom: IntArray, right: IntArray, top: IntArray, left: IntArray
) -> IntArray:
    """Put numbers of inner points and of sides together, (c, m + 1, m + 1)."""
    grid = np.empty((len(inner), bottom.shape[1], left.shape[1]), np.int64)
    grid[:, 1:-1, 1:-1] = inner
    grid[:, :, 0], grid[:, :, -1], grid[:, 0], grid[:, -1] = bottom, top, left, right
    return grid


def _grid_quads(grid: IntArray) -> IntArray:
    """Give the elements of grids, (c, q, 4); counter-clockwise as the first index to the second."""
    corners = (grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:])
    return np.stack(corners, axis=3).reshape(len(grid), -1, 4)
