"""The resistance of a ship at some speeds: its parts, of what it was computed, and its table.

Speeds are in knots, forces in kN, powers in kW.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any, Literal

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.resistance.holtrop_ship import HoltropShip
from assoc_hull.display import ShownAsText
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "KNOT",
    "Resistance",
    "ResistanceInput",
    "Source",
    "inputs_of",
]

KNOT = 1852.0 / 3600.0
"""m/s."""

Source = Literal["measured", "particulars", "given", "regression", "default"]
"""Where a number came from: the lines of the hull, her principal dimensions and draughts, the
caller, the regression of the papers, or what is taken where nothing was said."""


@attrs.frozen
class ResistanceInput:
    """A number of which the resistance was computed.

    Attributes
    ----------
    symbol : str
        Of the papers.
    name : str
        The argument that gives it, and the field of `HoltropShip`.
    value : float
        As it was used, in `unit`.
    unit : str
        A dash where there is none.
    source : str
        One of `Source`.
    note : str
        What else there is to say: the form parameter that was measured, what others say.
    """

    symbol: str
    name: str
    value: float
    unit: str
    source: Source
    note: str = ""


_FIELDS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "length": ("L", "m"),
        "breadth": ("B", "m"),
        "draught_fore": ("T_F", "m"),
        "draught_aft": ("T_A", "m"),
        "volume": ("V", "m3"),
        "lcb": ("lcb", "% L"),
        "cm": ("C_M", "-"),
        "cwp": ("C_WP", "-"),
        "wetted_surface": ("S", "m2"),
        "entrance_deg": ("i_E", "deg"),
        "bulb_area": ("A_BT", "m2"),
        "bulb_height": ("h_B", "m"),
        "transom_area": ("A_T", "m2"),
        "c_stern": ("C_stern", "-"),
        "appendage_area": ("S_APP", "m2"),
        "appendage_factor": ("1+k2", "-"),
        "thruster_diameter": ("d", "m"),
        "thruster_coefficient": ("C_BTO", "-"),
        "rho": ("rho", "t/m3"),
        "nu": ("nu", "m2/s"),
        "roughness": ("k_s", "m"),
    }
)
"""Symbol and unit of what is shown of a ship, in this order."""

_BY_REGRESSION = {"wetted_surface": "S", "entrance_deg": "iE"}
"""What the regression gives where nobody does, and its name among the coefficients."""


def inputs_of(
    ship: HoltropShip, hull: Mapping[str, float], known: Mapping[str, tuple[Source, str]]
) -> tuple[ResistanceInput, ...]:
    """Give all inputs of a ship; where `known` says nothing of one, it was given.

    Parameters
    ----------
    ship : HoltropShip
        The ship.
    hull : mapping of str to float
        Her coefficients, for what the regression gives.
    known : mapping of str to (Source, str)
        Source and note by the name of the field.
    """
    found = []
    for name, (symbol, unit) in _FIELDS.items():
        value = getattr(ship, name)
        source, note = known.get(name, ("given", ""))
        if name in _BY_REGRESSION:
            key = _BY_REGRESSION[name]
            if value is None:
                value, source = hull[key], "regression"
            elif f"{key} regression" in hull:
                said = f"the regression gives {hull[f'{key} regression']:.6g}"
                note = f"{note}; {said}" if note else said
        if value is not None and not (value == 0.0 and name.startswith("thruster")):
            found.append(ResistanceInput(symbol, name, value, unit, source, note))
    return tuple(found)


_PARTS: Mapping[str, str] = MappingProxyType(
    {
        "RF": "friction",
        "form": "form",
        "RAPP": "appendages",
        "RW": "waves",
        "RB": "bulb",
        "RTR": "transom",
        "RA": "correlation",
    }
)
"""The parts by their heads in the table, in the order in which they are added."""


def _fixed(given: Mapping[str, float]) -> Mapping[str, float]:
    return MappingProxyType(dict(given))


def _fixed_columns(given: Mapping[str, FloatArray]) -> Mapping[str, FloatArray]:
    return MappingProxyType(dict(given))


@attrs.frozen(eq=False, kw_only=True, repr=False)
class Resistance(ShownAsText):
    """Resistance in calm deep water at n speeds.

    Attributes
    ----------
    name : str
        Of the ship.
    method : str
        "1984" or "1982".
    ship : HoltropShip
        What it was computed of.
    inputs : tuple of ResistanceInput
        The same, each with its source.
    coefficients : mapping of str to float
        What does not vary with the speed, by the symbols of the papers; see
        `assoc_hull.analysis.resistance.holtrop.hull_coefficients`.
    by_speed : mapping of str to (n,)
        What does: CF, m4 (m2 in 1982), c6.
    speeds : (n,), kn
        As given.
    froude, reynolds : (n,)
        On L.
    friction : (n,), kN
        RF, of a plate of the wetted surface, by the line of the ITTC of 1957.
    form : (n,), kN
        RF k1, what the form adds to it.
    appendages, waves, bulb, transom, correlation : (n,), kN
        RAPP, RW, RB, RTR and RA.
    warnings : tuple of str
        What to mind: ranges of the regression that the ship leaves, values that were capped.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> found = ah.examples.series60(0.70).resistance([14.0, 16.0])
    >>> found.total.round(0).tolist()
    [225.0, 338.0]
    """

    name: str
    method: str
    ship: HoltropShip
    inputs: tuple[ResistanceInput, ...]
    coefficients: Mapping[str, float] = attrs.field(converter=_fixed)
    by_speed: Mapping[str, FloatArray] = attrs.field(converter=_fixed_columns)
    speeds: FloatArray
    froude: FloatArray
    reynolds: FloatArray
    friction: FloatArray
    form: FloatArray
    appendages: FloatArray
    waves: FloatArray
    bulb: FloatArray
    transom: FloatArray
    correlation: FloatArray
    warnings: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.speeds, self.froude, self.reynolds, *self.by_speed.values())
        freeze(*(getattr(self, each) for each in _PARTS.values()))

    def __len__(self) -> int:
        return len(self.speeds)

    @property
    def total(self) -> FloatArray:
        """R, the sum of all parts from left to right, (n,), kN."""
        first, *others = (getattr(self, each) for each in _PARTS.values())
        found: FloatArray = sum(others, first)
        return found

    @property
    def power(self) -> FloatArray:
        """P_E = R V, effective power, (n,), kW."""
        return self.total * (self.speeds * KNOT)

    def table(self) -> dict[str, FloatArray]:
        """Give what is printed as arrays (n,) by the heads of the table.

        Returns
        -------
        dict of str to (n,)
            ``V`` (kn), ``Fn``; ``RF``, ``form``, ``RAPP``, ``RW``, ``RB``, ``RTR``, ``RA`` and
            ``R`` (kN); ``PE`` (kW).
        """
        parts = {head: getattr(self, name) for head, name in _PARTS.items()}
        return {
            "V": self.speeds, "Fn": self.froude, **parts, "R": self.total, "PE": self.power,
        }  # fmt: skip

    def as_array(self) -> NDArray[Any]:
        """Give the table as one structured array, (n,), with a field for each of its heads."""
        columns = self.table()
        found = np.empty(len(self), [(head, np.float64) for head in columns])
        for head, column in columns.items():
            found[head] = column
        return found

    def __str__(self) -> str:
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        title = f"Resistance by Holtrop {self.method}"
        yield (f"{self.name}: {title}" if self.name else title) + "; V in kn, R in kN, PE in kW"
        yield from _aligned(list(_cells(self.table())))
        yield ""
        rows = [
            (each.symbol, _shown(each.value), "" if each.unit == "-" else each.unit,
             each.source + (f": {each.note}" if each.note else ""))
            for each in self.inputs
        ]  # fmt: skip
        symbol, value, unit = (max(len(row[k]) for row in rows) for k in range(3))
        for row in rows:
            yield f"{row[0]:<{symbol}}  {row[1]:>{value}} {row[2]:<{unit}}  {row[3]}".rstrip()
        yield ""
        yield from _wrapped([f"{n} {v:.5g}" for n, v in self.coefficients.items()])
        yield from (f"warning: {each}" for each in self.warnings)


_DIGITS: Mapping[str, int] = MappingProxyType({"V": 2, "Fn": 4, "PE": 0})
_WIDTH = 96
_NIL = 1e-12


def _shown(value: float) -> str:
    """Give six digits; what is but a rounding is 0."""
    return f"{value if abs(value) > _NIL else 0.0:.6g}"


def _cells(columns: Mapping[str, FloatArray]) -> Iterator[list[str]]:
    """Give the rows of the table as words, heads first."""
    yield list(columns)
    for row in zip(*(column.tolist() for column in columns.values()), strict=True):
        yield [
            f"{value:.{_DIGITS.get(head, 1)}f}" for head, value in zip(columns, row, strict=True)
        ]


def _aligned(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Align columns to the right."""
    wide = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(cell.rjust(room) for cell, room in zip(row, wide, strict=True))


def _wrapped(words: Sequence[str]) -> Iterator[str]:
    """Put words into lines, with commas between them."""
    line = ""
    for word in words:
        if line and len(line) + len(word) + 2 > _WIDTH:
            yield line + ","
            line = word
        else:
            line = f"{line}, {word}" if line else word
    yield line
