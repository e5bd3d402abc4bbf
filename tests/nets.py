"""Nets of hulls with a formula, with the directions of their ends as the formula has them."""

import numpy as np

from assoc_hull.edit.adoption.adopt_lines import adopt
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, Ends, HullState, Particulars
from assoc_hull.shipped.wigley import wigley_half_breadth

__all__ = ["ellipsoid_net", "wigley_net"]

A, B, C = 50.0, 8.0, 6.0
"""Semi-axes of the ellipsoid, m; its centre lies at x = A, z = C."""


def ellipsoid_net(stations: int, girth: int) -> HullState:
    """Give the whole ellipsoid: stations by equal angles, and as many diagonals round.

    `stations` count the two tips; `girth` counts keel and z = 6 m, the diagonals go on at the
    same angles to the top. Every diagonal runs from tip to tip.
    """
    x = A - A * np.cos(np.linspace(0.0, np.pi, stations))
    angle = np.linspace(0.0, np.pi, 2 * girth - 1)
    sources = [_profile(x)]
    sources += [_ring(f"ST {i}", float(x[i]), angle) for i in range(1, stations - 1)]
    sources += [_diagonal(f"DIA {j}", x, float(angle[j])) for j in range(1, len(angle) - 1)]
    links = [
        Association("boundary", "sections"),
        Association("boundary", "diagonals"),
        Association("sections", "diagonals"),
    ]
    return adopt(sources, Particulars("Ellipsoid", 2 * A, 2 * B, 2 * C, C), links)[0]


def _scale(x: FloatArray | float) -> FloatArray:
    """Give the scale of the section at x against that at the middle."""
    return np.sqrt(np.maximum(1.0 - ((np.asarray(x) - A) / A) ** 2, 0.0))


def _ring(name: str, x: float, angle: FloatArray) -> LineSource:
    k = float(_scale(x))
    y, z = B * k * np.sin(angle), C - C * k * np.cos(angle)
    y[[0, -1]] = 0.0
    return LineSource.make(
        "sections", name, np.column_stack([np.full(len(z), x), y, z]),
        ends=Ends((1, 1), ((0.0, 1.0, 0.0), (0.0, -1.0, 0.0))),
    )  # fmt: skip


def _diagonal(name: str, x: FloatArray, angle: float) -> LineSource:
    """From tip to tip in a plane through the axis."""
    k = _scale(x)
    out = np.array([0.0, B * np.sin(angle), -C * np.cos(angle)])
    normal = np.array([0.0, -out[2], out[1]]) / np.hypot(out[1], out[2])
    points = np.column_stack([x, 0.0 * x, np.full(len(x), C)]) + k[:, None] * out
    points[[0, -1]] = [[0.0, 0.0, C], [2.0 * A, 0.0, C]]
    return LineSource.make(
        "diagonals", name, points, plane=(normal, float(normal[2] * C)),
        ends=Ends((1, 1), (tuple(out.tolist()), tuple((-out).tolist()))),
    )  # fmt: skip


def _profile(x: FloatArray) -> LineSource:
    """From the top aft, round the keel, and back to the top."""
    k = _scale(x)
    middle = len(x) // 2
    below = np.column_stack([x, 0.0 * x, C - C * k])
    above = np.column_stack([x, 0.0 * x, C + C * k])
    points = np.concatenate([above[middle:0:-1], below, above[-2 : middle - 1 : -1]])
    return LineSource.make(
        "boundary", "profile", points, plane=((0, 1, 0), 0.0), boundary=BoundaryKind.END,
        ends=Ends((1, 1), ((-1.0, 0.0, 0.0), (-1.0, 0.0, 0.0))),
    )  # fmt: skip


def wigley_net(stations: int, waterlines: int) -> HullState:
    """Give the Wigley hull to z = 1.5 T; lines have the formula's own directions at their ends.

    `stations` count the two ends, `waterlines` the base line and z = T.
    """
    length, breadth, draught = hull = (100.0, 10.0, 6.25)
    x, z = np.linspace(0.0, length, stations), np.linspace(0.0, draught, waterlines)
    deck = 1.5 * draught
    corners = np.array([[0, 0, deck], [0, 0, 0], [length, 0, 0], [length, 0, deck]], np.float64)
    sources = [
        LineSource.make(
            "boundary", "profile", corners, plane=((0, 1, 0), 0.0), boundary=BoundaryKind.END,
            kind=[0, PointKind.KNUCKLE, PointKind.KNUCKLE, 0],
        )
    ]  # fmt: skip
    for height in [*z[1:].tolist(), deck]:
        level = np.full(len(x), height)
        sheer = (
            float(wigley_half_breadth(np.array(0.5 * length), np.array(height), *hull))
            * 4.0
            / length
        )
        sources.append(
            LineSource.make(
                "boundary" if height == deck else "waterlines",
                "deck edge" if height == deck else f"WL {height:g}",
                np.column_stack([x, wigley_half_breadth(x, level, *hull), level]),
                plane=((0, 0, 1), height) if height == deck else None,
                boundary=BoundaryKind.END if height == deck else None,
                ends=Ends((1, 1), ((1.0, sheer, 0.0), (1.0, -sheer, 0.0))),
            )
        )
    sources += [
        _frame(f"ST {i}", float(x[i]), np.append(z, deck), hull) for i in range(1, stations - 1)
    ]
    links = [Association("boundary", "sections"), Association("boundary", "waterlines")]
    links.append(Association("sections", "waterlines"))
    return adopt(sources, Particulars("Wigley", length, breadth, deck, draught), links)[0]


def _frame(name: str, x: float, z: FloatArray, hull: tuple[float, float, float]) -> LineSource:
    """From the keel up; a tangent point where the wall side begins."""
    level = np.full(len(z), x)
    kind = np.zeros(len(z), int)
    kind[-2] = PointKind.TANGENT
    flare = float(wigley_half_breadth(np.array(x), np.array(hull[2]), *hull)) * 2.0 / hull[2]
    return LineSource.make(
        "sections", name, np.column_stack([level, wigley_half_breadth(level, z, *hull), z]),
        kind=kind.tolist(),
        direction=np.where((kind > 0)[:, None], [0.0, 0.0, 1.0], 0.0),
        ends=Ends((1, 1), ((0.0, flare, 1.0), (0.0, 0.0, 1.0))),
    )  # fmt: skip
