"""Untrimmed spline surfaces of an IGES file, moved to where they belong, in metres.

Source: IGES 5.3 (US PRO, 1996), section 4.24 (entity 128).

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.iges.read import surfaces_of_iges
>>> from assoc_hull.io.iges.write import iges_text
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> found, unit, notes = surfaces_of_iges(iges_text([plate], "mm"), "plate.igs")
>>> found[0].name, found[0].net[1, 1].tolist(), unit
('plate', [2.0, 1.0, 0.0], 'mm')
"""

from __future__ import annotations

from collections import Counter
from itertools import chain

from assoc_hull.errors import BadInputError, NeedsCadError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.iges.file import IgesFile
from assoc_hull.io.iges.names import name_property, readable, scale_note, unit_of
from assoc_hull.io.iges.spline import SurfaceData, spline_surface
from assoc_hull.io.iges.surface_entities import Part, left_out, parts_of
from assoc_hull.io.iges.transform import NOTHING, Motion, motion_of
from assoc_hull.io.iges.trim import borders_of_face, is_box, parameter_curves

__all__ = ["surfaces_of_iges"]

Found = tuple[list[SplineSurface], str, tuple[str, ...]]


def surfaces_of_iges(text: str, source: str, unit: str | None = None) -> Found:
    """Read the spline surfaces of an IGES file.

    Parameters
    ----------
    text : str
        The file.
    source : str
        Its name, for messages.
    unit : str or None
        The unit of its lengths; None: as the file says.

    Returns
    -------
    surfaces : list of SplineSurface
        In the order of the file; m.
    unit : str
        The unit of the file.
    notes : tuple of str
        What was left out or done.

    Raises
    ------
    BadInputError
        The file is damaged, tells no unit, holds no spline surface or surfaces of other kinds, or
        a surface is trimmed.
    """
    file = IgesFile.of_text(text, source)
    name, metres, notes = unit_of(file, unit)
    parts = parts_of(file)
    shown = [part for part in parts if not part.hidden]
    if not shown:
        raise _nothing(file, parts)
    records = [file.record(part.surface) for part in shown]
    data = [spline_surface(record) for record in records]
    for part, each in zip(shown, data, strict=True):
        _require_untrimmed(file, part, each)
    motions = [_motion(file, part) for part in shown]
    properties = [
        name_property(file, record, each.after) for record, each in zip(records, data, strict=True)
    ]
    names = _names(file, shown, properties)
    found = [
        _surface(each, motion, metres, called)
        for each, motion, called in zip(data, motions, names, strict=True)
    ]
    more = (*scale_note(file), *left_out(file, parts), *_of_motions(file, shown, motions))
    return found, name, (*notes, *more)


def _nothing(file: IgesFile, parts: list[Part]) -> BadInputError:
    """Give the error for a file without surfaces to see."""
    notes = " ".join(left_out(file, parts))
    what = "there is no spline surface (128)" if not parts else "all surfaces are blanked"
    return BadInputError(what, f"in {file.source}", f"export the surfaces. {notes}".strip())


def _require_untrimmed(file: IgesFile, part: Part, data: SurfaceData) -> None:
    """Refuse a face that is not all of its surface."""
    borders = borders_of_face(file, part.face) if part.face else None
    if borders is None:
        return
    entry = file.entries[part.face]
    curves = list(chain.from_iterable(borders))
    if not all(curves):
        what = "its border is not given in the parameters of the surface"
    elif len(borders) > 1:
        what = f"it has {len(borders) - 1} holes"
    else:
        found = [parameter_curves(file, each) for each in curves]
        if all(found) and is_box(list(chain.from_iterable(found)), data.spans, data.points):
            return
        what = "its border is not that of the whole surface"
    raise NeedsCadError(
        f"this surface is trimmed: {what}", file.where(entry),
        "export the surface untrimmed; hulls of trimmed ones are read with the extra 'cad'",
    )  # fmt: skip


def _motion(file: IgesFile, part: Part) -> Motion:
    """Give where a surface goes, moved by itself and with what it is a part of."""
    found = NOTHING
    for number in part.chain:
        found = found.then(motion_of(file, file.entries[number].transformation))
        if not file.entries[number].dependent:
            break
    return found


def _of_motions(file: IgesFile, parts: list[Part], motions: list[Motion]) -> tuple[str, ...]:
    return tuple(
        f"{file.source}: the transformation of D{part.surface} stretches by up to "
        f"{100.0 * motion.stretch:.3g} %, where only turns are usual."
        for part, motion in zip(parts, motions, strict=True)
        if motion.stretch
    )


def _surface(data: SurfaceData, motion: Motion, metres: float, name: str) -> SplineSurface:
    net = motion.of(data.net)
    if metres != 1.0:
        net = net * metres
    found = SplineSurface(name, data.degrees, *data.knots, net, data.weights)
    return found if found.domain == data.spans else found.restricted(*data.spans)


def _names(file: IgesFile, parts: list[Part], properties: list[str]) -> list[str]:
    """Give each surface its name in the file, or a number; none comes twice."""
    found: dict[str, None] = {}
    count: Counter[str] = Counter()
    for place, (part, owned) in enumerate(zip(parts, properties, strict=True), start=1):
        labels = [file.entries[number].label for number in reversed(part.chain[:2])]
        told = (readable(word) for word in (owned, *labels))
        first = name = next((word for word in told if word), f"surface {place}")
        while name in found:
            count[first] += 1
            name = f"{first} ({count[first] + 1})"
        found[name] = None
    return list(found)
