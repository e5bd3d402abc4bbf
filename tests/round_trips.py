"""Hulls exported and read back, a row a hull and form: `python -m tests.round_trips`.

Of forms that hold splines (DXF, IGES, 3DM) the farthest place of a curve, inflections that it has
more, and whether flats, features and particulars are the same. Of tables and sections how far the
farthest given point comes back from where it was, and half of the last printed digit. Of STEP and
STL, and of the surface that 3DM holds beside the lines, how far the lines lie off what was written,
and what the export told of that. Of all: what
volume and LCB the hull has that is read with its length, draught and deck, the verdict, and what
the export said that the form cannot hold.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import attrs
import numpy as np
from scipy.spatial import cKDTree

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, NotSoundError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.io.cad.write import CadReport
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.export.sections import sections_to_export
from assoc_hull.io.lines.line_points import LinePolylines, lines_as_points
from assoc_hull.io.mesh.read import read_triangles
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.reports import ExportBook
from assoc_hull.io.slicing.surface_lines import faces_of_file
from tests.own_files import compared, facts

TABLES = ("csv", "xlsx")
SECTIONS = ("britfair", "gf", "delftship")
POINTS = (*TABLES, *SECTIONS, "delftship-offsets")
SPLINES = {"dxf": ".dxf", "iges-lines": ".igs", "3dm": ".3dm"}
SOLIDS = {"step": ".step", "stl": ".stl", "3dm-surface": ".3dm"}
FORMS = (*SPLINES, *POINTS, *SOLIDS)


def yacht() -> Hull:
    """Sysser 1, from its table."""
    data = Path(os.environ.get("ASSOC_HULL_DATA", Path(__file__).parents[2] / "shared" / "data"))
    return ah.read(data / "sysser1" / "sysser01_offsets.csv", length=10.0474)


HULLS: dict[str, Callable[[], Hull]] = {
    "wigley": ah.examples.wigley,
    "series60": ah.examples.series60,
    "series60_60": lambda: ah.examples.series60(0.60),
    "yacht": yacht,
    "container_ship_225m": ah.examples.container_ship_225m,
    "bulk_carrier_180m": ah.examples.bulk_carrier_180m,
    "bulk_carrier_207k": ah.examples.bulk_carrier_207k,
    "plain_ship": ah.examples.plain_ship,
    "seaking_ship": ah.examples.seaking_ship,
    "sfolds_ship": ah.examples.sfolds_ship,
    "prelikon_ship": ah.examples.prelikon_ship,
}


@attrs.frozen
class RoundTrip:
    """One hull through one form.

    Attributes
    ----------
    hull, form : str
        Which.
    points : int
        How many were written: of lines points, of surfaces faces, of a mesh triangles.
    farthest, limit : float, m
        How far the lines come back off where they were, and what the export allows for.
    same : str
        Of splines: new inflections, and what differs besides; else nothing.
    told : tuple of str
        What the export said that the form cannot hold.
    volume, lcb : float
        Off by so large a part: of the volume, of Lpp.
    verdict : str
        Of the import, or the refusal.
    """

    hull: str
    form: str
    points: int
    farthest: float
    limit: float
    same: str
    told: tuple[str, ...]
    volume: float
    lcb: float
    verdict: str

    def __str__(self) -> str:
        return (
            f"| {self.hull} | {self.form} | {self.points} | {1e3 * self.farthest:.2g} of "
            f"{1e3 * self.limit:.2g} | {self.same} | {100.0 * self.volume:+.3f}, "
            f"{100.0 * self.lcb:+.3f} | {self.verdict} | {', '.join(self.told) or 'nothing'} |"
        )


HEAD = (
    "| hull | form | points | off, of what is allowed, mm | splines | V, LCB, % | verdict | told |",
    "|---|---|---|---|---|---|---|---|",
)

_EXACT = 1e-9
"""Splines come back within this, m."""


def round_trip(name: str, hull: Hull, form: str, folder: Path, **cuts: Any) -> RoundTrip:
    """Export, measure what is in the file, and read the hull as a user does, with other cuts."""
    endings = {**{each: f".{each}" for each in TABLES}, **SPLINES, **SOLIDS}
    path = folder / f"{name}{endings.get(form, '.txt')}"
    try:
        report: Any = (
            _written_surface(hull, path) if form == "3dm-surface" else hull.export(path, form)
        )
    except AssocHullError as error:
        nan = float("nan")
        return RoundTrip(name, form, 0, nan, nan, "", (), nan, nan, f"not written: {error}")
    told = _told(report)
    back: Hull | None = None
    try:
        back = _read(hull, path, form, **cuts)
    except NotSoundError as error:
        first = error.findings[0].partition("; ")[0]
        verdict = f"refused, measured all the same: {len(error.findings)} of: {first}"[:200]
        back = _read(hull, path, form, accept=True, **cuts)
    except AssocHullError as error:
        verdict = f"refused: {error}".partition(": give")[0][:200]
    else:
        notes = () if back.adoption is None else back.adoption.notes
        verdict = ", ".join(n.removeprefix("verdict: ") for n in notes if n.startswith("verdict"))
    same = ""
    if form in SPLINES and back is not None:
        found = compared(hull, back)
        farthest, limit, same = found.away, _EXACT, _same(hull, back, found.inflections)
        count = report.points
    elif form in SOLIDS:
        farthest, limit, count = solid_off(hull, path), *_allowed(report, hull)
    else:
        far = table_off(hull, path) if form in TABLES else lines_off(hull, form, path)
        farthest, limit, count = far, report.rounding, report.points
    volume, lcb = _numbers_off(hull, back)
    return RoundTrip(name, form, count, farthest, limit, same, told, volume, lcb, verdict)


def _written_surface(hull: Hull, path: Path) -> CadReport:
    """Write a file of Rhino with the surface, and nothing of the lines that it was fitted to."""
    import rhino3dm

    # What a surface is written for, and what is told of it, is one in all forms.
    report = hull.export(path.with_suffix(".step"))
    assert isinstance(report, CadReport)
    hull.export(path, "3dm")
    model = rhino3dm.File3dm.Read(str(path))
    for each in list(model.Objects):
        if model.Layers[each.Attributes.LayerIndex].Name != "surface":
            model.Objects.Delete(each.Attributes.Id)
    for i in reversed(range(len(model.Strings))):
        model.Strings.Delete(model.Strings[i][0])
    model.Write(str(path), 7)
    return report


def _told(report: Any) -> tuple[str, ...]:
    notes = (*report.left_out, *report.mended) if hasattr(report, "mended") else ()
    return tuple(sorted({note.kind for note in notes}))


def _read(hull: Hull, path: Path, form: str, *, accept: bool = False, **cuts: Any) -> Hull:
    ship = hull.particulars
    options: dict[str, Any] = {"length": ship.length, "draught": ship.draught, "deck": ship.deck}
    if form in SPLINES:
        options = {}
    elif form in TABLES:
        options = {"deck": ship.deck}
    elif form not in SOLIDS:
        options["ap"] = "0 m"
    return ah.read(path, accept=accept, **options, **cuts)


def _same(hull: Hull, back: Hull, inflections: int) -> str:
    """Say how many inflections are new, and which facts besides the curves are others."""
    known, found = facts(hull), facts(back)
    others = [name for name in known if known[name] != found[name]]
    return f"{inflections} new inflections, {', '.join(others) or 'all else'} " + (
        "differ" if others else "the same"
    )


def _allowed(report: Any, hull: Hull) -> tuple[float, int]:
    """Give what an export of a surface or mesh said of its distance from the lines, and its size.

    Triangles leave lines by their chords.
    """
    if hasattr(report, "chord"):
        return float(report.chord), int(report.triangles)
    return float(report.residual) + _DEFLECTION * hull.particulars.length, int(report.faces)


def _numbers_off(hull: Hull, back: Hull | None) -> tuple[float, float]:
    if back is None:
        return float("nan"), float("nan")
    true, found = (each.hydrostatics(on_error="report") for each in (hull, back))
    return found.volume / true.volume - 1.0, (found.lcb - true.lcb) / hull.particulars.length


_NEAREST = 16
"""So many triangles are looked at for the nearest to a point."""


_DEFLECTION = 1e-5
"""Surfaces are measured on facets that lie within this part of Lpp of them."""


def solid_off(hull: Hull, path: Path) -> float:
    """Give how far the farthest point of a section, waterline or buttock is off a solid, m."""
    corner = _corners(path, hull.particulars.length)
    lines = lines_as_points(hull.state, ("sections", "waterlines", "buttocks"), 0.05)
    points = np.concatenate([piece.points for line in lines for piece in line.pieces])
    centre = corner.mean(axis=1)
    reach = np.sqrt(((corner - centre[:, None]) ** 2).sum(axis=2)).max()
    tree = cKDTree(centre)
    away, near = (np.asarray(each) for each in tree.query(points, _NEAREST))
    found = np.min([_from_triangles(points, corner[each]) for each in near.T], axis=0)
    # A triangle whose middle is farther than that cannot be nearer: all others are looked at.
    # Only what could be the farthest of all is looked at with every triangle in reach.
    order = np.argsort(-found)
    most = 0.0
    for i in order.tolist():
        if found[i] <= most:
            break
        if away[i, -1] - reach < found[i]:
            mine = np.array(tree.query_ball_point(points[i], found[i] + reach))
            every = np.repeat(points[i][None], len(mine), axis=0)
            found[i] = _from_triangles(every, corner[mine]).min()
        most = max(most, float(found[i]))
    return most


def _corners(path: Path, length: float) -> FloatArray:
    """Give the triangles (n, 3, 3), m, of a mesh, or of fine facets of surfaces."""
    if path.suffix == ".stl":
        mesh = read_triangles(path)
        corner: FloatArray = mesh.xyz[mesh.face]
        return corner
    found = faces_of_file(path).facets(_DEFLECTION * length, 0.02 * length).mesh
    return np.asarray(found.xyz[found.face])


def _from_triangles(points: FloatArray, corner: FloatArray) -> FloatArray:
    """Give the distance (n,), m, of each point from its triangle, corners (n, 3, 3)."""
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    size = np.sqrt((normal * normal).sum(axis=1))
    unit = normal / np.maximum(size, 1e-300)[:, None]
    height = ((points - corner[:, 0]) * unit).sum(axis=1)
    foot = points - height[:, None] * unit
    inside = size > 0.0
    sides = []
    for i in range(3):
        start, step = corner[:, i], corner[:, (i + 1) % 3] - corner[:, i]
        inside &= (np.cross(step, foot - start) * unit).sum(axis=1) >= 0.0
        part = ((points - start) * step).sum(axis=1) / np.maximum((step * step).sum(axis=1), 1e-300)
        gap = points - start - np.clip(part, 0.0, 1.0)[:, None] * step
        sides.append(np.sqrt((gap * gap).sum(axis=1)))
    return np.asarray(np.where(inside, np.abs(height), np.min(sides, axis=0)))


def table_off(hull: Hull, path: Path) -> float:
    """Give how far the farthest half-breadth of a table is off the section of the hull, m."""
    table = read_offsets(path)[0]
    worst = 0.0
    for line in hull.groups["sections"].lines.values():
        i = int(np.abs(table.x - (line.position or 0.0)).argmin())
        for j, z in enumerate(table.z.tolist()):
            met = line.meet(((0.0, 0.0, 1.0), z))
            if len(met) and np.isfinite(table.half_breadth[i, j]):
                worst = max(worst, abs(float(met[:, 1].max()) - float(table.half_breadth[i, j])))
    return worst


def lines_off(hull: Hull, form: str, path: Path) -> float:
    """Give how far the farthest point of a line is off where it was written from, m."""
    found = read_lines(path)
    worst = 0.0
    for line in written(hull, form):
        [same] = [o for o in found.group(line.group) if abs(o.offset - line.offset) < 1e-3]
        for one, other in zip(line.pieces, same.pieces, strict=True):
            worst = max(worst, float(np.abs(one.points - other.points).max()))
    return worst


def written(hull: Hull, form: str) -> list[LinePolylines]:
    """The lines that a form holds, as points before rounding."""
    if form in SECTIONS:
        return sections_to_export(hull.state, ExportBook(decimals=9))
    return lines_as_points(hull.state, ("sections", "waterlines", "buttocks"))


def round_trips(names: Iterable[str], forms: Sequence[str]) -> Iterator[RoundTrip]:
    """All of them, one by one."""
    with TemporaryDirectory() as folder:
        for name in names:
            hull = HULLS[name]()
            for form in forms:
                yield round_trip(name, hull, form, Path(folder))


def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line; 1 if lines come back farther off than their form allows."""
    parser = argparse.ArgumentParser(prog="python -m tests.round_trips", description=__doc__)
    known = (*HULLS, *FORMS)
    parser.add_argument("--only", nargs="*", choices=known, default=[], help="hulls and forms")
    only = parser.parse_args(arguments).only
    names = [each for each in HULLS if each in only] or list(HULLS)
    forms = [each for each in FORMS if each in only] or list(FORMS)
    off = 0
    print(*HEAD, sep="\n")
    for each in round_trips(names, forms):
        print(each, flush=True)
        # A surface that is not sound is not written, which is no loss on the way.
        off += bool(each.points) and not each.farthest <= each.limit * (1.0 + 1e-6)
    return 1 if off else 0


if __name__ == "__main__":
    sys.exit(main())
