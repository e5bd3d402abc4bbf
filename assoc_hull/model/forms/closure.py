"""Closure: the entrance by which a curve of two halves has a given fullness and centroid.

The run is given. In the frame of the ship (x from -1 at AP to 1 at FP, ordinate 1 for the whole
section or half-breadth), with A, m and X area, centroid and inner end of run and entrance,

    2 C   = A_R + A_E + Y (X_E - X_R)
    2 C m = A_R m_R + A_E m_E + Y (X_E^2 - X_R^2)/2

C is the prismatic coefficient of a curve of sectional areas, the waterplane coefficient of a
waterline, m the centroid of the whole, Y the ordinate of the parallel part. The parameters of S.Y.
Kim, S.W. Kang, "Ship Lines Creation by B-Spline Form Parameter Method", Trans. SNAK 29(2), 1992,
reproduce these sums; the sums and the limits are our derivation.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import attrs

from assoc_hull.arguments import instance, number, positive
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.form_curves.integrals import form_integrals
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.two_halves import half_fault, half_number, half_vertices, reachable

if TYPE_CHECKING:
    from assoc_hull.model.tables import Particulars

__all__ = [
    "Coefficients",
    "close_halves",
    "close_sac",
    "closing_area",
    "coefficients",
]

_CALL = "in a closure"


def close_sac(
    fullness: float,
    centroid: float,
    *,
    run_end: float,
    entrance_start: float,
    run_area: float,
    run_centroid: float,
    top: float = 1.0,
    end_ordinate: float = 0.0,
    entrance_end: float = 1.0,
    where: str = _CALL,
) -> tuple[float, float]:
    """Give area and centroid of the entrance, from fullness and centroid of the whole.

    Parameters
    ----------
    fullness : float
        Of the whole curve, C above: the prismatic or the waterplane coefficient.
    centroid : float
        Of the whole curve, in half lengths from midship, forward positive.
    run_end, entrance_start, entrance_end : float
        Where the run ends, the entrance begins and ends, in half lengths from midship.
    run_area, run_centroid : float
        Area of the run over half the length, and its centroid in half lengths.
    top : float
        Ordinate of the parallel part, Y above.
    end_ordinate : float
        Ordinate at the end of the entrance.
    where : str
        Named in errors.

    Returns
    -------
    float, float

    Raises
    ------
    OutOfRangeError
        No falling curve has this area, or this centroid with it: fullness or centroid lie
        outside of the interval that the error gives.
    """
    area = closing_area(
        fullness, run_end, entrance_start, entrance_end, top, run_area, end_ordinate, where
    )
    length = entrance_end - entrance_start
    moment = run_area * run_centroid + 0.5 * top * (entrance_start**2 - run_end**2)
    entrance = 2.0 * fullness * centroid - moment
    room = _room(area, length, end_ordinate, top)
    limits = [(moment + area * entrance_start + each) / (2.0 * fullness) for each in room]
    if not limits[0] <= centroid <= limits[1]:
        why = "leaves an entrance that falls and rises"
        raise OutOfRangeError(
            "centroid", centroid, where, why, limits[0], limits[1], "half lengths"
        )
    return area, entrance / area


def closing_area(
    fullness: float,
    run_end: float,
    entrance_start: float,
    entrance_end: float,
    top: float,
    run_area: float,
    end_ordinate: float,
    where: str,
) -> float:
    """Give the area of the entrance, over half the length, if it fits between its ends.

    Arguments as of `close_sac`.
    """
    length = entrance_end - entrance_start
    if length <= 0.0:
        what = f"the entrance begins at {entrance_start:g} and ends at {entrance_end:g}"
        raise BadInputError(what, where, "let it begin abaft its end")
    if entrance_start < run_end:
        what = f"the run ends at {run_end:g}, the entrance begins at {entrance_start:g}"
        raise BadInputError(what, where, "let the run end abaft the entrance, or where it begins")
    body = run_area + top * (entrance_start - run_end)
    area = 2.0 * fullness - body
    low, high = (0.5 * (body + each * length) for each in (end_ordinate, top))
    if not low < fullness < high:
        why = "leaves an entrance that does not fit between its ends"
        raise OutOfRangeError("fullness", fullness, where, why, low, high, "")
    return area


def _room(area: float, length: float, low: float, high: float) -> tuple[float, float]:
    """Give the least and the largest moment, about its beginning, of a curve that falls.

    `low` and `high` are its ordinates at the end and at the beginning.
    """
    rise = high - low
    full = (area / length - low) / rise
    base = 0.5 * low * length * length
    return base + 0.5 * rise * (full * length) ** 2, base + 0.5 * rise * full * length * length


# --------------------------------------------------------------------------------------
# Closing definitions; where no entrance does it, the error has the interval of what was asked for.


@attrs.frozen
class Coefficients:
    """Fullness and centroid of a curve of two halves.

    Attributes
    ----------
    fullness : float
        Area under the curve over that of its frame: the prismatic coefficient of a curve of
        sectional areas, the waterplane coefficient of a half-breadth, both for Y = 1.
    block : float or None
        Of a curve of sectional areas: volume over length, breadth and draught.
    centroid : float, m
        From midship, forward positive.
    centroid_percent : float
        The same in hundredths of the length.
    """

    fullness: float
    block: float | None
    centroid: float
    centroid_percent: float


def coefficients(definition: FormDefinition, particulars: Particulars) -> Coefficients:
    """Give fullness and centroid of a curve of two halves.

    Parameters
    ----------
    definition : FormDefinition
        Of kind halves: a curve of sectional areas or a waterline.
    particulars : Particulars
        Of the ship.

    Returns
    -------
    Coefficients
    """
    run, entrance = (_half_sums(definition, half) for half in ("run", "entrance"))
    first, last, top = (
        half_number(definition, name) for name in ("run_end", "entrance_start", "top")
    )
    area = run[0] + entrance[0] + top * (last - first)
    moment = run[0] * run[1] + entrance[0] * entrance[1] + 0.5 * top * (last**2 - first**2)
    mean, centroid = 0.5 * area, moment / area
    half = 0.5 * particulars.length
    block = None
    if definition.use == "sectional_area":
        block = mean * half_number(definition, "full") / (particulars.breadth * particulars.draught)
    return Coefficients(mean, block, centroid * half, 50.0 * centroid)


def close_halves(
    definition: FormDefinition,
    particulars: Particulars,
    *,
    cp: float | None = None,
    cb: float | None = None,
    cw: float | None = None,
    lcb: float | None = None,
    lcf: float | None = None,
) -> FormDefinition:
    """Give the same curve with the entrance by which it has a fullness and a centroid.

    What is not given stays as it is; a centroid of the entrance that is None stays None, as it
    comes out fairest with the area.

    Parameters
    ----------
    definition : FormDefinition
        Of kind halves.
    particulars : Particulars
        Of the ship.
    cp, cb : float or None
        Prismatic or block coefficient of a curve of sectional areas; one of them.
    cw : float or None
        Waterplane coefficient of a waterline.
    lcb, lcf : float or None, m
        Centroid of a curve of sectional areas or of a waterline, from midship, forward positive.

    Returns
    -------
    FormDefinition

    Raises
    ------
    BadInputError
        Names that do not belong to this curve.
    OutOfRangeError
        No falling entrance does it.

    Examples
    --------
    >>> from assoc_hull.model.forms.closure import close_halves, coefficients
    >>> from assoc_hull.model.form_definition import FormDefinition
    >>> from assoc_hull.model.tables import Particulars
    >>> ship = Particulars("ship", 100.0, 16.0, 9.0, 6.0)
    >>> areas = FormDefinition("areas", "sectional_area", "halves", {
    ...     "full": 92.0, "run_start": -1.0, "run_start_ordinate": 0.0,
    ...     "run_start_angle_deg": 40.0, "run_start_curvature": 0.0, "run_end": -0.2,
    ...     "run_end_angle_deg": 0.0, "run_end_curvature": 0.0, "run_area": 0.45,
    ...     "run_centroid": -0.5, "top": 1.0, "entrance_start": 0.2,
    ...     "entrance_start_angle_deg": 0.0, "entrance_start_curvature": 0.0,
    ...     "entrance_end": 1.0, "entrance_end_ordinate": 0.0, "entrance_end_angle_deg": -45.0,
    ...     "entrance_end_curvature": 0.0})
    >>> closed = close_halves(areas, ship, cb=0.62, lcb=-0.76)
    >>> round(coefficients(closed, ship).block, 12), round(coefficients(closed, ship).centroid, 12)
    (0.62, -0.76)
    """
    definition = instance(definition, FormDefinition, "definition", _CALL)
    where = f"in the closure of {definition.name!r}"
    asked = {"cp": cp, "cb": cb, "cw": cw, "lcb": lcb, "lcf": lcf}
    given = _given(definition, asked, where)
    names = [name for name in given if name in ("cp", "cb", "cw")]
    places = [name for name in given if name in ("lcb", "lcf")]
    ship = 0.5 * particulars.length
    scale = 1.0
    if names == ["cb"]:
        # Cb = Cp Cm: over the coefficient of the full section Cb becomes the Cp of the curve.
        scale = half_number(definition, "full") / (particulars.breadth * particulars.draught)
    # Of the curve as it is only what was not asked for is needed.
    now = None if names and places else coefficients(definition, particulars)
    fullness = given[names[0]] / scale if names else _there(now).fullness
    centroid: float | None = None
    if places or definition.value("entrance_centroid") is not None:
        centroid = (given[places[0]] if places else _there(now).centroid) / ship
    try:
        return _closed(definition, fullness, centroid, where)
    except (BadInputError, OutOfRangeError) as error:
        asked_for = ((names or ["fullness"])[0], scale), ((places or ["centroid"])[0], ship)
        # The interval of the error does not know tangents: its ends may be out of reach, too.
        better = _admissible(definition, fullness, centroid, asked_for, where, bool(places))
        if better is not None:
            raise better from None
        if isinstance(error, OutOfRangeError) and error.name in ("fullness", "centroid"):
            raise _as_asked(error, *asked_for[error.name == "centroid"]) from None
        raise


def _closed(
    definition: FormDefinition, fullness: float, centroid: float | None, where: str
) -> FormDefinition:
    """Give the definition with its entrance, which can be made; a centroid of None stays None."""
    run = _half_sums(definition, "run")
    frame = {name: half_number(definition, name) for name in _FRAME}
    end = half_number(definition, "entrance_end_ordinate")
    at: float | None = None
    if centroid is None:
        area = closing_area(fullness, **frame, run_area=run[0], end_ordinate=end, where=where)
    else:
        area, at = close_sac(
            fullness, centroid, **frame, run_area=run[0], run_centroid=run[1], end_ordinate=end,
            where=where,
        )  # fmt: skip
    found = definition.having({"entrance_area": area, "entrance_centroid": at})
    fault = half_fault(found, "entrance")
    if fault:
        raise BadInputError(f"the entrance {fault}", where, "give other tangents, or another run")
    return found


def _admissible(
    definition: FormDefinition,
    fullness: float,
    centroid: float | None,
    asked: tuple[tuple[str, float], tuple[str, float]],
    where: str,
    by_centroid: bool,
) -> OutOfRangeError | None:
    """Say between which values what was asked for may lie, all else kept; None if nowhere.

    Each end is the last value at which an entrance can be made.
    """

    def limits(full: float, at: float | None) -> tuple[float, float]:
        """Give the interval outside of which there is none for sure."""
        try:
            _closed(definition, full, at, where)
        except OutOfRangeError as error:
            if error.name in ("fullness", "centroid"):
                return error.least, error.most
        except BadInputError:
            pass
        return math.nan, math.nan

    # Asked for what no curve has, the closure gives the whole interval in its error.
    ways = [(False, limits(_FAR, centroid), fullness)]
    if centroid is not None:
        # What only stays as it was comes last.
        ways.insert(0 if by_centroid else 1, (True, limits(fullness, _FAR), centroid))
    for moves, ends, value in ways:
        # `moves` is bound here, as the loop goes on.
        def made(at: float, moves: bool = moves) -> bool:
            try:
                _closed(definition, fullness if moves else at, at if moves else centroid, where)
            except (BadInputError, OutOfRangeError):
                return False
            return True

        # nan: the closure fails for what no other value mends.
        room = reachable(made, *ends, value) if math.isfinite(ends[0]) else None
        if room is not None:
            why = "leaves no entrance that can be made"
            found = OutOfRangeError("", value, where, why, room[0], room[1], "")
            return _as_asked(found, *asked[moves])
    return None


_FAR = 1e3
"""A coefficient or a centroid (half lengths) that no curve has."""

_FRAME = ("run_end", "entrance_start", "entrance_end", "top")


def _there(found: Coefficients | None) -> Coefficients:
    assert found is not None
    return found


def _given(
    definition: FormDefinition, asked: Mapping[str, float | None], where: str
) -> dict[str, float]:
    """Take what was given, if it belongs to the curve and is given once."""
    known = ("cp", "cb", "lcb") if definition.use == "sectional_area" else ("cw", "lcf")
    if definition.kind != "halves":
        raise BadInputError("it has no run and entrance", where, "give a curve of two halves")
    found = {}
    for name, value in asked.items():
        if value is None:
            continue
        if name not in known:
            raise BadInputError(f"{name} does not belong to it", where, f"use {', '.join(known)}")
        found[name] = number(value, name, where) if name[0] == "l" else positive(value, name, where)
    if "cp" in found and "cb" in found:
        raise BadInputError("cp and cb are both given", where, "give one of them")
    return found


def _as_asked(error: OutOfRangeError, name: str, scale: float) -> OutOfRangeError:
    """Give an error in the name and unit of what was asked for."""
    unit = "m" if name in ("lcb", "lcf", "centroid") else ""
    return OutOfRangeError(
        name, error.value * scale, error.where, error.why, error.least * scale,
        error.most * scale, unit,
    )  # fmt: skip


def _half_sums(definition: FormDefinition, half: str) -> tuple[float, float]:
    """Give area and centroid of a half: those given, or else as they come out fairest."""
    given = [definition.value(f"{half}_{name}") for name in ("area", "centroid")]
    if given[0] is not None and given[1] is not None:
        return given[0], given[1]
    found = form_integrals(half_vertices(definition, half)[None])
    area = float(found.area[0])
    return area, float(found.moment[0]) / area
