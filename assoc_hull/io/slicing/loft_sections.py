"""Longitudinal lines through the sections of a hull that is given by sections alone.

BRITFAIR, GHS and DELFTship files hold sections and nothing else, drawings often a profile too. A
net of them has no ends and nothing between two sections, so the profile, the deck edge and some
waterlines are lofted through them, as a loftsman draws them: the profile through the feet of the
sections, the deck edge through their heads, waterlines through the places where they reach a
height. They are fair curves through what is given; between two sections they are a guess, and it is
told.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.slicing.loft_sections import loft_sections
>>> from assoc_hull.model.line_source import LineSource
>>> z = np.linspace(0.0, 6.0, 9)
>>> sections = []
>>> for x in np.linspace(0.0, 100.0, 11):
...     y = 5.0 * (1.0 - (x / 50.0 - 1.0) ** 2) * (1.0 - (1.0 - z / 6.0) ** 2)
...     points = np.column_stack([np.full(9, x), y, z])
...     sections.append(LineSource.make("sections", f"ST {x:g}", points))
>>> lofted = loft_sections(sections, 4.0, 0.005)
>>> lofted.posts
('ST 0', 'ST 100')
>>> [line.name for line in lofted.lines][:3]
['profile', 'deck edge', 'WL 0.094']
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.surface_layout import BROAD_END, NEAR_END
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.polylines.operations import runs_where
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.io.lines.raw_lines import plane_name
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.slicing.cut_planes import propose_places
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource, line_curve_data

__all__ = ["LoftedSections", "is_bare", "loft_sections"]

# Lengths of this module are those of hulls of 100 m and more, and less in proportion for others.

_CENTRE = 1e-3
"""Points this close (m) to the centre plane lie in it."""

_ABAFT = 0.05
"""An immersed end farther (m) forward of the AP than this is where sections end, not the hull."""

_WATERLINES = 13
"""How many are lofted between keel and deck edge."""

_LEAST = 5
"""Fewer sections than this do not tell how a longitudinal line runs."""

_FLATTEST = 0.1
"""Where a section rises at a smaller sine a waterline's place on it is a guess."""

_SHEER = 0.3
"""Where a drawn profile ends farther above or below the last section's head, of the depth, the deck
does not end with it."""

_EQUAL = 0.2
"""Places that differ by less than this part of the tolerance are equal: the line is straight."""


@attrs.frozen(eq=False)
class LoftedSections:
    """What was lofted.

    Attributes
    ----------
    lines : tuple of LineSource
        Profile, deck edge, waterlines, and the edge of the transom if there is one.
    transom : str or None
        The section that is the edge of the transom, and no section any more.
    posts : tuple of str
        Sections in the centre plane: plumb ends, which are parts of the profile.
    """

    lines: tuple[LineSource, ...]
    transom: str | None
    posts: tuple[str, ...]


def is_bare(slices: HullSlices) -> bool:
    """Tell whether a hull is given by sections alone, or by these and the profile."""
    return (
        not slices.facets
        and all(line.name == "profile" for line in slices.boundaries)
        and {line.group for line in slices.lines} == {"sections"}
    )


def loft_sections(
    sources: Sequence[LineSource],
    draught: float | None,
    tolerance: float,
    factor: float = 1.0,
) -> LoftedSections | None:
    """Loft longitudinal lines through sections.

    Parameters
    ----------
    sources : sequence of LineSource
        The sections, upward, and the profile if it is drawn; others are passed over.
    draught : float or None, m
        Of the design: below it an end that lies forward of the AP is not the hull's.
    tolerance : float, m
        How far a line may pass the sections, measured across the hull.
    factor : float
        Of lengths, by the size of the hull.

    Returns
    -------
    LoftedSections or None
        None where the sections do not tell enough: few of them, sections in several curves, as
        through a bulb, or such as do not begin in the centre plane; a profile in several curves.
    """
    chosen = [each for each in sources if each.group == "sections"]
    ordered = sorted(chosen, key=lambda each: each.offset)
    names = [each.name for each in ordered]
    near = factor * _CENTRE
    posts = [each for each in ordered if np.abs(each.points[:, 1]).max() <= near]
    whole = [each for each in ordered if np.abs(each.points[:, 1]).max() > near]
    if len(set(names)) < len(names) or len(whole) < _LEAST or not _at_ends(posts, whole):
        return None
    if any(abs(each.points[0, 1]) > near or each.points[-1, 1] <= near for each in whole):
        return None
    drawn = [each for each in sources if each.group == "boundary" and each.name == "profile"]
    if len(drawn) > 1:
        return None
    if drawn:
        return _along_profile(drawn[0], whole, posts, tolerance, factor)
    aft, fore = _post(posts, whole[0].offset, -1), _post(posts, whole[-1].offset, 1)
    widest = max(float(each.points[:, 1].max()) for each in whole)
    spacing = whole[1].offset - whole[0].offset
    transom = None if aft is not None else _transom(whole[0], draught, factor, widest, spacing)
    profile = _profile(whole, aft, fore, tolerance)
    lines = [profile, _deck_edge(whole, aft, fore, tolerance)]
    lines += _waterlines(whole, profile, tolerance, factor)
    return _with_transom(lines, transom, posts)


def _along_profile(
    profile: LineSource, whole: list[LineSource], posts: list[LineSource], tolerance: float,
    factor: float,
) -> LoftedSections | None:  # fmt: skip
    """Loft deck edge and waterlines between a profile that is drawn and the sections."""
    aft, fore = sorted((profile.points[0], profile.points[-1]), key=lambda each: float(each[0]))
    tall = max(float(np.ptp(each.points[:, 2])) for each in whole)
    heads = [each.points[-1] for each in whole]
    near = factor * _ABAFT
    # A profile that comes to the foot of the last section ends there, and so does the hull.
    last = whole[0].points[0]
    transom = whole[0] if float(np.abs(aft - last)[[0, 2]].max()) <= near else None
    for end, sign in ((aft, -1.0), (fore, 1.0)):
        if end is aft and transom is not None:
            continue
        beside = heads[0 if end is aft else -1]
        beyond = sign * float(end[0] - beside[0])
        if beyond <= near or abs(float(end[2] - beside[2])) > _SHEER * tall:
            return None
        heads.insert(0 if end is aft else len(heads), np.array([end[0], 0.0, end[2]]))
    xyz = np.array(heads)
    deck = _boundary("deck edge", xyz, _straight(xyz, tolerance), tolerance, plane=False)
    lines = [deck, *_waterlines(whole, profile, tolerance, factor)]
    return _with_transom(lines, transom, posts)


def _with_transom(
    lines: list[LineSource], transom: LineSource | None, posts: list[LineSource]
) -> LoftedSections:
    """Put the section that is the edge of the transom, if one is, among the boundary curves."""
    if transom is not None:
        lines = [
            *lines,
            attrs.evolve(
                transom, group="boundary", family="boundary", name="transom",
                boundary=BoundaryKind.END,
            ),
        ]  # fmt: skip
    left = None if transom is None else transom.name
    return LoftedSections(tuple(lines), left, tuple(each.name for each in posts))


def _at_ends(posts: list[LineSource], whole: list[LineSource]) -> bool:
    """Tell whether sections in the centre plane stand at the ends, one at each at most."""
    aft = [each for each in posts if each.offset < whole[0].offset]
    fore = [each for each in posts if each.offset > whole[-1].offset]
    return len(aft) <= 1 and len(fore) <= 1 and len(aft) + len(fore) == len(posts)


def _post(posts: list[LineSource], x: float, side: int) -> LineSource | None:
    """Give the post aft (side -1) or forward (1) of a place, m."""
    return next((each for each in posts if side * (each.offset - x) > 0.0), None)


def _transom(
    section: LineSource, draught: float | None, factor: float, widest: float, spacing: float
) -> LineSource | None:
    """Give the aftmost section if it is a transom, None where the hull goes on abaft of it."""
    under = section.points[section.points[:, 2] < (np.inf if draught is None else draught)]
    immersed = draught is not None and len(under) > 0
    broad = len(under) > 0 and float(under[:, 1].max()) >= BROAD_END * widest
    # Farther off than half a spacing a section may be missing.
    far = section.offset > (NEAR_END * spacing if broad else factor * _ABAFT)
    goes_on = immersed and far
    return None if goes_on else section


# --------------------------------------------------------------------------------------
# Boundary curves.


def _profile(
    whole: list[LineSource], aft: LineSource | None, fore: LineSource | None, tolerance: float
) -> LineSource:
    """Draw the profile through the feet of the sections, down and up the posts."""
    feet = np.array([each.points[0] for each in whole])
    feet[:, 1] = 0.0
    kind = _straight(feet, tolerance)
    parts, kinds = [feet], [kind]
    for post, behind in ((aft, False), (fore, True)):
        if post is None:
            continue
        points, corner = _post_points(post, feet[-1 if behind else 0], upward=behind)
        at = len(parts) if behind else 0
        parts.insert(at, points)
        kinds.insert(at, corner)
    xyz, kind = np.concatenate(parts), np.concatenate(kinds)
    return _boundary("profile", xyz, kind, tolerance, plane=True)


def _post_points(
    post: LineSource, foot: FloatArray, *, upward: bool
) -> tuple[FloatArray, IntArray]:
    """Give a post as points along the profile, with a corner where it stands on the keel."""
    heights = np.sort(post.points[:, 2])
    low, high = float(heights[0]), float(heights[-1])
    points = np.array([[post.offset, 0.0, z] for z in (low, 0.5 * (low + high), high)])
    kind = np.array([PointKind.KNUCKLE, PointKind.SMOOTH, PointKind.SMOOTH], np.int64)
    return (points, kind) if upward else (points[::-1].copy(), kind[::-1].copy())


def _deck_edge(
    whole: list[LineSource], aft: LineSource | None, fore: LineSource | None, tolerance: float
) -> LineSource:
    """Draw the deck edge through the heads of the sections, from and to the tops of posts."""
    heads = [each.points[-1] for each in whole]
    if aft is not None:
        heads.insert(0, _top(aft))
    if fore is not None:
        heads.append(_top(fore))
    xyz = np.array(heads)
    return _boundary("deck edge", xyz, _straight(xyz, tolerance), tolerance, plane=False)


def _top(post: LineSource) -> FloatArray:
    return np.array([post.offset, 0.0, float(post.points[:, 2].max())])


def _boundary(
    name: str, xyz: FloatArray, kind: IntArray, tolerance: float, *, plane: bool
) -> LineSource:
    """Give a boundary curve; where it is straight it is so along the ship."""
    way = np.zeros_like(xyz)
    way[kind == PointKind.TANGENT, 0] = 1.0
    return LineSource.make(
        "boundary", name, xyz, kind=kind.tolist(), direction=way, tolerance=0.2 * tolerance,
        plane=(np.array([0.0, 1.0, 0.0]), 0.0) if plane else None, boundary=BoundaryKind.END,
    )  # fmt: skip


def _straight(xyz: FloatArray, tolerance: float) -> IntArray:
    """Give kinds of points: tangent at the ends of runs along the ship of three equal places.

    Through a run that ends in a bend a spline would swing; none ends at the first or last point.
    """
    kind = np.full(len(xyz), int(PointKind.SMOOTH), np.int64)
    near = np.abs(np.diff(xyz[:, 1:], axis=0)) < _EQUAL * tolerance
    same: NDArray[np.bool_] = np.asarray(near.all(axis=1))
    for first, last in runs_where(same).tolist():
        if last - first < 2:
            continue
        if first > 0:
            kind[first] = PointKind.TANGENT
        if last < len(xyz) - 1:
            kind[last] = PointKind.TANGENT
    return kind


# --------------------------------------------------------------------------------------
# Waterlines.


def _waterlines(
    whole: list[LineSource], profile: LineSource, tolerance: float, factor: float
) -> list[LineSource]:
    """Loft waterlines from the keel to the lowest place of the deck edge."""
    low = min(float(each.points[:, 2].min()) for each in whole)
    high = min(float(each.points[-1, 2]) for each in whole)
    if high <= low:
        return []
    splines = loft(line_curve_data(whole))
    contour = loft(line_curve_data([profile]))
    places = propose_places(low, high, _WATERLINES, dense=True, factor=factor)
    found = [_waterline(splines, whole, contour, z, tolerance) for z in places.tolist()]
    return [each for each in found if each is not None]


def _waterline(
    splines: SplineBatch,
    whole: list[LineSource],
    contour: SplineBatch,
    z: float,
    tolerance: float,
) -> LineSource | None:
    """Loft one waterline, at its outermost place of each section; None where few reach it."""
    up = np.array([0.0, 0.0, 1.0])
    cut = intersect_planes(splines, up, np.array([z]))
    outermost: dict[int, int] = {}
    for i in np.argsort(cut.xyz[:, 1], kind="stable").tolist():
        outermost[int(cut.curve[i])] = i
    rows = np.array([outermost[k] for k in sorted(outermost)], np.int64)
    numbers = cut.curve[rows]
    # Sections without the height between such as have it: a hollow keel, of which nobody knows.
    if len(rows) < _LEAST or len(rows) != int(np.ptp(numbers)) + 1:
        return None
    xyz = cut.xyz[rows].copy()
    xyz[:, 0] = [whole[k].offset for k in numbers.tolist()]
    slope = derivative(splines, numbers, cut.t[rows])
    rise = np.abs(slope[:, 2]) / np.sqrt((slope * slope).sum(axis=1))
    near = tolerance / np.maximum(rise, _FLATTEST)
    kind = _straight(xyz, tolerance)
    ends = intersect_planes(contour, up, np.array([z])).xyz
    abaft, ahead = ends[ends[:, 0] < xyz[0, 0]], ends[ends[:, 0] > xyz[-1, 0]]
    least = tolerance
    if len(abaft):
        xyz, kind = np.vstack([abaft[np.argmax(abaft[:, 0])], xyz]), np.append(0, kind)
        near = np.append(least, near)
    if len(ahead):
        xyz, kind = np.vstack([xyz, ahead[np.argmin(ahead[:, 0])]]), np.append(kind, 0)
        near = np.append(near, least)
    way = np.zeros_like(xyz)
    way[kind == PointKind.TANGENT, 0] = 1.0
    xyz[:, 2] = z
    apart = np.append(True, np.linalg.norm(np.diff(xyz, axis=0), axis=1) > tolerance)
    return LineSource.make(
        "waterlines", plane_name("waterlines", z), xyz[apart], kind=kind[apart].tolist(),
        direction=way[apart], tolerance=near[apart],
    )  # fmt: skip
