"""A table of derivatives of outputs by parameters."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import choice
from assoc_hull.errors import UnknownNameError
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Sensitivities"]

_WHERE = "in a table of sensitivities"
_DIGITS = 6


def _held(given: Mapping[str, str]) -> Mapping[str, str]:
    return MappingProxyType(dict(given))


@attrs.frozen(eq=False)
class Sensitivities:
    """Derivatives of m outputs by k parameters.

    Attributes
    ----------
    ship : str
        Name.
    outputs, units : tuple of m str
        What is differentiated, and its units.
    values : (m,)
        Present values, in these units.
    parameters, per : tuple of k str
        By what, and the units of the parameters; a dash where there is none.
    matrix : (m, k)
        In the unit of the output per unit of the parameter.
    usual : (k,)
        A usual change of each parameter, in its unit.
    exact : (m,) bool
        The derivatives are those of the sums themselves; else extrapolated differences.
    absent : mapping of str to str
        By name: why the hull cannot be varied by a parameter, where none were chosen.
    """

    ship: str
    outputs: tuple[str, ...]
    units: tuple[str, ...]
    values: FloatArray
    parameters: tuple[str, ...]
    per: tuple[str, ...]
    matrix: FloatArray
    usual: FloatArray
    exact: NDArray[np.bool_]
    absent: Mapping[str, str] = attrs.field(factory=dict, converter=_held)

    def __attrs_post_init__(self) -> None:
        freeze(self.values, self.matrix, self.usual, self.exact)

    def of(self, output: str, parameter: str) -> float:
        """Give one derivative.

        Raises
        ------
        UnknownNameError
            The table has no such output or parameter.
        """
        column = _place("parameter of the table", parameter, self.parameters)
        return float(self.row(output)[column])

    def row(self, output: str) -> FloatArray:
        """Give the derivatives of one output, (k,); raises as `of`."""
        found: FloatArray = self.matrix[_place("output of the table", output, self.outputs)]
        return found

    @property
    def per_usual(self) -> FloatArray:
        """By how much outputs change with a usual change of each parameter, (m, k)."""
        found: FloatArray = self.matrix * self.usual
        return found

    @property
    def percent(self) -> FloatArray:
        """The same in percent of the present values, (m, k); nan for a value of nil."""
        size = np.where(self.values == 0.0, np.nan, np.abs(self.values))
        found: FloatArray = 100.0 * self.per_usual / size[:, None]
        return found

    def table(self, scale: str = "unit") -> str:
        """Give the table as text: a row for each parameter, a column for each output.

        Parameters
        ----------
        scale : {"unit", "usual", "percent"}
            Changes per unit of the parameter, per usual change of it, or these in percent of
            the present value.

        Raises
        ------
        BadInputError
            Another scale.
        """
        shown_as = choice(scale, "scale", ("unit", "usual", "percent"), _WHERE)
        numbers = {"unit": self.matrix, "usual": self.per_usual, "percent": self.percent}[shown_as]
        marks = ["" if sure else " ~" for sure in self.exact.tolist()]
        head = ["", "per", *(f"{n}{mark}" for n, mark in zip(self.outputs, marks, strict=True))]
        units = ["", "", *("%" if shown_as == "percent" else unit for unit in self.units)]
        rows = [head, units, ["now", "", *(_words(each) for each in self.values.tolist())]]
        for k, name in enumerate(self.parameters):
            step = self.per[k] if shown_as == "unit" else f"{self.usual[k]:.4g} {self.per[k]}"
            rows.append([name, step, *(_words(each) for each in numbers[:, k].tolist())])
        notes = ["~ by differences, extrapolated"] if not self.exact.all() else []
        notes += [f"{name}: {why}" for name, why in self.absent.items()]
        return "\n".join([*_aligned(rows), *notes])

    def __str__(self) -> str:
        return self.table()

    def document(self) -> dict[str, Any]:
        """Give the table as data: numbers, words, lists and mappings; null for nan."""
        return {
            "ship": self.ship,
            "outputs": [
                {"name": name, "unit": unit, "value": value, "exact": sure}
                for name, unit, value, sure in zip(
                    self.outputs, self.units, self.values.tolist(), self.exact.tolist(), strict=True
                )
            ],
            "parameters": [
                {"name": name, "unit": unit, "usual": usual}
                for name, unit, usual in zip(
                    self.parameters, self.per, self.usual.tolist(), strict=True
                )
            ],
            "derivatives": [
                [None if np.isnan(each) else each for each in row] for row in self.matrix.tolist()
            ],
            "absent": dict(self.absent),
        }

    def to_json(self) -> str:
        """Give `document` as JSON."""
        return json.dumps(self.document(), indent=1, allow_nan=False)


def _place(kind: str, name: str, known: Sequence[str]) -> int:
    if name not in known:
        raise UnknownNameError(kind, str(name), tuple(known))
    return known.index(name)


def _words(number: float) -> str:
    return "-" if np.isnan(number) else f"{number:.{_DIGITS}g}"


def _aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Set columns, the first to the left and all others to the right."""
    wide = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    lines = []
    for first, *others in rows:
        cells = [each.rjust(room) for each, room in zip(others, wide[1:], strict=True)]
        lines.append("  ".join([first.ljust(wide[0]), *cells]))
    return lines
