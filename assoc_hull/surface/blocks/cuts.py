"""Where a half hull is cut across and along: lines of its net beside bends of its profile."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.surface.blocks.outline import WINDOW, Bend, Course, bends_inward, course
from assoc_hull.surface.blocks.region import BRIDGE, Chord, Region

__all__ = ["LEAST", "EndCut", "end_cut", "passes", "whole_sections"]

_KEEL = 0.1
"""A section stands on the keel where the profile rises by less than this a metre."""
_NEAR = 0.02
"""A line near a bend is no farther from it than this part of the ship's length ..."""
_THROUGH = 0.006
"""... and one through it, than this."""
_BEFORE = 0.01
"""A section beside a bend stands this part of the length off it."""
_LONG = {"bow": 0.08, "stern": 0.11}
"""An end is at least so long a part of the ship: what is pulled at its tip has faded where the body
begins; and there sections have lost the hollow of a skeg, for which the body has too few knots."""
LEAST, _SHARP = 35.0, 60.0
"""An end whose profile bends into the ship by so many degrees has a block of its own; and two, if
by so many."""


@attrs.frozen(eq=False)
class EndCut:
    """How an end of the hull is cut off the body.

    Attributes
    ----------
    kind : {"bow", "stern"}
        Which end.
    section : Chord
        The section, from the deck down.
    beside : Chord or None
        The next section towards midship: the bay between is where surfaces overlap.
    along : tuple of Chord
        The waterline that parts the end, from the section to the profile; and the next one above.
    bend : Bend
        The bend it is cut for.
    notes : tuple of str
        What is to be known.
    """

    kind: str
    section: Chord
    beside: Chord | None
    along: tuple[Chord, ...]
    bend: Bend
    notes: tuple[str, ...] = ()


def whole_sections(whole: Region, length: float) -> tuple[Chord, ...]:
    """Give the sections in one piece that stand on the keel, from aft forward, from the deck down.

    Parameters
    ----------
    whole : Region
        The half hull.
    length : float, m
        Of the ship.
    """
    graph, net = whole.graph, whole.graph.net
    found = list[tuple[float, Chord]]()
    lines: dict[str, list[Chord]] = {}
    for curve in np.unique(graph.curve).tolist():
        if net.family[curve] == "sections" and np.isfinite(net.x[curve]):
            lines.setdefault(net.name[curve], []).extend(whole.chords(curve))
    outline = course(whole)
    for chords in lines.values():
        if len(chords) == 1:
            chord = _downward(whole, chords[0])
            if _on_keel(whole, outline, chord.last, length):
                found.append((float(net.x[chord.curve]), chord))
    return tuple(chord for _, chord in sorted(found, key=lambda each: each[0]))


def _downward(region: Region, chord: Chord) -> Chord:
    z = region.graph.place[[chord.first, chord.last], 2]
    return chord if z[0] >= z[1] else chord.reversed()


def _on_keel(whole: Region, outline: Course, node: int, length: float) -> bool:
    """Tell whether the border is nearly level at a node."""
    i = int(np.flatnonzero(outline.node == node)[0])
    half = 0.25 * WINDOW * length
    before, behind = outline.at(outline.start[i] + np.array([-half, half]))
    step = np.abs(behind - before)
    return bool(outline.centre[np.searchsorted(outline.along, outline.start[i])]) and bool(
        step[2] <= _KEEL * step[0]
    )


def end_cut(whole: Region, length: float, kind: str) -> EndCut | None:
    """Find how an end of the hull is to be cut off, if at all.

    Parameters
    ----------
    whole : Region
        The half hull.
    length : float, m
        Of the ship.
    kind : {"bow", "stern"}
        Which end.
    """
    bend = _main_bend(whole, length, kind)
    if bend is None:
        return None
    through = _section_through(whole, bend, length)
    if through is not None:
        return EndCut(kind, through, None, (), bend)
    pair = _section_beside(whole, bend, length, kind)
    if pair is None:
        return None
    section, beside = pair
    parted = kind == "stern" or bend.turn >= _SHARP
    along = _waterlines(whole, section, bend, length) if parted else ()
    x, _, z = bend.place
    note = (
        () if along or not parted else (f"no waterline ends near the bend at ({x:.2f}, {z:.2f})",)
    )
    return EndCut(kind, section, beside, along, bend, note)


def _towards(kind: str) -> float:
    """Give the sign of the way from an end to midship."""
    return -1.0 if kind == "bow" else 1.0


def _main_bend(whole: Region, length: float, kind: str) -> Bend | None:
    """Give the sharpest bend of the profile in a half of the ship."""
    x = whole.graph.place[:, 0]
    middle = 0.5 * (float(x.min()) + float(x.max()))
    bends = [
        bend
        for bend in bends_inward(course(whole), length, LEAST)
        if (bend.place[0] - middle) * _towards(kind) < 0.0
    ]
    return max(bends, key=lambda each: (each.turn, each.along)) if bends else None


def _section_beside(
    whole: Region, bend: Bend, length: float, kind: str
) -> tuple[Chord, Chord | None] | None:
    """Give the section that cuts an end off, and the next one towards midship."""
    towards, x = _towards(kind), whole.graph.net.x
    sections = whole_sections(whole, length)
    sections = sections[::-1] if kind == "stern" else sections
    tip = float((whole.graph.place[:, 0] * towards).min())
    limit = max(bend.place[0] * towards + _BEFORE * length, tip + _LONG[kind] * length)
    good = [i for i, run in enumerate(sections) if float(x[run.curve]) * towards >= limit]
    if not good:
        return None
    return sections[good[-1]], sections[good[-1] - 1] if good[-1] else None


def _section_through(whole: Region, bend: Bend, length: float) -> Chord | None:
    """Give a section that ends at a bend of the profile, if one does."""
    net, place = whole.graph.net, whole.graph.place
    for curve in np.unique(whole.graph.curve).tolist():
        if net.family[curve] != "sections":
            continue
        for chord in whole.chords(curve):
            down = _downward(whole, chord)
            away = np.abs(place[down.last] - np.array(bend.place)).max()
            if away <= _THROUGH * length:
                return down
    return None


def _waterlines(whole: Region, section: Chord, bend: Bend, length: float) -> tuple[Chord, ...]:
    """Give the waterline from a section to a bend of the profile, and the next above it."""
    graph = whole.graph
    on_section = set(np.append(whole.begin(section.half), section.last).tolist())
    parts = [
        part for part in whole.parted([section.half]) if passes(part, bend, 0.5 * _BEFORE * length)
    ]
    if len(parts) != 1:
        return ()
    (part,) = parts
    outline = course(whole)
    where = dict(zip(outline.node.tolist(), outline.start.tolist(), strict=False))
    found = list[tuple[float, float, Chord]]()
    for curve in np.unique(graph.curve[part.edges]).tolist():
        if graph.net.family[curve] != "waterlines":
            continue
        for chord in part.chords(curve):
            run = chord if chord.first in on_section else chord.reversed()
            if run.first in on_section and run.last in where and run.last not in on_section:
                away = abs(where[run.last] - bend.along)
                away = min(away, outline.length - away)
                found.append((away, float(graph.place[run.last, 2]), run))
    close = [each for each in found if each[0] <= _NEAR * length]
    if not close:
        return ()
    _, level, cut = min(close, key=lambda each: each[:2])
    above = sorted((each for each in found if each[1] > level), key=lambda each: each[1])
    cut = _over_bridge(part, cut)
    return (cut, above[0][2]) if above else (cut,)


def _over_bridge(region: Region, line: Chord) -> Chord:
    """Let a waterline end over the bridge that leaves its last crossing, if there is one."""
    graph = region.graph
    last = int(region.begin(line.half[-1:])[0])
    for edge in np.flatnonzero(region.interior).tolist():
        if graph.net.family[int(graph.curve[edge])] == BRIDGE and last in graph.edge[edge]:
            half = 2 * edge + int(graph.edge[edge, 1] == last)
            run = np.append(line.half[:-1], half)
            return Chord(run, line.curve, line.first, int(region.end(run[-1:])[0]))
    return line


def passes(part: Region, bend: Bend, near: float) -> bool:
    """Tell whether the border of a part passes a bend.

    Parameters
    ----------
    part : Region
        The part.
    bend : Bend
        Where the profile bends.
    near : float, m
        What counts as passed.
    """
    found = part.path(part.loop)
    return bool(np.abs(found - np.array(bend.place)).max(axis=1).min() <= near)
