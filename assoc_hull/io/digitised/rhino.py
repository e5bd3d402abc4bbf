"""The curves of a file of Rhino as digitised pieces; what else it shows is told by layer.

A curve is a section, waterline or buttock by its name, else by its layer, else by the plane that it
lies in; in the centre plane it is the profile. Profile, deck edge and transom go by name or layer.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.io.lines.raw_lines import RawLines, RawPiece, boundary_name, plane_name
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.reports import Notebook
from assoc_hull.io.rhino.read import RhinoCurve, RhinoModel, read_rhino
from assoc_hull.io.units import METRES

__all__ = ["rhino_lines", "rhino_shows", "tell_left_out"]

_CHORD = 1e-6
"""Points leave curves by this part of the size of all: 0.3 mm on a ship of 300 m."""

_FLAT = 1e-4
"""Curves that leave a plane by more than this part of the size lie in none."""

_PREFIXES = ("ST", "SECTION", "FRAME", "FR", "WL", "WATERLINE", "BTK", "BUTTOCK")
_LAYERS = {
    "sections": "sections", "section": "sections", "stations": "sections", "station": "sections",
    "frames": "sections", "waterlines": "waterlines", "waterline": "waterlines",
    "buttocks": "buttocks", "buttock": "buttocks",
}  # fmt: skip
_EDGES = {
    "profile": "profile", "stem": "profile", "contour": "profile", "centreline": "profile",
    "centerline": "profile", "keel": "profile", "deck edge": "deck edge", "deck": "deck edge",
    "sheer": "deck edge", "sheerline": "deck edge", "transom": "transom",
}  # fmt: skip
_NO_LINE = ("boundary", "diagonals", "diagonal")
"""Layers of curves that are features of lines, which are found anew."""


def rhino_shows(model: RhinoModel, source: str) -> str:
    """Tell what of a file is the hull: "surfaces", or "lines".

    Raises
    ------
    BadInputError
        It shows neither.
    """
    # In a file of ours that was changed the lines are what the surface was made of.
    if (model.surfaces or model.trimmed) and not model.text:
        return "surfaces"
    if model.curves:
        return "lines"
    held = f"{len(model.meshes)} meshes" if model.meshes else "nothing"
    remedy = "save it as STL" if model.meshes else "show the layers of the hull and save it again"
    raise BadInputError(f"it shows no curve and no surface, and {held}", f"in {source}", remedy)


def rhino_lines(path: Path, book: Notebook) -> RawLines:
    """Read the curves that lie in planes, and boundary curves.

    Raises
    ------
    BadInputError
        The file is damaged, or holds no such curve.
    MissingExtraError
        rhino3dm is not installed.
    """
    model = read_rhino(path)
    every = [curve.spline.points for curve in model.curves]
    if not every:
        raise BadInputError("there is no curve", f"in {path.name}", "show them and save it again")
    size = float(np.ptp(np.concatenate(every), axis=0).max())
    metres = METRES.get(model.unit or "", 1.0)
    pieces: list[RawPiece] = []
    others: Counter[str] = Counter()
    for curve in model.curves:
        name = _line_name(curve, size, metres)
        if name is None:
            others[curve.layer] += 1
            continue
        where = f"the curve {curve.spline.name!r} on the layer {curve.layer!r} of {path.name}"
        points = curve.spline.polyline(_CHORD * size)
        pieces.append(RawPiece(name, points, where, curve.spline.knuckles()))
    for layer, count in others.items():
        what = f"{count} curves lie in no plane of a section, waterline or buttock: left out"
        book.suspect("curve", f"the layer {layer!r}", what, count)
    tell_left_out(model, book, surfaces=len(model.surfaces) + len(model.trimmed))
    if not pieces:
        what = f"none of {len(every)} curves is a section, waterline, buttock or boundary curve"
        raise BadInputError(what, f"in {path.name}", "name them ST, WL, BTK, profile or deck edge")
    return RawLines(pieces, model.unit)


def tell_left_out(model: RhinoModel, book: Notebook, *, curves: int = 0, surfaces: int = 0) -> None:
    """Tell what is not read, by layer."""
    for layer, kind, count in model.left:
        book.assume("left out", f"the layer {layer!r}", f"{count} objects: {kind}", count)
    rest = {"curves": curves, "surfaces": surfaces, "meshes": len(model.meshes)}
    for kind, count in rest.items():
        if count:
            book.assume("left out", "the file", f"{count} {kind}", count)


def _line_name(curve: RhinoCurve, size: float, metres: float) -> str | None:
    """Give the name of the line of a curve, None if it is none."""
    name = curve.spline.name.strip()
    leaf = curve.layer.rpartition("::")[2].strip().lower()
    edge = _EDGES.get(name.lower()) or boundary_name(name) or _EDGES.get(leaf)
    if edge is not None:
        return edge
    word = name.split()[0].upper() if name else ""
    if word in _PREFIXES:
        return name
    if leaf in _NO_LINE:
        return None
    spread = np.ptp(curve.spline.points, axis=0)
    flat = [group for group, axis in AXES.items() if spread[axis] <= _FLAT * size]
    told = _LAYERS.get(leaf)
    group = told if told in flat else flat[0] if len(flat) == 1 else None
    if group is None:
        return None
    offset = float(np.median(curve.spline.points[:, AXES[group]])) * metres
    centred = group == "buttocks" and abs(offset) <= _FLAT * size * metres
    return "profile" if centred else plane_name(group, offset)
