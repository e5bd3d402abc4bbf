"""Files of lines that this package wrote: the hull comes back as it was, its points included."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import attrs

from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, adopt
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.patches.spline_curve import SplineCurve
from assoc_hull.graph.journal import Journal
from assoc_hull.io.dxf.entities import DrawingEntity, drawing_entities, drawing_unit, drawn_spline
from assoc_hull.io.dxf.lines import IN_SPACE, NAMES
from assoc_hull.io.iges.curves import own_iges_lines
from assoc_hull.io.iges.file import looks_like_iges
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.lines.own_lines import BETWEEN, MARK, OwnLines, TextedCurve, own_lines
from assoc_hull.io.reports import Note, OffsetReport
from assoc_hull.io.rhino.read import is_rhino, own_rhino_lines
from assoc_hull.io.units import METRES
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import HullState, Particulars

__all__ = ["own_dxf_lines", "read_own_file"]

# --------------------------------------------------------------------------------------
# A drawing of ours read as what it was: splines, and what its record tells of each by number.

_DRAWN = (
    "SPLINE", "LINE", "POLYLINE", "LWPOLYLINE", "ARC", "CIRCLE", "ELLIPSE", "HELIX", "MLINE",
    "INSERT",
)  # fmt: skip


def own_dxf_lines(text: str, source: str) -> OwnLines | None:
    """Give the lines of a drawing of ours in space; None if it is none.

    Raises
    ------
    BadInputError
        A group code or a spline that is none.
    """
    if NAMES not in text or IN_SPACE not in text:
        return None
    entities = drawing_entities(text, source)
    records = [told for each in entities if (told := _record(each))]
    if not records:
        return None
    if len(records) > 1:
        return OwnLines(fault=f"it has {len(records)} texts of a hull")
    unit = drawing_unit(entities)
    if unit is None:
        return OwnLines(fault="its header tells no unit any more")
    hull, *texts = records[0].split(BETWEEN)
    left = {str(number): told for number, told in enumerate(texts)}
    curves, others = list[TextedCurve](), list[str]()
    for entity in entities:
        # A copy of a curve has the number of the curve, whose text is taken already.
        told = left.pop(_number(entity), "") if entity.kind == "SPLINE" else ""
        if told and entity.number(73):
            curves.append(TextedCurve(told, _spline(entity, METRES[unit])))
        elif entity.kind in _DRAWN:
            others.append(f"{entity.kind} at {entity.where}")
    return attrs.evolve(own_lines(hull, curves, others), unit=unit)


def _record(entity: DrawingEntity) -> str:
    """Give the text of a record of ours, empty if it is another's."""
    words = [value for code, value, _ in entity.codes if code == 1]
    return "".join(words[1:]) if entity.kind == "XRECORD" and words[:1] == [NAMES] else ""


def _number(entity: DrawingEntity) -> str:
    """Give the number of a curve in space, empty if it has none."""
    ours = entity.extended(NAMES)
    words = [] if ours is None else [value for code, value, _ in ours.codes if code == 1000]
    return words[3] if words[2:3] == [IN_SPACE] and len(words) == 4 else ""


def _spline(entity: DrawingEntity, metres: float) -> SplineCurve:
    """Give a spline in m."""
    raw = drawn_spline(entity)
    points = raw.control[:, :3] * metres if metres != 1.0 else raw.control[:, :3].copy()
    weights = raw.control[:, 3].copy() if raw.control.shape[1] > 3 else None
    return SplineCurve(entity.where, raw.degree, raw.knots, points, weights)


_MOST_BYTES = 200_000_000
_OFF = 1e-3
"""A particular that is given, and is off that of the file by more than this part, is suspicious."""

_SIZES = ("length", "breadth", "depth", "draught")
_TAKEN = (*_SIZES, "deck", "accept", "strict")
"""Options that change no place of a line."""


@attrs.frozen(eq=False)
class OwnHull:
    """A hull from a file of ours; without a hull, `why` tells that it is read as any other."""

    state: HullState | None
    adoption: AdoptionReport | None
    why: str = ""
    suspicions: tuple[Note, ...] = ()

    @property
    def notes(self) -> OffsetReport:
        """Tell that nothing had to be assumed."""
        what = "lines that assoc-hull wrote: points, kinds and particulars are taken as they stand"
        return OffsetReport((Note("own file", "the file", what),), (), self.suspicions)

    def added_to(self, notes: OffsetReport) -> OffsetReport:
        """Add to the notes on a file why it is not read as ours."""
        what = f"assoc-hull wrote it; {self.why}: its curves are read as digitised lines"
        note = Note("own file", "the file", what)
        return attrs.evolve(notes, assumptions=(note, *notes.assumptions))


def read_own_file(path: Path, options: ImportOptions) -> OwnHull | None:
    """Give the hull of a file of ours, which is told by a mark in it; None if it has none."""
    lines = _lines(path)
    if lines is None:
        return None
    taken = (*_TAKEN, *(["unit"] if options.unit == lines.unit else []))
    other = [name for name in options.given() if name not in taken]
    if other:
        return OwnHull(None, None, f"{', '.join(other)} was given")
    if lines.fault:
        return OwnHull(None, None, f"another program has changed it: {lines.fault}")
    return _adopted(lines, options)


def _lines(path: Path) -> OwnLines | None:
    """Read the lines of a file of ours, None if it is none, or damaged: then its reader says so."""
    if not path.is_file() or path.stat().st_size > _MOST_BYTES:
        return None
    if is_rhino(path):
        return own_rhino_lines(path)
    data = path.read_bytes()
    if MARK.encode() not in data:
        return None
    text = data.decode("utf-8", "replace")
    reader = own_iges_lines if looks_like_iges(text) else own_dxf_lines
    try:
        return reader(text, path.name)
    except AssocHullError:
        return None


def _adopted(lines: OwnLines, options: ImportOptions) -> OwnHull:
    """Make the net again, and look whether any curve has moved."""
    assert lines.particulars is not None
    ship = attrs.evolve(lines.particulars, **options.named(*_SIZES, "deck"))
    try:
        state, report = adopt(lines.sources, ship, lines.associations, lines.tolerances)
    except AssocHullError as error:
        return OwnHull(None, None, f"no net could be made of its lines as they are: {error}")
    adoption = attrs.evolve(report, notes=(*report.notes, *_features(state, lines)))
    return OwnHull(state, adoption, suspicions=tuple(_contradictions(lines.particulars, ship)))


def _contradictions(told: Particulars, taken: Particulars) -> Iterator[Note]:
    """Tell of particulars that were given and are not those of the file."""
    for name in _SIZES:
        said, given = float(getattr(told, name)), float(getattr(taken, name))
        if abs(given - said) > _OFF * said:
            yield Note(
                name, "the options", f"{given:g} m, as given; the file says {said:g} m", given
            )


def _features(state: HullState, lines: OwnLines) -> list[str]:
    """Keep the features that the hull had, of those that its points show; tell which are gone."""
    wanted = set(lines.features)
    Maker(state, Journal()).features(
        each for each in state.features if (each.kind, each.name) in wanted
    )
    gone = sorted(wanted - {(each.kind, each.name) for each in state.features})
    return [f"the feature {name!r} ({kind}) was not found again" for kind, name in gone]
