"""How many hulls stand side by side, and whether one of them is symmetric about its centre plane.

Sections tell: pairs of x and of straight pieces (k, 2, 2) in y and z, m, port and starboard, the
middle of the ship at y = 0. Where two hulls stand, a section below water has no point near y = 0,
and each side comes up through the water twice. Skegs part a section too, but near an end only; a
hull without a bottom comes up once.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.lines.several_hulls import find_hulls
>>> u = np.array([[[-5.0, 2], [-4, 0]], [[-4, 0], [-3, 2]]])
>>> both = np.concatenate([u, u * [-1, 1]])
>>> found = find_hulls([(float(x), both) for x in range(10)], [1.0])
>>> found.count, found.centre
(2, 4.0)
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise
from typing import NoReturn

import attrs
import numpy as np

from assoc_hull.arguments import number, shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.reports import Notebook
from assoc_hull.io.units import METRES

__all__ = [
    "FoundHulls",
    "HullChoice",
    "Section",
    "SectionDifference",
    "find_hulls",
    "largest_difference",
    "refuse_asymmetric",
    "refuse_missing",
    "refuse_several",
    "sections_within",
    "tell_which",
    "top_below_bridge",
    "water_levels",
]

Section = tuple[float, FloatArray]

_NEAR = 0.02
"""A section reaches the centre plane where it has a point this part of the breadth off it."""

_MOST = 0.5
"""Two hulls stand apart over more than this part of the length; skegs do so near an end."""

_OUTRIGGERS = 0.15
"""Hulls outside of one on the centre plane may be short: these count from this part on."""

_PLACE = re.compile(r"([-+]?[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]{1,2})?)\s*([a-z]*)")
"""A number, and a unit behind it."""

_WORDS = {2: "two", 3: "three", 4: "four", 5: "five"}


@attrs.frozen
class HullChoice:
    """What the caller says of the one hull that is meant.

    Attributes
    ----------
    centre : float or str or None
        Where its centre plane lies in the file: a number in the unit of the file, or a text with
        a unit such as "4.2 m", at full scale.
    depth, draught : float or None, m
        Above its lowest place: where a demihull ends and the bridge deck begins; the waterline.
    """

    centre: float | str | None = None
    depth: float | None = None
    draught: float | None = None

    def place(self, factor: float) -> float | None:
        """Give the centre plane in m at full scale; `factor` is m over the unit of the file.

        Raises
        ------
        BadInputError
            The centre is no number, nor one with a unit.
        """
        if self.centre is None:
            return None
        if not isinstance(self.centre, str):
            return factor * number(self.centre, "centre", "as an argument")
        found = _PLACE.fullmatch(self.centre.strip())
        if found is None or (found[2] and found[2] not in METRES):
            raise BadInputError(
                f"centre is {shown(self.centre)}", "as an argument",
                f"give a number in the unit of the file, or with a unit of {', '.join(METRES)}, "
                "as '4.2 m'",
            )  # fmt: skip
        return float(found[1]) * (METRES[found[2]] if found[2] else factor)


def water_levels(low: float, high: float, choice: HullChoice) -> list[float]:
    """Give the heights at which hulls are counted, m; the first is that of the water.

    A bridge deck may hang lower than half the depth: so hulls are counted at half of it too.
    """
    height = choice.draught if choice.draught is not None else 0.5 * (high - low)
    return [low + height, low + 0.5 * height]


# --------------------------------------------------------------------------------------
# Counting.


@attrs.frozen
class FoundHulls:
    """Hulls that stand side by side.

    Attributes
    ----------
    count : int
        How many; 1 also where it is not plain.
    planes : tuple of float, m
        y of the centre planes at y >= 0, rising; of one hull 0.
    bridge : float or None, m
        The lowest height at which the innermost two are joined; None if they are not.
    """

    count: int
    planes: tuple[float, ...] = (0.0,)
    bridge: float | None = None

    @property
    def centre(self) -> float:
        """The centre plane of the hull that is proposed: the outermost to port."""
        return self.planes[-1]

    def limits(self, place: float) -> tuple[float, float]:
        """Give the y between which the hull next to a place stands; infinite outside of all."""
        both = sorted({each for plane in self.planes for each in (plane, -plane)})
        middle = [0.5 * (one + other) for one, other in pairwise(both)]
        every = [-np.inf, *middle, np.inf]
        at = int(np.searchsorted(middle, place))
        return every[at], every[at + 1]


def find_hulls(
    sections: Sequence[Section], levels: Sequence[float], *, oriented: bool = False
) -> FoundHulls:
    """Count the hulls at some heights (m), the first of which is that of the water.

    `oriented` says that pieces run with the outside to their right: then bodies may overlap.
    """
    breadth = 2.0 * max((float(np.abs(part[..., 0]).max()) for _, part in sections), default=0.0)
    for i, level in enumerate(levels):
        rows = [
            (x, *_contour(part, level, _NEAR * breadth, oriented))
            for x, part in sections
            if (part[..., 1] < level).any()
        ]
        count = _count(rows, _OUTRIGGERS if i == 0 else _MOST)
        if count > 1:
            planes = _planes(rows, count)
            # Between the ends of a tunnel: its roof comes down to the bottom where it ends.
            apart = {x for x, many, _ in rows if many == count}
            return FoundHulls(
                count, planes, _bridge([each for each in sections if each[0] in apart], planes)
            )
    return FoundHulls(1)


def _contour(part: FloatArray, level: float, near: float, oriented: bool) -> tuple[int, FloatArray]:
    """Give how many hulls a section shows, and where it comes up to port of the centre plane."""
    (y, z), below = (part[..., 0], part[..., 1]), part[..., 1] < level
    cut = below[:, 0] != below[:, 1]
    step = np.where(cut, z[:, 1] - z[:, 0], 1.0)
    at = y[:, 0] + (level - z[:, 0]) / step * (y[:, 1] - y[:, 0])
    # What is above the water goes: a piece that comes up ends there.
    wet = np.where(below, y, at[:, None])[below.any(axis=1)]
    there = bool(((wet.min(axis=1) <= near) & (wet.max(axis=1) >= -near)).any())
    mine = cut & (at > near)
    order = np.argsort(at[mine])
    port = at[mine][order]
    if oriented:
        # From outside in: each piece that runs up leads into a body, one that runs down out of it.
        up = np.where(z[mine, 1] > z[mine, 0], 1, -1)[order]
        inside = np.append(np.cumsum(up[::-1])[::-1] != 0, False)
        port = port[inside[:-1] != inside[1:]]
    beside = 2 * ((len(port) - 1) // 2) if there else 2 * (len(port) // 2)
    return beside + there, port


def _count(rows: Sequence[tuple[float, int, FloatArray]], short: float) -> int:
    """Give the number that most of the length shows, or, on a hull in the middle, a part of it."""
    if len(rows) < 3:
        return 1
    x, count = np.array([row[0] for row in rows]), np.array([row[1] for row in rows])
    share = np.abs(np.gradient(x))
    share /= share.sum()
    most = int(count.max())
    for many in range(most, 1, -1):
        beside = share[count >= many].sum()
        if beside > (short if many % 2 else _MOST):
            return many
    return 1


def _planes(rows: Sequence[tuple[float, int, FloatArray]], count: int) -> tuple[float, ...]:
    odd = count % 2
    good = [port for _, many, port in rows if many == count]
    pairs = [
        float(np.median([0.5 * (port[i] + port[i + 1]) for port in good]))
        for i in range(odd, odd + 2 * (count // 2), 2)
    ]
    return (0.0, *pairs) if odd else tuple(pairs)


def _bridge(sections: Sequence[Section], planes: tuple[float, ...]) -> float | None:
    """Give the lowest height between the two innermost hulls, m."""
    middle = 0.0 if planes[0] > 0.0 else 0.5 * planes[1]
    heights = []
    for _, part in sections:
        y, z = part[..., 0] - middle, part[..., 1]
        cut = (y[:, 0] < 0.0) != (y[:, 1] < 0.0)
        if cut.any():
            share = y[cut, 0] / (y[cut, 0] - y[cut, 1])
            heights.append(float((z[cut, 0] + share * (z[cut, 1] - z[cut, 0])).min()))
        # Of half a ship the bridge deck ends in the centre plane and does not cross it.
        ends = z[np.abs(y) < 1e-9]
        heights += [float(ends.min())] if len(ends) else []
    return min(heights, default=None)


def refuse_several(found: FoundHulls, place: str, low: float, where: str) -> None:
    """Refuse hulls side by side; `place` is the centre that is proposed, `low` the lowest height.

    Raises
    ------
    BadInputError
        There are two or more.
    """
    if found.count == 1:
        return
    words = _WORDS.get(found.count, str(found.count))
    remedy = f"give one {'demihull' if found.count == 2 else 'hull'} with centre={place}"
    if found.bridge is not None:
        remedy += f" and depth={_rounded_down(found.bridge - low)}, below the bridge deck"
    raise BadInputError(f"there are {words} hulls side by side", where, remedy)


def _rounded_down(height: float) -> str:
    """Give a height to the centimetre of a ship, and not above it."""
    step = 10.0 ** (np.floor(np.log10(max(height, 1e-6))) - 2.0)
    return f"{np.floor(height / step + 1e-9) * step:.6g}"


# --------------------------------------------------------------------------------------
# What the one that is meant has for itself, be it of lines or of a mesh.


def sections_within(sections: Sequence[Section], limits: tuple[float, float]) -> list[Section]:
    """Give the pieces of sections that lie between two y, without the sections that have none."""
    found = []
    for x, part in sections:
        middle = part[..., 0].mean(axis=1)
        mine = np.asarray(part[(middle > limits[0]) & (middle < limits[1])])
        if len(mine):
            found.append((x, mine))
    return found


def top_below_bridge(
    found: FoundHulls, low: float, choice: HullChoice, where: str, book: Notebook
) -> float:
    """Give the height at which the hull ends, m: below a bridge deck; infinite without one."""
    if found.bridge is None:
        return np.inf
    depth = choice.depth
    if depth is None:
        depth = found.bridge - low
        what = f"the bridge deck begins {depth:.4g} m high; the hull is taken to end there"
        book.assume("depth", where, f"{what}, unless depth= is given", depth)
    what = f"what lies higher than {depth:.4g} m is cut off"
    book.repair("bridge deck", where, what, depth)
    return low + depth


def refuse_missing(centre: float, proposed: float, where: str) -> NoReturn:
    """Refuse a centre plane about which there is no hull; both places in the unit of the file.

    Raises
    ------
    BadInputError
        Always.
    """
    raise BadInputError(
        f"there is no hull at centre={centre:.7g}", f"in {where}",
        f"give the centre plane of one, as {proposed:.7g}",
    )  # fmt: skip


def tell_which(found: FoundHulls, place: float, centre: float, where: str, book: Notebook) -> None:
    """Tell which of several is read, by its place in the file; `centre` is that in m."""
    if found.count > 1:
        what = f"of {found.count} hulls side by side that at {place:.7g} is read"
        book.assume("one hull", where, what, centre)


# --------------------------------------------------------------------------------------
# Symmetry of the one that is meant.

_LEVEL = 1e-6
"""Places nearer than this (m) in height are on one level."""

_POINTS = 200
"""Points of a section whose mirror images are compared, at most."""


@attrs.frozen
class SectionDifference:
    """Where a hull differs most from its mirror image: how far (m), and the place (m)."""

    amount: float
    x: float
    z: float


def largest_difference(sections: Sequence[Section], centre: float, top: float) -> SectionDifference:
    """Compare each section below `top` with its mirror image at y = `centre`, m."""
    worst = SectionDifference(0.0, 0.0, 0.0)
    for x, part in sections:
        points = part.reshape(-1, 2)
        # A bridge deck that begins just there is none of the hull.
        points = points[points[:, 1] < top - _LEVEL]
        points = points[:: 1 + len(points) // _POINTS] * [-1.0, 1.0] + [2.0 * centre, 0.0]
        if len(points):
            away = _distances(points, part)
            at = int(away.argmax())
            if away[at] > worst.amount:
                worst = SectionDifference(float(away[at]), x, float(points[at, 1]))
    return worst


def _distances(points: FloatArray, part: FloatArray) -> FloatArray:
    """Give how far points (n, 2) are from the nearest of straight pieces, (n,)."""
    start, step = part[:, 0], part[:, 1] - part[:, 0]
    square = np.maximum((step * step).sum(axis=1), 1e-300)
    off = points[:, None] - start
    along = np.clip((off * step).sum(axis=2) / square, 0.0, 1.0)
    away = off - along[..., None] * step
    return np.asarray(np.sqrt((away * away).sum(axis=2).min(axis=1)))


def refuse_asymmetric(
    sections: Sequence[Section],
    centre: float,
    top: float,
    noise: float,
    shown_place: tuple[float, float],
    where: str,
) -> None:
    """Refuse a hull that is not symmetric about its centre plane within noise, m.

    `shown_place` is the unit of messages: y of the file is a * y + b.

    Raises
    ------
    BadInputError
        It is symmetric about another plane, which is named, or about none.
    """
    worst = largest_difference(sections, centre, top)
    if worst.amount <= noise:
        return
    a, b = shown_place
    said = f"the hull is not symmetric about centre={a * centre + b:.7g}"
    much = f"it differs from its mirror image by up to {worst.amount:.4g} m"
    much += f" (at x = {worst.x:.4g} m, {worst.z:.4g} m high)"
    every = np.concatenate([part.reshape(-1, 2) for _, part in sections])
    wet = every[every[:, 1] < top - _LEVEL]
    better = 0.5 * float(wet[:, 0].min() + wet[:, 0].max())
    if largest_difference(sections, better, top).amount <= noise:
        raise BadInputError(
            f"{said}: {much}", where, f"its centre plane is there: give centre={a * better + b:.7g}"
        )
    alike = _alike_up_to(sections, centre, top, noise)
    low = float(every[:, 1].min())
    remedy = "asymmetric demihulls are not taken"
    if alike - low > 0.3 * (top - low):
        remedy = f"if the bridge deck begins there, give depth={_rounded_down(alike - low)}"
    raise BadInputError(f"{said}: {much}", where, remedy)


def _alike_up_to(sections: Sequence[Section], centre: float, top: float, noise: float) -> float:
    """Give the greatest height up to which a hull is symmetric, m, by halving."""
    low = float(min(part[..., 1].min() for _, part in sections))
    good, bad = low, top
    for _ in range(12):
        middle = 0.5 * (good + bad)
        if largest_difference(sections, centre, middle).amount <= noise:
            good = middle
        else:
            bad = middle
    return good
