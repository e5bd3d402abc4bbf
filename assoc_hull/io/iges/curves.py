"""Curves of an IGES file: splines (126), lines (110), polylines (106) and chains of them (102).

Source: IGES 5.3 (US PRO, 1996), sections 4.4, 4.6, 4.13 and 4.23.

Examples
--------
>>> from assoc_hull.io.iges.curves import curves_of_iges
>>> from assoc_hull.io.iges.write import IgesLayout
>>> layout = IgesLayout()
>>> layout.add_named(110, "0. 2. 1. 9. 0. 1.".split(), "WL 1")
>>> (found,), unit, notes = curves_of_iges(layout.text("A line", "mm", 9.0), "lines.igs")
>>> found.name, found.points.tolist(), unit, notes
('WL 1', [[0.0, 0.002, 0.001], [0.009, 0.0, 0.001]], 'mm', ())
"""

from __future__ import annotations

from collections import Counter

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.knots import checked_knots
from assoc_hull.geometry.patches.spline_curve import SplineCurve
from assoc_hull.io.iges.entities import (
    name_property,
    property_pointers,
    readable_name,
    scale_note,
    spline_curve,
    transformation_of,
    unit_of,
)
from assoc_hull.io.iges.file import DirectoryEntry, IgesFile, IgesRecord
from assoc_hull.io.iges.surfaces import KINDS, SILENT
from assoc_hull.io.lines.own_lines import IMAGE, MARK, OwnLines, TextedCurve, own_lines

__all__ = ["curves_of_iges", "holds_surfaces", "own_iges_lines"]

Found = tuple[list[SplineCurve], str, tuple[str, ...]]

_POLYLINES = (1, 2, 11, 12, 63)
_READ = (106, 110, 126)
_CHAIN = 102
_SURFACES = frozenset({114, 118, 120, 122, 128, 140, 143, 144, 186, 190, 510, 514})
_MOST, _FARTHEST = 100_000, 1e6
"""Points of a curve; how far off they may lie, m."""


def holds_surfaces(text: str) -> bool:
    """Tell whether a file has surfaces, by its directory alone.

    Parameters
    ----------
    text : str
        An IGES file.

    Examples
    --------
    >>> from assoc_hull.io.iges.curves import holds_surfaces
    >>> holds_surfaces(f"{126:8d}{1:8d}{'':56}D      1"), holds_surfaces(f"{144:8d}{'':64}D      1")
    (False, True)
    """
    kinds = {line[:8].strip() for line in text.splitlines() if line[72:73] == "D"}
    return any(str(each) in kinds for each in _SURFACES)


def curves_of_iges(text: str, source: str, unit: str | None = None) -> Found:
    """Read the curves of an IGES file.

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
    curves : list of SplineCurve
        In the order of the file, m; those of a chain one by one, with its name where they have
        none.
    unit : str
        The unit of the file.
    notes : tuple of str
        What was left out or done.

    Raises
    ------
    BadInputError
        The file is damaged, tells no unit, or holds no curve that can be read.
    """
    file = IgesFile.of_text(text, source)
    name, metres, notes = unit_of(file, unit)
    chains = _chains(file)
    shown = [each for each in file.entries.values() if _is_curve(file, each, chains)]
    left = _left_out(file, chains, shown)
    if not shown:
        what = "there is no curve that can be read (126, 110, 106)"
        told = " ".join(left)
        raise BadInputError(what, f"in {source}", f"export lines as splines. {told}".strip())
    curves = [_curve(file, each, chains, metres) for each in shown]
    return curves, name, (*notes, *scale_note(file), *left)


def own_iges_lines(text: str, source: str) -> OwnLines | None:
    """Give the lines of a file of ours with what it tells of them; None if it is none of ours.

    Raises
    ------
    BadInputError
        The file is damaged, or tells no unit.
    """
    if f"{len(MARK)}H{MARK}" not in text:
        return None
    file = IgesFile.of_text(text, source)
    unit, metres, _ = unit_of(file, None)
    own = {
        each.number: _text_of(file, each.number)
        for each in file.entries.values() if (each.kind, each.form) == (406, 27)
    }  # fmt: skip
    hull = [own[number] for number in own if not file.entries[number].dependent and own[number]]
    if len(hull) != 1:
        return OwnLines(fault=f"it has {len(hull)} texts of a hull") if hull else None
    chains = _chains(file)
    curves, others = list[TextedCurve](), list[str]()
    for entry in file.entries.values():
        if not _is_curve(file, entry, chains):
            continue
        record = file.record(entry.number)
        pointers = property_pointers(file, record, _shape(record, entry)[5])
        told = next((own[each] for each in pointers if own.get(each)), "")
        if told == IMAGE:
            continue
        if told and entry.kind == 126 and not entry.transformation:
            curves.append(TextedCurve(told, _curve(file, entry, chains, metres)))
        else:
            others.append(f"D{entry.number}")
    return attrs.evolve(own_lines(hull[0], curves, others), unit=unit)


def _text_of(file: IgesFile, number: int) -> str:
    """Give the text of generic data of ours, empty if they are of another."""
    record = file.record(number)
    if record.text(2) != MARK:
        return ""
    count = record.count(3, "the number of values", len(record))
    return "".join(record.text(5 + 2 * i) for i in range(count))


def _chains(file: IgesFile) -> dict[int, DirectoryEntry]:
    """Tell of curves which chain they are a part of."""
    found: dict[int, DirectoryEntry] = {}
    for entry in file.entries.values():
        # A chain that depends on another is the border of a surface, or a part of a chain.
        if entry.kind == _CHAIN and not entry.dependent:
            record = file.record(entry.number)
            count = record.count(1, "the number of curves", _MOST)
            for each in record.pointers(2, count, "the curves"):
                found[each] = entry
    return found


def _is_curve(file: IgesFile, entry: DirectoryEntry, chains: dict[int, DirectoryEntry]) -> bool:
    if entry.kind not in _READ or (entry.kind == 106 and entry.form not in _POLYLINES):
        return False
    chain = chains.get(entry.number)
    if chain is None:
        return not entry.dependent and not entry.blanked
    return not chain.blanked


def _curve(
    file: IgesFile, entry: DirectoryEntry, chains: dict[int, DirectoryEntry], metres: float
) -> SplineCurve:
    """Read a curve and bring it to its place."""
    record = file.record(entry.number)
    degree, knots, points, weights, span, after = _shape(record, entry)
    motion = transformation_of(file, entry.transformation)
    chain = chains.get(entry.number)
    if chain is not None:
        motion = motion.then(transformation_of(file, chain.transformation))
    placed = motion.of(points) * metres if metres != 1.0 else motion.of(points).copy()
    if not np.abs(placed).max() <= _FARTHEST:
        what = f"a control point lies {np.abs(placed).max():.3g} m away"
        raise BadInputError(what, record.where, "export the file again")
    told = (name_property(file, record, after), entry.label, chain.label if chain else "")
    name = next((each for each in map(readable_name, told) if each), f"curve D{entry.number}")
    curve = SplineCurve(name, degree, knots, placed, weights)
    return curve if span == curve.domain else curve.restricted(*span)


def _shape(
    record: IgesRecord, entry: DirectoryEntry
) -> tuple[int, FloatArray, FloatArray, FloatArray | None, tuple[float, float], int]:
    """Give degree, knots, control points, weights, bounds, and where properties begin."""
    if entry.kind == 126:
        data = spline_curve(record)
        count = len(data.points)
        after = 7 + len(data.knots) + 4 * count + 5
        weights = None if (data.weights == data.weights[0]).all() else data.weights
        knots = checked_knots(data.knots, data.degree, count, "the knots", record.where)
        return data.degree, knots, data.points, weights, data.span, after
    if entry.kind == 110:
        points, after = record.reals(1, 6, "the line").reshape(2, 3), 7
    else:
        points, after = _polyline(record)
    last = float(len(points) - 1)
    knots = np.concatenate([[0.0], np.arange(len(points)), [last]])
    return 1, knots, points, None, (0.0, last), after


def _polyline(record: IgesRecord) -> tuple[FloatArray, int]:
    """Give the points (k, 3) of an entity 106, pairs at one height or triples, and what follows."""
    flat = record.count(1, "the kind of points", 2) == 1
    count = record.count(2, "the number of points", _MOST)
    if count < 2:
        what = f"a polyline has {count} points"
        raise BadInputError(what, record.where, "give two or more")
    if not flat:
        return record.reals(3, 3 * count, "the points").reshape(count, 3), 3 + 3 * count
    height = float(record.reals(3, 1, "the height")[0])
    pairs = record.reals(4, 2 * count, "the points").reshape(count, 2)
    return np.column_stack([pairs, np.full(count, height)]), 4 + 2 * count


def _left_out(
    file: IgesFile, chains: dict[int, DirectoryEntry], shown: list[DirectoryEntry]
) -> tuple[str, ...]:
    """Tell what of a file is not read."""
    taken = {each.number for each in shown} | {each.number for each in chains.values()}
    taken |= {number for number, chain in chains.items() if chain.blanked}
    count = Counter(
        entry.kind for entry in file.entries.values()
        if entry.number not in taken and entry.kind not in SILENT and not entry.blanked
        and (entry.number in chains or not entry.dependent)
    )  # fmt: skip
    notes = []
    if count:
        words = ", ".join(
            f"{many} of type {kind}{f' ({KINDS[kind]})' if kind in KINDS else ''}"
            for kind, many in sorted(count.items())
        )
        notes.append(f"Of {file.source} only curves are read; left out are {words}.")
    hidden = sum(each.blanked and each.kind in (*_READ, _CHAIN) for each in file.entries.values())
    if hidden:
        notes.append(f"{hidden} curves are blanked in the file and left out.")
    return tuple(notes)
