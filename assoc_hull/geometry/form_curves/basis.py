"""The basis functions of form-parameter curves, and integrals of their products, as fractions.

These tables are what area and moments of curves rest upon: with N_i on [0, 4],

    A  = sum y_i x_j a_ij          a_ij  = int N_i N_j' dt        denominators divide 720
    My = sum y_i x_j x_k b_ijk     b_ijk = int N_i N_j N_k' dt    denominators divide 181440

Curves are integrated by `assoc_hull.geometry.form_curves.integrals`, segment by segment; the
tables say what must come out, and give the coefficients of the middle vertex.

Examples
--------
>>> from assoc_hull.geometry.form_curves.basis import area_table
>>> [int(720 * each) for each in area_table()[0]]
[-10, -9, 18, 1, 0, 0, 0]
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache

__all__ = ["VERTICES", "area_table", "basis", "moment_table"]

VERTICES = 7
_SEGMENTS = 4
_PARTS = ((1, -3, 3, -1), (4, 0, -6, 3), (1, 3, 3, -3), (0, 0, 0, 1))
"""Six times the basis functions of a segment, in ascending powers of u."""

Power = tuple[Fraction, ...]
"""A polynomial in ascending powers."""


def basis(vertex: int, segment: int) -> Power:
    """Give the basis function of a vertex on a segment, in ascending powers of u = t - segment."""
    part = vertex - segment
    inside = 0 <= part < len(_PARTS)
    return tuple(Fraction(each, 6) for each in _PARTS[part]) if inside else (Fraction(0),)


def _times(one: Power, other: Power) -> Power:
    found = [Fraction(0)] * (len(one) + len(other) - 1)
    for i, left in enumerate(one):
        for j, right in enumerate(other):
            found[i + j] += left * right
    return tuple(found)


def _slope(power: Power) -> Power:
    return tuple(n * each for n, each in enumerate(power))[1:] or (Fraction(0),)


def _integral(power: Power) -> Fraction:
    """Integrate from 0 to 1."""
    return sum((each / (n + 1) for n, each in enumerate(power)), Fraction(0))


@lru_cache(maxsize=1)
def area_table() -> tuple[tuple[Fraction, ...], ...]:
    """Give a_ij = int N_i N_j' dt, 7 rows of 7."""
    return tuple(
        tuple(
            sum(
                (
                    _integral(_times(basis(i, s), _slope(basis(j, s))))
                    for s in range(_SEGMENTS)
                    if 0 <= i - s < 4 and 0 <= j - s < 4
                ),
                Fraction(0),
            )
            for j in range(VERTICES)
        )
        for i in range(VERTICES)
    )


@lru_cache(maxsize=1)
def moment_table() -> tuple[tuple[tuple[Fraction, ...], ...], ...]:
    """Give b_ijk = int N_i N_j N_k' dt, 7 tables of 7 rows of 7."""
    found = [[[Fraction(0)] * VERTICES for _ in range(VERTICES)] for _ in range(VERTICES)]
    for s in range(_SEGMENTS):
        for i in range(s, s + 4):
            for j in range(s, s + 4):
                both = _times(basis(i, s), basis(j, s))
                for k in range(s, s + 4):
                    found[i][j][k] += _integral(_times(both, _slope(basis(k, s))))
    return tuple(tuple(tuple(row) for row in table) for table in found)
