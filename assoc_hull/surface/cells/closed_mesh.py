"""The closed mesh of a hull: filled cells, covered where the half is open, mirrored and checked.

`closed_mesh` takes a hull, `mesh_of_net` the lines of one; both give a `ClosedMesh` or raise.
The mesh comes from the lines alone, so it is independent of any surface fitted to them.
Deck and transom are covered whatever the particulars say of the deck.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.arguments import all_of, flag, integer, positive
from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError, OpenMeshError, OpenNetError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersed_triangles import immersed_triangles, make_body
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.tables import HasState, HullState, state_of
from assoc_hull.model.tunnel_definition import TunnelDefinition
from assoc_hull.surface.cells.filling import FilledCells, fill_cells
from assoc_hull.surface.cells.meshed_bodies import surfaces_of
from assoc_hull.surface.cells.net_faces import sound_cells
from assoc_hull.surface.cells.net_nodes import merge_linked
from assoc_hull.surface.cells.tunnel_walls import cut_mouth, wall_of

__all__ = [
    "SHELL",
    "BelowDraught",
    "ClosedMesh",
    "MeshReport",
    "MeshedBody",
    "TriangleGroups",
    "closed_mesh",
    "cover_openings",
    "curves_named",
    "examine_mesh",
    "fine_mesh_of_state",
    "mesh_of_net",
    "mesh_of_state",
    "mirror_half",
    "require_closed",
    "triangles_below",
]


SHELL = "shell"
"""The name of the group of the hull itself."""

_ON_CENTRE = 1e-6
"""Places on the border so near to the centre plane (lengths of the hull) lie in it."""

_COINCIDE = 1e-8
"""Vertices on one edge so near to one another (lengths of the hull) are one."""

_CAPS = {"deck edge": "deck"}
"""What is closed by a line other than by its own name."""


@attrs.frozen(eq=False)
class TriangleGroups:
    """Triangles of a hull in groups.

    Attributes
    ----------
    xyz : (v, 3), m
        Vertices.
    triangle : (f, 3) int
        Counter-clockwise from outside.
    group : (f,) int
        The group of each, in `names`.
    cell : (f,) int
        The cell of the net that each lies in; -1 in what closes the hull.
    central : (v,) bool
        Vertices in the centre plane at which the halves meet.
    names : tuple of str
        The groups: the shell, and what closes it, by the lines at its border.
    collapsed : int
        Triangles that vanished because two of their corners coincide.
    """

    xyz: FloatArray
    triangle: IntArray
    group: IntArray
    cell: IntArray
    central: NDArray[np.bool_]
    names: tuple[str, ...]
    collapsed: int


def cover_openings(filled: FilledCells) -> TriangleGroups:
    """Close a half hull but for the centre plane: deck, transom and other ends.

    What the border encloses is ruled across the ship, from each place on it to the centre plane:
    a plane where deck or transom is one. The camber of a deck is not there.
    """
    graph, outline = filled.cells.graph, filled.cells.outline
    curve = graph.curve[outline >> 1]
    rim = filled.along(outline)
    xyz, central = _on_centre(filled.xyz, rim, graph.net.centre[curve])
    aside = np.flatnonzero(~central[rim].all(axis=1))
    named = [_CAPS.get(graph.net.name[c], graph.net.name[c]) for c in curve[aside].tolist()]
    names = (SHELL, *dict.fromkeys(named))
    group = np.array([names.index(each) for each in named], np.int64)
    xyz, central, quad = _across(xyz, central, rim[aside])
    shell, cell = filled.triangles()
    caps = np.concatenate([quad[:, [0, 1, 2]], quad[:, [0, 2, 3]]])
    triangle = np.concatenate([shell, caps])
    of_caps = np.tile(np.repeat(group, filled.steps), 2)
    found = TriangleGroups(
        xyz, triangle,
        np.concatenate([np.zeros(len(shell), np.int64), of_caps]),
        np.concatenate([cell, np.full(len(caps), -1)]),
        central, names, 0,
    )  # fmt: skip
    return _collapsed(found)


def _on_centre(
    xyz: FloatArray, rim: IntArray, centre: NDArray[np.bool_]
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Lay the border into the centre plane where its lines lie there."""
    near = _ON_CENTRE * float(np.ptp(xyz[:, 0]))
    central = np.zeros(len(xyz), bool)
    central[rim[centre]] = True
    central[rim[np.abs(xyz[rim, 1]) <= near]] = True
    placed = xyz.copy()
    placed[central, 1] = 0.0
    return placed, central


def _across(
    xyz: FloatArray, central: NDArray[np.bool_], rim: IntArray
) -> tuple[FloatArray, NDArray[np.bool_], IntArray]:
    """Give elements from the border to the centre plane, with the vertices that they add there."""
    outer = np.unique(rim[~central[rim]])
    foot = np.arange(len(xyz))
    foot[outer] = len(xyz) + np.arange(len(outer))
    added = xyz[outer] * [1.0, 0.0, 1.0]
    begin, finish = rim[:, :-1].ravel(), rim[:, 1:].ravel()
    quad = np.column_stack([begin, finish, foot[finish], foot[begin]])
    return (
        np.concatenate([xyz, added]),
        np.concatenate([central, np.ones(len(outer), bool)]),
        quad,
    )


def _collapsed(sheets: TriangleGroups) -> TriangleGroups:
    """Make vertices one that coincide, and take away triangles that have lost a corner by it."""
    triangle = sheets.triangle
    edge = np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]])
    step = sheets.xyz[edge[:, 0]] - sheets.xyz[edge[:, 1]]
    near = (_COINCIDE * float(np.ptp(sheets.xyz[:, 0]))) ** 2
    pair = edge[(dot(step, step) <= near) & (edge[:, 0] != edge[:, 1])]
    one = np.arange(len(sheets.xyz))
    if len(pair):
        one = merge_linked(len(sheets.xyz), pair)
    central = sheets.central.copy()
    central[one[sheets.central]] = True
    xyz = sheets.xyz.copy()
    xyz[central, 1] = 0.0
    triangle = one[triangle]
    # Elements with two equal corners were triangles from the start.
    stays = (triangle != np.roll(triangle, 1, axis=1)).all(axis=1)
    whole = (sheets.triangle != np.roll(sheets.triangle, 1, axis=1)).all(axis=1)
    return _used(
        attrs.evolve(
            sheets, xyz=xyz, triangle=triangle[stays], group=sheets.group[stays],
            cell=sheets.cell[stays], central=central, collapsed=int((whole & ~stays).sum()),
        )
    )  # fmt: skip


def _used(sheets: TriangleGroups) -> TriangleGroups:
    """Leave out vertices of no triangle."""
    used = np.unique(sheets.triangle)
    number = np.full(len(sheets.xyz), -1, np.int64)
    number[used] = np.arange(len(used))
    return attrs.evolve(
        sheets, xyz=sheets.xyz[used], triangle=number[sheets.triangle], central=sheets.central[used]
    )


_SIDES = 16
"""Sides of the prism that stands for a tunnel, to each point of an edge."""


def _tunnelled(sheets: TriangleGroups, tunnel: TunnelDefinition, sides: int) -> TriangleGroups:
    """Cut the mouth of a tunnel out of a half hull, and add its wall to the centre plane."""
    axis = tunnel.x, tunnel.z
    cut = cut_mouth(sheets.xyz, sheets.triangle, axis, tunnel.radius, sides)
    xyz, wall, foot = wall_of(cut.xyz, cut.triangle, axis, tunnel.radius)
    central = np.zeros(len(xyz), bool)
    central[: len(sheets.central)] = sheets.central
    central[foot] = True
    return _used(
        TriangleGroups(
            xyz, np.concatenate([cut.triangle, wall]),
            np.concatenate([sheets.group[cut.source], np.full(len(wall), len(sheets.names))]),
            np.concatenate([sheets.cell[cut.source], np.full(len(wall), -1)]),
            central, (*sheets.names, tunnel.name), sheets.collapsed,
        )
    )  # fmt: skip


def mirror_half(sheets: TriangleGroups) -> TriangleGroups:
    """Give both sides of the hull: port first, then starboard."""
    across = np.flatnonzero(~sheets.central)
    twin = np.arange(len(sheets.xyz))
    twin[across] = len(sheets.xyz) + np.arange(len(across))
    return TriangleGroups(
        np.concatenate([sheets.xyz, sheets.xyz[across] * [1.0, -1.0, 1.0]]),
        np.concatenate([sheets.triangle, twin[sheets.triangle][:, ::-1]]),
        np.tile(sheets.group, 2),
        np.tile(sheets.cell, 2),
        np.concatenate([sheets.central, np.zeros(len(across), bool)]),
        sheets.names,
        2 * sheets.collapsed,
    )


# --------------------------------------------------------------------------------------
# The check: closed edge by edge, and how good its triangles are.

_NIL = 1e-14
"""Triangles of an area this part of the square of the length of the mesh are zero."""

_ALIKE = 1e-9
"""Volumes by x, by y and by z of a closed mesh agree to this part."""


@attrs.frozen(eq=False)
class MeshReport:
    """What was found of a mesh.

    Attributes
    ----------
    vertices, edges, triangles : int
        Of the mesh.
    open_edges : int
        Edges that are not those of two triangles, once in each sense.
    off_centre : int
        How many of these do not lie in the centre plane.
    first_open : (3,), m
        The middle of the first of them; nan where there is none.
    euler : int
        Vertices - edges + triangles: 2 for one closed surface, 2 less for each tunnel through it.
    fluxes : (3,), m3
        The volume by x, by y and by z: alike if, and only if, the mesh is closed.
    area : float, m2
        Of all triangles.
    nil : int
        Triangles without area.
    collapsed : int
        Triangles taken away because two of their corners coincide.
    slenderness : (3,)
        Longest side by the height over it, of half, of 95 % and of 99 % of the triangles no more.
    tunnels : int
        How many there should be.
    """

    vertices: int
    edges: int
    triangles: int
    open_edges: int
    off_centre: int
    first_open: FloatArray
    euler: int
    fluxes: FloatArray
    area: float
    nil: int
    collapsed: int
    slenderness: FloatArray
    tunnels: int = 0

    def __attrs_post_init__(self) -> None:
        freeze(self.first_open, self.fluxes, self.slenderness)

    @property
    def closed(self) -> bool:
        """Whether every edge is that of two triangles, once in each sense."""
        return self.open_edges == 0

    @property
    def sound(self) -> bool:
        """Whether it is closed, one body with no hole but its tunnels, and faces outward."""
        least, most = float(self.fluxes.min()), float(self.fluxes.max())
        alike = least > 0.0 and most - least <= _ALIKE * most
        return self.closed and self.euler == 2 - 2 * self.tunnels and alike


def examine_mesh(
    xyz: FloatArray, triangle: IntArray, collapsed: int = 0, tunnels: int = 0
) -> MeshReport:
    """Examine a mesh.

    Parameters
    ----------
    xyz : (v, 3), m
        Vertices, each of a triangle.
    triangle : (f, 3) int
        Triangles.
    collapsed : int
        How many were taken away before.
    tunnels : int
        How many there should be.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.surface.cells.closed_mesh import examine_mesh
    >>> corner = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> face = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> examine_mesh(corner, face).sound, examine_mesh(corner, face[:3]).open_edges
    (True, 3)
    """
    mesh = Triangles(xyz, triangle)
    ends, key = mesh.edges(), mesh.edge_keys()
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.append(True, np.diff(key[order]) != 0))
    sense = np.where(ends[:, 0] < ends[:, 1], 1, -1)[order]
    count = np.diff(np.append(first, len(order)))
    lost = ends[order[first[(count != 2) | (np.add.reduceat(sense, first) != 0)]]]
    vector = mesh.area_vectors()
    area = np.sqrt(dot(vector, vector))
    centroid = mesh.corners.mean(axis=1)
    return MeshReport(
        len(xyz), len(first), len(triangle), len(lost),
        int((xyz[lost, 1] != 0.0).any(axis=1).sum()),
        xyz[lost[0]].mean(axis=0) if len(lost) else np.full(3, np.nan),
        len(xyz) - len(first) + len(triangle),
        np.asarray((vector * centroid).sum(axis=0)),
        float(area.sum()),
        int((area <= _NIL * float(np.ptp(xyz[:, 0])) ** 2).sum()),
        collapsed,
        _slenderness(mesh, area),
        tunnels,
    )  # fmt: skip


def _slenderness(mesh: Triangles, area: FloatArray) -> FloatArray:
    """Give quantiles of the longest side by the height over it."""
    corner = mesh.corners
    side = corner - np.roll(corner, 1, axis=1)
    longest = dot(side, side).max(axis=1)
    ratio = np.divide(longest, 2.0 * area, out=np.full(len(area), np.inf), where=area > 0.0)
    return np.asarray(np.quantile(ratio, [0.5, 0.95, 0.99], method="higher"))


# --------------------------------------------------------------------------------------
# The mesh. What encloses a volume is checked before it is given out. The mesh shares nothing with
# the strips that hydrostatics is integrated on, so that each is a check of the other.

_WHERE = "in a closed mesh"
_MOST_POINTS = 64

_COARSE = 1e-4
"""Chords that leave one line in twenty by more than this part of the length are reported: on ships
with sections and waterlines it is a tenth to a third of it, and volumes are good to .05 %."""


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


def triangles_below(body: Triangles, level: float) -> BelowDraught:
    """Give what a closed body of both sides has below a level, m, above its lowest place."""
    plane = FloatingPlanes(np.array([level]), np.zeros(1), np.zeros(1))
    found = immersed_triangles(make_body(body), plane)
    volume = float(found.volume[0])
    return BelowDraught(
        volume, float(found.moment_x[0]) / volume, float(found.moment_z[0]) / volume
    )


@attrs.frozen(eq=False)
class MeshedBody:
    """A closed surface of a body beside the net; one that stands on both sides has two.

    Attributes
    ----------
    name : str
        Its group.
    first, last : int
        Its triangles in the mesh, the last left out.
    sign : int
        1 faces outward; -1 is taken from the hull, and faces inward.
    report : MeshReport
        What was found of it, as it faces outward.
    """

    name: str
    first: int
    last: int
    sign: int
    report: MeshReport


_CHORD = 3e-4
"""Chords of which one in twenty leaves its line by no more than this part of the length are."""


@attrs.frozen(eq=False, repr=False)
class ClosedMesh(ShownAsText):
    """Triangles that enclose a hull, or its port half, and each body beside its net.

    Attributes
    ----------
    xyz : (v, 3), m
        Vertices: first those of the hull, which shares none with bodies.
    triangle : (f, 3) int
        Counter-clockwise from outside: first those of the hull, then those of bodies.
    group : (f,) int
        The group of each, a place in `names`.
    cell : (f,) int
        The cell of the net that each lies in, the same on both sides; -1 in deck, ends and bodies.
    names : tuple of str
        The groups: ``"shell"``, then ``"deck"``, other covers by the lines at their borders,
        tunnels, bodies.
    half : bool
        The port half only, which is open in the centre plane.
    steps : int
        Into how many parts each edge of the net is cut.
    cells : int
        Cells of the net, of one half.
    report : MeshReport
        What was found of the hull itself.
    sagitta : (3,), m
        How far the lines leave their chords between points: half, 95 % and all of them no more.
    notes : tuple of str
        What was done to lines that do not part the hull into cells as they are, and bodies that
        enclose nothing, which are left out.
    bodies : tuple of MeshedBody
        Beside the hull, each closed by itself.
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
    bodies: tuple[MeshedBody, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz, self.triangle, self.group, self.cell, self.sagitta)

    @property
    def triangles(self) -> Triangles:
        """The mesh as `assoc_hull.geometry` takes it."""
        return Triangles(self.xyz, self.triangle)

    @property
    def fine(self) -> bool:
        """Whether chords are as short as those of a mesh in a file are by default."""
        return float(self.sagitta[1]) <= _CHORD * float(np.ptp(self.xyz[:, 0]))

    @property
    def volume(self) -> float:
        """What the hull encloses, m3, without bodies beside it.

        Raises
        ------
        OpenMeshError
            It is a half, or does not close.
        """
        require_closed(self.report, "the volume", self.half)
        return float(self.report.fluxes.mean())

    def below(self, draught: float) -> BelowDraught:
        """Give volume and centroid below a waterplane: a check of `Hull.hydrostatics`.

        Of the hull alone: hydrostatics do not see bodies beside the net.

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
        xyz = self.xyz[: self.report.vertices]
        if height <= float(xyz[:, 2].min()):
            raise BadInputError(
                f"a draught of {height:g} m, below which nothing lies", _WHERE, "give a larger one"
            )
        return triangles_below(Triangles(xyz, self.triangle[: self.report.triangles]), height)

    @property
    def area(self) -> float:
        """The area of the hull, m2, without bodies beside it."""
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
        beside = {each.name for each in self.bodies}
        areas = ", ".join(
            f"{name} {area:.3f} m2" for name, area in self.areas.items() if name not in beside
        )
        volume = " ".join(f"{each:.3f}" for each in report.fluxes.tolist())
        closed = f"yes: each edge in two triangles, Euler {report.euler}"
        where = "elsewhere" if report.off_centre else "all in the centre plane"
        ajar = f"no: {report.open_edges} open edges, {where}"
        median, most, nearly = report.slenderness.tolist()
        bend = [f"{1000.0 * each:.1f}" for each in self.sagitta.tolist()]
        rows = [
            ("mesh", f"{sides}; {self.cells} cells a half, {self.steps} points to an edge"),
            (
                "triangles",
                f"{report.triangles}, {report.vertices} vertices, {report.nil} without area",
            ),
            ("area", areas),
            ("watertight", closed if report.sound else ajar),
            ("volume", f"{volume} m3, by x, y and z" if report.sound else "none: it is open"),
            ("chords", f"{bend[0]} mm off their lines (median), 95 % {bend[1]}, most {bend[2]}"),
            ("slenderness", f"median {median:.1f}, 95 % below {most:.1f}, 99 % below {nearly:.1f}"),
            *([("bodies", self._bodies())] if self.bodies else []),
            *(("note", note) for note in self.notes),
        ]
        return "\n".join(f"{name:<12}{text}" for name, text in rows)

    def _bodies(self) -> str:
        """Say what stands beside the hull."""
        told = dict.fromkeys(each.name for each in self.bodies)
        if self.half:
            return f"beside the hull, what of them stands to port: {', '.join(told)}"
        volumes = dict.fromkeys(told, 0.0)
        for each in self.bodies:
            volumes[each.name] += each.sign * float(each.report.fluxes.mean())
        words = ", ".join(f"{name} {volume:.3f} m3" for name, volume in volumes.items())
        triangles = len(self.triangle) - self.report.triangles
        return f"beside the hull, each closed: {words}; {triangles} triangles"


def require_closed(
    report: MeshReport, asked: str, half: bool, remedy: str = "mend the lines there"
) -> None:
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
        else remedy,
    )  # fmt: skip


def _with_bodies(mesh: ClosedMesh, bodies: Sequence[AttachedBody]) -> ClosedMesh:
    """Set bodies beside a mesh of a hull, each a group."""
    xyz, triangle, group = [mesh.xyz], [mesh.triangle], [mesh.group]
    names, notes, found = list(mesh.names), list(mesh.notes), list[MeshedBody]()
    vertices, count = len(mesh.xyz), len(mesh.triangle)
    called = _group_names(bodies, mesh.names)
    for each in surfaces_of(bodies, half=mesh.half):
        report = None
        if len(each.triangle):
            report = examine_mesh(each.xyz, each.triangle[:, :: each.sign])
        if report is None or (report.off_centre if mesh.half else not report.sound):
            notes.append(f"the body {each.name!r} encloses nothing as it is, and is left out")
            continue
        name = called[each.name]
        names += [name] if name not in names else []
        xyz.append(each.xyz)
        triangle.append(each.triangle + vertices)
        group.append(np.full(len(each.triangle), names.index(name)))
        found.append(MeshedBody(name, count, count + len(each.triangle), each.sign, report))
        vertices, count = vertices + len(each.xyz), count + len(each.triangle)
    faces = np.concatenate(triangle)
    cell = np.full(count, -1)
    cell[: len(mesh.cell)] = mesh.cell
    return attrs.evolve(
        mesh, xyz=np.concatenate(xyz), triangle=faces, group=np.concatenate(group), cell=cell,
        names=tuple(names), notes=tuple(dict.fromkeys(notes)), bodies=tuple(found),
    )  # fmt: skip


def _group_names(bodies: Sequence[AttachedBody], taken: Sequence[str]) -> dict[str, str]:
    """Give the group of each body: its name, told from a cover or a tunnel that is called so."""
    return {
        each.name: f"{each.name} ({each.group})" if each.name in taken else each.name
        for each in bodies
    }


def mesh_of_net(
    net: CurveNet,
    *,
    half: bool = False,
    points: int = 4,
    leave_out: NDArray[np.bool_] | None = None,
    tunnels: Sequence[TunnelDefinition] = (),
    bodies: Sequence[AttachedBody] = (),
) -> ClosedMesh:
    """Make a closed mesh on the lines of a hull.

    Parameters
    ----------
    net : CurveNet
        Curves and crossings.
    half : bool
        The port half only. It is covered by deck and ends, and open in the centre plane.
    points : int
        Into how many parts each piece of a line between two crossings is cut; even.
    leave_out : (m,) bool or None
        Curves to do without.
    tunnels : sequence of TunnelDefinition
        Through the hull: prisms, of `_SIDES` sides to a point.
    bodies : sequence of AttachedBody
        Beside it: closed surfaces of their own.

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
    >>> from assoc_hull.analysis.net.curve_net import gather_net
    >>> from assoc_hull.surface.cells.closed_mesh import mesh_of_net
    >>> found = mesh_of_net(gather_net(ah.examples.wigley().state), points=2)
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
    sheets = cover_openings(filled)
    for each in tunnels:
        sheets = _tunnelled(sheets, each, _SIDES * points)
    if not half:
        sheets = mirror_half(sheets)
    report = examine_mesh(sheets.xyz, sheets.triangle, sheets.collapsed, len(tunnels))
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
    found = ClosedMesh(
        sheets.xyz, sheets.triangle, sheets.group, sheets.cell, sheets.names, half, points,
        filled.cells.count, report, sagitta, notes,
    )  # fmt: skip
    return _with_bodies(found, bodies) if bodies else found


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


def closed_mesh(
    hull: HasState, *, half: bool = False, points: int = 4, leave_out: Collection[str] = ()
) -> ClosedMesh:
    """Make a closed mesh on the lines of a hull: for panels, printing, a check of volumes.

    The arguments and what is raised are those of `Hull.mesh`.
    """
    return mesh_of_state(state_of(hull, _WHERE), half=half, points=points, leave_out=leave_out)


def mesh_of_state(
    state: HullState, *, half: bool = False, points: int = 4, leave_out: Collection[str] = ()
) -> ClosedMesh:
    """Make a closed mesh of the tables of a hull, as `closed_mesh` does."""
    if state.failed:
        raise BadInputError("a curve has failed", _WHERE, "mend it, or take back the edit")
    net = gather_net(state)
    names = all_of(leave_out, str, "leave_out", _WHERE)
    held = {each.name for each in state.tunnels} | {each.name for each in state.bodies}
    held -= set(net.name)
    return mesh_of_net(
        net, half=half, points=points,
        leave_out=curves_named(net, [name for name in names if name not in held]),
        tunnels=[each for each in state.tunnels if each.name not in names],
        bodies=[each for each in state.bodies if each.name not in names],
    )  # fmt: skip


_POINTS = (4, 8, 16, 32)
"""Parts of each piece of a line between crossings: the first with which chords are short enough."""


def fine_mesh_of_state(
    state: HullState,
    off: Callable[[ClosedMesh], float],
    *,
    half: bool = False,
    leave_out: Collection[str] = (),
) -> ClosedMesh:
    """Make a closed mesh of the tables of a hull for a file: as fine as its lines ask for.

    `off` tells by how much a mesh is another body than it should be; 1 is the most that is taken.
    """
    last = np.inf
    for points in _POINTS:
        mesh = mesh_of_state(state, half=half, points=points, leave_out=leave_out)
        now = off(mesh)
        # What chords cut off is a fourth with twice as many; what stays has another reason.
        if mesh.fine and (now <= 1.0 or now > 0.5 * last):
            break
        last = now
    return mesh


def curves_named(net: CurveNet, names: Sequence[str], where: str = _WHERE) -> NDArray[np.bool_]:
    """Tell which curves of a net are those of some lines, (m,).

    Raises
    ------
    WrongTypeError, UnknownNameError
        Something else than names was given, or a name is that of no line.
    """
    wanted = all_of(names, str, "leave_out", where)
    for name in wanted:
        if name not in net.name:
            raise UnknownNameError("line", name, tuple(dict.fromkeys(net.name)))
    return np.isin(np.array(net.name), wanted)
