"""The lines of a ship of portions: sections, what bounds them, and where the hull ends flat.

Sections pass all given ordinates. A portion is smooth along itself as the ordinates tell; the
definition bends at every second of them, by a few degrees in a good table, and the spline of the
kernel runs smoothly through. Only corners sharper than a limit stay corners.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.creation.classical.runs import kinds_along
from assoc_hull.creation.classical.sfolds_portion import Portion
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.classical.ordinate_section import OrdinateSection
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

__all__ = [
    "AFT",
    "FORE",
    "Frame",
    "frames_of",
    "lines_of_portions",
    "name_of",
    "section_points",
]

AFT, FORE = "aft end", "fore end"
"""Lines that bound a hull where it ends flat."""

_SAME = 1e-6
"""Places (m) that differ by less are one."""

_PROFILE_CORNER = 30.0
"""Keel, stem and deck edge have a knuckle where chords turn by more than this, degrees."""

_PASSED = 1e-5
"""Lines pass the given points within this, m."""

_NO_CORNER = 1e-6
"""Degrees; by rounding."""

_BETWEEN = 3
"""Where corners stay, so many points are added to each step: areas are kept within 1e-5."""


@attrs.frozen(eq=False)
class Frame:
    """A section of the main body where it stands."""

    x: float
    section: OrdinateSection

    @property
    def is_point(self) -> bool:
        """Whether it has no breadth: the hull ends there on its centre line."""
        return bool((self.section.outline()[:, 0] <= _SAME).all())


def frames_of(portions: Sequence[Portion]) -> tuple[Frame, ...]:
    """Give the sections of the main body from aft forward, those at joints once.

    Parameters
    ----------
    portions : sequence of Portion
        That do not overlap; those beyond the main body are left out.

    Raises
    ------
    GeometryError
        Two portions with different sections where they join, or a portion of areas alone.
    """
    main = sorted((each for each in portions if each.is_main), key=lambda each: each.stations[0])
    found: list[Frame] = []
    for portion in main:
        if not portion.sections:
            what = f"portion {portion.number}: no sections, only areas"
            raise GeometryError(what, "give its sections", {"number": portion.number})
        for x, section in zip(portion.stations.tolist(), portion.sections, strict=True):
            if found and x - found[-1].x <= _SAME:
                _require_same(found[-1].section, section, x)
                continue
            found.append(Frame(x, section))
    return tuple(found)


def _require_same(one: OrdinateSection, two: OrdinateSection, x: float) -> None:
    first, second = one.outline(), two.outline()
    if first.shape == second.shape and np.abs(first - second).max() <= _SAME:
        return
    what = f"sections of two portions differ at x={figure(x)}"
    remedy = "give the same section to both, or leave a step of a spacing between them"
    raise GeometryError(what, remedy, {"x": x})


def lines_of_portions(portions: Sequence[Portion], corner: float) -> tuple[LineSource, ...]:
    """Give the lines of the main body.

    Parameters
    ----------
    portions : sequence of Portion
        As checked.
    corner : float, degrees
        Sections keep corners of the definition that are sharper; at 0 all of them, with more
        points of its parabolas between.

    Returns
    -------
    tuple of LineSource
        Profile, deck edge, flat ends as boundaries; sections.

    Raises
    ------
    GeometryError
        As `frames_of`; fewer than two sections with a breadth, or one without between others.
    """
    frames = frames_of(portions)
    wide = [frame for frame in frames if not frame.is_point]
    if len(wide) < 2:
        what = f"main body: {len(wide)} section(s) with a breadth"
        raise GeometryError(what, "give two or more", {"count": len(wide)})
    inner = [frame.x for frame in frames[1:-1] if frame.is_point]
    if inner:
        what = f"section at x={figure(inner[0])} has no breadth, and the hull goes on beyond"
        raise GeometryError(what, "give it a breadth, or end the hull there", {"x": inner[0]})
    found = [_profile(frames), _deck_edge(frames)]
    found += [
        _section(frame, corner, name_of(frames, k))
        for k, frame in enumerate(frames)
        if not frame.is_point
    ]
    return tuple(found)


def name_of(frames: Sequence[Frame], index: int) -> str:
    """Give the name of the line that a section becomes; the first and the last are flat ends."""
    if index == 0:
        return AFT
    return FORE if index == len(frames) - 1 else f"ST {frames[index].x:g}"


def _profile(frames: Sequence[Frame]) -> LineSource:
    """Run along the keel; up to the deck at ends without breadth."""
    keel = [[frame.x, 0.0, frame.section.keel] for frame in frames]
    if frames[0].is_point:
        keel.insert(0, [frames[0].x, 0.0, frames[0].section.hd])
    if frames[-1].is_point:
        keel.append([frames[-1].x, 0.0, frames[-1].section.hd])
    points = np.array(keel)
    kind, direction = kinds_along(points, _PROFILE_CORNER)
    return LineSource.make(
        "boundary", "profile", points, plane=((0.0, 1.0, 0.0), 0.0), boundary=BoundaryKind.END,
        kind=kind.tolist(), direction=direction, tolerance=_PASSED,
    )  # fmt: skip


def _deck_edge(frames: Sequence[Frame]) -> LineSource:
    """Join the upper ends of the sections."""
    points = np.array([[frame.x, *frame.section.outline()[-1]] for frame in frames])
    kind, direction = kinds_along(points, _PROFILE_CORNER)
    plane = ((0.0, 0.0, 1.0), float(points[0, 2])) if np.ptp(points[:, 2]) <= 1e-9 else None
    return LineSource.make(
        "boundary", "deck edge", points, plane=plane, boundary=BoundaryKind.END,
        kind=kind.tolist(), direction=direction, tolerance=_PASSED,
    )  # fmt: skip


def _section(frame: Frame, corner: float, name: str) -> LineSource:
    """Draw a section; where the hull ends flat it bounds the hull."""
    outline, kind = section_points(frame.section, corner)
    points = np.column_stack([np.full(len(outline), frame.x), outline])
    straight, direction = kinds_along(points, 180.0)
    tangent = (straight == int(PointKind.TANGENT)) & (kind == int(PointKind.SMOOTH))
    kind = np.where(tangent, straight, kind)
    direction = np.where(tangent[:, None], direction, 0.0)
    plane = ((1.0, 0.0, 0.0), frame.x)
    if name in (AFT, FORE):
        return LineSource.make(
            "boundary", name, points, plane=plane, boundary=BoundaryKind.END, kind=kind.tolist(),
            direction=direction, tolerance=_PASSED,
        )  # fmt: skip
    return LineSource.make(
        "sections", name, points, plane=plane, kind=kind.tolist(),
        direction=direction, tolerance=_PASSED,
    )  # fmt: skip


def section_points(section: OrdinateSection, corner: float) -> tuple[FloatArray, IntArray]:
    """Give the points of a section, (n, 2) as y, z in m, and a `PointKind` each.

    Parameters
    ----------
    section : OrdinateSection
        The section.
    corner : float, degrees
        See `lines_of_portions`.
    """
    steps = section.steps()
    before, after = (steps[:-1, 1] + 2.0 * steps[:-1, 2]), steps[1:, 1]
    across = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turn = np.degrees(np.abs(np.arctan2(across, (before * after).sum(axis=1))))
    sharp = np.concatenate([[False], turn > max(corner, _NO_CORNER), [False]])
    kind = np.where(sharp, int(PointKind.KNUCKLE), int(PointKind.SMOOTH))
    if corner > 0.0:
        return section.outline(), kind
    count = _BETWEEN + 1
    u = np.arange(count)[:, None, None] / count
    c0, c1, c2 = steps.transpose(1, 0, 2)
    many = (c0 + u * (c1 + u * c2)).transpose(1, 0, 2).reshape(-1, 2)
    kinds = np.full(len(many) + 1, int(PointKind.SMOOTH))
    kinds[::count] = kind
    return np.concatenate([many, section.outline()[-1:]]), kinds
