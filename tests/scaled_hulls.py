"""Hulls brought to 100 m between perpendiculars, as files at any scale and in any unit.

Coordinates are rounded to micrometres at 100 m, as exported files have them; a file at another
scale or in another unit holds the same decimals times a number, with all digits that takes.
"""

from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from typing import Any

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles
from assoc_hull.hull import Hull
from assoc_hull.io.iges.write import iges_text
from assoc_hull.io.importing.import_hull import ImportReport, import_hull
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.lines.line_points import lines_as_points
from assoc_hull.model.tables import HullState
from assoc_hull.shipped.series60 import todd_table
from tests import meshes

LENGTH = 100.0
UNITS = {"m": 1.0, "mm": 1e-3, "ft": 0.3048, "in": 0.0254}
FAMILIES = ("boundary", "sections", "waterlines", "buttocks")


@attrs.frozen(eq=False)
class ScaledHull:
    """A hull of 100 m whose file can be written at any scale.

    Attributes
    ----------
    ending : str
        Of its file.
    write : callable
        Writes to a path with coordinates, m at 100 m, times a factor; in a unit.
    draught, breadth : float, m
        At 100 m.
    cuts : dict
        Numbers of planes, where a file is cut; none else.
    """

    ending: str
    write: Callable[[Path, float, str], None]
    draught: float
    breadth: float
    cuts: dict[str, Any] = attrs.field(factory=dict)

    def read(
        self, folder: Path, scale: float = 1.0, unit: str = "m"
    ) -> tuple[HullState, ImportReport]:
        """Write the file of the hull at a scale (part of 100 m) in a unit, and import it."""
        path = folder / f"hull{self.ending}"
        self.write(path, scale / UNITS[unit], unit)
        wanted = ImportOptions(
            length=scale * LENGTH, draught=scale * self.draught, breadth=scale * self.breadth,
            unit=unit, accept=True, **self.cuts,
        )  # fmt: skip
        return import_hull(path, wanted)


def _lines_text(lines: Iterable[tuple[str, int, FloatArray]], factor: float) -> str:
    rows = ["line,piece,x,y,z"]
    for name, piece, points in lines:
        rows += [f"{name},{piece},{x!r},{y!r},{z!r}" for x, y, z in (factor * points).tolist()]
    return "\n".join(rows) + "\n"


def digitised(hull: Hull, chord: float = 2e-3) -> ScaledHull:
    """The lines of a net as digitised points."""
    ship = hull.state.particulars
    grown = LENGTH / ship.length
    lines = [
        (line.name, number, np.round(grown * piece.points, 6))
        for line in lines_as_points(hull.state, FAMILIES, chord)
        for number, piece in enumerate(line.pieces)
    ]

    def write(path: Path, factor: float, _: str) -> None:
        path.write_text(_lines_text(lines, factor), encoding="utf-8")

    return ScaledHull(".csv", write, grown * ship.draught, grown * ship.breadth)


def series60_table(block: float) -> ScaledHull:
    """The published offsets of a parent of Series 60, as a table."""
    table = todd_table(block)[0]
    grown = LENGTH / table.length
    x, z = np.round(grown * table.x, 6), np.round(grown * table.z, 6)
    y = np.round(grown * table.half_breadth, 6)
    assert table.draught is not None

    def write(path: Path, factor: float, _: str) -> None:
        head = ",".join(["x", *(f"wl_{value!r}" for value in (factor * z).tolist())])
        rows = [
            ",".join([repr(at), *("" if np.isnan(b) else repr(b) for b in values)])
            for at, values in zip((factor * x).tolist(), (factor * y).tolist(), strict=True)
        ]
        path.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")

    return ScaledHull(".csv", write, grown * table.draught, 2.0 * float(np.nanmax(y)))


def meshed(mesh: Triangles, draught: float, breadth: float, cuts: dict[str, int]) -> ScaledHull:
    """A mesh, as OBJ."""
    xyz = np.round(mesh.xyz, 6)
    faces = [f"f {i} {j} {k}" for i, j, k in (mesh.face + 1).tolist()]

    def write(path: Path, factor: float, _: str) -> None:
        rows = [f"v {x!r} {y!r} {z!r}" for x, y, z in (factor * xyz).tolist()]
        path.write_text("\n".join([*rows, *faces]) + "\n", encoding="utf-8")

    return ScaledHull(".obj", write, draught, breadth, cuts)


def yacht_mesh() -> Triangles:
    """A yacht of 100 m by formula: flared sections of a deep vee, a raked stem, no flat at all."""
    u, v = np.meshgrid(np.linspace(0.0, 1.0, 161), np.linspace(0.0, 1.0, 61), indexing="ij")
    z = 14.0 * v
    x = LENGTH * u + 4.0 * u * v
    y = 12.0 * (1.0 - (2.0 * u - 0.9) ** 2 / 1.21) * v**0.6 * (1.0 - u**6)
    return grid_triangles(np.stack([x, np.maximum(y, 0.0), z], axis=2))


def surfaces() -> ScaledHull:
    """The Wigley hull as one surface, as IGES."""
    z, breadth = np.array([0.0, 3.125, 6.25]), np.array([0.0, 10.0, 10.0])
    rows = ((0.0, 0.0), (50.0, 1.0), (LENGTH, 0.0))
    net = np.array([np.column_stack([np.full(3, x), part * breadth, z]) for x, part in rows])

    def write(path: Path, factor: float, unit: str) -> None:
        # The writer takes metres and the unit that the file is to declare.
        metres = factor * UNITS[unit] * net
        text = iges_text([SplineSurface.bezier(metres, "hull")], unit)
        path.write_text(text, encoding="ascii")

    return ScaledHull(".igs", write, 6.25, 10.0, {"stations": 9, "waterlines": 4, "buttocks": 2})


@cache
def scaled_hull(name: str) -> ScaledHull:
    """One of the hulls, by name."""
    cuts = {"stations": 9, "waterlines": 5, "buttocks": 3}
    makers: dict[str, Callable[[], ScaledHull]] = {
        "Wigley, mesh": lambda: meshed(meshes.wigley_half(161, 41), 5.0, 10.0, cuts),
        "Series 60 .60, table": lambda: series60_table(0.60),
        "Series 60 .70, lines": lambda: digitised(ah.examples.series60(0.70)),
        "container ship, lines": lambda: digitised(ah.examples.container_ship_225m()),
        "carrier, lines": lambda: digitised(ah.examples.bulk_carrier_207k(), 5e-3),
        "yacht, mesh": lambda: meshed(yacht_mesh(), 6.0, 24.0, cuts),
        "Wigley, surface": surfaces,
    }
    return makers[name]()
