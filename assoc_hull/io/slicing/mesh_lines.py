"""A triangulated hull cut into lines: stations, waterlines, buttocks and boundary curves.

The mesh is repaired, put into ship axes (m) and cut by planes; pieces are joined and ordered.
Sections run upward, other lines forward. A hull whose sections end far from the centre plane has no
bottom, which is reported here and refused when a hull is made of the lines.

Examples
--------
The Wigley hull, as triangles made here rather than read from a file:

>>> import numpy as np
>>> from assoc_hull.io.slicing.mesh_lines import slice_mesh
>>> from assoc_hull.geometry.surfaces.triangles import grid_triangles
>>> x, z = np.meshgrid(np.linspace(0, 100, 41), np.linspace(0, 6.25, 11), indexing="ij")
>>> y = 5.0 * (1.0 - (x / 50.0 - 1.0) ** 2) * (1.0 - (1.0 - z / 6.25) ** 2)
>>> mesh = grid_triangles(np.stack([x, y, z], axis=2))
>>> slices = slice_mesh(mesh, stations=[25.0, 50.0], waterlines=[1.5], buttocks=1)
>>> for line in slices.lines:
...     print(line.name, line.pieces[0].ends)
ST 25 ('profile', 'deck edge')
ST 50 ('profile', 'deck edge')
WL 1.5 ('profile', 'profile')
BTK 2.5 ('deck edge', 'deck edge')
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import instance
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import cumulative_lengths
from assoc_hull.geometry.surfaces.triangles import Triangles, check_mesh
from assoc_hull.io.lines.mend_lines import join_pieces, report_crossings, report_joins
from assoc_hull.io.lines.several_hulls import HullChoice
from assoc_hull.io.lines.ship_frame import ShipFrame
from assoc_hull.io.lines.slices import (
    AXES,
    GapJoin,
    Gaps,
    HullSlices,
    LinePiece,
    SliceLine,
    settled_gaps,
)
from assoc_hull.io.mesh.frame import levelled, place_mesh, scale_mesh
from assoc_hull.io.mesh.one_hull import place_one_hull
from assoc_hull.io.mesh.read import read_triangles
from assoc_hull.io.mesh.repair import facet_depth, mend_mesh
from assoc_hull.io.mesh.shell import MeshShell, RimKind, cut_shell, make_shell, rim_pieces
from assoc_hull.io.placing.frame import find_frame
from assoc_hull.io.placing.options import FileAxes, FrameOptions
from assoc_hull.io.placing.outline import outline_of_mesh
from assoc_hull.io.reports import Notebook, Tell, no_progress
from assoc_hull.io.slicing.cut_planes import Places, plane_places
from assoc_hull.tolerance import length_factor

__all__ = [
    "BOTTOM",
    "DOUBLED",
    "cut_placed",
    "in_ship_axes",
    "read_mesh",
    "refuse_bottomless",
    "report_bottom",
    "slice_mesh",
    "without_loops",
]

# --------------------------------------------------------------------------------------
# A missing bottom: sections begin far from the centre plane, on no boundary curve.

BOTTOM = "bottom missing"

_OFF = 0.02
"""A section that begins this part of the half-breadth off the centre plane does not reach it."""

_MANY = 0.1
"""One section of ten may do so: a hole, which is reported by itself."""


def report_bottom(lines: Sequence[SliceLine], half: float, book: Notebook) -> None:
    """Report sections that do not reach the centre plane; `half` (m) is half the breadth."""
    sections = [line for line in lines if line.group == "sections"]
    off = {line.name: _gap(line) for line in sections}
    bad = {name: gap for name, gap in off.items() if gap > _OFF * half}
    if len(bad) <= _MANY * len(sections):
        return
    worst = max(bad, key=lambda name: bad[name])
    begin = f"{len(bad)} of {len(sections)} begin off the centre plane"
    what = f"{begin}, by up to {bad[worst]:.4g} m ({worst})"
    book.suspect(BOTTOM, "the sections", what, bad[worst])


def _gap(line: SliceLine) -> float:
    """Give how far (m) the lower end of a section is off the centre plane; 0 where it has one."""
    ends = [
        (float(piece.points[-end, 2]), float(piece.points[-end, 1]), piece.ends[end])
        for piece in line.pieces
        if not piece.closed
        for end in (0, 1)
    ]
    if not ends or any(kind == "profile" for _, _, kind in ends):
        return 0.0
    _, off, kind = min(ends)
    return off if kind == "loose" else 0.0


def refuse_bottomless(slices: HullSlices) -> None:
    """Refuse to make a hull of lines whose bottom is missing: its volume would be wrong unseen.

    Raises
    ------
    BadInputError
        The report of the slices has it among its suspicions.
    """
    found = next((note for note in slices.report.suspicions if note.kind == BOTTOM), None)
    if found is not None:
        what = f"the bottom is missing: of the sections {found.what}"
        raise BadInputError(what, f"in {slices.name}", "export the bottom too, or close the hull")


# --------------------------------------------------------------------------------------
# Cutting.

_PREFIX = {"sections": "ST", "waterlines": "WL", "buttocks": "BTK"}


def read_mesh(
    path: str | Path,
    *,
    stations: Places = 41,
    waterlines: Places = 20,
    buttocks: Places = 12,
    scale: float = 1.0,
    unit: str = "auto",
    axes: str = "auto",
    gaps: Gaps | float | None = None,
    length: float | None = None,
    name: str | None = None,
    tell: Tell = no_progress,
    frame: FrameOptions | None = None,
    choice: HullChoice | None = None,
) -> HullSlices:
    """Read a triangulated hull and cut it; arguments as for `slice_mesh`.

    Parameters
    ----------
    path : str or Path
        STL, OBJ or PLY, also ``.gz``.

    Raises
    ------
    BadInputError, NoMeetingError
        As for `slice_mesh`; also a file that holds no mesh.
    MissingExtraError
        trimesh is not installed.
    """
    file = Path(path)
    tell("reading the mesh", 0, 0)
    mesh = read_triangles(file)
    title = file.name.removesuffix(".gz") if name is None else name
    return slice_mesh(
        mesh, stations=stations, waterlines=waterlines, buttocks=buttocks, scale=scale, unit=unit,
        axes=axes, gaps=gaps, length=length, name=Path(title).stem if name is None else title,
        tell=tell, frame=frame, choice=choice,
    )  # fmt: skip


def slice_mesh(
    mesh: Triangles,
    *,
    stations: Places = 41,
    waterlines: Places = 20,
    buttocks: Places = 12,
    scale: float = 1.0,
    unit: str = "auto",
    axes: str = "auto",
    gaps: Gaps | float | None = None,
    length: float | None = None,
    name: str = "hull",
    tell: Tell = no_progress,
    frame: FrameOptions | None = None,
    choice: HullChoice | None = None,
) -> HullSlices:
    """Cut a mesh into stations, waterlines, buttocks and boundary curves.

    Parameters
    ----------
    mesh : Triangles
        Whole hull or half.
    stations, waterlines, buttocks : int or sequence of float, m
        How many to propose (stations lie closer at the ends of the ship, waterlines at the
        bottom and buttocks evenly), or their places in ship axes at full scale.
    scale : float
        Full scale over model scale.
    unit : {"auto", "m", "mm", "cm", "ft", "in"}
        Unit of the file.
    axes : str
        "auto", or which axes of the file point forward, to port and up: ``"+x+y+z"``.
    gaps : Gaps, float or None
        What is joined; by default ends up to 60 mm apart, of a hull under 100 m less in
        proportion. A number is the width (m) up to which ends are joined.
    length : float or None, m
        Between perpendiculars, where it is known: it tells the size of the hull.
    name : str
        Name of the hull.
    tell : callable
        Hears which line is being cut.
    frame : FrameOptions or None
        Where base line, waterline and perpendiculars are, what is not given being found; None:
        x and z stay as the file has them.
    choice : HullChoice or None
        Which of several hulls side by side; by default there is one.

    Returns
    -------
    HullSlices
        Its report tells whatever was found rather than given.

    Raises
    ------
    BadInputError
        A mesh that is no hull or of several, or pieces that do not chain.
    NoMeetingError
        A plane that misses the hull.
    """
    check_mesh(instance(mesh, Triangles, "mesh", "in slice_mesh"))
    book = Notebook()
    scaled = scale_mesh(mesh, scale, unit, book)
    factor = float(np.ptp(scaled.xyz, axis=0).max()) / float(np.ptp(mesh.xyz, axis=0).max())
    metres = float(f"{factor:.12g}")
    ends = (frame or FrameOptions()).ends(metres)
    mended, turned = place_one_hull(
        levelled(mend_mesh(scaled, book), book),
        lambda each, notes: place_mesh(each, axes, notes, ends=ends),
        choice or HullChoice(), metres, book, turned=axes != "auto",
    )  # fmt: skip
    placed, found = in_ship_axes(turned, mended, factor, frame, book, "the mesh")
    wanted = {"sections": stations, "waterlines": waterlines, "buttocks": buttocks}
    small = length_factor(length or float(np.ptp(placed.xyz[:, 0])))
    limits = settled_gaps(gaps, small, "in slice_mesh")
    slices = cut_placed(placed, wanted, limits, name, book, tell, small)
    _tell_doubled(slices, mended, placed, metres, book)
    return attrs.evolve(slices, frame=found, report=book.report())


DOUBLED = "doubles back"
"""The kind of what is told of a line that a spike of the mesh makes turn back on itself."""

_BACK = math.cos(math.radians(160.0))
"""A line that turns by more than this at one point runs back beside itself."""


def _tell_doubled(
    slices: HullSlices, before: Triangles, placed: Triangles, factor: float, book: Notebook
) -> None:
    """Suspect the mesh where a line doubles back, by the vertex that stands out most beside it.

    `before` is the mesh as in the file, m; a unit of the file is `factor` m.
    """
    found = [
        (turn, line.name, place)
        for line in slices.lines for piece in line.pieces
        for turn, place in _turns(piece) if turn < _BACK
    ]  # fmt: skip
    if not found:
        return
    _, name, place = min(found, key=lambda each: each[0])
    row, out = _spike(placed, place)
    at = ", ".join(f"{value:.4g}" for value in (before.xyz[row] / factor).tolist())
    what = (
        f"a line cut from the mesh doubles back; beside it the vertex at ({at}) of the file lies "
        f"{1e3 * out:.4g} mm off the middle of its neighbours: look at the mesh there"
    )
    book.suspect(DOUBLED, name, what, out)


def _spike(mesh: Triangles, place: FloatArray) -> tuple[int, float]:
    """Give that end of the edge at a place which lies farther off the middle of its neighbours, m.

    Points of a line lie on edges of the mesh.
    """
    start, end = mesh.xyz[mesh.edges()].transpose(1, 0, 2)
    along, away = end - start, place - start
    part = (along * away).sum(axis=1) / np.maximum((along * along).sum(axis=1), 1e-300)
    off = np.linalg.norm(away - np.clip(part, 0.0, 1.0)[:, None] * along, axis=1)
    ends = []
    for row in mesh.edges()[int(off.argmin())].tolist():
        around = np.unique(mesh.face[(mesh.face == row).any(axis=1)])
        middle = mesh.xyz[around[around != row]].mean(axis=0)
        ends.append((float(np.linalg.norm(mesh.xyz[row] - middle)), row))
    out, row = max(ends)
    return row, out


def _turns(piece: LinePiece) -> Iterator[tuple[float, FloatArray]]:
    """Give the cosine of the turn at each inner point of a piece, of a ring at all, and where."""
    points = piece.points
    if piece.closed:
        points = np.concatenate([points, points[1:2]])
    step = np.diff(points, axis=0)
    step /= np.maximum(np.linalg.norm(step, axis=1), 1e-300)[:, None]
    yield from zip((step[1:] * step[:-1]).sum(axis=1).tolist(), points[1:-1], strict=True)


def in_ship_axes(
    turned: Triangles,
    before: Triangles,
    factor: float,
    options: FrameOptions | None,
    book: Notebook,
    where: str,
) -> tuple[Triangles, ShipFrame | None]:
    """Move a mesh (m) with x forward and z up so that x = 0 is the AP and z = 0 the base line.

    `before` is the mesh as it was turned from, which tells the axes of places that are given in
    the file; a unit of the file is `factor` m. `where` names it in notes. Without options it stays
    where it is.

    Raises
    ------
    BadInputError
        As for `assoc_hull.io.placing.frame.find_frame`.
    """
    if options is None:
        return turned, None
    axes = FileAxes.between(float(f"{factor:.12g}"), before.xyz, turned.xyz)
    frame = find_frame(outline_of_mesh(turned), options, book, where, axes=axes)
    _suspect_trim(frame, options, book, where)
    return turned.moved(frame.moved(turned.xyz)), frame


def _suspect_trim(frame: ShipFrame, options: FrameOptions, book: Notebook, where: str) -> None:
    """Suspect a raked keel: a body lies in its file as it was drawn, which may be as it floats.

    Offsets and lines are measured from a base line, so that a keel that rises there is raked.
    """
    known = options.draught_aft is not None or options.draught_fwd is not None
    if frame.rake and not known:
        angle = math.degrees(math.atan2(abs(frame.rake), frame.length))
        end = "stern" if frame.rake > 0.0 else "bow"
        what = (
            f"the keel is straight and lies {angle:.3g} degrees deeper by the {end}: if the hull "
            "is not built with such a rake but lies trimmed in the file, turn it level first"
        )
        book.suspect("trim", where, what, frame.rake)


def cut_placed(
    placed: Triangles,
    wanted: Mapping[str, Places],
    gaps: Gaps,
    name: str,
    book: Notebook,
    tell: Tell = no_progress,
    factor: float = 1.0,
) -> HullSlices:
    """Cut a mesh that lies in ship axes, m, outward; as `slice_mesh`.

    `wanted` gives the planes of each group, as a number or as places (m); `factor` is that of
    lengths, by the size of the hull.

    Raises
    ------
    BadInputError, NoMeetingError
        As for `slice_mesh`.
    """
    shell = make_shell(placed, book)
    low, high = shell.mesh.xyz.min(axis=0), shell.mesh.xyz.max(axis=0)
    joins: list[GapJoin] = []
    lines: list[SliceLine] = []
    places = [
        (group, place)
        for group, planes in wanted.items()
        for place in _places(group, planes, low[AXES[group]], high[AXES[group]], factor)
    ]
    for i, (group, place) in enumerate(places):
        tell("cutting lines", i, len(places))
        lines.append(_cut(shell, group, place, gaps, joins, book))
    report_joins(joins, book, factor)
    report_bottom(lines, float(high[1]), book)
    return HullSlices(
        name, tuple(lines), tuple(_boundaries(shell, gaps, joins, book)), tuple(joins),
        book.report(), True, low, high, facet_depth(shell.mesh), gaps,
        factor=factor,
    )  # fmt: skip


def _places(group: str, wanted: Places, low: float, high: float, factor: float) -> list[float]:
    label, dense = ("stations" if group == "sections" else group), group == "sections"
    found = plane_places(label, wanted, float(low), float(high), dense=dense, factor=factor)
    return [float(each) for each in found]


def _cut(
    shell: MeshShell, group: str, place: float, gaps: Gaps, joins: list[GapJoin], book: Notebook
) -> SliceLine:
    axis, name = AXES[group], f"{_PREFIX[group]} {place:g}"
    pieces, made = join_pieces(name, cut_shell(shell, axis, place), gaps)
    if not pieces:
        raise BadInputError(
            f"{name} cuts no triangle", "in the mesh",
            f"mend the gap there, or give {group} at other places",
        )  # fmt: skip
    joins += made
    _report_loose_ends(name, pieces, book)
    report_crossings(name, pieces, axis, book)
    return SliceLine(group, name, place, tuple(_in_order(pieces, group)))


def _in_order(pieces: list[LinePiece], group: str) -> list[LinePiece]:
    """Turn each piece the usual way round; lowest first, then aftmost."""
    turned = [_turn(piece, group) for piece in pieces]
    return sorted(turned, key=lambda each: (each.points[:, 2].min(), each.points[:, 0].min()))


def _turn(piece: LinePiece, group: str) -> LinePiece:
    """Sections run upward (from the lower end), other lines forward."""
    axis = 2 if group == "sections" else 0
    first, last = piece.points[0], piece.points[-1]
    rise = float(last[axis] - first[axis])
    if piece.ends[0] == piece.ends[1] == "profile" and group == "sections":
        rise = float(last[2] - first[2])
    if rise >= 0.0 or piece.closed:
        return piece
    return piece.reversed()


def _report_loose_ends(name: str, pieces: list[LinePiece], book: Notebook) -> None:
    loose = [
        piece.points[-end]
        for piece in pieces
        for end in (0, 1)
        if piece.ends[end] == "loose" and not piece.closed
    ]
    if loose:
        x, y, z = loose[0].tolist()
        what = f"{len(loose)} ends lie on no boundary, first ({x:.4g}, {y:.4g}, {z:.4g}) m"
        book.suspect("loose end", name, what, len(loose))


def _boundaries(
    shell: MeshShell, gaps: Gaps, joins: list[GapJoin], book: Notebook
) -> list[SliceLine]:
    """Chain the open edges into profile, deck edge and the edges of transom and bossing."""
    found: list[SliceLine] = []
    for kind in range(RimKind.LOOSE):
        name = RimKind.NAMES[kind]
        chains, made = join_pieces(name, rim_pieces(shell, kind), gaps)
        joins += made
        if not chains:
            continue
        if kind == RimKind.PROFILE:
            chains = [without_loops(each, gaps.join, book) for each in chains]
        elif kind == RimKind.DECK:
            chains = open_pieces(chains, name, book)
        length = [_length(each) for each in chains]
        longest = max(length)
        kept = [each for each, size in zip(chains, length, strict=True) if size > 0.02 * longest]
        if len(kept) < len(chains):
            what = f"{len(chains) - len(kept)} short pieces left out"
            book.repair("short piece", name, what, len(chains) - len(kept))
        found.append(SliceLine("boundary", name, float("nan"), tuple(_forward(kept, kind))))
    return found


def open_pieces(pieces: list[LinePiece], name: str, book: Notebook) -> list[LinePiece]:
    """Leave out closed pieces of the deck edge of a half, which runs from end to end."""
    closed = [each for each in pieces if _is_loop(each)]
    if not closed or len(closed) == len(pieces):
        return pieces
    longest = max(closed, key=_length)
    x, y, z = longest.points[0].tolist()
    what = (
        f"{len(closed)} closed pieces left out, the longest {_length(longest):.3g} m at "
        f"({x:.4g}, {y:.4g}, {z:.4g}) m: a hole of the mesh, or a body that lies on the deck"
    )
    book.suspect("closed piece", name, what, len(closed))
    return [each for each in pieces if not _is_loop(each)]


def _is_loop(piece: LinePiece) -> bool:
    return piece.closed or bool((piece.points[0] == piece.points[-1]).all())


_LOOPS = 0.02
"""Loops of more than this part of a profile are parts of the hull, not crossings of its halves."""

_DETOUR = 4.0
"""A way along the profile this many times longer than the gap between its ends is a loop."""


def without_loops(piece: LinePiece, join: float, book: Notebook) -> LinePiece:
    """Leave out where a profile turns back: small loops where the surface passes y = 0.

    Ends of a loop lie within `join` (m) of each other.
    """
    from scipy.spatial import cKDTree

    at = cumulative_lengths(piece.points)
    pairs = cKDTree(piece.points).query_pairs(join, output_type="ndarray").astype(np.int64)
    if piece.closed or not len(pairs):
        return piece
    gap = np.linalg.norm(piece.points[pairs[:, 1]] - piece.points[pairs[:, 0]], axis=1)
    way = np.abs(at[pairs[:, 1]] - at[pairs[:, 0]])
    loop = way > np.maximum(_DETOUR * gap, join)
    if not loop.any():
        return piece
    kept = _shortest_way(at, pairs[loop], gap[loop])
    points = piece.points[kept]
    less = float(at[-1] - cumulative_lengths(points)[-1])
    if less > _LOOPS * float(at[-1]):
        return piece
    first = int(np.flatnonzero(np.diff(kept) > 1)[0])
    x, _, z = points[first].tolist()
    what = (
        f"turned back first at ({x:.4g}, {z:.4g}) m, where the hull passes its centre plane; "
        f"{len(at) - len(kept)} points, {less:.3g} m of {float(at[-1]):.4g} m, left out"
    )
    book.suspect("loop", "profile", what, less)
    owner = None if piece.owner is None else piece.owner[kept]
    return attrs.evolve(piece, points=points, owner=owner)


def _shortest_way(at: FloatArray, pairs: IntArray, gap: FloatArray) -> IntArray:
    """Give the points of the shortest way from the first to the last, over pairs too, in order."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    count = len(at)
    steps = np.column_stack([np.arange(count - 1), np.arange(1, count)])
    ends = np.concatenate([steps, pairs])
    size = np.maximum(np.concatenate([np.diff(at), gap]), 1e-9)  # 0 would be no edge
    graph: Any = coo_array((size, (ends[:, 0], ends[:, 1])), (count, count)).tocsr()
    _, before = dijkstra(graph, directed=False, indices=0, return_predecessors=True)  # type: ignore[call-overload]
    way = [count - 1]
    while way[-1] != 0:
        way.append(int(before[way[-1]]))
    return np.array(way[::-1], np.int64)


def _length(piece: LinePiece) -> float:
    return float(np.linalg.norm(np.diff(piece.points, axis=0), axis=1).sum())


def _forward(pieces: list[LinePiece], kind: int) -> list[LinePiece]:
    """Turn profile and deck edge from aft forward, the transom from the centre plane outward."""
    column = 0 if kind in (RimKind.PROFILE, RimKind.DECK) else 1
    turned = [
        piece if piece.points[0, column] <= piece.points[-1, column] else piece.reversed()
        for piece in pieces
    ]
    return sorted(turned, key=lambda each: (each.points[:, 0].min(), each.points[:, 2].min()))
