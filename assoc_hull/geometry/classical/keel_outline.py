"""The keel of a ship: its contour in the centre plane, and the edge of the flat of bottom.

The contour is given abaft and ahead of the level keel; over the level keel the flat of bottom has
a half-width. All run in straight lines between given points. Source: Kim & Chang, "Some
Representations of Ship Hulls by Mathematical Method for Design and Production", J. SNAK; part III
is taken for the second of the two that have a contour.

Examples
--------
>>> from assoc_hull.geometry.classical.keel_outline import KeelOutline
>>> keel = KeelOutline.make(
...     10, 120, [(0, 8), (5, 3), (10, 0)], [(120, 0), (126, 1.5), (130, 9)],
...     [(10, 0), (30, 7.5), (90, 7.5), (120, 0)],
... )
>>> keel.part([7, 20, 128]).tolist(), keel.height([7, 20, 128]).round(9).tolist()
([1, 2, 3], [1.8, 0.0, 5.25])
>>> keel.flat(20).tolist()
3.75
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["KeelOutline"]

_SAME = 1e-9
"""Places (m) that differ by less are one."""


@attrs.frozen(eq=False)
class KeelOutline:
    """Contour and flat of bottom; x forward, z up from the base line, m.

    Attributes
    ----------
    x_a, x_b : float, m
        Where the level keel begins and ends.
    aft, forward : (n, 2), m
        Rows (x, z), x not decreasing; they come to the level keel at `x_a` and leave it at `x_b`.
        Upright pieces only at an end.
    tangent : (n, 2), m
        Rows (x, b): half-widths of the flat of bottom.
    notes : tuple of str
        A flat of bottom that begins or ends with a step.
    """

    x_a: float
    x_b: float
    aft: FloatArray
    forward: FloatArray
    tangent: FloatArray
    notes: tuple[str, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.aft, self.forward, self.tangent)

    @classmethod
    def make(
        cls, x_a: float, x_b: float, aft: ArrayLike, forward: ArrayLike, tangent: ArrayLike
    ) -> Self:
        """Check what is handed in; arguments as the attributes.

        Raises
        ------
        GeometryError
            ``"contour: x must be non-decreasing (row {i})"``, ``"contour: part {p} must end at
            x={x} with z=0, got z={z}"``, ``"bottom tangent line: negative half-width at row
            {i}"``, ``"bottom tangent line: must cover [{x_a}, {x_b}]"``; an upright piece that is
            not at an end, limits in the wrong order.
        """
        first, last = (float(finite(each, "contour", ())) for each in (x_a, x_b))
        if not first < last:
            raise GeometryError(
                f"contour: the level keel runs from x={figure(first)} to {figure(last)}",
                "give limits in ascending order", {"x_a": first, "x_b": last},
            )  # fmt: skip
        stern = _contour(aft, 1, first)
        stem = _contour(forward, 3, last)
        line = _tangent(tangent, first, last)
        return cls(first, last, stern, stem, line, _steps(line, first, last))

    @property
    def ends(self) -> tuple[float, float]:
        """The least and the greatest x, m."""
        return float(self.aft[0, 0]), float(self.forward[-1, 0])

    def part(self, x: ArrayLike) -> IntArray:
        """Tell the part of each x (m): 1 abaft the level keel, 2 on it, 3 ahead of it.

        Raises
        ------
        GeometryError
            ``"contour: x={x} outside [{a}, {b}]"``, as from all of these.
        """
        place = inside(x, "contour", *self.ends)
        return np.asarray(1 + (place >= self.x_a) + (place > self.x_b), np.int64)

    def height(self, x: ArrayLike) -> FloatArray:
        """Give heights of the keel (m) at x (m); the lower one where it is upright."""
        place, part = inside(x, "contour", *self.ends), self.part(x)
        stern = np.interp(place, *_graph(self.aft, outer=0).T)
        stem = np.interp(place, *_graph(self.forward, outer=-1).T)
        return np.where(part == 1, stern, np.where(part == 3, stem, 0.0))

    def flat(self, x: ArrayLike) -> FloatArray:
        """Give half-widths of the flat of bottom (m) at x (m), 0 off the level keel."""
        place, part = inside(x, "contour", *self.ends), self.part(x)
        return np.where(part == 2, np.interp(place, *self.tangent.T), 0.0)


def _contour(rows: ArrayLike, part: int, end: float) -> FloatArray:
    """Take a contour that comes to the level keel at `end`, its last row aft, its first forward."""
    given = finite(rows, f"contour: part {part}", (None, 2))
    if not len(given):
        raise GeometryError(
            f"contour: part {part} has {len(given)} row(s)", "give one or more", {"part": part}
        )
    step = np.diff(given[:, 0])
    if (step < 0.0).any():
        row = int(np.argmax(step < 0.0)) + 1
        what = f"contour: x must be non-decreasing (row {row})"
        raise GeometryError(what, "put the rows in order from aft", {"row": row, "part": part})
    x, z = given[-1 if part == 1 else 0]
    if abs(x - end) > _SAME or abs(z) > _SAME:
        raise GeometryError(
            f"contour: part {part} must end at x={figure(end)} with z=0, got z={figure(z)}"
            + (f" at x={figure(x)}" if abs(x - end) > _SAME else ""),
            "let it come to the level keel", {"part": part, "x": float(x), "z": float(z)},
        )  # fmt: skip
    upright = (step == 0.0) & (given[1:, 0] != given[0, 0]) & (given[1:, 0] != given[-1, 0])
    if upright.any():
        row = int(np.argmax(upright)) + 1
        what = f"contour: part {part} is upright at row {row}, x={figure(given[row, 0])}"
        raise GeometryError(what, "let it be upright at an end only", {"row": row, "part": part})
    return given


def _graph(contour: FloatArray, outer: int) -> FloatArray:
    """Give the rows of which a height is a function of x: of upright ends one row each.

    At the outer end the lowest row counts; at the inner one the highest: the keel there has the
    level keel for its lower end.
    """
    x, low, high = contour[:, 0], contour[outer, 0], contour[-1 - outer, 0]
    inner = contour[(x > min(low, high)) & (x < max(low, high))]
    ends = [
        (low, contour[x == low, 1].min()), (high, contour[x == high, 1].max()),
    ]  # fmt: skip
    return np.concatenate([[min(ends)], inner, [max(ends)]])


def _tangent(rows: ArrayLike, first: float, last: float) -> FloatArray:
    given = finite(rows, "bottom tangent line", (None, 2))
    negative = np.flatnonzero(given[:, 1] < 0.0)
    if len(negative):
        row = int(negative[0])
        what = f"bottom tangent line: negative half-width at row {row}"
        raise GeometryError(what, "give 0 or more", {"row": row, "b": float(given[row, 1])})
    back = np.flatnonzero(np.diff(given[:, 0]) <= 0.0)
    if len(back):
        row = int(back[0]) + 1
        what = f"bottom tangent line: x must be increasing (row {row})"
        raise GeometryError(what, "put the rows in order from aft", {"row": row})
    if not len(given) or given[0, 0] > first + _SAME or given[-1, 0] < last - _SAME:
        raise GeometryError(
            f"bottom tangent line: must cover [{figure(first)}, {figure(last)}]",
            "give rows from one end of the level keel to the other", {"x_a": first, "x_b": last},
        )  # fmt: skip
    return given


def _steps(tangent: FloatArray, first: float, last: float) -> tuple[str, ...]:
    """Tell of steps in the flat of bottom, where it should close."""
    return tuple(
        f"bottom tangent line: b={figure(width)} at x={figure(x)}, where the level keel {does}: "
        "the flat of bottom has a step there"
        for x, does in ((first, "begins"), (last, "ends"))
        if (width := float(np.interp(x, *tangent.T))) > _SAME
    )
