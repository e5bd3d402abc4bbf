"""What a study is asked for, checked and frozen; and samples of numbers for it.

Samples: numbers drawn within intervals, evenly spread, the same ones for the same seed.

Sources: I.M. Sobol, "On the distribution of points in a cube and the approximate evaluation of
integrals", USSR Comp. Math. Math. Phys. 7 (1967) 86-112, scrambled after A.B. Owen; M.D. McKay,
R.J. Beckman, W.J. Conover, "A comparison of three methods for selecting values of input variables
in the analysis of output from a computer code", Technometrics 21 (1979) 239-245.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import (
    choice,
    integer,
    numbers,
    pair,
    shown,
    shown_name,
    text,
)
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.variation.fields.layers import Layer
from assoc_hull.variation.parameters.catalogue import NAMES
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.request import TargetRequest, VariationRequest, rank_of_output

__all__ = ["METHODS", "OUTPUTS", "Sample", "StudyDesign", "grid", "sample"]

METHODS = ("sobol", "latin", "uniform")
"""How numbers are drawn."""

_IN_SAMPLE = "in sample"
_MOST_SAMPLES = 10**6


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
    >>> from assoc_hull.study.design import grid
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
        if not 1 <= count <= _MOST_SAMPLES:
            what = f"with {name} there are {count} combinations"
            raise BadInputError(what, where, f"give from 1 to {_MOST_SAMPLES:,}")
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
    >>> from assoc_hull.study.design import sample
    >>> drawn = sample({"breadth": (9.5, 10.5), "draught": (6.0, 6.5)}, 4, seed=7)
    >>> sorted(drawn), len(drawn["breadth"])
    (['breadth', 'draught'], 4)
    """
    if not isinstance(ranges, Mapping):
        raise WrongTypeError(f"ranges is {type(ranges).__name__}", _IN_SAMPLE, "give them by name")
    if not ranges:
        raise BadInputError("there are no ranges", _IN_SAMPLE, "give (low, high) by name")
    names = [text(name, "a name of the ranges", _IN_SAMPLE) for name in ranges]
    ends = np.array([pair(each, f"the range of {name}", _IN_SAMPLE, positive=False)
                     for name, each in zip(names, ranges.values(), strict=True)])  # fmt: skip
    number = integer(count, "count", _IN_SAMPLE, least=1)
    start = integer(seed, "seed", _IN_SAMPLE, least=0, most=2**32 - 1)
    how = choice(method, "method", METHODS, _IN_SAMPLE)
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


OUTPUTS = (
    "volume", "displacement", "lcb", "kb", "kmt", "kml", "waterplane_area", "lcf",
    "wetted_surface", "a_midship", "cb", "cp", "cm", "cw",
)  # fmt: skip
"""What is told of each variant unless it is said."""

_WHERE = "in study"
_MOST = 1_000_000
"""Variants of one study: what is asked for them is held in memory."""


@attrs.frozen(eq=False)
class StudyDesign:
    """What a study is asked for.

    Attributes
    ----------
    given : tuple of str
        Parameters whose values are given: named ones, and layers.
    free : tuple of str
        Parameters whose values are sought.
    layers : tuple of Layer
        The raw layers among these, by their names.
    values : (n, g)
        Of the given parameters, variant by variant: m, degrees, or the factor on a layer.
    aims : tuple of str
        Outputs that are aimed at.
    targets : (n, m)
        What they are to be, variant by variant, in their units.
    bounds : (k, 2)
        Least and greatest value of each free parameter; infinite where nothing bounds it.
    outputs : tuple of str
        What is told of each variant; those that are aimed at among them.
    layout : Layout
        How far the fields of named parameters reach.
    drawn : str
        How values were drawn, by `sample`, with the seed; empty if they were not.
    """

    given: tuple[str, ...]
    free: tuple[str, ...]
    layers: tuple[Layer, ...]
    values: FloatArray
    aims: tuple[str, ...]
    targets: FloatArray
    bounds: FloatArray
    outputs: tuple[str, ...]
    layout: Layout
    drawn: str = ""

    def __attrs_post_init__(self) -> None:
        freeze(self.values, self.targets, self.bounds)

    @property
    def count(self) -> int:
        """How many variants."""
        return len(self.values)

    @property
    def names(self) -> tuple[str, ...]:
        """All parameters: given ones, then free ones."""
        return self.given + self.free

    @classmethod
    def of(
        cls,
        *,
        set: object = None,
        reach: object = None,
        free: object = (),
        bounds: Mapping[str, object] | None = None,
        layers: Sequence[object] = (),
        outputs: Sequence[str] = OUTPUTS,
        layout: Mapping[str, Any] | Layout | None = None,
    ) -> StudyDesign:
        """Take what a designer gives; see `Hull.study`.

        Raises
        ------
        UnknownNameError
            No such parameter, or no such output.
        BadInputError
            Columns of different lengths, numbers that are none, or fewer free parameters than
            there are targets.
        """
        ask = _ask(layers, layout)
        raw = {each.name: each for each in ask.layers}
        aims, targets = _columns(_by_name(reach, "reach"), "reach")
        turn = sorted(range(len(aims)), key=lambda i: rank_of_output(aims[i]))
        aims, targets = tuple(aims[i] for i in turn), [targets[i] for i in turn]  # as `vary` has it
        sought = _sought(free, bounds, aims, raw)
        raw |= {each.name: each for each in sought.free if not isinstance(each, str)}
        given, values = _columns(_by_name(set, "set"), "set", (*NAMES, *raw))
        unused = [name for name in raw if name not in given and name not in sought.names]
        given, values = (*given, *unused), [*values, *(np.ones(1) for _ in unused)]
        _check(given, sought.names, aims)
        told = _outputs(outputs, aims)
        _refuse_columns(raw, told)
        count = _count([*zip(given, values, strict=True), *zip(aims, targets, strict=True)])
        return cls(
            given, sought.names, tuple(raw.values()), _table(values, count), aims,
            _table(targets, count), sought.limits([0.0] * len(sought.names)),
            told, ask.layout,
            _drawn(set, reach),
        )  # fmt: skip


_NOTHING = TargetRequest({}, (), {})
"""Nothing is free."""


def _sought(
    free: object, bounds: object, aims: tuple[str, ...], raw: Mapping[str, Layer]
) -> TargetRequest:
    """Take what is free, and between which values, as `vary` does; layers also by their names."""
    if bounds is not None and not isinstance(bounds, Mapping):
        raise WrongTypeError(f"bounds is {shown(bounds)}", _WHERE, "give (low, high) by name")
    if isinstance(free, Sequence) and not isinstance(free, str):
        free = [raw.get(each, each) if isinstance(each, str) else each for each in free]
    return TargetRequest.of(dict.fromkeys(aims, 0.0), free, bounds, True) or _NOTHING


def _ask(layers: Sequence[object], layout: Mapping[str, Any] | Layout | None) -> VariationRequest:
    """Take layers and layout as `vary` does."""
    if isinstance(layers, str) or not isinstance(layers, Sequence):
        raise WrongTypeError(f"layers is {shown(layers)}", _WHERE, "give a list of layers")
    if not layers:
        whole = attrs.asdict(layout) if isinstance(layout, Layout) else layout
        return VariationRequest({}, layout=Layout.of(whole))
    ask = VariationRequest.of(layers=layers, layout=layout)
    names = [each.name for each in ask.layers]
    for name in names:
        if names.count(name) > 1 or name in NAMES:
            raise BadInputError(
                f"two parameters are called '{name}'", _WHERE, "give each layer a name of its own"
            )
    return ask


def _by_name(given: object, argument: str) -> object:
    """Turn a table, or a row per variant, into a column per name."""
    if given is None or isinstance(given, Mapping):
        return given
    names = getattr(getattr(given, "dtype", None), "names", None)
    if names is not None or _is_frame(given):
        table: Any = given
        return {str(name): np.asarray(table[name]) for name in names or table.columns}
    if isinstance(given, str) or not isinstance(given, Sequence) or not given:
        raise WrongTypeError(f"{argument} is {shown(given)}", _WHERE, "give values by name")
    rows = [row for row in given if isinstance(row, Mapping)]
    what = "outputs" if argument == "reach" else "parameters"
    if len(rows) != len(given) or any(row.keys() != rows[0].keys() for row in rows):
        raise BadInputError(
            f"the rows of {argument} do not ask for the same {what}", _WHERE,
            "give a mapping per variant, all of the same names",
        )  # fmt: skip
    return {name: [row[name] for row in rows] for name in rows[0]}


def _drawn(*given: object) -> str:
    """Say how values were drawn."""
    words = (each.drawn for each in given if isinstance(each, Sample))
    return ", ".join(dict.fromkeys(filter(None, words)))


def _is_frame(given: object) -> bool:
    """Tell whether it is a frame of pandas, without which nobody has one."""
    pandas = sys.modules.get("pandas")
    return pandas is not None and isinstance(given, pandas.DataFrame)


def _columns(
    given: object, argument: str, known: tuple[str, ...] | None = None
) -> tuple[tuple[str, ...], list[FloatArray]]:
    """Take one number or one per variant, by name."""
    if given is None:
        return (), []
    if not isinstance(given, Mapping):
        raise WrongTypeError(f"{argument} is {shown(given)}", _WHERE, "give values by name")
    for name in given:
        if known is not None and name not in known:
            raise UnknownNameError("parameter", shown_name(name), known)
        text(name, f"a name in {argument}", _WHERE)
    # An output, as a moment of inertia, may be larger than any length.
    most = {} if known is not None else {"most": math.inf}
    columns = [
        np.atleast_1d(numbers(each, str(name), _WHERE, **most)) for name, each in given.items()
    ]
    for name, column in zip(given, columns, strict=True):
        if not 1 <= len(column) <= _MOST:
            raise BadInputError(
                f"{name} has {len(column)} values", _WHERE, f"give from 1 to {_MOST:,}"
            )
    return tuple(map(str, given)), columns


def _check(given: tuple[str, ...], free: tuple[str, ...], aims: tuple[str, ...]) -> None:
    """See that given and free parameters and targets fit together."""
    for name in free:
        if name in given:
            raise BadInputError(f"free parameter '{name}' is set as well", _WHERE, "name it once")
    if not given and not aims:
        raise BadInputError(
            "nothing is asked for", _WHERE, "give values with set, or targets with reach"
        )
    if len(free) < len(aims):
        raise BadInputError(
            f"{len(aims)} targets need at least {len(aims)} free parameters ({len(free)} given)",
            _WHERE, "free more parameters, or drop targets",
        )  # fmt: skip


_COLUMNS = ("number", "margin", "shift", "residual", "trials", "anew", "failure", "reason")
"""What a table has beside parameters and outputs."""


def _refuse_columns(layers: Iterable[str], outputs: tuple[str, ...]) -> None:
    """Refuse a layer whose column another one of the table would cover."""
    for name in layers:
        if name in (*_COLUMNS, *outputs) or name.startswith("asked "):
            raise BadInputError(
                f"the layer '{name}' has the name of another column of the table", _WHERE,
                "give it another name",
            )  # fmt: skip


def _count(columns: Sequence[tuple[str, FloatArray]]) -> int:
    """Give how many variants columns are for."""
    long = [(name, len(column)) for name, column in columns if len(column) > 1]
    for name, size in long:
        if size != long[0][1]:
            raise BadInputError(
                f"{name} has {size} values, {long[0][0]} has {long[0][1]}", _WHERE,
                "give one value, or one per variant",
            )  # fmt: skip
    return long[0][1] if long else 1


def _table(columns: Sequence[FloatArray], count: int) -> FloatArray:
    """Put columns side by side, (count, c)."""
    found = np.empty((count, len(columns)))
    for i, column in enumerate(columns):
        found[:, i] = column
    return found


def _outputs(given: Sequence[str], aims: tuple[str, ...]) -> tuple[str, ...]:
    """Take names of outputs: those that are aimed at come first."""
    if isinstance(given, str) or not isinstance(given, Sequence):
        raise WrongTypeError(f"outputs is {shown(given)}", _WHERE, "give a list of names")
    names = [text(name, "a name in outputs", _WHERE) for name in given]
    return tuple(dict.fromkeys((*aims, *names)))
