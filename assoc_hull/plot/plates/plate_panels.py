"""Plates side by side in a part of a sheet, each with its views, name, shares and roll axis."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import all_of, choice
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.plates.paint_tiles import colours, draw_signs, paint_plate
from assoc_hull.plot.plates.plate_layout import (
    PlateCell,
    PlatePlacement,
    PlateSight,
    SheetArea,
    lay_plates,
    plate_frame,
    relief_of,
    upright,
)
from assoc_hull.plot.plates.plate_picture import PlateEntry, PlateScene
from assoc_hull.plot.sheet.labels import LabelledLine, label_lines, wrap_words
from assoc_hull.plot.sheet.paper import MARGIN, Pen, View
from assoc_hull.plot.sheet.sheet_figure import Sheet
from assoc_hull.plot.sheet.title_block import scale_bar

__all__ = ["VIEWS", "PlateLook", "draw_plates", "field_beside", "regions", "views_of"]

VIEWS = ("plan", "space", "parameters")

PlateLook = Callable[[PlateEntry], tuple[PlateScene, FloatArray]]
"""Gives the tiles that a plate is drawn with, and the colours (k, 3) they have."""

_AXIS = Pen(0.3, "0.1", (6.0, 1.0, 0.8, 1.0), 2.8)
_WORD = 3.0  # mm at A3, a line of words


def regions(entry: PlateEntry) -> tuple[PlateScene, FloatArray]:
    """Draw a plate by its regions."""
    return entry.scene, colours(entry.scene.tint)


def views_of(views: object, where: str) -> list[str]:
    """Take the kinds of views, each once.

    Raises
    ------
    BadInputError, WrongTypeError
        Another word, a word twice, none at all.
    """
    found = [choice(each, "a view", VIEWS, where) for each in all_of(views, str, "views", where)]
    if not found or len(set(found)) < len(found):
        remedy = f"give some of {', '.join(VIEWS)}, each once"
        raise BadInputError(f"views are {', '.join(found) or 'none'}", where, remedy)
    return found


def draw_plates(
    sheet: Sheet,
    entries: Sequence[PlateEntry],
    field: SheetArea,
    views: Sequence[str],
    look: PlateLook,
) -> None:
    """Draw plates as large as they can be, all to one scale.

    Parameters
    ----------
    sheet : Sheet
        Where to draw.
    entries : sequence of Entry
        The plates.
    field : Field
        The part of the sheet.
    views : sequence of str
        What is drawn of each.
    look : Look
        How.
    """
    factor = sheet.paper.factor
    looks = [look(entry) for entry in entries]
    plates = [
        _sights(scene, entry.frame, views) for entry, (scene, _) in zip(entries, looks, strict=True)
    ]
    single = len(entries) == 1 and entries[0].axis is None
    below = 0.0 if single else (3.0 * _WORD + 1.5) * factor
    room = SheetArea(field.left, field.low + 8.0 * factor, field.right, field.top)
    cells = lay_plates(plates, room, factor, below)
    for entry, cell, plate, (_, colour) in zip(entries, cells, plates, looks, strict=True):
        _plate(sheet, cell, plate, entry, colour)
        if not single:
            _below(sheet, cell, entry.words)
    _scale(sheet, field, cells[0].denominator)


def _sights(scene: PlateScene, frame: FloatArray | None, views: Sequence[str]) -> list[PlateSight]:
    """Give the views of a plate, in a frame of its own if there is one."""
    shape = scene.drawn()
    normal, middle = shape.normal, shape.corner.mean(axis=1)
    plan = plate_frame(middle, np.sqrt((normal**2).sum(axis=-1)), normal.sum(axis=0))
    if frame is not None:
        plan = attrs.evolve(plan, frame=frame)
    found = {
        "plan": lambda: PlateSight("plan", shape, plan),
        "space": lambda: PlateSight("space", shape, plan.in_space(relief_of(plan, middle))),
        "parameters": lambda: _over_parameters(scene),
    }
    return [found[view]() for view in views]


def _over_parameters(scene: PlateScene) -> PlateSight:
    """Give a plate over its parameters, about as long and broad as it is."""
    (u0, u1), (v0, v1) = scene.surface.domain
    corner = scene.surface.at([[u0, u0], [u1, u1]], [[v0, v1], [v0, v1]])
    along, across = (np.linalg.norm(np.diff(corner, axis=axis), axis=-1).mean() for axis in (0, 1))
    least = 0.1 * max(along, across, 1e-9)
    size = np.array([max(along, least) / (u1 - u0), max(across, least) / (v1 - v0)])

    def chart(uv: FloatArray) -> FloatArray:
        flat = (uv - (u0, v0)) * size
        return np.concatenate([flat, np.zeros_like(flat[..., :1])], axis=-1)

    shape = scene.drawn(chart)
    return PlateSight("parameters", shape, upright(shape.corner.mean(axis=(0, 1))))


def _plate(
    sheet: Sheet,
    cell: PlateCell,
    plate: Sequence[PlateSight],
    entry: PlateEntry,
    colour: FloatArray,
) -> None:
    """Draw the views of a plate with their captions."""
    for place, sight in zip(cell.places, plate, strict=True):
        name = f"{entry.name}/{sight.kind}"
        paint_plate(sheet, place, sight.shape, colour, name, shaded=sight.kind == "space")
        clear = []
        if entry.axis is not None and sight.kind != "parameters":
            clear = [_axis(sheet, place, sight, entry.axis, name)]
        if entry.scene.tint.shape == sight.shape.tint.shape:
            draw_signs(sheet, place, sight.shape, name, clear)
        _levels(sheet, place, sight, name)
    field, factor = cell.field, sheet.paper.factor
    words = [entry.name] if entry.name else []
    words += [_told(sight, cell.denominator) for sight in plate]
    lines = wrap_words(sheet, " · ".join(words), field.right - field.left, 1.15)[:2]
    for k, line in enumerate(lines):
        top = (field.left, field.top - (1.0 + k * _WORD) * factor)
        sheet.text(top, line, size=1.1, bold=True, across="left", up="top", name="label/plate")


def _told(sight: PlateSight, denominator: float) -> str:
    """Say how a view shows the plate."""
    if sight.kind == "plan":
        return f"plan 1:{denominator:g}"
    if sight.kind == "parameters":
        return "over u, v"
    relief = sight.eye.relief
    return "in space" if relief == 1.0 else f"in space, heights × {relief:g}"


def _axis(
    sheet: Sheet, place: PlatePlacement, sight: PlateSight, direction: FloatArray, name: str
) -> FloatArray:
    """Draw the axis a plate is rolled about through its middle, as far as the plate reaches."""
    from matplotlib.path import Path

    eye, shape = sight.eye, sight.shape
    flat = attrs.evolve(place, eye=attrs.evolve(eye, turn=np.eye(3)))
    ring = Path(flat.on_paper(np.concatenate(shape.edges)))
    reach = float(np.abs((shape.corner - eye.middle) @ direction).max())
    way = np.linspace(-reach, reach, 401)
    inside = ring.contains_points(flat.on_paper(eye.middle + way[:, None] * direction))
    kept = 0.94 * way[inside] if inside.any() else way
    ends = eye.middle + kept[[0, -1], None] * direction
    sheet.line(place.on_paper(ends), _AXIS, f"{name}/axis")
    return place.on_paper(ends)


def _levels(sheet: Sheet, place: PlatePlacement, sight: PlateSight, name: str) -> None:
    """Write the curvature on lines that part no regions."""
    lines = [
        LabelledLine(f"K = {line.level:g}".replace("-", "−"), place.on_paper(line.points))
        for line in sight.shape.lines
        if not line.parting and len(line.points) > 1
    ]
    if lines:
        label_lines(sheet, lines, 0.0, sheet.paper.width, name=f"label/{name}/level")


def _below(sheet: Sheet, cell: PlateCell, words: str) -> None:
    """Write what the regions of a plate take of it."""
    field, factor = cell.field, sheet.paper.factor
    lines = wrap_words(sheet, words, field.right - field.left, 1.0)[:3]
    for k, line in enumerate(lines):
        place = (field.left, field.low + ((3 - k) * _WORD - 0.5) * factor)
        sheet.text(place, line, across="left", up="top", name="label/shares")


def _scale(sheet: Sheet, field: SheetArea, denominator: float) -> None:
    """Draw the scale of the plans; of plates too small for a bar it is written."""
    if not denominator:
        return
    factor, words = sheet.paper.factor, f"plan 1:{denominator:g}"
    view = View("plan", (0, 1), denominator, (0.0, 0.0))
    place = (field.left, field.low + 3.0 * factor)
    if 0.5 * view.unit < field.right - field.left:
        scale_bar(sheet, view, place, 60.0 * factor, words)
    else:
        sheet.text(place, words, across="left", up="bottom", name="label/bar")


def field_beside(sheet: Sheet, block: float) -> SheetArea:
    """Give the part of a sheet left of a block so wide, mm at A3."""
    factor, paper = sheet.paper.factor, sheet.paper
    edge = (MARGIN + 5.0) * factor
    right = paper.width - (MARGIN + block + 5.0) * factor
    return SheetArea(edge, MARGIN * factor + 2.0, right, paper.height - edge + 1.0 * factor)
