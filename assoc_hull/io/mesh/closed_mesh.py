"""A closed mesh written as STL, OBJ, PLY or glTF, whole or not at all.

Numbers are rounded as the format rounds them before the mesh is checked. Vertices may fall together
then: triangles between them have no area and are left out on both sides of the same edge, so that
the mesh stays closed. That is checked on what is written, not on what it was made of.
"""

from __future__ import annotations

import io
import math
import os
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import attrs
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.arguments import choice, instance, text
from assoc_hull.errors import MissingExtraError, NotSoundError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.io.write_file import form_by_ending, write_whole
from assoc_hull.surface.cells.closed_mesh import ClosedMesh, examine_mesh, require_closed
from assoc_hull.surface.cells.meshed_bodies import welded
from assoc_hull.surface.volume_check import NOT_HELD, Displaced, mesh_below, mesh_faults

__all__ = [
    "MESH_ENDINGS",
    "MESH_FORMS",
    "FiledMesh",
    "MeshFile",
    "MeshForm",
    "mesh_form_of",
    "write_mesh",
]

# --------------------------------------------------------------------------------------
# The formats: numbers as they hold them, and bytes.

_RECORD = np.dtype([("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("more", "<u2")])
_STL_TITLE = 80
_DECIMALS = 6
"""Digits behind the point of texts at least: a micrometre in m."""

_PLACES = 8
"""A text rounds by no more than half of this power of a tenth of the length: of a model of 0.5 m a
micrometre would fold small facets, and let a body beside it touch it."""


def _decimals(values: FloatArray) -> int:
    """Give the digits behind the point with which a text holds a mesh, (v, 3)."""
    size = float(np.ptp(values, axis=0).max(initial=0.0))
    return _DECIMALS if size <= 0.0 else max(_DECIMALS, _PLACES - math.floor(math.log10(size)))


@attrs.frozen(eq=False)
class FiledMesh:
    """A mesh with the numbers that a file will hold.

    Attributes
    ----------
    xyz : (v, 3)
        In the unit of the file.
    triangle : (f, 3) int
        Counter-clockwise from outside; those of a group side by side.
    group : (f,) int
        A place in `names`.
    names : tuple of str
        The groups.
    title : str
        What the mesh is, for forms that can say so.
    decimals : int
        Digits behind the point of a text.
    """

    xyz: FloatArray
    triangle: IntArray
    group: IntArray
    names: tuple[str, ...]
    title: str
    decimals: int = _DECIMALS

    @classmethod
    def of(
        cls, mesh: ClosedMesh, scale: float, rounded: Callable[[FloatArray], FloatArray], title: str
    ) -> FiledMesh:
        """Round a mesh (m) to the numbers of a file; `scale` is units of the file in a metre.

        Raises
        ------
        OpenMeshError
            It does not close, before or after it was rounded; a half may be open in the centre
            plane.
        """
        exact, tunnels = mesh.xyz * scale, mesh.report.tunnels
        places = rounded(exact)
        end = min((each.first for each in mesh.bodies), default=len(mesh.triangle))
        every = [(0, end, 1, tunnels, "a file", "mend the lines there")]
        every += [
            (each.first, each.last, each.sign, 0, f"the body {each.name!r} in a file",
             "leave it out of the mesh, by leave_out")
            for each in mesh.bodies
        ]  # fmt: skip
        xyz, faces, groups, count = list[FloatArray](), list[IntArray](), list[IntArray](), 0
        # The hull and each body by itself: places that they share stay apart.
        for first, last, sign, holes, what, remedy in every:
            order = first + np.argsort(mesh.group[first:last], kind="stable")
            found = welded(places, mesh.triangle[order])
            report = examine_mesh(found.xyz / scale, found.face[:, ::sign], tunnels=holes)
            if not mesh.half and not report.sound:
                found = welded(
                    _collapsed(exact, places, mesh.triangle[order]), mesh.triangle[order]
                )
                report = examine_mesh(found.xyz / scale, found.face[:, ::sign], tunnels=holes)
            if report.off_centre if mesh.half else not report.sound:
                require_closed(report, what, mesh.half, remedy)
            xyz.append(found.xyz)
            faces.append(found.face + count)
            groups.append(mesh.group[order[found.origin]])
            count += len(found.xyz)
        return cls(
            np.concatenate(xyz), np.concatenate(faces), np.concatenate(groups), mesh.names, title,
            _decimals(exact),
        )  # fmt: skip

    @property
    def runs(self) -> list[tuple[str, IntArray]]:
        """The triangles of each group that has any, (k, 3), with its name."""
        parts = ((name, self.triangle[self.group == i]) for i, name in enumerate(self.names))
        return [(name, part) for name, part in parts if len(part)]

    def normals(self) -> FloatArray:
        """Give the unit normals of the triangles, (f, 3)."""
        vector = Triangles(self.xyz, self.triangle).area_vectors()
        size = np.sqrt((vector**2).sum(axis=1))[:, None]
        return np.asarray(vector / np.where(size > 0.0, size, 1.0))


_SHORT = 4.0
"""Times what rounding moves a place by: an edge as short as that may not survive it."""


def _collapsed(exact: FloatArray, places: FloatArray, triangle: IntArray) -> FloatArray:
    """Put both ends of edges that rounding may make nothing of at one rounded place.

    Where only one of several short edges at a corner vanishes, the slivers that are left share an
    edge between four.
    """
    edge = np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]])
    away = exact[edge[:, 0]] - exact[edge[:, 1]]
    limit = _SHORT * float(np.abs(places - exact).max(initial=0.0))
    short = edge[(away * away).sum(axis=1) <= limit * limit]
    links = coo_array((np.ones(len(short)), (short[:, 0], short[:, 1])), (len(exact), len(exact)))
    _, corner = connected_components(links, directed=False)
    _, first, part = np.unique(corner, return_index=True, return_inverse=True)
    return np.asarray(places[first[part]])


def _stl(mesh: FiledMesh) -> bytes:
    records = np.zeros(len(mesh.triangle), _RECORD)
    records["corner"], records["normal"] = mesh.xyz[mesh.triangle], mesh.normals()
    # A title that begins with "solid" would make it text.
    title = f"mesh of {mesh.title}".encode("ascii", "replace")[:_STL_TITLE].ljust(_STL_TITLE)
    return title + len(records).to_bytes(4, "little") + records.tobytes()


def _stl_text(mesh: FiledMesh) -> bytes:
    normals = mesh.normals()
    rows: list[str] = []
    for number, name in enumerate(mesh.names):
        mine = mesh.group == number
        if not mine.any():
            continue
        rows.append(f"solid {_word(name)}")
        places = mesh.xyz[mesh.triangle[mine]].tolist()
        for normal, corners in zip(normals[mine].tolist(), places, strict=True):
            rows.append(" facet normal " + " ".join(f"{each:.6f}" for each in normal))
            rows.append("  outer loop")
            rows += ["   vertex " + _numbers(corner, mesh.decimals) for corner in corners]
            rows += ["  endloop", " endfacet"]
        rows.append(f"endsolid {_word(name)}")
    return "\n".join([*rows, ""]).encode("ascii", "replace")


def _obj(mesh: FiledMesh) -> bytes:
    places = mesh.xyz.tolist()
    rows = [f"# {mesh.title}", *("v " + _numbers(each, mesh.decimals) for each in places)]
    for name, part in mesh.runs:
        rows.append(f"g {_word(name)}")
        rows += [f"f {a} {b} {c}" for a, b, c in (part + 1).tolist()]
    return "\n".join([*rows, ""]).encode("ascii", "replace")


def _ply(mesh: FiledMesh) -> bytes:
    names = [f"comment group {number} {name}" for number, name in enumerate(mesh.names)]
    kind, small = ("uchar", "u1") if len(names) <= 256 else ("ushort", "<u2")
    head = [
        "ply", "format binary_little_endian 1.0", f"comment {mesh.title}", *names,
        f"element vertex {len(mesh.xyz)}", "property double x", "property double y",
        "property double z", f"element face {len(mesh.triangle)}",
        "property list uchar int vertex_indices", f"property {kind} group", "end_header", "",
    ]  # fmt: skip
    rows = np.zeros(
        len(mesh.triangle), np.dtype([("many", "u1"), ("corner", "<i4", 3), ("group", small)])
    )
    rows["many"], rows["corner"], rows["group"] = 3, mesh.triangle, mesh.group
    return (
        "\n".join(head).encode("ascii", "replace")
        + mesh.xyz.astype("<f8").tobytes()
        + (rows.tobytes())
    )


def _glb(mesh: FiledMesh) -> bytes:
    """Write a scene with a mesh a group; glTF has y up and the bow towards the viewer, +z."""
    try:
        import trimesh
    except ImportError as error:
        raise MissingExtraError("trimesh", "mesh") from error
    scene: Any = trimesh.Scene()
    turned = np.zeros((4, 4))
    turned[[0, 1, 2, 3], [1, 2, 0, 3]] = 1.0
    for name, part in mesh.runs:
        used, face = np.unique(part, return_inverse=True)
        one = trimesh.Trimesh(mesh.xyz[used], face.reshape(-1, 3), process=False)
        scene.add_geometry(one, node_name=name, geom_name=name, transform=turned)
    out = io.BytesIO()
    scene.export(out, file_type="glb")
    return out.getvalue()


def _numbers(values: list[float], decimals: int) -> str:
    return " ".join(f"{each:.{decimals}f}" for each in values)


def _word(name: str) -> str:
    """Give a name as one word: groups of these formats end at a space."""
    return "_".join(name.split()) or "group"


def _single(values: FloatArray) -> FloatArray:
    """Round to single precision; + 0.0 makes -0.0 a 0.0, here and below."""
    return values.astype(np.float32).astype(np.float64) + 0.0


def _written(values: FloatArray) -> FloatArray:
    return np.round(values, _decimals(values)) + 0.0


def _exact(values: FloatArray) -> FloatArray:
    return values + 0.0


@attrs.frozen
class MeshForm:
    """A form of meshes.

    Attributes
    ----------
    about : str
        What it is, in a few words.
    endings : tuple of str
        Names of files that mean it.
    dumps : callable
        Gives the bytes of a rounded mesh.
    rounded : callable
        Gives numbers as the form holds them.
    units : tuple of str
        Units that may be chosen, the default first.
    groups : bool
        Whether the form tells deck from shell.
    """

    about: str
    endings: tuple[str, ...]
    dumps: Callable[[FiledMesh], bytes]
    rounded: Callable[[FloatArray], FloatArray]
    units: tuple[str, ...] = ("m", "mm")
    groups: bool = True


MESH_FORMS: Mapping[str, MeshForm] = MappingProxyType({
    "stl": MeshForm("triangles in single precision", (".stl",), _stl, _single, groups=False),
    "stl-text": MeshForm("triangles as text, a solid a group", (), _stl_text, _written),
    "obj": MeshForm("vertices and triangles as text", (".obj",), _obj, _written),
    "ply": MeshForm("vertices and triangles in double precision", (".ply",), _ply, _exact),
    "glb": MeshForm("a scene for viewers, glTF 2.0", (".glb",), _glb, _single, units=("m",)),
})  # fmt: skip
"""The forms by name."""


# --------------------------------------------------------------------------------------
# The file.

MESH_ENDINGS: Mapping[str, str] = MappingProxyType(
    {ending: name for name, form in MESH_FORMS.items() for ending in form.endings}
)
"""The form that the ending of a file means."""

_SCALES = {"m": 1.0, "mm": 1e3}
_WHERE = "in a mesh file"


@attrs.frozen
class MeshFile:
    """What was written of a mesh.

    Attributes
    ----------
    path, form, unit : str
        The file; one of `assoc_hull.io.mesh.closed_mesh.MESH_FORMS`; "m" or "mm".
    half : bool
        Whether it is the port half, open in the centre plane.
    vertices, triangles : int
        As they are in the file, equal vertices counted once.
    left_out : int
        Triangles of the mesh that have no area in the numbers of the file.
    groups : tuple of str
        Shell, deck, other covers, tunnels, bodies. STL tells them in its text only.
    volume : float or None, m3
        What the hull encloses, without bodies; None of a half, which encloses nothing.
    size : int
        Bytes.
    chord : float or None, m
        How far the lines leave the edges of triangles between points at most.
    bodies : tuple of str
        Those of the groups that are bodies beside the hull, each closed by itself.
    displaced : (float, float, float) or None, m and m3
        A level, the volume of the mesh below it, of a half that of both sides, and that of
        hydrostatics; None: not compared.
    faults : tuple of str
        What was accepted.
    """

    path: str
    form: str
    unit: str
    half: bool
    vertices: int
    triangles: int
    left_out: int
    groups: tuple[str, ...]
    volume: float | None
    size: int
    chord: float | None = None
    bodies: tuple[str, ...] = ()
    displaced: tuple[float, float, float] | None = None
    faults: tuple[str, ...] = ()

    @property
    def words(self) -> str:
        """What was written, without where.

        Examples
        --------
        >>> from assoc_hull.io.mesh.closed_mesh import MeshFile
        >>> groups = ("shell", "deck")
        >>> print(MeshFile("a.stl", "stl", "m", False, 9, 14, 0, groups, 8.0, 784))
        9 vertices, 14 triangles: shell, deck
        closed, 8.000 m3
        not compared with hydrostatics, which were not had of its lines
        written: a.stl (stl, m)
        """
        rows = [
            f"{self.vertices} vertices, {self.triangles} triangles: {', '.join(self.groups)}",
            "the port half, open in the centre plane"
            if self.volume is None
            else f"closed, {self.volume:.3f} m3",
        ]
        if self.bodies:
            rows.append(f"beside the hull, closed surfaces of their own: {', '.join(self.bodies)}")
        if self.chord is not None:
            rows.append(f"lines leave the edges of triangles by up to {1e3 * self.chord:.1f} mm")
        if self.displaced is None:
            rows.append(NOT_HELD)
        else:
            level, mine, theirs = self.displaced
            sides = "both sides hold " if self.half else ""
            rows.append(
                f"below {level:.2f} m {sides}{mine:.3f} m3, by hydrostatics {theirs:.3f} m3 "
                f"({100.0 * (mine / theirs - 1.0):+.2f} %)"
            )
        rows += [f"accepted: {each}" for each in self.faults]
        if self.left_out:
            rows.append(f"{self.left_out} triangles have no area in the numbers of the file")
        return "\n".join(rows)

    def __str__(self) -> str:
        return f"{self.words}\nwritten: {self.path} ({self.form}, {self.unit})"


def mesh_form_of(path: str | os.PathLike[str], form: str | None = None) -> str:
    """Tell in which form a mesh is to be written: the one asked for, else by the ending.

    Raises
    ------
    BadInputError
        Neither says one.

    Examples
    --------
    >>> from assoc_hull.io.mesh.closed_mesh import mesh_form_of
    >>> mesh_form_of("ship.PLY"), mesh_form_of("ship.stl", "stl-text")
    ('ply', 'stl-text')
    """
    return form_by_ending(path, form, tuple(MESH_FORMS), MESH_ENDINGS, _WHERE)


def write_mesh(
    mesh: ClosedMesh,
    path: str | os.PathLike[str],
    form: str | None = None,
    *,
    unit: str | None = None,
    name: str = "hull",
    by_lines: Sequence[Displaced] = (),
    net: CurveNet | None = None,
    accept: bool = False,
) -> MeshFile:
    """Write a mesh.

    Parameters
    ----------
    mesh : ClosedMesh
        Both sides of a hull, or one.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : str or None
        "stl", "stl-text", "obj", "ply" or "glb"; by the ending of the file if None.
    unit : {"m", "mm"} or None
        Of the file, m if None. No form but glTF, which is in m, says which.
    name : str
        What the mesh is, for forms that can say so.
    by_lines : sequence of Displaced
        What hydrostatics find of the lines of the hull, to be compared with both sides.
    net : CurveNet or None
        These lines, beyond which no mesh reaches.
    accept : bool
        Write a mesh too that holds another volume, or reaches beyond.

    Returns
    -------
    MeshFile
        How much was written.

    Raises
    ------
    OpenMeshError
        The mesh does not close, as it is or in the numbers of the file.
    NotSoundError
        It is another body than hydrostatics measure, and that was not accepted.
    BadInputError, MissingExtraError
        A form or unit that is not known, a file that cannot be written; glTF without trimesh.
    """
    instance(mesh, ClosedMesh, "the mesh", _WHERE)
    chosen = mesh_form_of(path, form)
    known = MESH_FORMS[chosen]
    used = known.units[0] if unit is None else choice(unit, "unit", known.units, _WHERE)
    side = "port half, open in the centre plane; " if mesh.half else ""
    title = f"{' '.join(text(name, 'the name', _WHERE).split())}: {side}unit {used}"
    filed = FiledMesh.of(mesh, _SCALES[used], known.rounded, title)
    faults = () if net is None else mesh_faults(mesh, by_lines, net)
    if faults and not accept:
        raise NotSoundError(f"the closed mesh of {name}", faults)
    data = known.dumps(filed)
    write_whole(path, data)
    return MeshFile(
        os.fspath(path), chosen, used, mesh.half, len(filed.xyz), len(filed.triangle),
        len(mesh.triangle) - len(filed.triangle), mesh.names,
        None if mesh.half else mesh.volume, len(data), float(mesh.sagitta[2]),
        tuple(dict.fromkeys(each.name for each in mesh.bodies)), _compared(mesh, by_lines), faults,
    )  # fmt: skip


def _compared(mesh: ClosedMesh, by_lines: Sequence[Displaced]) -> tuple[float, float, float] | None:
    """Give the level at which volumes differ most, with that of the mesh and of hydrostatics."""
    if not by_lines:
        return None
    found = [(each.level, mesh_below(mesh, each.level).volume, each.volume) for each in by_lines]
    return max(found, key=lambda each: abs(each[1] / each[2] - 1.0))
