"""A file of Rhino as plain values: curves, surfaces and meshes by name and layer, in its unit.

What is hidden, on a layer that is off, or of a kind that is not read is counted by layer. A face
that is trimmed is not read: rhino3dm does not tell its trims.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import regular_file
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.knots import checked_knots
from assoc_hull.geometry.patches.spline_curve import SplineCurve
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.child_process import limits_for, run_in_child
from assoc_hull.io.lines.own_lines import IMAGE, MARK, OwnLines, TextedCurve, own_lines
from assoc_hull.io.rhino.write import rhino_module
from assoc_hull.io.units import METRES

__all__ = [
    "RhinoCurve",
    "RhinoMesh",
    "RhinoModel",
    "is_rhino",
    "own_rhino_lines",
    "read_rhino",
    "rhino_values",
]

_HEAD = b"3D Geometry File Format"
_MOST_BYTES = 200_000_000
_UNITS = {
    "Meters": "m", "Millimeters": "mm", "Centimeters": "cm", "Feet": "ft", "Inches": "in",
}  # fmt: skip
_SIDES, _TRIMMED = 33, 1e-3
"""Places along a side of a surface; edges this part of its size off its sides trim it."""


@attrs.frozen(eq=False)
class RhinoCurve:
    """A curve: its layer, its spline in the unit of the file, which has its name, and our text."""

    layer: str
    spline: SplineCurve
    text: str


@attrs.frozen(eq=False)
class RhinoMesh:
    """Triangles: layer, name, vertices (v, 3) in the unit of the file, corners (f, 3)."""

    layer: str
    name: str
    xyz: FloatArray
    face: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz, self.face)


@attrs.frozen(eq=False)
class RhinoModel:
    """What a file holds.

    Attributes
    ----------
    unit : str or None
        "m", "mm", "cm", "ft" or "in"; None for another or none.
    curves, surfaces, meshes : tuple
        Curves, spline surfaces with their layers, meshes; those that are shown.
    left : tuple of (str, str, int)
        Layer and kind of what is not read, and how many.
    trimmed : tuple of str
        Names of faces that are trimmed.
    text : str
        Our text of the hull, empty if it is no file of ours.
    """

    unit: str | None
    curves: tuple[RhinoCurve, ...]
    surfaces: tuple[tuple[str, SplineSurface], ...]
    meshes: tuple[RhinoMesh, ...]
    left: tuple[tuple[str, str, int], ...]
    trimmed: tuple[str, ...]
    text: str


def is_rhino(path: Path) -> bool:
    """Tell by its beginning whether a file is one of Rhino."""
    if not path.is_file():  # opening a pipe waits for ever
        return False
    try:
        with path.open("rb") as file:
            return file.read(len(_HEAD)) == _HEAD
    except OSError:
        return False


def read_rhino(path: Path) -> RhinoModel:
    """Read a file of Rhino; rhino3dm works in a process of its own, with limits.

    Raises
    ------
    BadInputError
        It is too large, damaged, or takes more than the limits of memory and time.
    MissingExtraError
        rhino3dm is not installed.
    """
    unit, curves, surfaces, meshes, left, trimmed, text = run_in_child(
        f"{__name__}:rhino_values", (str(regular_file(path)),), limits_for(path), f"at {path}",
        (__name__, "rhino3dm"),
    )  # fmt: skip
    return RhinoModel(
        unit,
        tuple(RhinoCurve(layer, SplineCurve(*each), own) for layer, each, own in curves),
        tuple((layer, SplineSurface(*each)) for layer, each in surfaces),
        tuple(RhinoMesh(*each) for each in meshes), left, trimmed, text,
    )  # fmt: skip


def rhino_values(name: str) -> tuple[Any, ...]:
    """Give what makes a `RhinoModel`, as plain values; called in a child."""
    path = Path(name)
    rhino = rhino_module()
    size = path.stat().st_size
    if size > _MOST_BYTES:
        what = f"the file has {size / 1e6:.0f} MB, more than {_MOST_BYTES / 1e6:g}"
        raise BadInputError(what, f"in {path.name}", "export the hull only")
    model = rhino.File3dm.Read(str(path))
    if model is None:
        raise BadInputError("rhino3dm cannot read it", f"in {path.name}", "save it again in Rhino")
    found = _Reader(rhino, model, path.name).model_values()
    return (
        found.unit,
        [(each.layer, _plain(each.spline), each.text) for each in found.curves],
        [(layer, _plain(each)) for layer, each in found.surfaces],
        [_plain(each) for each in found.meshes],
        found.left, found.trimmed, found.text,
    )  # fmt: skip


def _plain(value: Any) -> tuple[Any, ...]:
    return tuple(getattr(value, each.name) for each in attrs.fields(type(value)))


def own_rhino_lines(path: Path) -> OwnLines | None:
    """Give the lines of a file of ours; None if it is none; raises as `read_rhino`."""
    model = read_rhino(path)
    if not model.text:
        return None
    if model.unit is None:
        return OwnLines(fault="it tells no unit any more")
    metres = METRES[model.unit]
    curves = [
        TextedCurve(each.text, attrs.evolve(each.spline, points=each.spline.points * metres))
        for each in model.curves if each.text
    ]  # fmt: skip
    others = [repr(each.spline.name) for each in model.curves if not each.text]
    return attrs.evolve(own_lines(model.text, curves, others), unit=model.unit)


@attrs.define(eq=False)
class _Reader:
    rhino: Any
    model: Any
    source: str
    curves: list[RhinoCurve] = attrs.field(factory=list)
    surfaces: list[tuple[str, SplineSurface]] = attrs.field(factory=list)
    meshes: list[RhinoMesh] = attrs.field(factory=list)
    left: Counter[tuple[str, str]] = attrs.field(factory=Counter)
    trimmed: list[str] = attrs.field(factory=list)

    def model_values(self) -> RhinoModel:
        unit = str(self.model.Settings.ModelUnitSystem).rpartition(".")[2]
        own = self.model.Strings[MARK] or ""
        layers = {each.Index: each for each in self.model.Layers}
        for each in self.model.Objects:
            layer = layers.get(each.Attributes.LayerIndex)
            title = layer.FullPath if layer is not None else ""
            if each.Attributes.IsInstanceDefinitionObject:
                continue
            if not each.Attributes.Visible or (layer is not None and not layer.Visible):
                self.left[title, "hidden"] += 1
            elif not (own and each.Attributes.GetUserString(MARK) == IMAGE):
                self._take(each.Geometry, each.Attributes, title)
        left = [(*key, count) for key, count in sorted(self.left.items())]
        return RhinoModel(
            _UNITS.get(unit), tuple(self.curves), tuple(self.surfaces), tuple(self.meshes),
            tuple(left), tuple(self.trimmed), str(own),
        )  # fmt: skip

    def _take(self, shape: Any, attributes: Any, layer: str) -> None:
        """Take an object in, or count it among what is left out."""
        name, kind = str(attributes.Name or ""), type(shape).__name__
        if isinstance(shape, self.rhino.Curve):
            text = str(attributes.GetUserString(MARK) or "")
            self.curves.append(RhinoCurve(layer, self._curve(shape, name), text))
        elif isinstance(shape, self.rhino.Extrusion):
            self._take_faces(shape.ToBrep(True), name, layer)
        elif isinstance(shape, self.rhino.Brep):
            self._take_faces(shape, name, layer)
        elif isinstance(shape, self.rhino.Surface):
            self.surfaces.append((layer, self._surface(shape.ToNurbsSurface(), name)))
        elif isinstance(shape, self.rhino.Mesh):
            self.meshes.append(_mesh(shape, name, layer))
        else:
            self.left[layer, kind] += 1

    def _curve(self, shape: Any, name: str) -> SplineCurve:
        where = f"in the curve {name!r} of {self.source}"
        nurbs = shape.ToNurbsCurve()
        if nurbs is None:
            raise BadInputError("the curve is no spline", where, "rebuild it, or explode it")
        points = np.array([[p.X, p.Y, p.Z, p.W] for p in map(nurbs.Points.__getitem__, _range(
            nurbs.Points))], np.float64)  # fmt: skip
        # Rhino leaves out the first and the last knot.
        inner = [nurbs.Knots[i] for i in _range(nurbs.Knots)]
        knots = np.array([inner[0], *inner, inner[-1]], np.float64)
        xyz, weights = _places(points, where)
        knots = checked_knots(knots, nurbs.Degree, len(xyz), "the knots", where)
        curve = SplineCurve(name, nurbs.Degree, knots, xyz, weights)
        # Knots that are not full at the ends, of a periodic curve.
        low, high = curve.domain
        return curve if knots[0] == low and knots[-1] == high else curve.restricted(low, high)

    def _take_faces(self, brep: Any, name: str, layer: str) -> None:
        """Take the faces of a polysurface that are whole surfaces."""
        for i in range(len(brep.Faces)):
            face, title = brep.Faces[i], f"{name or layer} {i + 1}"
            nurbs = face.UnderlyingSurface().ToNurbsSurface()
            surface = self._surface(nurbs, title)
            if _is_trimmed(brep, face, surface):
                self.trimmed.append(title)
            else:
                self.surfaces.append((layer, surface))

    def _surface(self, nurbs: Any, name: str) -> SplineSurface:
        where = f"in the surface {name!r} of {self.source}"
        rows, columns = nurbs.Points.CountU, nurbs.Points.CountV
        points = np.array(
            [[_four(nurbs.Points[i, j]) for j in range(columns)] for i in range(rows)], np.float64
        )
        knots = []
        for side in (nurbs.KnotsU, nurbs.KnotsV):
            inner = [side[i] for i in _range(side)]
            knots.append(np.array([inner[0], *inner, inner[-1]], np.float64))
        xyz, weights = _places(points.reshape(-1, 4), where)
        shape = (rows, columns)
        return SplineSurface(
            name, (nurbs.Degree(0), nurbs.Degree(1)), knots[0], knots[1], xyz.reshape(*shape, 3),
            None if weights is None else weights.reshape(shape),
        )  # fmt: skip


def _range(sequence: Any) -> range:
    return range(len(sequence))


def _four(point: Any) -> tuple[float, float, float, float]:
    return point.X, point.Y, point.Z, point.W


def _places(points: FloatArray, where: str) -> tuple[FloatArray, FloatArray | None]:
    """Give places and weights of homogeneous points, (n, 4)."""
    weights = points[:, 3]
    if not np.isfinite(points).all() or not (weights > 0.0).all():
        raise BadInputError("a control point is no place", where, "save it again in Rhino")
    if (weights == weights[0]).all():
        return points[:, :3] / weights[0], None
    return points[:, :3] / weights[:, None], weights.copy()


def _mesh(shape: Any, name: str, layer: str) -> RhinoMesh:
    points = [shape.Vertices.Point3dAt(i) for i in _range(shape.Vertices)]
    xyz = np.array([[p.X, p.Y, p.Z] for p in points], np.float64).reshape(-1, 3)
    face: list[tuple[int, int, int]] = []
    for i in range(shape.Faces.Count):
        a, b, c, d = shape.Faces[i]
        face += [(a, b, c)] if c == d else [(a, b, c), (a, c, d)]
    return RhinoMesh(layer, name, xyz, np.array(face, np.int64).reshape(-1, 3))


def _is_trimmed(brep: Any, face: Any, surface: SplineSurface) -> bool:
    """Tell whether the edges of a face leave the sides of its surface."""
    if len(face.Loops) != 1:
        return True
    size = float(np.ptp(surface.net.reshape(-1, 3), axis=0).max())
    places = np.concatenate(list(_edge_places(brep, face)) or [np.zeros((0, 3))])
    near = _distance(np.concatenate(list(_sides(surface))), places)
    return bool((near > _TRIMMED * size).any())


def _edge_places(brep: Any, face: Any) -> Iterator[FloatArray]:
    loop = face.OuterLoop
    for i in range(loop.TrimCount):
        number = loop.Trims[i].EdgeIndex
        if number < 0:  # a side that is a point
            continue
        edge = brep.Edges[number]
        low, high = edge.Domain.T0, edge.Domain.T1
        points = [edge.PointAt(t) for t in np.linspace(low, high, 9).tolist()]
        yield np.array([[p.X, p.Y, p.Z] for p in points])


def _sides(surface: SplineSurface) -> Iterator[FloatArray]:
    """Give the four sides as segments, (k, 2, 3)."""
    (u0, u1), (v0, v1) = surface.domain
    u, v = np.linspace(u0, u1, _SIDES), np.linspace(v0, v1, _SIDES)
    for side in (
        surface.at(u, np.full(_SIDES, v0)), surface.at(u, np.full(_SIDES, v1)),
        surface.at(np.full(_SIDES, u0), v), surface.at(np.full(_SIDES, u1), v),
    ):  # fmt: skip
        yield np.stack([side[:-1], side[1:]], axis=1)


def _distance(segment: FloatArray, places: FloatArray) -> FloatArray:
    """Give how far places lie off the nearest of some segments."""
    start, step = segment[:, 0], segment[:, 1] - segment[:, 0]
    off = places[:, None] - start
    square = np.maximum((step * step).sum(axis=1), 1e-30)
    part = np.clip((off * step).sum(axis=2) / square, 0.0, 1.0)
    found: FloatArray = np.linalg.norm(off - part[..., None] * step, axis=2).min(axis=1)
    return found
