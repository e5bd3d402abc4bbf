"""Features of cut or digitised lines: noise, corners, straight runs and circular arcs.

All thresholds are in `FeatureRules`. Corners that chain over neighbouring lines are a knuckle line;
straight runs and arcs are found between corners.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TypeVar

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.circular_arcs import ArcRule, CircularArc, find_arcs
from assoc_hull.geometry.polylines.corners import (
    ChainRule,
    Corner,
    CornerRule,
    find_corners,
    join_corners,
    marked_corners,
    with_marked,
)
from assoc_hull.geometry.polylines.noise import (
    facet_depth,
    facet_depths,
    forward_points,
    point_scatter,
)
from assoc_hull.geometry.polylines.operations import (
    PolygonRule,
    cumulative_lengths,
    distinct_points,
    filled_polygon,
    polygon_corners,
)
from assoc_hull.geometry.polylines.smoothing import local_scatter
from assoc_hull.geometry.polylines.straight_runs import (
    Onset,
    StraightRun,
    StraightRunRule,
    find_straight_runs,
)
from assoc_hull.io.lines.slices import AXES, HullSlices, LinePiece, SliceLine

__all__ = [
    "FeatureRules",
    "KnuckleTrace",
    "PieceFeatures",
    "find_features",
    "is_well_known",
    "plane_columns",
    "runs_of",
    "with_arcs",
]


@attrs.frozen
class FeatureRules:
    """Every threshold of the features.

    Attributes
    ----------
    corner : CornerRule
        What counts as a corner of one line.
    chain : ChainRule
        What joins corners of neighbouring lines.
    alone_deg : float
        A corner that joins no knuckle line must turn by this to be kept.
    run : StraightRunRule
        What counts as a straight run.
    arc : ArcRule
        What counts as a circular arc.
    polygon : PolygonRule
        What counts as a polygon, of lines cut from facets.
    onset : float, m
        A tangent point is kept where its place is known at least this well, or where its doubt
        moves the line across by less than its scatter.
    border : float, m
        The end of a run counts for the border of a flat where it is known at least this well,
        for that of a run without a radius too.
    apart : float, m
        Marks of a border nearer to one another count as one: as points are adopted.
    border_deg : float
        A border is split where it turns by more.
    smooth_least : float, m
        Pieces are smoothed within this at least, measured across the hull.
    smooth_times : float
        Else within this many times the scatter at the place ...
    smooth_most : float, m
        ... but not within more than this, nor 1.5 times the depth of its own facets, ...
    smooth_depths : float
        ... nor this many times the depth of the facets of the mesh, whichever is most.
    adopt_least, adopt_least_facets : float, m
        Least tolerance of adoption, of digitised lines and of a mesh ...
    adopt_times : float
        ... else this many times the median noise of the pieces.
    near_least : float, m
        A gap of two smooth lines that weighs as much as a datum passed by all that is allowed,
        at least ...
    near_times : float
        ... else this many times the median noise of the pieces.
    """

    corner: CornerRule = attrs.field(factory=CornerRule)
    chain: ChainRule = attrs.field(factory=ChainRule)
    alone_deg: float = 10.0
    run: StraightRunRule = attrs.field(factory=StraightRunRule)
    arc: ArcRule = attrs.field(factory=ArcRule)
    polygon: PolygonRule = attrs.field(factory=PolygonRule)
    onset: float = 0.1
    border: float = 20.0
    apart: float = 0.2
    border_deg: float = 40.0
    smooth_least: float = 1e-3
    smooth_times: float = 2.5
    smooth_most: float = 1e-2
    smooth_depths: float = 1.7
    adopt_least: float = 5e-3
    adopt_least_facets: float = 1e-2
    adopt_times: float = 3.0
    near_least: float = 5e-4
    near_times: float = 0.8

    def scaled(self, ratio: float) -> FeatureRules:
        """Give the rules with every length times a ratio: for the model of a ship."""
        lengths = (
            "onset", "border", "apart", "smooth_least", "smooth_most", "adopt_least",
            "adopt_least_facets", "near_least",
        )  # fmt: skip
        return attrs.evolve(
            self,
            corner=_times(self.corner, ratio, "stretch", "window"),
            chain=_times(self.chain, ratio, "slack"),
            run=_times(self.run, ratio, "within", "least"),
            arc=_times(self.arc, ratio, "within"),
            polygon=_times(self.polygon, ratio, "off", "least", "long", "close", "reach", "spaced"),
            **{name: ratio * getattr(self, name) for name in lengths},
        )


Rule = TypeVar("Rule", CornerRule, ChainRule, StraightRunRule, ArcRule, PolygonRule)


def _times(rule: Rule, ratio: float, *names: str) -> Rule:
    """Multiply lengths of a rule."""
    return attrs.evolve(rule, **{name: ratio * getattr(rule, name) for name in names})


@attrs.frozen(eq=False)
class PieceFeatures:
    """One piece of a line with what was found on it.

    Attributes
    ----------
    line : SliceLine
        The line.
    piece : LinePiece
        The piece.
    points : (n, d), m
        Its points in its plane, or in space.
    noise : float, m
        Scatter of digitised points, or depth of facets.
    allowed : (n,), m
        How far it may be smoothed at each point, in its plane.
    sine : (n,)
        Sine of the angle between plane and hull, 1 where it is not known, 0.1 at least.
    depth : float, m
        How deep facets of the mesh lie inside the hull.
    moved : float, m
        What its ends were moved by to lie on boundary curves.
    corners : tuple of Corner
        Those kept.
    suggested : tuple of Corner
        Those that turn too little and join no knuckle line.
    runs : tuple of StraightRun or None
        Its straight runs, None as long as they were not looked for.
    arcs : tuple of CircularArc
        Its circular arcs, once they were looked for.
    """

    line: SliceLine
    piece: LinePiece
    points: FloatArray
    noise: float
    allowed: FloatArray
    sine: FloatArray
    depth: float = 0.0
    moved: float = 0.0
    corners: tuple[Corner, ...] = ()
    suggested: tuple[Corner, ...] = ()
    runs: tuple[StraightRun, ...] | None = None
    arcs: tuple[CircularArc, ...] = ()


@attrs.frozen(eq=False)
class KnuckleTrace:
    """A knuckle line: its places on lines of one group.

    Attributes
    ----------
    group : str
        Of the lines it was found on.
    lines : tuple of str
        Their names.
    places : (n, 3), m
        Where it crosses them.
    turn_deg : (n,)
        By how much they turn there.
    doubt : (n,), m
        How far each place may lie off along its line, 2 standard deviations.
    """

    group: str
    lines: tuple[str, ...]
    places: FloatArray
    turn_deg: FloatArray
    doubt: FloatArray


def plane_columns(group: str) -> list[int]:
    """Give the coordinates that vary on a line of a group."""
    return [axis for axis in range(3) if axis != AXES.get(group)]


def find_features(
    slices: HullSlices, rules: FeatureRules | None = None
) -> tuple[list[PieceFeatures], list[KnuckleTrace]]:
    """Find noise and knuckles of all pieces of all lines, cut from a mesh or digitised.

    Pieces come in the order of the lines, boundary curves last; knuckle lines by group.
    """
    wanted = rules or FeatureRules()
    found: list[PieceFeatures] = []
    knuckles: list[KnuckleTrace] = []
    for group in ("sections", "waterlines", "buttocks"):
        parts = [
            (line, _bare(line, piece, slices, wanted))
            for line in slices.group(group)
            for piece in line.pieces
        ]
        marks = [marked_corners(part.points, _marks(part, slices, wanted)) for _, part in parts]
        seen = [
            with_marked(_corners(part, slices.facets, wanted), marked)
            for (_, part), marked in zip(parts, marks, strict=True)
        ]
        kept, chains = _choose(slices.group(group), [part for _, part in parts], seen, wanted)
        # `with_marked` puts marked corners first; they stay, whatever they turn by.
        kept |= {(i, j) for i, marked in enumerate(marks) for j in range(len(marked))}
        found += [
            attrs.evolve(
                part,
                corners=tuple(corner for j, corner in enumerate(seen[i]) if (i, j) in kept),
                suggested=tuple(corner for j, corner in enumerate(seen[i]) if (i, j) not in kept),
            )
            for i, (_, part) in enumerate(parts)
        ]
        knuckles += chains
    for line in slices.boundaries:
        for piece in line.pieces:
            part = _bare(line, piece, slices, wanted)
            # Turns are measured in a plane: on a curve in space no corners are looked for.
            plane = part.points.shape[1] == 2
            every = _corners(part, slices.facets, wanted) if plane else []
            # A boundary curve has no neighbours to join a knuckle line with.
            strong = [each for each in every if each.turn_deg >= wanted.alone_deg]
            marked = marked_corners(part.points, _marks(part, slices, wanted)) if plane else []
            found.append(attrs.evolve(part, corners=tuple(with_marked(strong, marked))))
    return found, knuckles


def _columns(line: SliceLine, piece: LinePiece) -> list[int]:
    """Give the axes of the coordinates that vary on a piece: all three on a curve in space."""
    if line.group != "boundary":
        return plane_columns(line.group)
    spread = np.ptp(piece.points, axis=0)
    flat = int(np.argmin(spread))
    return [axis for axis in range(3) if axis != flat or spread[flat] > 1e-3]


def _bare(
    line: SliceLine, piece: LinePiece, slices: HullSlices, rules: FeatureRules
) -> PieceFeatures:
    """Give a piece in its plane, with its noise."""
    columns = _columns(line, piece)
    kept = distinct_points(piece.points[:, columns], 1e-6)
    points = piece.points[kept][:, columns]
    sine = np.ones(len(kept)) if piece.sine is None else np.maximum(piece.sine[kept], 0.1)
    if slices.facets and not piece.closed:
        sides = polygon_corners(points, rules.polygon)
        if sides is not None:
            points, sine = filled_polygon(points, sides, sine, rules.polygon)
    local = local_scatter(points, 6)
    # Points of a mesh lie inside the hull by the depth of its facets, those of a drawing scatter.
    if slices.facets:
        noise = facet_depth(points)
        depths = np.minimum(facet_depths(points), 2.0 * noise)
        most = max(rules.smooth_most, rules.smooth_depths * slices.depth)
        waves = np.minimum(rules.smooth_times * local, most / sine)
        allowed = np.maximum(1.5 * depths, waves)
        least = np.maximum(1.5 * noise, rules.smooth_least / sine)
    else:
        noise = point_scatter(points)
        least = np.full(len(points), max(3.0 * noise, rules.smooth_least))
        allowed = least
    allowed = np.maximum(allowed, least)
    if slices.facets:
        # Where a plane grazes the hull, its cut through facets runs to and fro.
        ahead = forward_points(points, _TO_AND_FRO * allowed)
        points, allowed, sine = points[ahead], allowed[ahead], sine[ahead]
    return PieceFeatures(line, piece, points, noise, allowed, sine, slices.depth)


_TO_AND_FRO = 3.0
"""Where a line runs to and fro it may be moved so many times as far as elsewhere."""


def _marks(part: PieceFeatures, slices: HullSlices, rules: FeatureRules) -> FloatArray:
    """Give the places in its plane where the file marks a knuckle of a piece, (k, 2), m."""
    places = slices.knuckles.get(part.line.name, np.zeros((0, 3)))
    marks = np.asarray(places[:, _columns(part.line, part.piece)])
    if not slices.facets or part.piece.closed or part.points.shape[1] != 2:
        return marks
    corners = polygon_corners(part.points, rules.polygon)
    return marks if corners is None else np.concatenate([marks, part.points[corners]])


def _corners(part: PieceFeatures, facets: bool, rules: FeatureRules) -> list[Corner]:
    if part.piece.closed or len(part.points) < 3:
        return []
    noise = max(0.5 * part.noise, 5e-4) if facets else part.noise
    return find_corners(part.points, noise, rules.corner)


def _choose(
    lines: tuple[SliceLine, ...],
    parts: list[PieceFeatures],
    seen: list[list[Corner]],
    rules: FeatureRules,
) -> tuple[set[tuple[int, int]], list[KnuckleTrace]]:
    """Give the corners to keep, as (piece, corner), and the knuckle lines that they form.

    Kept are corners that join a knuckle line, and sharp ones.
    """
    number = {line.name: i for i, line in enumerate(lines)}
    # A line may be in pieces; a knuckle line goes from line to line, on whichever piece.
    merged: list[list[Corner]] = [[] for _ in lines]
    origin: list[list[tuple[int, int]]] = [[] for _ in lines]
    for i, part in enumerate(parts):
        for j, corner in enumerate(seen[i]):
            merged[number[part.line.name]].append(corner)
            origin[number[part.line.name]].append((i, j))
    offsets = np.array([line.offset for line in lines])
    chains = join_corners(offsets, merged, rules.chain) if len(lines) else []
    kept = {(i, j) for i, corners in enumerate(seen) for j, corner in enumerate(corners)
            if corner.turn_deg >= rules.alone_deg}  # fmt: skip
    found: list[KnuckleTrace] = []
    for chain in chains:
        # They were found by the turn over a stretch; between fitted sides they may turn by less.
        if np.mean([merged[i][j].turn_deg for i, j in chain]) < rules.corner.least_deg:
            continue
        kept |= {origin[i][j] for i, j in chain}
        group = lines[0].group
        places = np.empty((len(chain), 3))
        places[:, plane_columns(group)] = [merged[i][j].place for i, j in chain]
        places[:, AXES[group]] = offsets[[i for i, _ in chain]]
        turns = np.array([merged[i][j].turn_deg for i, j in chain])
        # 2 standard deviations, as `KnuckleTrace` gives it.
        doubt = np.array([2.0 * merged[i][j].uncertainty for i, j in chain])
        names = tuple(lines[i].name for i, _ in chain)
        found.append(KnuckleTrace(group, names, places, turns, doubt))
    return kept, found


# --------------------------------------------------------------------------------------
# Straight runs and circular arcs between corners.


def runs_of(part: PieceFeatures, rules: FeatureRules) -> tuple[StraightRun, ...]:
    """Give the straight runs between the corners of a plane piece; those it holds stay."""
    if part.runs is not None:
        return part.runs
    if part.points.shape[1] != 2 or part.piece.closed:
        return ()
    found: list[StraightRun] = []
    for first, points in _smooth_parts(part):
        found += [_shifted(run, first) for run in find_straight_runs(points, part.noise, rules.run)]
    return tuple(found)


def with_arcs(part: PieceFeatures, rules: FeatureRules) -> PieceFeatures:
    """Give a plane piece, its points as they were given, with the arcs between its corners."""
    found: list[CircularArc] = []
    for first, points in _smooth_parts(part):
        found += [_shifted_arc(arc, first) for arc in find_arcs(points, part.noise, rules.arc)]
    return attrs.evolve(part, arcs=tuple(found))


def _smooth_parts(part: PieceFeatures) -> Iterator[tuple[float, FloatArray]]:
    """Give the parts of a plane piece between its corners, each with its first length, m."""
    if part.points.shape[1] != 2 or part.piece.closed:
        return
    at = cumulative_lengths(part.points)
    edges = [0.0, *(corner.at for corner in part.corners), float(at[-1])]
    for low, high in pairwise(edges):
        inside = (at >= low - 1e-9) & (at <= high + 1e-9)
        if inside.sum() >= 6:
            yield float(at[inside][0]), part.points[inside]


def _shifted(run: StraightRun, by: float) -> StraightRun:
    """Count lengths from the beginning of the whole piece."""
    before, after = _later(run.before, by), _later(run.after, by)
    return attrs.evolve(run, begin=run.begin + by, end=run.end + by, before=before, after=after)


def _shifted_arc(arc: CircularArc, by: float) -> CircularArc:
    before, after = _later(arc.before, by), _later(arc.after, by)
    return attrs.evolve(arc, begin=arc.begin + by, end=arc.end + by, before=before, after=after)


def _later(onset: Onset, by: float) -> Onset:
    return attrs.evolve(onset, at=onset.at + by)


def is_well_known(onset: Onset, noise: float, rules: FeatureRules) -> bool:
    """Tell whether the place of a tangent point is known well enough to split a line there.

    That is where it is known in metres, and where an error along the line moves the line across
    by less than its points scatter.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.straight_runs import Onset
    >>> from assoc_hull.io.slicing.features import FeatureRules
    >>> from assoc_hull.io.slicing.features import is_well_known
    >>> shoulder = Onset("arc", 60.0, np.zeros(2), 120.0, 0.4)
    >>> is_well_known(shoulder, 1e-3, FeatureRules()), is_well_known(shoulder, 1e-4, FeatureRules())
    (True, False)
    """
    if onset.kind != "arc":
        return onset.kind == "border"
    # Moved by u along its tangent, a circle of radius r leaves the line by u^2 / (2 r).
    across = onset.uncertainty**2 / (2.0 * onset.radius)
    return onset.uncertainty < rules.onset or across < noise
