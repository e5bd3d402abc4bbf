"""Samples: numbers drawn within intervals, evenly spread, the same ones for the same seed.

Sources: I.M. Sobol, "On the distribution of points in a cube and the approximate evaluation of
integrals", USSR Comp. Math. Math. Phys. 7 (1967) 86-112, scrambled after A.B. Owen; M.D. McKay,
R.J. Beckman, W.J. Conover, "A comparison of three methods for selecting values of input variables
in the analysis of output from a computer code", Technometrics 21 (1979) 239-245.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from assoc_hull.arguments import choice, integer, numbers, pair, text
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["METHODS", "Sample", "grid", "sample"]

METHODS = ("sobol", "latin", "uniform")
"""How numbers are drawn."""

_WHERE = "in sample"
_MOST = 10**6


class Sample(dict[str, FloatArray]):
    """Values by name, (n,) each, which `study` takes as a mapping; it tells how they came about.

    Attributes
    ----------
    drawn : str
        The method and the seed.
    """

    def __init__(self, columns: Mapping[str, FloatArray], drawn: str) -> None:
        super().__init__(columns)
        self.drawn = drawn


def grid(axes: Mapping[str, Sequence[float] | FloatArray]) -> Sample:
    """Give every combination of some values, for `study`.

    Parameters
    ----------
    axes : mapping of str to (k,)
        By name, the values, in the unit of the name.

    Returns
    -------
    Sample
        By name (n,), n being the product of the numbers of values; the last name runs fastest.

    Raises
    ------
    BadInputError, WrongTypeError
        No values, or more than 1,000,000 combinations.

    Examples
    --------
    >>> from assoc_hull.study.sampling import grid
    >>> {name: each.tolist() for name, each in grid({"breadth": [9, 10], "draught": [6]}).items()}
    {'breadth': [9.0, 10.0], 'draught': [6.0, 6.0]}
    """
    where = "in grid"
    if not isinstance(axes, Mapping):
        raise WrongTypeError(f"axes is {type(axes).__name__}", where, "give values by name")
    if not axes:
        raise BadInputError("there are no axes", where, "give values by name")
    names = [text(name, "a name of the axes", where) for name in axes]
    values = [np.atleast_1d(numbers(each, name, where))
              for name, each in zip(names, axes.values(), strict=True)]  # fmt: skip
    count = 1
    for name, each in zip(names, values, strict=True):
        count *= len(each)
        if not 1 <= count <= _MOST:
            what = f"with {name} there are {count} combinations"
            raise BadInputError(what, where, f"give from 1 to {_MOST:,}")
    columns = np.meshgrid(*values, indexing="ij")
    by_name = {name: _own(each.ravel()) for name, each in zip(names, columns, strict=True)}
    return Sample(by_name, "grid of " + " x ".join(str(len(each)) for each in values))


def sample(
    ranges: Mapping[str, tuple[float, float]], count: int, *, seed: int = 0, method: str = "sobol"
) -> Sample:
    """Draw values within intervals, for `study`.

    Parameters
    ----------
    ranges : mapping of str to (float, float)
        By name, the least and the greatest value, in the unit of the name.
    count : int
        How many are drawn.
    seed : int
        The same seed gives the same numbers.
    method : {"sobol", "latin", "uniform"}
        A scrambled Sobol sequence, whose first numbers are those of a smaller count; a Latin
        hypercube, which has one value in each of `count` equal parts of every interval; or
        independent uniform numbers.

    Returns
    -------
    Sample
        A value per variant, (count,), by name, in the unit of the name; ``drawn`` tells the method
        and the seed.

    Raises
    ------
    BadInputError, WrongTypeError
        No interval, one that is empty, or no such method.

    Examples
    --------
    >>> from assoc_hull.study.sampling import sample
    >>> drawn = sample({"breadth": (9.5, 10.5), "draught": (6.0, 6.5)}, 4, seed=7)
    >>> sorted(drawn), len(drawn["breadth"])
    (['breadth', 'draught'], 4)
    """
    if not isinstance(ranges, Mapping):
        raise WrongTypeError(f"ranges is {type(ranges).__name__}", _WHERE, "give them by name")
    if not ranges:
        raise BadInputError("there are no ranges", _WHERE, "give (low, high) by name")
    names = [text(name, "a name of the ranges", _WHERE) for name in ranges]
    ends = np.array([pair(each, f"the range of {name}", _WHERE, positive=False)
                     for name, each in zip(names, ranges.values(), strict=True)])  # fmt: skip
    number = integer(count, "count", _WHERE, least=1)
    start = integer(seed, "seed", _WHERE, least=0, most=2**32 - 1)
    how = choice(method, "method", METHODS, _WHERE)
    drawn = ends[:, 0] + (ends[:, 1] - ends[:, 0]) * _unit(len(names), number, start, how)
    columns = {name: _own(column) for name, column in zip(names, drawn.T, strict=True)}
    return Sample(columns, f"{how}, seed {start}")


def _unit(size: int, count: int, seed: int, method: str) -> FloatArray:
    """Draw numbers from 0 to 1, (count, size)."""
    random = np.random.default_rng(seed)
    if method == "uniform":
        return random.random((count, size))
    from scipy.stats import qmc  # takes half a second, which who draws nothing does not wait for

    if method == "latin":
        return np.asarray(qmc.LatinHypercube(size, seed=random).random(count))
    # the balance of a sequence is that of whole powers of two
    return np.asarray(qmc.Sobol(size, seed=random).random_base2((count - 1).bit_length()))[:count]


def _own(column: FloatArray) -> FloatArray:
    found = column.copy()
    freeze(found)
    return found
