"""A body plan in a flat DXF drawing: sections of both halves, by the labels beside them.

The after body is drawn to one side of the centre line and the fore body to the other, at one scale.
Each section begins on the centre line or ends beside its label; where stations stand comes from
their numbers, the length and how many spacings it has. Grid lines and whatever has no label are
left out, and told by layer.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import attrs
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.io.digitised.dxf import drawn_curves, tell_oddities
from assoc_hull.io.dxf.entities import DrawingEntity, drawing_entities, drawing_unit
from assoc_hull.io.dxf.read_lines_plan import names_of
from assoc_hull.io.lines.raw_lines import plane_name
from assoc_hull.io.reports import Notebook, OffsetReport
from assoc_hull.io.units import METRES, checked_unit, refuse_other_unit

__all__ = ["BodyPlan", "BodyPlanRules", "is_body_plan", "read_body_plan"]

_LEAST = 4
"""A flat drawing of fewer curves is no body plan."""

_HEAD, _MOST_BYTES = 2000, 50_000_000
_CHORD = 1e-5
"""Points of a spline are this close, as a part of the drawing's size."""

_SAME = 1e-5
"""Ends this near one another, in parts of the size, meet."""

_STRAIGHT, _NEAR, _REACH = 1e-3, 5e-3, 0.12
"""Parts of the size: of a straight line, of the centre line, and how far a label may lie."""

_SET = 1e-3
"""Labels whose offsets from their sections differ by less, in parts of the size, were set alike."""

_ALIKE = (3, 0.8)
"""So many labels, and this part of those of a side, tell that all were set alike."""

_TWINS = 0.025
"""Sections that end this near one another, in parts of the size, may have each other's label."""

_NUMBER = re.compile(
    r"(?:ST(?:ATION)?|SEC(?:TION)?|FR(?:AME)?|NO|#)?[\s.:#]*"
    r"(?P<whole>-?\d+(?:[.,]\d+)?)?\s*(?P<part>½|¼|¾|[123]/[24])?",
    re.IGNORECASE,
)
_PARTS = {"½": 0.5, "¼": 0.25, "¾": 0.75, "1/2": 0.5, "1/4": 0.25, "3/4": 0.75, "2/4": 0.5}
_COMMON = (10, 20)
"""Into how many spacings a length is parted as a rule."""


@attrs.frozen
class BodyPlanRules:
    """What is said of a body plan, where the drawing does not tell it.

    Attributes
    ----------
    scale : float
        Full scale over that of the drawing.
    unit : str or None
        Of the drawing.
    length : float or None, m
        Between perpendiculars.
    spacings : int or None
        Of stations, between the perpendiculars.
    spacing : float or None, m
        Of stations, in place of the two.
    zero : {"ap", "fp"} or None
        Where station 0 is.
    """

    scale: float = 1.0
    unit: str | None = None
    length: float | None = None
    spacings: int | None = None
    spacing: float | None = None
    zero: str | None = None


@attrs.frozen
class BodyPlan:
    """The sections as digitised lines in text, in `unit` and at the scale of the drawing."""

    text: str
    unit: str
    notes: OffsetReport


def is_body_plan(path: Path) -> bool:
    """Tell whether a file is a drawing all of whose curves lie in its plane, and none of ours."""
    if not path.is_file() or path.stat().st_size > _MOST_BYTES:
        return False
    data = path.read_bytes()
    if not re.search(rb"^\s*0\s*\r?\n\s*SECTION\s*$", data[:_HEAD], re.MULTILINE):
        return False
    try:
        entities = drawing_entities(data.decode("utf-8", "replace"), path.name)
        drawn = drawn_curves(entities)
        flat = all(not np.ptp(each.corners[:, 2]) and not each.corners[0, 2] for _, each in drawn)
    except BadInputError:
        return False
    ours = any(names_of(entity)[1] for entity, _ in drawn)
    return len(drawn) >= _LEAST and flat and not ours


@attrs.frozen(eq=False)
class _Curve:
    """A curve of the drawing, (n, 2), and its layer."""

    xy: FloatArray
    layer: str


@attrs.frozen
class _Label:
    """A number in the drawing: a station, or 'AP' or 'FP'."""

    word: str
    place: tuple[float, float]
    alike: bool = False
    """Whether it was set as all others: then the end of its section is in its place."""


def read_body_plan(path: Path, rules: BodyPlanRules) -> BodyPlan:
    """Read the sections of a body plan.

    Raises
    ------
    BadInputError
        It tells no unit, no label is beside a section, or nothing tells where stations stand.
    """
    book, where = Notebook(), f"in {path.name}"
    entities = drawing_entities(path.read_bytes().decode("utf-8", "replace"), path.name)
    unit = _unit(drawing_unit(entities), rules.unit, path.name)
    drawn = drawn_curves(entities)
    tell_oddities(entities, book, without=("curve",))  # stamps and frames: told by layer
    size = float(max(np.ptp(each.corners[:, :2], axis=0).max() for _, each in drawn))
    every = [
        _Curve(curve.piece(_CHORD * size).points[:, :2], entity.word(8)) for entity, curve in drawn
    ]
    every = [half for each in _chained(every, size) for half in _halves(each, size)]
    curves = [each for each in every if not _is_straight(each, size)]
    if not curves:
        told = "".join(f"; {note.what}" for note in book.suspicions)
        raise BadInputError(f"all curves of the flat drawing are straight{told}", where,
                            "give a drawing of sections, or lines in space")  # fmt: skip
    grid = Counter(each.layer for each in every if _is_straight(each, size))
    for layer, count in grid.items():
        book.assume("left out", f"the layer {layer!r}", f"{count} straight lines: a grid", count)
    centre = _centre(curves, size, book)
    flats = [each for each in every if _is_straight(each, size)]
    curves = [_with_bottom(each, flats, centre, size) for each in curves]
    labels = _set_alike(curves, _labels(entities), centre, size)
    pairs, rest = _labelled(curves, labels, size)
    if not pairs:
        raise BadInputError("no section of the body plan has a number beside it", where,
                            "put the number of its station at the end of each section")  # fmt: skip
    pairs = _in_order(pairs, centre, size, book)
    for layer, count in Counter(each.layer for each in rest).items():
        what = f"{count} curves without the number of a station: left out"
        book.suspect("curve", f"the layer {layer!r}", what, count)
    _tell_texts(entities, book)
    places = _places([label.word for _, label in pairs], pairs, centre, rules, book, where)
    factor = rules.scale * METRES[unit]
    rows = ["line,x,y,z,piece"]
    done: dict[float, str] = {}
    for number, ((curve, label), x) in enumerate(zip(pairs, places, strict=True)):
        side = "right" if curve.xy[:, 0].mean() > centre else "left"
        if done.setdefault(x, side) != side:
            book.repair("both sides", f"station {label.word}", "drawn on both sides: one is kept")
            continue
        name = plane_name("sections", x)
        rows += [
            f"{name},{x / factor!r},{abs(a - centre)!r},{b!r},{number}"
            for a, b in _upward(curve.xy).tolist()
        ]
    return BodyPlan("\n".join(rows) + "\n", unit, book.report())


def _unit(told: str | None, given: str | None, source: str) -> str:
    unit = None if given is None else checked_unit(given, "as an argument")
    refuse_other_unit(source, told, unit)
    found = unit or told
    if found is None:
        what = "a body plan tells no unit"
        raise BadInputError(what, f"in {source}", f"give unit: {', '.join(METRES)}")
    return found


def _chained(curves: list[_Curve], size: float) -> list[_Curve]:
    """Join curves of a layer where the ends of two meet and of no third: pieces of one section."""
    found: list[_Curve] = []
    for layer in dict.fromkeys(each.layer for each in curves):
        mine = [each for each in curves if each.layer == layer]
        open_ = [each for each in mine if np.ptp(each.xy[[0, -1]], axis=0).max() > _SAME * size]
        found += [each for each in mine if each not in open_]
        if open_:
            ends = np.concatenate([each.xy[[0, -1]] for each in open_])
            # Places within a rounding of one another are one node.
            node = connected_components(_near(ends, _SAME * size))[1].astype(np.int64)
            found += [_Curve(xy, layer) for xy in _along(open_, node.reshape(-1, 2))]
    return found


def _near(places: FloatArray, near: float) -> coo_array:
    """Give the pairs of places nearer to one another than this, as a graph."""
    pairs = cKDTree(places).query_pairs(near, output_type="ndarray")
    return coo_array(
        (np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(places), len(places))
    )


def _along(curves: list[_Curve], node: IntArray) -> list[FloatArray]:
    """Give the points of chains of curves, whose ends are nodes, (n, 2)."""
    count = np.bincount(node.ravel())
    at: dict[int, list[tuple[int, int]]] = {}
    for i, pair in enumerate(node.tolist()):
        for end, place in enumerate(pair):
            at.setdefault(place, []).append((i, end))
    done, found = set[int](), list[FloatArray]()
    # Chains begin where they end; what is left then are rings.
    starts = [(i, end) for place, here in at.items() if count[place] != 2 for i, end in here]
    for start in [*starts, *((i, 0) for i in range(len(curves)))]:
        i, end = start
        run: list[FloatArray] = []
        while i not in done:
            done.add(i)
            run.append(curves[i].xy[::-1] if end else curves[i].xy)
            place = int(node[i, 1 - end])
            if count[place] == 2:
                i, end = next((each for each in at[place] if each[0] != i), (i, end))
        if run:
            found.append(np.concatenate([run[0], *(each[1:] for each in run[1:])]))
    return found


def _with_bottom(curve: _Curve, flats: list[_Curve], centre: float, size: float) -> _Curve:
    """Lead a section in to the centre line along a level bottom that it shares with others."""
    up, near = _upward(curve.xy), _SAME * size
    x, y = up[0].tolist()
    level = [
        sorted(each.xy[[0, -1], 0].tolist())
        for each in flats
        if each.layer == curve.layer and np.abs(each.xy[:, 1] - y).max() <= near
    ]
    reached, ahead = x, np.sign(centre - x)
    # From one line to the next, as far as they touch.
    for _ in level:
        here = [pair for pair in level if pair[0] - near <= reached <= pair[1] + near]
        reached = ahead * max([ahead * reached, *(ahead * end for pair in here for end in pair)])
    if abs(x - centre) <= _NEAR * size or ahead * (centre - reached) > near:
        return curve
    return attrs.evolve(curve, xy=np.vstack([[centre, y], up]))


def _halves(curve: _Curve, size: float) -> list[_Curve]:
    """Part a section that is drawn on both sides in its middle."""
    xy = curve.xy
    middle = 0.5 * float(xy[0, 0] + xy[-1, 0])
    level = abs(float(xy[0, 1] - xy[-1, 1])) <= _STRAIGHT * size
    low = int(xy[:, 1].argmin())
    if not level or _is_straight(curve, size) or low in (0, len(xy) - 1):
        return [curve]
    side = np.sign(xy[:, 0] - middle)
    cut = np.flatnonzero(side[1:] != side[0])
    first = int(cut[0]) + 1 if len(cut) else 0
    if not first or (side[first:] == side[0]).any():
        return [curve]  # a ring, or what turns back
    a, b = xy[first - 1], xy[first]
    foot = a + (middle - a[0]) / (b[0] - a[0]) * (b - a)
    parts = np.vstack([xy[:first], foot]), np.vstack([foot, xy[first:]])
    return [_Curve(each, curve.layer) for each in parts]


def _is_straight(curve: _Curve, size: float) -> bool:
    """Tell lines of the grid, and frames, from sections."""
    first, last = curve.xy[0], curve.xy[-1]
    along = last - first
    length = float(np.hypot(*along))
    if length <= _STRAIGHT * size:
        return True  # closed: a frame, a circle around a label
    off = np.abs(along[0] * (curve.xy - first)[:, 1] - along[1] * (curve.xy - first)[:, 0]) / length
    return bool(off.max() <= _STRAIGHT * size)


def _centre(curves: list[_Curve], size: float, book: Notebook) -> float:
    """Find the centre line: most sections begin on it."""
    low = np.array([each.xy[np.argmin(each.xy[:, 1]), 0] for each in curves])
    near = np.abs(low[:, None] - low) <= _NEAR * size
    best = int(near.sum(axis=1).argmax())
    centre = float(np.median(low[near[best]]))
    what = f"at {centre:.6g} of the drawing, where {int(near[best].sum())} sections begin"
    book.assume("centre line", "the body plan", what, centre)
    return centre


def _labels(entities: list[DrawingEntity]) -> list[_Label]:
    """Give the texts that are numbers of stations."""
    found = []
    for each in entities:
        if each.kind in ("TEXT", "MTEXT"):
            word = re.sub(r"\\[A-Za-z][^;]*;|[{}]", "", each.word(1)).strip()
            if word.upper() in ("AP", "FP") or (word and _value(word) is not None):
                code = 11 if each.kind == "TEXT" and each.numbers(11) else 10
                x, y, _ = each.place(code)
                found.append(_Label(word.upper(), (x, y)))
    return found


def _value(word: str) -> float | None:
    """Give the number that a label means."""
    match = _NUMBER.fullmatch(word)
    if match is None or not (match["whole"] or match["part"]):
        return None
    whole = float((match["whole"] or "0").replace(",", "."))
    part = _PARTS.get(match["part"] or "", 0.0)
    return whole - part if whole < 0.0 else whole + part


def _set_alike(
    curves: list[_Curve], labels: list[_Label], centre: float, size: float
) -> list[_Label]:
    """Move the labels of a side onto the ends of its sections, where they stand at one offset."""
    found: list[_Label] = []
    for left in (True, False):
        mine = [each for each in labels if (each.place[0] < centre) == left]
        tops = [_upward(each.xy)[-1] for each in curves if (each.xy[:, 0].mean() < centre) == left]
        moved: list[_Label] = []
        if mine and len(tops) >= _ALIKE[0]:
            step = np.array([each.place for each in mine])[:, None] - np.array(tops)
            offsets = step.reshape(-1, 2)
            offsets = offsets[np.hypot(*offsets.T) <= _REACH * size]
            # How many labels stand at each offset from the end of some section; the nearest first.
            offsets = offsets[np.argsort(np.hypot(*offsets.T), kind="stable")]
            met = [np.abs(step - each).max(axis=2).min(axis=1) <= _SET * size for each in offsets]
            count = [int(each.sum()) for each in met]
            best = int(np.argmax(count)) if count else 0
            if count and count[best] >= max(_ALIKE[0], _ALIKE[1] * min(len(mine), len(tops))):
                off = offsets[best]
                moved = [
                    attrs.evolve(each, place=tuple((each.place - off).tolist()), alike=True)
                    for each, on in zip(mine, met[best].tolist(), strict=True) if on
                ]  # fmt: skip
        found += moved or mine
    return found


def _labelled(
    curves: list[_Curve], labels: list[_Label], size: float
) -> tuple[list[tuple[_Curve, _Label]], list[_Curve]]:
    """Give each section the label that lies nearest to one of its ends; the pairs that fit best."""
    pairs = sorted(
        (float(np.hypot(*(curve.xy[end] - np.array(label.place)))), i, j)
        for i, curve in enumerate(curves) for j, label in enumerate(labels) for end in (0, -1)
    )  # fmt: skip
    mine: dict[int, int] = {}
    for away, i, j in pairs:
        if away <= _REACH * size and i not in mine and j not in mine.values():
            mine[i] = j
    rest = [curve for i, curve in enumerate(curves) if i not in mine]
    return [(curves[i], labels[j]) for i, j in sorted(mine.items())], rest


def _in_order(
    pairs: list[tuple[_Curve, _Label]], centre: float, size: float, book: Notebook
) -> list[tuple[_Curve, _Label]]:
    """Share out labels of sections that end at one place: fuller sections lie nearer amidships."""
    out = list(pairs)
    left = np.array([curve.xy[:, 0].mean() < centre for curve, _ in pairs])
    numbers = np.array([_value(label.word) or 0.0 for _, label in pairs])
    area = np.array([_area(curve.xy, centre) for curve, _ in pairs])
    ends = np.array([_upward(curve.xy)[-1] for curve, _ in pairs])
    for side in (left, ~left):
        mine = np.flatnonzero(side)
        rising = float(((area - area[side].mean()) * (numbers - numbers[side].mean()))[side].sum())
        near = _SET if sum(label.alike for _, label in pairs) > 0.5 * len(pairs) else _TWINS
        for group in _together(ends[mine], near * size):
            rows = mine[group]
            if len(rows) < 2:
                continue
            curves = rows[np.argsort(area[rows], kind="stable")]
            labels = rows[np.argsort(np.sign(rising) * numbers[rows], kind="stable")]
            for i, j in zip(curves.tolist(), labels.tolist(), strict=True):
                out[i] = (pairs[i][0], pairs[j][1])
            words = ", ".join(sorted((pairs[j][1].word for j in rows.tolist()), key=_sorting))
            what = "they end at one place; fuller ones are taken to lie nearer amidships"
            book.assume("labels", f"the sections {words}", what, len(rows))
    return out


def _sorting(word: str) -> tuple[float, str]:
    return _value(word) or 0.0, word


def _area(xy: FloatArray, centre: float) -> float:
    up = _upward(xy)
    return float(np.trapezoid(np.abs(up[:, 0] - centre), up[:, 1]))


def _together(places: FloatArray, near: float) -> list[list[int]]:
    """Give places, (n, 2), in groups whose neighbours along x lie near one another."""
    order = np.argsort(places[:, 0], kind="stable").tolist()
    groups: list[list[int]] = []
    for each in order:
        if groups and np.abs(places[each] - places[groups[-1][-1]]).max() <= near:
            groups[-1].append(each)
        else:
            groups.append([each])
    return groups


def _places(
    words: list[str], pairs: list[tuple[_Curve, _Label]], centre: float, rules: BodyPlanRules,
    book: Notebook, where: str,
) -> list[float]:  # fmt: skip
    """Give x of the stations from AP, m."""
    numbers = np.array([np.nan if w in ("AP", "FP") else _value(w) for w in words], np.float64)
    left = np.array([curve.xy[:, 0].mean() < centre for curve, _ in pairs])
    zero = rules.zero or _zero(numbers, left, book)
    spacing, last = rules.spacing, None
    if spacing is None:
        if rules.length is None:
            raise BadInputError("nothing tells how far apart the stations of the body plan are",
                                where, "give length=, or frame_spacing=")  # fmt: skip
        last = rules.spacings or _spacings(numbers, book, where)
        spacing = rules.length / last
    x = numbers * spacing
    if zero == "fp":
        length = rules.length or float(np.nanmax(x))
        x = length - x
    ends = {"AP": 0.0, "FP": rules.length if rules.length is not None else np.nan}
    x = np.where(np.isnan(x), [ends.get(w, np.nan) for w in words], x)
    if np.isnan(x).any():
        raise BadInputError(
            "a section is labelled FP and no length is known", where, "give length="
        )
    return [round(float(each), 9) + 0.0 for each in x]


def _zero(numbers: FloatArray, left: np.typing.NDArray[np.bool_], book: Notebook) -> str:
    """Tell where station 0 is: the after body is drawn to the left, as a rule."""
    one, other = numbers[left], numbers[~left]
    aft_low = not len(one) or not len(other) or np.nanmean(one) <= np.nanmean(other)
    zero = "ap" if aft_low else "fp"
    what = f"at the {zero.upper()}, since the after body is taken to be drawn to the left"
    book.assume("station zero", "the body plan", what)
    return zero


def _spacings(numbers: FloatArray, book: Notebook, where: str) -> int:
    most = float(np.nanmax(numbers))
    found = next((each for each in _COMMON if each - 1.0 <= most <= each + 0.5), None)
    if found is None:
        what = f"the highest station of the body plan is {most:g}"
        raise BadInputError(what, where, "give station_spacings=, or frame_spacing=")
    what = f"{found} between the perpendiculars, by the highest label, {most:g}"
    book.assume("station numbers", "the body plan", what, found)
    return found


def _upward(xy: FloatArray) -> FloatArray:
    return xy if xy[-1, 1] >= xy[0, 1] else xy[::-1]


def _tell_texts(entities: list[DrawingEntity], book: Notebook) -> None:
    """Tell, by layer, texts that are no stations, and entities that are not read."""
    known = ("TEXT", "MTEXT", "SPLINE", "LINE", "POLYLINE", "LWPOLYLINE")
    odd = Counter(
        (each.word(8), each.kind) for each in entities
        if each.kind in ("ARC", "CIRCLE", "ELLIPSE", "INSERT", "HATCH", "DIMENSION", "POINT")
        and each.kind not in known
    )  # fmt: skip
    for (layer, kind), count in odd.items():
        book.assume("left out", f"the layer {layer!r}", f"{count} of {kind}", count)
