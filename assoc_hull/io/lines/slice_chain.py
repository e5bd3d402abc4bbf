"""A plane through a shell: the pieces of the line it cuts, chained across small gaps."""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import distinct, order_paths
from assoc_hull.io.lines.slices import Gaps, Join, Piece
from assoc_hull.io.mesh.shell import Rim, Shell

__all__ = ["cut_shell", "enough", "join_pieces", "nearest_ends", "rim_pieces"]

_SAME = 1e-6


def cut_shell(shell: Shell, axis: int, offset: float) -> list[Piece]:
    """Cut a shell with a plane; pieces as they come, not joined yet.

    Parameters
    ----------
    shell : Shell
        Half a hull.
    axis : int
        The plane is where this coordinate equals `offset`.
    offset : float, m
    """
    mesh = shell.mesh
    height = mesh.xyz[:, axis] - offset
    above = height >= 0.0  # a vertex in the plane counts as above, for all its triangles
    side = above[mesh.face]
    cut = side.any(axis=1) & ~side.all(axis=1)
    face = mesh.face[cut]
    if not len(face):
        return []
    side = above[face]
    lone = np.argmax(side != (side.sum(axis=1) > 1)[:, None], axis=1)
    a, b, c = (face[np.arange(len(face)), (lone + i) % 3] for i in range(3))
    ends = np.sort(np.concatenate([np.column_stack([a, b]), np.column_stack([a, c])]), axis=1)
    keys, number = np.unique(ends[:, 0] * len(mesh.xyz) + ends[:, 1], return_inverse=True)
    pairs = np.column_stack(np.divmod(keys, len(mesh.xyz)))
    places = _meet(mesh.xyz, height, pairs, axis, offset)
    kinds = _kinds(shell, pairs)
    links = number.reshape(2, -1).T
    sine = _sines(mesh.corners_of(face), number.reshape(2, -1), len(pairs), axis)
    owner = None if mesh.origin is None else _owners(mesh.origin[cut], number)
    return _pieces(order_paths(links, len(pairs)), places, kinds, sine, owner)


def _owners(origin: IntArray, number: IntArray) -> IntArray:
    """Give the origin of one of the triangles around each place: the first."""
    every = np.tile(origin, 2)
    return np.asarray(every[np.unique(number.ravel(), return_index=True)[1]])


def _sines(corner: FloatArray, number: IntArray, count: int, axis: int) -> FloatArray:
    """Give the sine of the angle between the plane and the triangles around each place."""
    vectors = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    sums = np.zeros((count, 3))
    for side in number:
        np.add.at(sums, side, vectors)
    length = np.maximum(np.sqrt((sums * sums).sum(axis=1)), 1e-300)
    cosine = np.abs(sums[:, axis]) / length
    return np.asarray(np.sqrt(np.maximum(1.0 - cosine * cosine, 0.0)))


def _meet(
    xyz: FloatArray, height: FloatArray, pairs: IntArray, axis: int, offset: float
) -> FloatArray:
    low, high = height[pairs[:, 0]], height[pairs[:, 1]]
    part = (low / (low - high))[:, None]
    places: FloatArray = xyz[pairs[:, 0]] + part * (xyz[pairs[:, 1]] - xyz[pairs[:, 0]])
    places[:, axis] = offset
    in_centre = (xyz[pairs, 1] == 0.0).all(axis=1)
    places[in_centre, 1] = 0.0
    return places


def _kinds(shell: Shell, pairs: IntArray) -> IntArray:
    """Say on what each cut edge lies: an open edge, or none (loose if a line ends there)."""
    count = len(shell.mesh.xyz)
    rim = np.sort(shell.rim, axis=1)
    key = rim[:, 0] * count + rim[:, 1]
    order = np.argsort(key)
    mine = pairs[:, 0] * count + pairs[:, 1]
    at = np.minimum(np.searchsorted(key[order], mine), max(len(key) - 1, 0))
    if not len(key):
        return np.full(len(pairs), Rim.LOOSE)
    found = key[order][at] == mine
    return np.where(found, shell.sort[order][at], Rim.LOOSE)


def _pieces(
    paths: list[tuple[IntArray, bool]],
    places: FloatArray,
    kinds: IntArray,
    sine: FloatArray,
    owner: IntArray | None,
) -> list[Piece]:
    found: list[Piece] = []
    for path, closed in paths:
        ring = np.append(path, path[0]) if closed else path
        kept = ring[distinct(places[ring], _SAME)]
        points = places[kept]
        if len(points) < 2:
            continue
        ends = (Rim.NAMES[kinds[path[0]]], Rim.NAMES[kinds[path[-1]]])
        ends = ("loose", "loose") if closed else ends
        mine = None if owner is None else owner[kept]
        found.append(Piece(points, ends, closed, sine[kept], mine))
    return found


def join_pieces(name: str, pieces: list[Piece], gaps: Gaps) -> tuple[list[Piece], list[Join]]:
    """Join loose ends across gaps, the nearest first.

    Parameters
    ----------
    name : str
        The line, for the table of joins.
    pieces : list of Piece
        As cut.
    gaps : Gaps
        What is joined and what refused.

    Raises
    ------
    BadInputError
        Two loose ends face one another across more than `gaps.join`.
    """
    done: list[Join] = []
    pieces = list(pieces)
    while True:
        near = nearest_ends(pieces)
        if near is None or near[0] > gaps.refuse:
            return pieces, done
        gap, (i, end), (j, other) = near
        place = 0.5 * (_end(pieces[i], end) + _end(pieces[j], other))
        x, y, z = place.tolist()
        if gap > gaps.join:
            raise BadInputError(
                f"the pieces do not chain: two ends {1e3 * gap:.0f} mm apart at "
                f"({x:.4g}, {y:.4g}, {z:.4g}) m", f"in {name}",
                f"mend the mesh there, or give join= of {enough(gap)} m or more",
            )  # fmt: skip
        done.append(Join(name, (x, y, z), gap))
        joined = _join(pieces[i], end, pieces[j], other) if i != j else _close(pieces[i])
        pieces = [each for k, each in enumerate(pieces) if k not in (i, j)] + [joined]


def enough(gap: float) -> str:
    """Write the width (m) that closes a gap, rounded up to millimetres.

    Examples
    --------
    >>> from assoc_hull.io.lines.slice_chain import enough
    >>> enough(0.1201)
    '0.121'
    """
    return f"{np.ceil(1e3 * gap) / 1e3:.3f}"


def _end(piece: Piece, end: int) -> FloatArray:
    return np.asarray(piece.points[-end])


def nearest_ends(pieces: list[Piece]) -> tuple[float, tuple[int, int], tuple[int, int]] | None:
    """Give the two loose ends that lie closest: their gap (m), and piece and end of each."""
    loose = [
        (i, end)
        for i, piece in enumerate(pieces)
        for end in (0, 1)
        if not piece.closed and piece.ends[end] == "loose"
    ]
    if len(loose) < 2:
        return None
    place = np.array([_end(pieces[i], end) for i, end in loose])
    owner = np.array([i for i, _ in loose])
    short = np.array([len(pieces[i].points) < 4 for i, _ in loose])
    first, second = np.triu_indices(len(loose), 1)
    apart = (owner[first] != owner[second]) | ~short[first]
    first, second = first[apart], second[apart]
    if not len(first):
        return None
    step = place[first] - place[second]
    gaps = np.sqrt((step * step).sum(axis=1))
    best = int(gaps.argmin())
    return float(gaps[best]), loose[int(first[best])], loose[int(second[best])]


def _join(first: Piece, end: int, second: Piece, other: int) -> Piece:
    """Put the second behind the first, each turned so that the given ends meet."""
    a, b = first if end else first.reversed(), second.reversed() if other else second
    points = np.concatenate([a.points, b.points])
    kept = distinct(points, _SAME)
    sine: FloatArray | None = None
    owner: IntArray | None = None
    if a.sine is not None and b.sine is not None:
        sine = np.concatenate([a.sine, b.sine])[kept]
    if a.owner is not None and b.owner is not None:
        owner = np.concatenate([a.owner, b.owner])[kept]
    return Piece(points[kept], (a.ends[0], b.ends[1]), sine=sine, owner=owner)


def _close(piece: Piece) -> Piece:
    points = np.concatenate([piece.points, piece.points[:1]])
    kept = distinct(points, _SAME)
    sine = None if piece.sine is None else np.append(piece.sine, piece.sine[0])[kept]
    owner = None if piece.owner is None else np.append(piece.owner, piece.owner[0])[kept]
    return Piece(points[kept], closed=True, sine=sine, owner=owner)


def rim_pieces(shell: Shell, sort: int) -> list[Piece]:
    """Give the open edges of one sort as polylines, the longest first."""
    mesh = shell.mesh
    chosen = shell.rim[shell.sort == sort]
    paths = order_paths(chosen, len(mesh.xyz))
    owner: IntArray | None = None
    if mesh.origin is not None:
        owner = np.zeros(len(mesh.xyz), np.int64)
        owner[mesh.face] = mesh.origin[:, None]
    found: list[Piece] = []
    for path, closed in paths:
        ring = np.append(path, path[0]) if closed else path
        kept = ring[distinct(mesh.xyz[ring], _SAME)]
        found.append(Piece(mesh.xyz[kept], owner=None if owner is None else owner[kept]))
    length = [float(np.linalg.norm(np.diff(each.points, axis=0), axis=1).sum()) for each in found]
    return [found[i] for i in np.argsort(length)[::-1].tolist() if len(found[i].points) > 1]
