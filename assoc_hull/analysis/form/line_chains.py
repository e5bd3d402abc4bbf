"""Lines of a hull as chains in a plane: a function of one coordinate, or a closed curve.

What cannot be either is refused, with the place where it fails.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.integrals.chains import (
    PlaneChains,
    chain_ends,
    closed_loop,
    cut_chain,
    join_chains,
    reversed_chain,
    straight_chain,
)
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.roots import unit_roots
from assoc_hull.model.objects import Curve

__all__ = ["AXES", "Span", "closed_chain", "function_chain"]

AXES = "xyz"

Span = tuple[float, float] | None

_MEET = 1e-6
"""By this part of the range neighbours may miss each other, and a curve may run back."""


def function_chain(
    curves: Sequence[Curve], axes: tuple[int, int], span: Span, name: str
) -> PlaneChains:
    """Give one coordinate of curves over another.

    Parameters
    ----------
    curves : sequence of Curve
        Which together make the function.
    axes : (int, int)
        Abscissa and ordinate: 0 for x, 1 for y, 2 for z.
    span : (float, float) or None, m
        Range of the abscissa; that of the curves if None. Beyond their ends the function is nil.
    name : str
        For messages.

    Returns
    -------
    PlaneChains
        One chain, its abscissa rising from end to end of the range.

    Raises
    ------
    BadInputError
        The curves are not single-valued in the abscissa, leave a gap, or lie outside the range.
    """
    runs = _in_order(curves, axes, along=0)
    if span is not None:
        runs = [part for run in runs for part in cut_chain(run, 0, *span)]
    runs = [run for run in runs if np.abs(run[:, 1:]).max(initial=0.0) > 0.0]
    where, axis = f"in a transform of {name}", AXES[axes[0]]
    ends = [chain_ends(run)[side][0] for run in runs for side in (0, 1)]
    if not runs or max(ends) <= min(ends):
        what = f"it has no extent along {axis}" + (" in the span" if span else "")
        raise BadInputError(what, where, "choose another abscissa or span")
    size = max(ends) - min(ends) if span is None else span[1] - span[0]
    _refuse_gaps(runs, _MEET * size, axis, where)
    whole = join_chains(runs)
    _refuse_return(whole, _MEET * size, axis, where)
    return PlaneChains.single(whole if span is None else _filled(whole, span))


def closed_chain(
    curves: Sequence[Curve], axes: tuple[int, int], mirror: int, span: Span, name: str
) -> PlaneChains:
    """Give curves closed with their mirror image.

    Parameters
    ----------
    curves : sequence of Curve
        One side, which end to end make one curve.
    axes : (int, int)
        The two coordinates: 0 for x, 1 for y, 2 for z.
    mirror : int
        Which of the two changes sign on the other side, 0 or 1.
    span : (float, float) or None, m
        Range of the other one to which the curve is cut; straight lines close what is cut.
    name : str
        For messages.

    Returns
    -------
    PlaneChains
        One closed chain, counter-clockwise, from a place in the mirror.

    Raises
    ------
    BadInputError
        The curves leave a gap, or lie outside the range.
    """
    other = 1 - mirror
    runs = _in_order(curves, axes, along=other)
    where = f"in a transform of {name}"
    places = np.concatenate([run[:, 0] for run in runs])
    size = float(np.ptp(places, axis=0).max())
    for one, next_ in pairwise(runs):
        gap = np.abs(chain_ends(one)[1] - chain_ends(next_)[0]).max()
        if gap > _MEET * size:
            what = f"its curves lie {gap:.3g} m apart"
            raise BadInputError(what, where, "take one of its curves")
    whole = join_chains(runs)
    if span is not None:
        whole = join_chains(cut_chain(whole, other, *span))
    if not len(whole):
        raise BadInputError("it does not reach into the span", where, "choose another span")
    return PlaneChains.single(closed_loop(whole, mirror))


def _in_order(curves: Sequence[Curve], axes: tuple[int, int], along: int) -> list[FloatArray]:
    """Give the curves as chains, each forward along a coordinate, and one after the other."""
    found = []
    for curve in curves:
        chain = PlaneChains.of(curve.spline, axes).cubic
        first, last = chain_ends(chain)
        found.append(chain if first[along] <= last[along] else reversed_chain(chain))
    return sorted(found, key=lambda chain: float(sum(end[along] for end in chain_ends(chain))))


def _refuse_gaps(runs: Sequence[FloatArray], allowed: float, axis: str, where: str) -> None:
    for one, next_ in pairwise(runs):
        low, high = float(chain_ends(one)[1][0]), float(chain_ends(next_)[0][0])
        if high - low > allowed:
            what = f"it has no curve from {axis} {low:.6g} to {high:.6g} m"
            raise BadInputError(what, where, "take one of its curves, or a span beside the gap")


def _refuse_return(chain: FloatArray, allowed: float, axis: str, where: str) -> None:
    """Refuse a chain whose abscissa runs back: there it has several values."""
    end = np.ones((len(chain), 1))
    turns = unit_roots(differentiate(chain[:, :, 0]))
    u = horner(chain[:, :, 0], np.concatenate([0.0 * end, turns, end], axis=1)).ravel()
    back = np.maximum.accumulate(u) - u
    worst = int(back.argmax())
    if back[worst] > allowed:
        what = f"it runs back by {back[worst]:.3g} m near {axis} {u[worst]:.6g} m"
        remedy = (
            f"it is no function of {axis}: choose another abscissa, or a span beside that place"
        )
        raise BadInputError(what, where, remedy)


def _filled(chain: FloatArray, span: tuple[float, float]) -> FloatArray:
    """Lead a chain to both ends of the range, nil where there was no curve."""
    first, last = chain_ends(chain)
    parts = [chain]
    for place, end, after in ((first, span[0], False), (last, span[1], True)):
        if abs(place[0] - end) > _MEET * (span[1] - span[0]):
            gap = [np.array([end, 0.0]), np.array([place[0], 0.0])]
            line = straight_chain(*(gap[::-1] if after else gap))
            parts = [*parts, line] if after else [line, *parts]
    return join_chains(parts)
