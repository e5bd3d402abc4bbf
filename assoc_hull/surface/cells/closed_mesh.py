"""The closed mesh of a hull: cells between its lines, filled, covered and mirrored.

What encloses a volume is checked before it is given out. The mesh comes from the lines alone, so
it is independent of surfaces fitted to them, and of the strips that hydrostatics is integrated on.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.gather import Net
from assoc_hull.arguments import flag, integer, positive
from assoc_hull.errors import BadInputError, OpenMeshError, OpenNetError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.floating.immersed_triangles import immersed_triangles, make_body
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.surface.cells.closing import cover, mirrored
from assoc_hull.surface.cells.filling import FilledCells, fill_cells
from assoc_hull.surface.cells.mesh_report import MeshReport, examined
from assoc_hull.surface.cells.sound_cells import sound_cells

__all__ = ["BelowDraught", "ClosedMesh", "mesh_of_net", "require_closed"]

_WHERE = "in a closed mesh"
_MOST_POINTS = 64

_COARSE = 1e-4
"""Chords that leave one line in twenty by more than this part of the length are told: on ships with
sections and waterlines it is a tenth to a third of it, and volumes are good to .05 %."""


@attrs.frozen
class BelowDraught:
    """What a closed mesh has below a waterplane at even keel.

    Attributes
    ----------
    volume : float, m3
        Of both sides.
    lcb, vcb : float, m
        Of its centroid: x from the aft perpendicular, z from the base line.
    """

    volume: float
    lcb: float
    vcb: float


@attrs.frozen(eq=False)
class ClosedMesh:
    """Triangles that enclose a hull, or its port half.

    Attributes
    ----------
    xyz : (v, 3), m
        Vertices.
    triangle : (f, 3) int
        Counter-clockwise from outside.
    group : (f,) int
        The group of each, a place in `names`.
    cell : (f,) int
        The cell of the net that each lies in, the same on both sides; -1 in deck and ends.
    names : tuple of str
        The groups: ``"shell"``, then ``"deck"``, and other covers by the lines at their borders.
    half : bool
        The port half only, which is open in the centre plane.
    steps : int
        Into how many parts each edge of the net is cut.
    cells : int
        Cells of the net, of one half.
    report : MeshReport
        What was found of it.
    sagitta : (3,), m
        How far the lines leave their chords between points: half, 95 % and all of them no more.
    notes : tuple of str
        What was done to lines that do not part the hull into cells as they are.
    """

    xyz: FloatArray
    triangle: IntArray
    group: IntArray
    cell: IntArray
    names: tuple[str, ...]
    half: bool
    steps: int
    cells: int
    report: MeshReport
    sagitta: FloatArray
    notes: tuple[str, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz, self.triangle, self.group, self.cell, self.sagitta)

    @property
    def triangles(self) -> Triangles:
        """The mesh as `assoc_hull.geometry` takes it."""
        return Triangles(self.xyz, self.triangle)

    @property
    def volume(self) -> float:
        """What it encloses, m3.

        Raises
        ------
        OpenMeshError
            It is a half, or does not close.
        """
        require_closed(self.report, "the volume", self.half)
        return float(self.report.fluxes.mean())

    def below(self, draught: float) -> BelowDraught:
        """Give volume and centroid below a waterplane: a check of `assoc_hull.hydrostatics`.

        Parameters
        ----------
        draught : float, m
            At even keel.

        Raises
        ------
        OpenMeshError
            It is a half, or does not close.
        BadInputError
            The draught is no positive number, or nothing lies below it.
        """
        require_closed(self.report, "the volume below a draught", self.half)
        height = positive(draught, "draught", _WHERE)
        if height <= float(self.xyz[:, 2].min()):
            raise BadInputError(
                f"a draught of {height:g} m, below which nothing lies", _WHERE, "give a larger one"
            )
        level = Planes(np.array([height]), np.zeros(1), np.zeros(1))
        found = immersed_triangles(make_body(self.triangles), level)
        volume = float(found.volume[0])
        return BelowDraught(
            volume, float(found.moment_x[0]) / volume, float(found.moment_z[0]) / volume
        )

    @property
    def area(self) -> float:
        """The area of all triangles, m2."""
        return self.report.area

    @property
    def areas(self) -> dict[str, float]:
        """The area of each group, m2."""
        vector = self.triangles.area_vectors()
        size = np.sqrt((vector * vector).sum(axis=1))
        total = np.bincount(self.group, size, minlength=len(self.names))
        return dict(zip(self.names, total.tolist(), strict=True))

    def __str__(self) -> str:
        report = self.report
        sides = "port half, open in the centre plane" if self.half else "both sides"
        areas = ", ".join(f"{name} {area:.3f} m2" for name, area in self.areas.items())
        volume = " ".join(f"{each:.3f}" for each in report.fluxes.tolist())
        closed = f"yes: each edge in two triangles, Euler {report.euler}"
        where = "elsewhere" if report.off_centre else "all in the centre plane"
        ajar = f"no: {report.open_edges} open edges, {where}"
        median, most, nearly = report.slenderness.tolist()
        bend = [f"{1000.0 * each:.1f}" for each in self.sagitta.tolist()]
        rows = [
            ("mesh", f"{sides}; {self.cells} cells a half, {self.steps} points to an edge"),
            ("triangles", f"{report.triangles}, {report.vertices} vertices, {report.nil} nil"),
            ("area", areas),
            ("watertight", closed if report.sound else ajar),
            ("volume", f"{volume} m3, by x, y and z" if report.sound else "none: it is open"),
            ("chords", f"{bend[0]} mm off their lines (median), 95 % {bend[1]}, most {bend[2]}"),
            ("slenderness", f"median {median:.1f}, 95 % below {most:.1f}, 99 % below {nearly:.1f}"),
            *(("note", note) for note in self.notes),
        ]
        return "\n".join(f"{name:<12}{text}" for name, text in rows)


def require_closed(report: MeshReport, asked: str, half: bool) -> None:
    """Refuse what only a closed mesh has.

    Raises
    ------
    OpenMeshError
        The mesh is open.
    """
    if report.sound:
        return
    x, y, z = report.first_open.tolist()
    raise OpenMeshError(
        asked, report.open_edges, (x, y, z),
        "this is one half, open in the centre plane: make both" if half and not report.off_centre
        else "mend the lines there",
    )  # fmt: skip


def mesh_of_net(
    net: Net,
    *,
    half: bool = False,
    points: int = 4,
    leave_out: NDArray[np.bool_] | None = None,
) -> ClosedMesh:
    """Make a closed mesh on the lines of a hull.

    Parameters
    ----------
    net : Net
        Curves and crossings.
    half : bool
        The port half only. It is covered by deck and ends, and open in the centre plane.
    points : int
        Into how many parts each piece of a line between two crossings is cut; even.
    leave_out : (m,) bool or None
        Curves to do without.

    Returns
    -------
    ClosedMesh
        Every edge is that of two triangles, once in each sense, but in the centre plane of a half.

    Raises
    ------
    BadInputError
        `points` is odd or out of its range.
    OpenNetError
        The lines do not part the hull into cells, or too few to enclose it.
    OpenMeshError
        The mesh does not close all the same.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.gather import gather
    >>> from assoc_hull.surface.cells.closed_mesh import mesh_of_net
    >>> found = mesh_of_net(gather(ah.examples.wigley().state), points=2)
    >>> found.names, found.report.euler, round(found.volume, 1)
    (('shell', 'deck'), 2, 4854.7)
    """
    half = flag(half, "half", _WHERE)
    points = integer(points, "points", _WHERE, least=2, most=_MOST_POINTS)
    if points % 2:
        raise BadInputError(
            f"{points} points to an edge", _WHERE, "give an even number: cells meet at middles"
        )
    filled = fill_cells(sound_cells(net, leave_out), points)
    sheets = cover(filled)
    if not half:
        sheets = mirrored(sheets)
    report = examined(sheets.xyz, sheets.triangle, sheets.collapsed)
    if not half and report.closed and not report.sound:
        fluxes = ", ".join(f"{each:.6g}" for each in report.fluxes.tolist())
        raise OpenNetError(
            f"what they enclose has {fluxes} m3 by x, y and z, and Euler's number {report.euler}",
            (), "add sections and waterlines, or give those that were left out",
        )  # fmt: skip
    if report.off_centre if half else not report.sound:
        require_closed(report, "the surface", half)
    sagitta = _sagitta(filled)
    notes = (*filled.cells.notes, *_coarse(sagitta, float(np.ptp(sheets.xyz[:, 0]))))
    return ClosedMesh(
        sheets.xyz, sheets.triangle, sheets.group, sheets.cell, sheets.names, half, points,
        filled.cells.count, report, sagitta, notes,
    )  # fmt: skip


def _coarse(sagitta: FloatArray, length: float) -> tuple[str, ...]:
    """Say that chords are too long, where lines cross so seldom that volumes are off by it."""
    if sagitta[1] <= _COARSE * length:
        return ()
    return (
        f"chords leave the lines by more than {sagitta[1]:.3g} m on one in twenty, by "
        f"{sagitta[2]:.3g} m at most: the mesh encloses less than the lines do; give more "
        "points, or draw more lines",
    )


def _sagitta(filled: FilledCells) -> FloatArray:
    """Give how far lines leave chords between points at their middles, m: quantiles, (3,)."""
    graph, steps = filled.cells.graph, filled.steps
    end = graph.points(steps)
    on_line = graph.pieces.points((np.arange(steps) + 0.5) / steps)
    away = on_line - 0.5 * (end[:, 1:] + end[:, :-1])
    size = np.sqrt((away * away).sum(axis=2)).ravel()
    return np.asarray(np.quantile(size, [0.5, 0.95, 1.0], method="higher"))
