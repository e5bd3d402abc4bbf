"""Smooth curves that meet: the penalised fits of many polylines, solved as one.

Polylines cut from one noisy surface and smoothed one by one no longer meet. Here each curve
keeps its data and its penalty, and each place where two curves ought to meet adds the square
of their distance along the normal of the surface there. Along the surface a curve may slide
at will: there a distance means nothing. All is linear, hence one system of equations.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.joint import join_fits, Tie
>>> from assoc_hull.geometry.polylines.smooth import fit_line
>>> x = np.linspace(0.0, 10.0, 40)
>>> one = fit_line(np.column_stack([x, np.sin(0.3 * x)]), 5e-3)
>>> other = fit_line(np.column_stack([x, np.sin(0.3 * x) + 2e-3]), 5e-3)
>>> up = np.array([0.0, 1.0])
>>> ties = [Tie(0, place, up, 1, place, up, 0.0) for place in (3.0, 5.0, 7.0)]
>>> low, high = (fit.draw().points for fit in join_fits([one, other], ties, 1e-4))
>>> middle = slice(8, 12)
>>> bool(np.abs(np.interp(5.0, *low.T) - np.interp(5.0, *high.T)) < 3e-4)
True
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.smooth import Fitted

__all__ = ["Tie", "join_fits"]


@attrs.frozen(eq=False)
class Tie:
    """A place where two curves ought to meet: ``way_a . a - way_b . b = offset``.

    Attributes
    ----------
    a, b : int
        Numbers of the fits; -1 for b where it may not move.
    at_a, at_b : float, m
        Lengths along their polylines.
    way_a, way_b : (d,)
        The normal of the surface in the coordinates of each fit.
    offset : float, m
        What the coordinates that a fit has not, or a curve that may not move, add.
    """

    a: int
    at_a: float
    way_a: FloatArray
    b: int
    at_b: float
    way_b: FloatArray
    offset: float


_ROUNDS = 3
"""How often the penalties of curves that pass their data too far off are lowered."""

_WIDE = 1.5
"""Data passed by more than this part of what is allowed are passed too far off."""

_LESS = 0.15
"""Factor by which they are lowered."""


def join_fits(fits: Sequence[Fitted], ties: Sequence[Tie], near: float) -> list[Fitted]:
    """Fit all curves at once so that they meet.

    Parameters
    ----------
    fits : sequence of Fitted
        Each fitted for itself; the sizes of their penalties are lowered only where a curve
        would else pass its data farther off than it may.
    ties : sequence of Tie
        Where they ought to meet.
    near : float, m
        A distance of two curves that weighs as much as a datum that lies off by what is
        allowed.

    Returns
    -------
    list of Fitted
        In the order given.
    """
    if not ties:
        return list(fits)
    held = _held(len(fits), ties)
    offset = np.array([tie.offset for tie in ties])
    found = list(fits)
    for turn in range(_ROUNDS):
        controls = _solve(found, held, offset, near)
        found = [
            attrs.evolve(each, control=control)
            for each, control in zip(found, controls, strict=True)
        ]
        wide = [each.fit.misfit(each.control) > _WIDE for each in found]
        if turn == _ROUNDS - 1 or not any(wide):
            break
        found = [
            attrs.evolve(each, size=each.size * _LESS) if far else each
            for each, far in zip(found, wide, strict=True)
        ]
    return found


@attrs.frozen(eq=False)
class _Held:
    """The ties of one fit: their numbers, lengths and normals, towards it positive."""

    tie: IntArray
    at: FloatArray
    way: FloatArray


def _held(count: int, ties: Sequence[Tie]) -> list[_Held | None]:
    """Sort the ends of ties by fit."""
    mine: list[list[tuple[int, float, FloatArray]]] = [[] for _ in range(count)]
    for i, tie in enumerate(ties):
        mine[tie.a].append((i, tie.at_a, tie.way_a))
        if tie.b >= 0:
            mine[tie.b].append((i, tie.at_b, -tie.way_b))
    return [
        _Held(*(np.array(column) for column in zip(*each, strict=True))) if each else None
        for each in mine
    ]


def _solve(
    fits: Sequence[Fitted], held: Sequence[_Held | None], offset: FloatArray, near: float
) -> list[FloatArray]:
    """Solve for the control points of all fits.

    The fits are banded and the ties few, so the forces that the ties exert are solved for
    first: a dense system with a row to each tie.
    """
    matrix, away = np.diag(np.full(len(offset), near * near)), -offset
    free = [each.fit.solve(each.size) for each in fits]
    answers: list[FloatArray | None] = []
    for each, control, mine in zip(fits, free, held, strict=True):
        answer = None if mine is None else _answer(each, mine)
        answers.append(answer)
        if mine is not None and answer is not None:
            rows = each.fit.rows(mine.at)
            matrix[np.ix_(mine.tie, mine.tie)] += (rows @ answer) * (mine.way @ mine.way.T)
            away[mine.tie] += ((rows @ control) * mine.way).sum(axis=1)
    force = np.linalg.solve(matrix, away)
    return [
        control
        if mine is None or answer is None
        else control - answer @ (force[mine.tie][:, None] * mine.way)
        for control, mine, answer in zip(free, held, answers, strict=True)
    ]


def _answer(each: Fitted, mine: _Held) -> FloatArray:
    """Give how control points give way to a unit force at each tie, (m, k), m2."""
    # Each curve counts in parts of what it is allowed.
    weight = 1.0 / float(each.fit.allowed.mean()) ** 2
    return each.fit.respond(each.size, each.fit.rows(mine.at).toarray().T) / weight
