"""Flats of a hull: straight runs of neighbouring lines in one plane, and the places of their rims.

The flat of side shows on sections and waterlines, that of bottom on sections and buttocks. What
all groups show of one plane makes one flat.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.polylines.flats import FlatRegion, fit_plane, join_straight_runs
from assoc_hull.geometry.polylines.operations import cumulative_lengths, resample
from assoc_hull.geometry.polylines.straight_runs import StraightRun
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.slicing.features import FeatureRules, PieceFeatures
from assoc_hull.io.slicing.smooth_lines import in_space

__all__ = ["FlatFound", "RimMark", "find_flats"]

_EVEN = 0.3
"""The standard deviation of a place that may lie anywhere within a length, as a part of that. Twice
that smoothed the border of the DTC's flat of side at the bow off by .8 m."""


@attrs.frozen(eq=False)
class RimMark:
    """One end of a run on the rim of a flat.

    Attributes
    ----------
    part, run, side : int
        Number of the piece, of the run on it, and 0 where the run begins, 1 where it ends.
    place : (3,), m
        On the flat's plane.
    doubt : float, m
        How far along the run the end may lie off: 2 standard deviations of an arc, half of what
        is possible for a gradual onset.
    spacing : float, m
        To the marks of the neighbouring lines; inf where it is none of a chain.
    chain : (int, int, int) or None
        Piece, run and side of the first mark of its chain of neighbouring lines.
    """

    part: int
    run: int
    side: int
    place: FloatArray
    doubt: float
    spacing: float = np.inf
    chain: tuple[int, int, int] | None = None

    def __attrs_post_init__(self) -> None:
        freeze(self.place)


@attrs.frozen(eq=False)
class FlatFound:
    """A flat.

    Attributes
    ----------
    name : str
        Such as "flat of side".
    normal : (3,)
        Unit normal of its plane.
    offset : float, m
        normal . place.
    marks : tuple of RimMark
        Where its runs begin and end, other than with their pieces.
    """

    name: str
    normal: FloatArray
    offset: float
    marks: tuple[RimMark, ...]


def find_flats(parts: list[PieceFeatures], rules: FeatureRules) -> list[FlatFound]:
    """Find flats on pieces whose runs are known.

    Parameters
    ----------
    parts : list of PieceFeatures
        Pieces of sections, waterlines and buttocks, with their runs.
    rules : FeatureRules
        The thresholds.

    Returns
    -------
    list of FlatFound
        The one of most runs first.
    """
    seen = [each for group in AXES for each in _of_group(parts, group, rules)]
    merged = sorted(_merge(seen), key=lambda each: -sum(len(one.runs) for one in each))
    names: list[str] = []
    found: list[FlatFound] = []
    # Over all runs: what is low is told by the height of the whole hull.
    top = max([float(end[:, 2].max()) for one in seen for end in one.ends], default=0.0)
    for each in merged:
        ends = np.concatenate([end for one in each for end in one.ends])
        # With the tolerance by which `_merge` has put them together.
        normal, offset, _ = fit_plane(ends, max(one.within for one in each))
        # Across an axis the offset is a coordinate; + 0.0 makes -0.0 a plain 0.
        offset = round(offset, 4) + 0.0 if 1.0 in normal else offset
        title = _title(normal, float(ends[:, 2].mean()), top)
        names.append(title)
        name = title if names.count(title) == 1 else f"{title} {names.count(title)}"
        marks = [mark for one in each for mark in _marks(parts, one, normal, offset, rules)]
        found.append(FlatFound(name, normal, offset, tuple(marks)))
    return found


@attrs.frozen(eq=False)
class _Seen:
    """A flat as one group shows it: its runs as (line, piece, run), their ends, (2, 3) each."""

    flat: FlatRegion
    runs: tuple[tuple[int, int, int], ...]
    ends: tuple[FloatArray, ...]
    within: float


def _of_group(parts: list[PieceFeatures], group: str, rules: FeatureRules) -> list[_Seen]:
    mine = [(i, part) for i, part in enumerate(parts) if part.line.group == group]
    # By place: runs on pieces of one line, or of two in one plane, are no neighbours.
    offsets = sorted({part.line.offset for _, part in mine})
    keys = [
        (offsets.index(part.line.offset), i, j)
        for i, part in mine
        for j in range(len(part.runs or ()))
    ]
    if not keys:
        return []
    ends = [_ends_of(parts[i], (parts[i].runs or ())[j]) for _, i, j in keys]
    both = np.array(ends)
    # By the scatter of their own lines: those at the ends of a ship may be known far less well.
    noise = np.array([parts[i].noise for _, i, _ in keys])
    within = np.maximum(rules.run.within, rules.run.scatters * noise)
    line = np.array([key[0] for key in keys])
    beyond = _beyond(both.mean(axis=1), line, offsets, mine)
    flats = join_straight_runs(line, both[:, 0], both[:, 1], within, rules.chain.lines, beyond)
    return [
        _Seen(
            flat, tuple(keys[i] for i in flat.runs), tuple(ends[i] for i in flat.runs),
            float(within[list(flat.runs)].max()),
        )
        for flat in flats
    ]  # fmt: skip


def _beyond(
    middle: FloatArray, line: IntArray, offsets: list[float], mine: list[tuple[int, PieceFeatures]]
) -> FloatArray:
    """Give where the lines before and after pass the middles of runs most closely, (n, 2, 3), m."""
    places: list[list[FloatArray]] = [[] for _ in offsets]
    for _, part in mine:
        places[offsets.index(part.line.offset)].append(in_space(part, part.points))
    joined = [np.concatenate(each) for each in places]
    out = np.full((len(line), 2, 3), np.nan)
    for i, number in enumerate(line.tolist()):
        for side, other in ((0, number - 1), (1, number + 1)):
            if 0 <= other < len(joined):
                away = ((joined[other] - middle[i]) ** 2).sum(axis=1)
                out[i, side] = joined[other][int(away.argmin())]
    return out


def _ends_of(part: PieceFeatures, run: StraightRun) -> FloatArray:
    """Give the places on the line of a run where it begins and ends, (2, 3), m.

    Of a gradual onset it is the middle of what is possible.
    """
    near = resample(part.points, np.array([run.before.at, run.after.at]))
    along = (near - run.origin) @ run.direction
    return in_space(part, run.origin + along[:, None] * run.direction)


def _merge(seen: list[_Seen]) -> list[list[_Seen]]:
    """Put together what groups show of one plane."""
    out: list[list[_Seen]] = []
    for one in seen:
        for mine in out:
            both = np.concatenate([end for each in (*mine, one) for end in each.ends])
            within = max(each.within for each in (*mine, one))
            if fit_plane(both, within)[2] <= within and _touch(mine, one):
                mine.append(one)
                break
        else:
            out.append([one])
    return out


def _touch(mine: list[_Seen], one: _Seen) -> bool:
    """Tell whether the extents of flats in one plane overlap."""
    before = np.concatenate([end for each in mine for end in each.ends])
    after = np.concatenate(one.ends)
    return bool(
        (before.min(axis=0) <= after.max(axis=0) + 0.1).all()
        and (after.min(axis=0) <= before.max(axis=0) + 0.1).all()
    )


def _title(normal: FloatArray, height: float, top: float) -> str:
    steep = np.abs(normal)
    if steep[2] > 0.9 and height < 0.5 * top:
        return "flat of bottom"
    return "flat of side" if steep[1] > 0.9 else "flat"


def _marks(
    parts: list[PieceFeatures], seen: _Seen, normal: FloatArray, offset: float, rules: FeatureRules
) -> list[RimMark]:
    """Give both rims of a flat as one group shows it, in chains of neighbouring lines."""
    found: list[RimMark] = []
    for side in (0, 1):
        chain: list[RimMark] = []
        chains = [chain]
        line_before = -2
        for (line, i, j), ends in zip(seen.runs, seen.ends, strict=True):
            run = (parts[i].runs or ())[j]
            onset = run.after if side else run.before
            if onset.kind == "end":
                continue
            place = _on_plane(ends[side], normal, offset, parts[i])
            # Of a gradual onset the middle half: its whole stretch is for the rarest shapes.
            doubt = (2.0 if onset.kind == "arc" else 0.5) * onset.uncertainty
            doubt = max(doubt, _within_facet(parts[i], onset.at))
            mark = RimMark(i, j, side, place, doubt)
            if onset.uncertainty >= rules.border:
                found.append(mark)
                continue
            if line != line_before + 1:
                chain = []
                chains.append(chain)
            chain.append(mark)
            line_before = line
        for each in chains:
            found += _chained(each) if len(each) >= rules.chain.lines else each
    return found


def _within_facet(part: PieceFeatures, at: float) -> float:
    """Give the doubt (m) that a facet leaves of a place along its line; 0 of digitised points.

    A hull may leave its flat anywhere within the facet.
    """
    if part.depth == 0.0:
        return 0.0
    along = cumulative_lengths(part.points)
    after = int(np.clip(np.searchsorted(along, at), 1, len(along) - 1))
    near = np.diff(along[max(after - 2, 0) : after + 2])
    return float(_EVEN * near.max())


def _chained(chain: list[RimMark]) -> list[RimMark]:
    places = np.array([mark.place for mark in chain])
    step = np.sqrt((np.diff(places, axis=0) ** 2).sum(axis=1))
    spacing = np.maximum(np.append(step, 0.0), np.append(0.0, step)).tolist()
    first = chain[0].part, chain[0].run, chain[0].side
    return [
        attrs.evolve(mark, spacing=size, chain=first)
        for mark, size in zip(chain, spacing, strict=True)
    ]


def _on_plane(
    place: FloatArray, normal: FloatArray, offset: float, part: PieceFeatures
) -> FloatArray:
    """Put a place onto a flat within the plane of its line."""
    way = normal.copy()
    way[AXES[part.line.group]] = 0.0
    way = way / (way @ normal)
    out = np.asarray(place + (offset - float(place @ normal)) * way)
    exact = normal == 1.0
    out[exact] = offset
    return out
