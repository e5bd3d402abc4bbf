"""Plane curves as chains of few arcs within a tolerance, tangents without a break.

Curves are cut at corners and straight runs (`arc_pieces`), pieces become chains (`arc_beam`),
these arc records (`arc_links`), and every chain is measured against its curve both ways on ten
times as many places as the search used (`arc_check`). A piece that does not keep the tolerance
there is searched again with more places.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.arc_fit import fit_arcs
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.segments import power
>>> from assoc_hull.geometry.splines.loft import loft
>>> x = np.linspace(0.0, 10.0, 6)
>>> curve = loft(CurveData.single(np.stack([x, np.sin(0.5 * x), 0.0 * x], axis=1)))
>>> fit = fit_arcs(power(curve)[:, :, :2], np.array([0, 5]), within=0.001)
>>> len(fit.arcs), bool(fit.deviation.max() <= 0.001)
(11, True)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_beam import Chain, chains
from assoc_hull.geometry.classical.arc_check import Apart, apart
from assoc_hull.geometry.classical.arc_links import Links, merged
from assoc_hull.geometry.classical.arc_pieces import Pieces
from assoc_hull.geometry.classical.arc_trials import Limits
from assoc_hull.geometry.classical.arcs import Arcs
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["ArcFit", "fit_arcs"]

_SAMPLES = 24
_DENSER = 10
_MARGIN = 0.98
"""The search keeps this part of the tolerance; the rest is for what lies between its places."""
_FLAT = 0.002
"""A straight run leaves its chord by no more than this part of the tolerance,"""
_FLATTEST = 1e-5
"""and m: what is straight does not depend on how coarse arcs may be."""
_AGAIN = 4


@attrs.frozen(eq=False)
class ArcFit:
    """Chains of arcs.

    Attributes
    ----------
    arcs : Arcs
        Of all curves, in order.
    start : (m + 1,) int
        Where those of each curve begin.
    smooth : (n,) bool
        Whether an arc begins in the direction in which the one before it ends; false at the
        beginning of a curve and at corners.
    deviation : (m, 2), m
        Largest distance of the curve from its arcs, and of the arcs from their curve.
    place : (m, 2), m
        The place on each curve that is farthest.
    stuck : (m,) bool
        Curves of which no arcs could be made within the limits; these have none.
    sharpest : (m, 3)
        Where a curve is bent most, of such curves: the place (m) and the radius (m); else nan.
    """

    arcs: Arcs
    start: IntArray
    smooth: np.typing.NDArray[np.bool_]
    deviation: FloatArray
    place: FloatArray
    stuck: np.typing.NDArray[np.bool_]
    sharpest: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.smooth, self.deviation, self.place, self.stuck, self.sharpest)

    def of(self, curve: int) -> Arcs:
        """Give the arcs of one curve."""
        own = slice(int(self.start[curve]), int(self.start[curve + 1]))
        arcs = self.arcs
        return Arcs(arcs.start[own], arcs.angle[own], arcs.curvature[own], arcs.length[own])


def fit_arcs(
    cubic: FloatArray, start: IntArray, within: float, least_radius: float = 0.0
) -> ArcFit:
    """Make chains of arcs of plane curves.

    Parameters
    ----------
    cubic : (p, 4, 2), m
        Cubics of all curves, in order, one beginning where the one before ends: coefficients
        of 1, u, u^2, u^3, u from 0 to 1.
    start : (m + 1,) int
        Where the cubics of each curve begin.
    within : float, m
        How far arcs may lie from their curve, and it from them.
    least_radius : float, m
        Of all arcs; 0 leaves them free.

    Raises
    ------
    GeometryError
        Arrays of other shapes, numbers that are not finite, a tolerance that is not above 0, a
        cubic that is a point.
    """
    cubic, start = _checked(cubic, start)
    within, least_radius = _length(within, "within"), _length(least_radius, "least_radius")
    if within == 0.0:
        raise GeometryError("arcs: within is 0", "give a tolerance above 0, m", {"within": 0.0})
    pieces = Pieces.of(cubic, start, min(_FLAT * within, _FLATTEST))
    bend = np.inf if least_radius <= 0.0 else (1.0 + 1e-12) / least_radius
    made, links, off = _made(pieces, Limits(_MARGIN * within, bend, _SAMPLES), within)
    curve = pieces.curve[links.piece]
    count = len(start) - 1
    stuck = np.ones(count, bool)
    stuck[curve] = False
    lost = [i for i in range(len(pieces)) if not pieces.straight[i] and i not in made]
    stuck[pieces.curve[lost]] = True
    deviation, place = _largest(pieces, links, off, count)
    deviation[stuck] = np.nan
    keep = ~stuck[curve]
    arcs, smooth, starts = _joined(pieces, links, keep, count)
    sharpest = np.full((count, 3), np.nan)
    for each in np.flatnonzero(stuck).tolist():
        sharpest[each] = _sharpest(pieces, [i for i in lost if pieces.curve[i] == each])
    return ArcFit(arcs, starts, smooth, deviation, place, stuck, sharpest)


def _checked(cubic: FloatArray, start: IntArray) -> tuple[FloatArray, IntArray]:
    """Take cubics and where those of each curve begin."""
    found = finite(cubic, "arcs", (None, 4, 2))
    starts = finite(start, "arcs", (None,))
    whole = starts.astype(np.int64)
    fits = len(whole) > 0 and whole[0] == 0 and whole[-1] == len(found)
    if not fits or (whole != starts).any() or (np.diff(whole) < 1).any():
        raise GeometryError(
            f"arcs: the beginnings of curves do not part {len(found)} cubics",
            "give rising numbers from 0 to their count", {"cubics": len(found)},
        )  # fmt: skip
    still = np.flatnonzero(np.abs(found[:, 1:]).max(axis=(1, 2)) == 0.0)
    if len(still):
        index = int(still[0])
        raise GeometryError(f"arcs: cubic {index} is a point", "leave it out", {"index": index})
    return found, whole


def _length(value: float, name: str) -> float:
    found = float(finite(value, f"arcs: {name}", ()))
    if found < 0.0:
        raise GeometryError(f"arcs: {name} is {figure(found)}", "give a length in m", {name: found})
    return found


def _made(pieces: Pieces, limits: Limits, within: float) -> tuple[dict[int, Chain], Links, Apart]:
    """Search all pieces, measure them, and search those again that are too far off."""
    made: dict[int, Chain] = {}
    rows = np.flatnonzero(~pieces.straight)
    samples = _DENSER * limits.samples
    for _ in range(_AGAIN):
        found = chains(pieces, rows, limits)
        made |= {
            row: each for row, each in zip(rows.tolist(), found, strict=True)
            if isinstance(each, Chain)
        }  # fmt: skip
        links = Links.of(pieces, made)
        off = apart(pieces, links, samples)
        far = np.unique(links.piece[off.most > within])
        rows = far[~pieces.straight[far]]
        if not len(rows):
            return made, links, off
        for row in rows.tolist():
            del made[row]
        limits = attrs.evolve(limits, within=0.95 * limits.within, samples=2 * limits.samples)
    links = Links.of(pieces, made)
    return made, links, apart(pieces, links, samples)


def _largest(pieces: Pieces, links: Links, off: Apart, count: int) -> tuple[FloatArray, FloatArray]:
    """Give deviations and places of whole curves."""
    deviation, place = np.zeros((count, 2)), np.full((count, 2), np.nan)
    curve = pieces.curve[links.piece]
    np.maximum.at(deviation[:, 0], curve, off.curve)
    np.maximum.at(deviation[:, 1], curve, off.arcs)
    order = np.lexsort((-off.curve, curve))
    first = order[np.unique(curve[order], return_index=True)[1]]
    place[curve[first]] = pieces.at(links.piece[first], off.w[first])
    return deviation, place


def _joined(
    pieces: Pieces, links: Links, keep: np.typing.NDArray[np.bool_], count: int
) -> tuple[Arcs, np.typing.NDArray[np.bool_], IntArray]:
    """Give the arcs of curves, neighbours of one circle as one, and which go on smoothly."""
    first, last = links.arc[keep].T
    numbers = np.concatenate([first, last[last != first]])
    curve = pieces.curve[links.piece[keep]]
    curves = np.concatenate([curve, curve[last != first]])
    order = np.argsort(numbers, kind="stable")
    numbers, curves = numbers[order], curves[order]
    # Groups end where pieces meet in a corner or a curve ends.
    old = links.arcs
    ends = old.end_angles()
    turned = np.abs(np.angle(np.exp(1j * (old.angle[numbers[1:]] - ends[numbers[:-1]]))))
    cut = (turned > 1e-9) | (np.diff(curves) != 0)
    group = np.concatenate([[0], np.cumsum(cut)]) if len(numbers) else np.zeros(0, np.int64)
    arcs = Arcs(*(each[numbers] for each in (old.start, old.angle, old.curvature, old.length)))
    arcs, begin = merged(arcs, group)
    smooth = np.append(False, np.diff(group[begin]) == 0)[: len(begin)]
    return arcs, smooth, np.searchsorted(curves[begin], np.arange(count + 1))


def _sharpest(pieces: Pieces, rows: list[int]) -> FloatArray:
    """Give place and radius (m) where some pieces are bent most."""
    best = np.array([np.nan, np.nan, np.inf])
    for row in rows:
        w = np.linspace(
            pieces.first[row], pieces.stop[row], 200 * int(pieces.stop[row] - pieces.first[row]) + 1
        )
        piece = np.full(len(w), row)
        with np.errstate(divide="ignore", invalid="ignore"):
            radius = 1.0 / np.abs(pieces.curvature(piece, w))
        at = int(np.nanargmin(radius))
        if radius[at] < best[2]:
            best = np.append(pieces.at(piece[at], w[at : at + 1])[0], radius[at])
    return best
