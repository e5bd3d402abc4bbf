"""Resistance of a hull as she floats: her form parameters as inputs of Holtrop's regression.

`resistance` is the verb behind `Hull.resistance`. `total_resistance` and `total_resistance_rates`
are for who ranks or aims: one number a speed of the bare hull, and how it changes with those of the
hull.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.form_parameters import CATALOGUE, form_parameters, shape_of
from assoc_hull.analysis.form.parameter import FormValue, evaluate
from assoc_hull.analysis.hydrostatics.record import SALT
from assoc_hull.analysis.resistance.calm_water_resistance import Resistance, Source
from assoc_hull.analysis.resistance.holtrop import Method, holtrop, method_of, speeds_of
from assoc_hull.analysis.resistance.holtrop_ship import NU, ROUGHNESS, WHERE, HoltropShip
from assoc_hull.arguments import plain
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HasState

__all__ = [
    "SYMBOLS",
    "resistance",
    "total_resistance",
    "total_resistance_rates",
]

SYMBOLS: Mapping[str, str] = {
    "length": "LWL", "breadth": "B", "draught_fore": "T_F", "draught_aft": "T_A", "volume": "V",
    "lcb": "LCB_WL", "cm": "C_M", "cwp": "Aw", "wetted_surface": "WSA", "bulb_area": "A_BT",
    "bulb_height": "h_B", "transom_area": "A_T",
}  # fmt: skip
"""The form parameter of which each number of a `HoltropShip` is taken; C_WP is Aw / (LWL B)."""

_MEASURED_ANGLE = "iE"
_PARTS = ("bulb_area", "bulb_height", "transom_area")
"""What a hull may lack; then it is 0."""


_USUAL: Mapping[str, tuple[float, str]] = {
    "c_stern": (0.0, "normal sections of the stern"),
    "appendage_area": (0.0, "bare hull"),
    "thruster_diameter": (0.0, "none"),
    "rho": (SALT, "salt water"),
    "nu": (NU, "salt water of 15 degrees"),
    "roughness": (ROUGHNESS, "a new ship"),
}
"""What is taken where nothing is stated, and what that means."""


# --------------------------------------------------------------------------------------
# The verb.


def resistance(
    hull: HasState,
    speeds: ArrayLike,
    *,
    method: Method = "1984",
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    c_stern: float = 0.0,
    appendage_area: float = 0.0,
    appendage_factor: float | None = None,
    thruster_diameter: float = 0.0,
    thruster_coefficient: float | None = None,
    wetted_surface: float | None = None,
    entrance_deg: float | None = None,
    bulb_area: float | None = None,
    bulb_height: float | None = None,
    transom_area: float | None = None,
    rho: float = SALT,
    nu: float = NU,
    roughness: float = ROUGHNESS,
) -> Resistance:
    """Give the resistance of a hull in calm deep water by Holtrop's regression.

    The arguments and what is raised are those of `Hull.resistance`.
    """
    stated = {
        "c_stern": c_stern, "appendage_area": appendage_area,
        "appendage_factor": appendage_factor, "thruster_diameter": thruster_diameter,
        "thruster_coefficient": thruster_coefficient, "wetted_surface": wetted_surface,
        "entrance_deg": entrance_deg, "bulb_area": bulb_area, "bulb_height": bulb_height,
        "transom_area": transom_area, "rho": rho, "nu": nu, "roughness": roughness,
    }  # fmt: skip
    plainly = {name: value if value is None else plain(value) for name, value in stated.items()}
    given = {name: value for name, value in plainly.items() if not _is_usual(name, value)}
    method_of(method)
    speeds_of(speeds)
    shape = shape_of(hull, draught=draught, draughts=draughts)
    doubts = shape.body.doubts(shape.planes, False)
    if doubts:
        raise BadInputError(doubts[0], WHERE, "mend the hull")
    wanted = (*SYMBOLS.values(), _MEASURED_ANGLE)
    measured = form_parameters(hull, draught=draught, draughts=draughts, only=wanted)
    at_design = draught is None and draughts is None
    ship = _ship(measured, given)
    sources = _sources(measured, given, at_design)
    return holtrop(ship, speeds, method, name=shape.header.ship, sources=sources)


def _is_usual(name: str, value: object) -> bool:
    """Tell whether a value is what stands for it where a caller says nothing."""
    usual = _USUAL.get(name, (None, ""))[0]
    return value is None or (isinstance(value, float) and value == usual)


def _ship(measured: Mapping[str, FormValue], stated: Mapping[str, Any]) -> HoltropShip:
    """Fill in a ship from form parameters by symbol, and what was stated."""
    length = measured["LWL"]
    if length.number is None:
        raise BadInputError(
            f"no length on the waterline: {length.reason}", WHERE, "give a lesser draught"
        )
    found = {name: _number(measured[symbol]) for name, symbol in SYMBOLS.items()}
    found["cwp"] /= found["length"] * found["breadth"]
    if isinstance(stated.get("bulb_area"), float) and not stated["bulb_area"]:
        found["bulb_height"] = 0.0
    return HoltropShip(**{**found, **stated})


def _number(value: FormValue) -> float:
    """Give a number; what a hull lacks is 0."""
    return value.number or 0.0


def _sources(
    measured: Mapping[str, FormValue], stated: Mapping[str, Any], at_design: bool
) -> dict[str, tuple[Source, str]]:
    """Say of each input where it came from."""
    found: dict[str, tuple[Source, str]] = {
        name: ("default", words) for name, (_, words) in _USUAL.items()
    }
    for name, symbol in SYMBOLS.items():
        found[name] = ("measured", _measured_note(name, measured[symbol]))
    found["breadth"] = ("particulars", "moulded")
    where: Source = "particulars" if at_design else "given"
    found["draught_fore"] = found["draught_aft"] = where, "design draught" if at_design else ""
    for name in stated:
        found[name] = ("given", "")
        value = measured[SYMBOLS[name]] if name in SYMBOLS else None
        if value is not None and value.number is not None:
            found[name] = ("given", f"{value.number:.6g} measured")
    if stated.get("bulb_area") == 0.0 and "bulb_height" not in stated:
        found["bulb_height"] = ("given", "no bulb")
    angle = measured[_MEASURED_ANGLE]
    seen = "none measured" if angle.number is None else f"{angle.number:.6g} measured"
    why = angle.reason if angle.number is None else angle.warning
    found["entrance_deg"] = ("given", f"{seen} ({why})" if why else seen)
    return found


def _measured_note(name: str, value: FormValue) -> str:
    """Say what was measured, why it is not there, or what to mind about it."""
    if name in _PARTS and value.number is None:
        return (value.reason or "").rpartition(": ")[2]
    note = "Aw / (LWL B)" if name == "cwp" else value.definition
    return f"{note}, {value.warning}" if value.warning else note


# --------------------------------------------------------------------------------------
# One number a speed, and how it changes.


def total_resistance(shape: FloatingShape, speeds: Sequence[float]) -> FloatArray:
    """Give the total resistance of a bare hull by the method of 1984, (n,), kN.

    Of a normal stern, in salt water of 15 degrees; `shape` is not asked whether it is doubtful.

    Raises
    ------
    BadInputError, OutOfRangeError
        A hull or speed of which the regression cannot tell it.
    """
    measured = evaluate(CATALOGUE, SYMBOLS.values(), shape, {})
    return holtrop(_ship(measured, {}), speeds).total


_STEP = 1e-4
"""Of the size of a form parameter: by so much it is changed to either side, and by twice that."""


def total_resistance_rates(
    shape: FloatingShape, speeds: Sequence[float], rates: Mapping[str, FloatArray]
) -> FloatArray:
    """Give how the total resistance of a bare hull changes with parameters of her shape.

    Parameters
    ----------
    shape : FloatingShape
        The hull in plain numbers.
    speeds : sequence of n float, kn
        At which.
    rates : mapping of str to (k,)
        How the form parameters of `SYMBOLS` change; nan for what the hull lacks.

    Returns
    -------
    (n, k)
        kN per unit of the parameter. By the regression's formulas it is differenced, centrally, at
        two distances, which are extrapolated.
    """
    measured = evaluate(CATALOGUE, SYMBOLS.values(), shape, {})
    found = np.zeros((len(speeds), len(next(iter(rates.values())))))
    for symbol in SYMBOLS.values():
        size = _number(measured[symbol])
        if size == 0.0 and symbol != "LCB_WL":
            continue  # what a hull lacks does not begin by a small change
        step = _STEP * (1.0 if symbol == "LCB_WL" else size)
        found += np.outer(_slope(measured, symbol, step, speeds), rates[symbol])
    return found


def _slope(
    measured: Mapping[str, FormValue], symbol: str, step: float, speeds: Sequence[float]
) -> FloatArray:
    """Give how the total resistance changes with one form parameter, (n,)."""

    def at(times: float) -> FloatArray:
        there = attrs.evolve(measured[symbol], number=_number(measured[symbol]) + times * step)
        return holtrop(_ship({**measured, symbol: there}, {}), speeds).total

    one, two = (at(times) - at(-times) for times in (1.0, 2.0))
    slope: FloatArray = (8.0 * one - two) / (12.0 * step)
    return slope
