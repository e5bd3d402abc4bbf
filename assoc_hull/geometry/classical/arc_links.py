"""Single arcs and biarcs of chains as arc records; neighbours of one circle become one arc.

A link is what a chain is made of: a straight line, an arc or a biarc over a stretch of a piece.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.classical.arc_beam import Chain
from assoc_hull.geometry.classical.arc_pieces import Pieces
from assoc_hull.geometry.classical.arc_ratio import biarcs_by_ratio
from assoc_hull.geometry.classical.arcs import Arcs, sinc
from assoc_hull.geometry.classical.checks import wrap
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["Links", "merged"]

_SAME = 1e-10
"""m, rad: arcs that one arc replaces may leave it, and turn from it, by no more."""
_STRAIGHT = 1e-11  # rad
_MOST_TURN = 3.0  # rad: a longer arc is not told by its ends well


@attrs.frozen(eq=False)
class Links:
    """Links of many pieces, in order.

    Attributes
    ----------
    piece : (n,) int
        The piece of each.
    low, high : (n,)
        Parameters of the piece.
    arcs : Arcs
        Their arcs.
    arc : (n, 2) int
        First and last arc of each, the same one but for biarcs.
    """

    piece: IntArray
    low: FloatArray
    high: FloatArray
    arcs: Arcs
    arc: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.piece, self.low, self.high, self.arc)

    @classmethod
    def of(cls, pieces: Pieces, chains: dict[int, Chain]) -> Self:
        """Make the records of chains by piece; straight pieces need none.

        Parameters
        ----------
        pieces : Pieces
            The curves.
        chains : dict of int to Chain
            Of pieces that are not straight; those without are left out.
        """
        rows = [i for i in range(len(pieces)) if pieces.straight[i] or i in chains]
        parts = [chains[i] if i in chains else _line(pieces, i) for i in rows]
        piece = np.repeat(np.array(rows, np.int64), [len(each.ratio) for each in parts])
        cut = {
            "low": [each.w[:-1] for each in parts], "high": [each.w[1:] for each in parts],
            "begin": [each.angle[:-1] for each in parts],
            "end": [each.angle[1:] for each in parts], "ratio": [each.ratio for each in parts],
        }  # fmt: skip
        low, high, begin, end, ratio = (
            np.concatenate([*each, np.zeros(0)]) for each in cut.values()
        )
        arcs, arc = _records(pieces, piece, (low, high), (begin, end), ratio)
        return cls(piece, low, high, arcs, arc)


def _line(pieces: Pieces, row: int) -> Chain:
    ends = np.array([pieces.first[row], pieces.stop[row]], np.float64)
    return Chain(ends, pieces.angle[row].copy(), np.array([np.nan]))


def _records(
    pieces: Pieces, piece: IntArray, w: tuple[FloatArray, FloatArray],
    angle: tuple[FloatArray, FloatArray], ratio: FloatArray,
) -> tuple[Arcs, IntArray]:  # fmt: skip
    """Give the arcs of links, and the first and last of each."""
    begin, end = (pieces.at(piece, each) for each in w)
    step = end - begin
    chord, course = np.hypot(step[:, 0], step[:, 1]), np.arctan2(step[:, 1], step[:, 0])
    alpha, beta = (wrap(each - course) for each in angle)
    pair = np.isfinite(ratio)
    count = np.where(pair, 2, 1)
    last = np.cumsum(count) - 1
    first = last - count + 1
    start = np.empty((int(count.sum()), 2))
    way, bend, length = (np.empty(len(start)) for _ in range(3))
    one = first[~pair]
    start[one], way[one] = begin[~pair], angle[0][~pair]
    bend[one] = -2.0 * np.sin(alpha[~pair]) / chord[~pair]
    length[one] = chord[~pair] / sinc(alpha[~pair])
    made = biarcs_by_ratio(chord[pair], alpha[pair], beta[pair], ratio[pair])
    cosine, sine = np.cos(course[pair]), np.sin(course[pair])
    x, y = made.join
    join = begin[pair] + np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=1)
    for arc, place, direction, k in (
        (first[pair], begin[pair], angle[0][pair], 0),
        (last[pair], join, course[pair] + made.tau, 1),
    ):
        start[arc], way[arc], bend[arc], length[arc] = (
            place, direction, made.bend[k], made.length[k]
        )  # fmt: skip
    bend[np.abs(bend * length) < _STRAIGHT] = 0.0
    return Arcs(start, wrap(way), bend, length), np.stack([first, last], axis=1)


def merged(arcs: Arcs, group: IntArray) -> tuple[Arcs, IntArray]:
    """Put neighbours that lie on one circle or line together.

    Parameters
    ----------
    arcs : Arcs
        In order.
    group : (n,) int
        Arcs of different groups stay apart.

    Returns
    -------
    arcs : Arcs
        Fewer, or as many.
    first : (k,) int
        The first of the given arcs in each.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.arc_links import merged
    >>> from assoc_hull.geometry.classical.arcs import Arcs
    >>> one = Arcs.make([[0, 0]], [0.0], [0.5], [2.0])
    >>> join = one.at(np.array([0]), [0.5])[0]
    >>> both = Arcs.make([[0, 0], join], [0, 0.25], [0.5, 0.5], [0.5, 1.5])
    >>> len(merged(both, np.zeros(2, int))[0])
    1
    """
    if not len(arcs):
        return arcs, np.zeros(0, np.int64)
    ends, turned = arcs.ends(), arcs.end_angles()
    both = arcs.length[:-1] + arcs.length[1:]
    step = np.abs(np.diff(arcs.curvature)) * both
    same = (np.diff(group) == 0) & (step < _SAME) & (step * both < 8.0 * _SAME)
    same &= np.abs(wrap(turned[:-1] - arcs.angle[1:])) < _SAME
    first = np.flatnonzero(np.append(True, ~same))
    turn = np.add.reduceat(arcs.curvature * arcs.length, first)
    if (np.abs(turn) > _MOST_TURN).any():
        # A circle that closes: every arc of it stays as it is.
        wide = np.repeat(np.abs(turn) > _MOST_TURN, np.diff(np.append(first, len(arcs))))
        first = np.flatnonzero(np.append(True, ~same | wide[1:]))
        turn = np.add.reduceat(arcs.curvature * arcs.length, first)
    last = np.append(first[1:], len(arcs)) - 1
    alone = first == last
    chord_step = ends[last] - arcs.start[first]
    chord = np.hypot(chord_step[:, 0], chord_step[:, 1])
    course = np.arctan2(chord_step[:, 1], chord_step[:, 0])
    angle, bend, length = course - 0.5 * turn, 2.0 * np.sin(0.5 * turn) / chord, chord
    length = length / sinc(0.5 * turn)
    return (
        Arcs(
            arcs.start[first],
            np.where(alone, arcs.angle[first], wrap(angle)),
            np.where(alone, arcs.curvature[first], bend),
            np.where(alone, arcs.length[first], length),
        ),
        first,
    )
