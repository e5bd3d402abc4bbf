"""A net from a table of offsets alone: what the table leaves open is completed by rule.

A table stops at its outermost stations and tells only between which two of them a waterline comes
onto a flat. Rules here find the flats and fair their borders, carry the waterlines on to stem and
stern contour, and make the centre profile. A table that they do not fit (rising keel, bulb, no flat
of bottom) is adopted as it stands. Lengths in m, x from the AP (+ forward), z from the base line.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.errors import BadInputError, CoincidentPointsError, TooFewPointsError
from assoc_hull.geometry.curves import FloatArray, PointKind, freeze
from assoc_hull.io.offsets.net import (
    BOW_END,
    TRANSOM,
    Completion,
    adopt_completed,
    at_full_size,
    flat_ends,
    held_up,
    net_of_lines,
    particulars_of_table,
)
from assoc_hull.io.offsets.table import OffsetTable, half_section_areas
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = [
    "CLOSING",
    "FlatOfSide",
    "centre_profile",
    "end_contours",
    "fair_border",
    "flat_of_bottom",
    "flat_of_side",
    "net_from_table",
    "stem_contour",
    "stern_contour",
]

# --------------------------------------------------------------------------------------
# A fair border for the flat of side, between the stations that bound it: least squares of its
# second differences and, with a small weight, of its distance from the estimates; never narrower
# upward.

_ESTIMATE = 0.2
"""Weight of the estimates against fairness."""

_WIDENS = 0.15
"""The flat widens upward by at least this (m) from one waterline to the next, so that every
plane passes its border cleanly."""

_PINNED = 1e-6
"""Freedom (m) of the border where the flat reaches the last station of the table: the solver wants
bounds that differ."""

_CLEAR = 0.05
"""Part of the interval between two stations that the border keeps clear of either."""


def fair_border(table: OffsetTable, border: FloatArray) -> FloatArray:
    """Fair the border of the flat of side.

    Parameters
    ----------
    table : OffsetTable
        The offsets.
    border : (n, 3), m
        From the highest waterline aft, down, forward along the lower side, up again; see
        `assoc_hull.io.offsets.complete_table.flat_of_side`.

    Returns
    -------
    (n, 3), m
        Its points on waterlines moved along these, those between on stations kept.

    Examples
    --------
    >>> from assoc_hull.io.offsets.complete_table import fair_border
    >>> from assoc_hull.io.offsets.complete_table import flat_of_side
    >>> from assoc_hull.shipped.series60 import todd_table
    >>> table = todd_table(0.60)[0]
    >>> rough = flat_of_side(table).border
    >>> fair_border(table, rough).shape == rough.shape
    True
    """
    out = np.array(border)
    # A station may come onto the flat at a waterline that, printed finer, is nowhere on it.
    flat = [
        j for j, z in enumerate(table.z)
        if (np.abs(border[:, 2] - z) < 1e-9).any() and len(_on_flat(table, j))
    ]  # fmt: skip
    count = len(flat)
    for ends, sign in ((slice(count - 1, None, -1), -1.0), (slice(len(out) - count, None), 1.0)):
        part = out[:count][::-1] if sign < 0.0 else out[ends]
        low, high = _bounds(table, flat, sign)
        part[:, 0] = _fair(part[:, 0], low, high, sign)
    return out


def _bounds(table: OffsetTable, flat: list[int], sign: float) -> tuple[FloatArray, FloatArray]:
    """Give the interval (m) in which each waterline comes onto the flat, aft (-1) or forward."""
    low, high = np.zeros(len(flat)), np.zeros(len(flat))
    for i, j in enumerate(flat):
        on = _on_flat(table, j)
        inside = int(on[0] if sign < 0.0 else on[-1])
        outside = int(np.clip(inside + sign, 0, len(table.x) - 1))
        first, last = sorted((float(table.x[inside]), float(table.x[outside])))
        clear = _CLEAR * (last - first)
        low[i], high[i] = first + clear, max(last - clear, first + _PINNED)
    return low, high


def _on_flat(table: OffsetTable, j: int) -> NDArray[np.int_]:
    """Give the stations at which a waterline is B/2 within its rounding."""
    off = table.breadth / 2.0 - table.half_breadth[:, j]
    return np.flatnonzero(off <= table.rounding[j] * (1 + 1e-6) + 1e-12)


def _fair(x: FloatArray, low: FloatArray, high: FloatArray, sign: float) -> FloatArray:
    """Fair the ends x (n,) of waterlines, from the lowest up, within their bounds, m."""
    from scipy.optimize import lsq_linear

    count = len(x)
    bend = np.diff(np.eye(count), 2, axis=0) if count > 2 else np.zeros((0, count))
    rows = np.concatenate([bend, _ESTIMATE * np.eye(count)])
    goal = np.concatenate([np.zeros(len(bend)), _ESTIMATE * np.clip(x, low, high)])
    found = np.clip(lsq_linear(rows, goal, (low, high)).x, low, high)
    # Upward in order, so that each widening holds for the waterlines above too; it may pass a
    # bound.
    for i in range(1, count):
        found[i] = sign * max(sign * found[i], sign * found[i - 1] + _WIDENS)
    return found


# --------------------------------------------------------------------------------------
# Flat of side in y = B/2, flat of bottom in z = 0. Near its border the distance from the flat grows
# with the square of the distance along the line: a straight line through the square roots of the
# two nearest offsets clearly off the flat has its zero at the border. It is clamped between the
# last station off the flat and the first one on it. Likewise upward along each station.

_CLEARLY_OFF = 3.0
"""An offset is clearly off the flat by more than this many times its rounding."""

_INSIDE = 0.1
"""The border stays this part of the interval clear of the last offset off the flat: a curve
cannot come onto the flat where its offset is not on it."""


@attrs.frozen(eq=False)
class FlatOfSide:
    """The border of the flat of side.

    Attributes
    ----------
    x_aft, x_forward : (w,), m
        Where each waterline of the table enters and leaves the flat; nan where it has none.
    z_lower : (s,), m
        Where each station of the table enters the flat from below; nan where it has none.
    border : (n, 3), m
        Points of the border in y = B/2: down the aft side from the highest waterline,
        forward along the lower side, up to the highest waterline again. Empty without flat.
    """

    x_aft: FloatArray
    x_forward: FloatArray
    z_lower: FloatArray
    border: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.x_aft, self.x_forward, self.z_lower, self.border)


def flat_of_side(table: OffsetTable) -> FlatOfSide:
    """Find the flat of side of a table.

    Parameters
    ----------
    table : OffsetTable
        An offset counts as on the flat when it is B/2 within its rounding.

    Returns
    -------
    FlatOfSide
        The border holds the ends on the waterlines, and of the stations those below the
        lowest waterline that has a flat. A waterline that touches B/2 at one station only
        has a flat too, as long as the neighbours let it be.

    Examples
    --------
    >>> from assoc_hull.io.offsets.complete_table import flat_of_side
    >>> from assoc_hull.shipped.series60 import todd_table
    >>> flat_of_side(todd_table(0.60)[0]).border.shape
    (12, 3)
    """
    off = np.maximum(table.breadth / 2.0 - table.half_breadth, 0.0)
    aft, forward = np.full(len(table.z), np.nan), np.full(len(table.z), np.nan)
    for j, rounding in enumerate(table.rounding):
        aft[j] = _entry(table.x, off[:, j], float(rounding))
        forward[j] = -_entry(-table.x[::-1], off[::-1, j], float(rounding))
    coarsest = float(table.rounding.max())
    lower = np.array([_entry(table.z, row, coarsest) for row in off])
    return FlatOfSide(aft, forward, lower, _border(table, aft, forward, lower))


def _entry(place: FloatArray, off: FloatArray, rounding: float) -> float:
    """Give where a line, followed in ascending order of `place` (m), first comes onto the flat.

    `off` (n,), m, is the distance from the flat; nan where the line has none.
    """
    known = np.isfinite(off)
    place, off = place[known], off[known]
    on = np.flatnonzero(off <= rounding * (1 + 1e-6) + 1e-12)
    if not len(on):
        return float("nan")
    first = int(on[0])
    clear = np.flatnonzero(off[:first] > _CLEARLY_OFF * rounding)[-2:]
    if len(clear) < 2:
        return float(place[first])
    (u, v), (p, q) = place[clear], np.sqrt(off[clear])
    zero = v + (v - u) * q / (p - q) if p > q else place[first]
    off_flat, on_flat = float(place[first - 1]), float(place[first])
    return float(np.clip(zero, off_flat + _INSIDE * (on_flat - off_flat), on_flat))


def _border(
    table: OffsetTable, aft: FloatArray, forward: FloatArray, lower: FloatArray
) -> FloatArray:
    has = np.flatnonzero(np.isfinite(aft))
    if not len(has):
        return np.empty((0, 3))
    down, up = has[::-1], has
    lowest = table.z[has[0]]
    below = np.flatnonzero(lower < lowest)
    inside = (table.x[below] > aft[has[0]]) & (table.x[below] < forward[has[0]])
    below = below[inside]
    x = np.concatenate([aft[down], table.x[below], forward[up]])
    z = np.concatenate([table.z[down], lower[below], table.z[up]])
    return np.column_stack([x, np.full(len(x), table.breadth / 2.0), z])


def flat_of_bottom(table: OffsetTable) -> FloatArray:
    """Give the border of the flat of bottom: the waterline at the base line.

    Parameters
    ----------
    table : OffsetTable
        Its lowest waterline lies at z = 0.

    Returns
    -------
    (n, 3), m
        Points in z = 0 from stern to stem; stations without a number are left out, and of
        the zeros at either end all but the innermost.

    Raises
    ------
    BadInputError
        The table has no waterline at the base line, or no number above 0 on it.

    Examples
    --------
    >>> from assoc_hull.io.offsets.complete_table import flat_of_bottom
    >>> from assoc_hull.shipped.series60 import todd_table
    >>> flat_of_bottom(todd_table(0.70)[0])[[0, -1]].tolist()
    [[0.0, 0.0, 0.0], [121.92, 0.0, 0.0]]
    """
    y = table.half_breadth[:, 0]
    wide = np.flatnonzero(y > 0)
    if abs(table.z[0]) > 1e-9 or not len(wide):
        raise BadInputError(
            f"the lowest waterline, at {table.z[0]:g} m, is no flat of bottom",
            f"table {table.name!r}",
            "give the half-breadths of the flat of bottom as waterline 0",
        )
    rows = np.arange(max(wide[0] - 1, 0), min(wide[-1] + 2, len(y)))
    rows = rows[np.isfinite(y[rows])]
    points = np.column_stack([table.x[rows], y[rows], np.zeros(len(rows))])
    freeze(points)
    return points


# --------------------------------------------------------------------------------------
# Ends: stem and stern contour, and the centre profile. A waterline that is 0 at the outermost
# station ends at the first zero next to a positive offset; any other overhangs.

_UPRIGHT = 1e-9
"""Ends of a contour this near to each other in x (m) stand upright above each other."""

CLOSING = 0.01675
"""Overhang of the waterline z = T abaft the AP, as a part of Lpp (DTMB Report 1712)."""


def stem_contour(table: OffsetTable) -> FloatArray:
    """Give the forward end of every waterline.

    Parameters
    ----------
    table : OffsetTable
        Any table.

    Returns
    -------
    (w,), m
        x where the half-breadth becomes 0: the first zero station before the last positive
        one; before a blank the straight line through the last two offsets, no farther than
        the blank station; from the last station of the table the same line, no farther than
        one more station spacing. nan where no offset is positive.

    Examples
    --------
    >>> from assoc_hull.io.offsets.complete_table import stem_contour
    >>> from assoc_hull.shipped.series60 import todd_table
    >>> stem_contour(todd_table(0.60)[0])[-3:].round(3).tolist()
    [121.92, 123.009, 123.561]
    """
    ends = _run_out(table.x, table.half_breadth)
    freeze(ends)
    return ends


def stern_contour(table: OffsetTable, closing: float = CLOSING) -> FloatArray:
    """Give the after end of every waterline.

    Parameters
    ----------
    table : OffsetTable
        Any table.
    closing : float
        Overhang of the waterline z = T abaft x = 0, as a part of Lpp; it counts where that
        waterline is positive at the aftermost station.

    Returns
    -------
    (w,), m
        As in `stem_contour`, and by the parabola below for waterlines that are positive at the
        aftermost station where the design waterline is.

    Raises
    ------
    BadInputError
        The closing lies forward of the aftermost station.

    Notes
    -----
    Series 60 has LWL/Lpp = 1.01675 (F.H. Todd, "Series 60: Methodical Experiments with Models of
    Single-Screw Merchant Ships", DTMB Report 1712, 1963). The published numbers do not hold the
    contour; this rule is ours. It leaves the AP at the height z0 where the straight line through
    the two lowest positive offsets at the last station becomes 0 (clamped between them and the
    waterline below), and follows e = e_T sqrt((z - z0) / (T - z0)) of the overhang e, level at z0
    and steeper upward, so that higher waterlines end farther aft. At 1.25 T and 1.5 T that is 3.7 m
    and 4.8 m; the parabola through the last three offsets of those waterlines would run on to 4.3
    to 4.5 m and 5.5 to 6.4 m, and a waterline that ends round ends before that.

    Examples
    --------
    >>> from assoc_hull.io.offsets.complete_table import stern_contour
    >>> from assoc_hull.shipped.series60 import todd_table
    >>> round(float(stern_contour(todd_table(0.60)[0])[5] / 121.92), 5)
    -0.01675
    """
    ends = -_run_out(-table.x[::-1], table.half_breadth[::-1]) + 0.0
    leaving = _leaving_height(table)
    if leaving is not None:
        over = table.z > leaving
        overhang = _overhang(table, leaving, closing, table.z[over])
        ends[over] = table.x[0] - overhang
    freeze(ends)
    return ends


def end_contours(table: OffsetTable, closing: float = CLOSING) -> tuple[FloatArray, FloatArray]:
    """Give `stern_contour` and `stem_contour`, each (w,), m.

    Raises
    ------
    BadInputError
        The closing lies forward of the aftermost station.

    Examples
    --------
    >>> from assoc_hull.io.offsets.complete_table import end_contours
    >>> from assoc_hull.shipped.series60 import todd_table
    >>> [round(float(end[-1]), 3) for end in end_contours(todd_table(0.60)[0])]
    [-4.826, 123.561]
    """
    return stern_contour(table, closing), stem_contour(table)


def _run_out(x: FloatArray, y: FloatArray) -> FloatArray:
    """Give where each column of y (s, w) ends in the direction of ascending x (s,)."""
    return np.array([_last_zero(x, column) for column in y.T])


def _last_zero(x: FloatArray, y: FloatArray) -> float:
    positive = np.flatnonzero(y > 0)
    if not len(positive):
        return float("nan")
    last = int(positive[-1])
    if last + 1 < len(x) and y[last + 1] == 0:
        return float(x[last + 1])
    limit = x[last + 1] if last + 1 < len(x) else 2 * x[last] - x[last - 1]
    fall = y[last - 1] - y[last] if last else np.nan
    if not fall > 0:
        return float(x[last])
    return float(min(x[last] + (x[last] - x[last - 1]) * y[last] / fall, limit))


def _leaving_height(table: OffsetTable) -> float | None:
    """Give the height (m) where the stern contour leaves the aftermost station, if it does."""
    y, z, draught = table.half_breadth[0], table.z, table.draught
    positive = np.flatnonzero(y > 0)
    if draught is None or not len(positive) or positive[0] == 0 or len(positive) < 2:
        return None
    low, high = int(positive[0]), int(positive[1])
    rise = (y[high] - y[low]) / (z[high] - z[low])
    zero = z[low] - y[low] / rise if rise > 0 else z[low - 1]
    zero = float(np.clip(zero, z[low - 1], z[low]))
    return zero if zero < draught else None


def _overhang(table: OffsetTable, leaving: float, closing: float, z: FloatArray) -> FloatArray:
    """Give the overhang (m) abaft the aftermost station at the heights z above `leaving`."""
    at_draught = closing * table.length + float(table.x[0])
    if not at_draught > 0 or table.draught is None:
        raise BadInputError(
            f"the closing {closing:g} ends the design waterline at x = "
            f"{-closing * table.length:.6g} m, not abaft the last station, {table.x[0]:.6g} m",
            f"table {table.name!r}",
            "give a larger closing",
        )
    return np.asarray(at_draught * np.sqrt((z - leaving) / (table.draught - leaving)))


def centre_profile(
    table: OffsetTable, closing: float = CLOSING
) -> tuple[FloatArray, NDArray[np.int8]]:
    """Give the profile in the centre plane, from the stern at the deck round to the stem.

    Parameters
    ----------
    table : OffsetTable
        With a level keel in z = 0 and positive offsets on its lowest waterline.
    closing : float
        As in `stern_contour`.

    Returns
    -------
    points : (n, 3), m
        In y = 0: from the highest waterline down the stern contour, where every second point
        is half-way in x between two ends of waterlines; down the upright at the AP to the keel;
        forward along the keel; up the upright stem; out along the rake to the highest
        waterline. A table whose end is not upright gives the ends of all its waterlines.
    kinds : (n,) int8
        A `PointKind` each: knuckles where the contour leaves the upright at the AP, at both
        ends of the keel and where the stem begins to rake; smooth elsewhere.

    Raises
    ------
    BadInputError
        The keel is not level, or the lowest waterline does not lie in z = 0, or an end of a
        waterline is unknown.

    Examples
    --------
    >>> from assoc_hull.io.offsets.complete_table import centre_profile
    >>> from assoc_hull.shipped.series60 import todd_table
    >>> points, kinds = centre_profile(todd_table(0.70)[0])
    >>> points[kinds == 2].round(2).tolist()
    [[0.0, 0.0, 6.18], [0.0, 0.0, 0.0], [121.92, 0.0, 0.0], [121.92, 0.0, 6.97]]
    """
    stern, stem = end_contours(table, closing)
    _refuse_rising(table, stern, stem)
    aft, forward = _stern_points(table, stern, closing), _stem_points(table, stem)
    xz = np.concatenate([aft, [[stern[0], 0.0], [stem[0], 0.0]], forward])
    kinds = np.full(len(xz), PointKind.SMOOTH, np.int8)
    corner = len(aft)
    kinds[[corner, corner + 1]] = PointKind.KNUCKLE
    for leaves, foot in ((corner - 1, corner), (corner + 2, corner + 1)):
        if leaves not in (0, len(xz) - 1) and abs(xz[leaves, 0] - xz[foot, 0]) <= _UPRIGHT:
            kinds[leaves] = PointKind.KNUCKLE
    points = np.column_stack([xz[:, 0], np.zeros(len(xz)), xz[:, 1]])
    freeze(points, kinds)
    return points, kinds


def _refuse_rising(table: OffsetTable, stern: FloatArray, stem: FloatArray) -> None:
    known = np.isfinite(stern).all() and np.isfinite(stem).all()
    if table.keel is None and not (np.nan_to_num(table.half_breadth[:, 0]) > 0.0).any():
        raise BadInputError(
            "no station has a breadth at the lowest level, so there is no flat bottom", "the table",
            "give the half-breadths of the flat bottom as waterline 0, or a column keel",
        )  # fmt: skip
    if table.keel is not None or abs(table.z[0]) > 1e-9 or not known:
        raise BadInputError(
            "the keel is not level or the table does not reach down to it",
            f"table {table.name!r}",
            "if she needs her stern, stem and transom closed, give her as lines with a profile, "
            "as a mesh or as surfaces",
        )


def _stern_points(table: OffsetTable, stern: FloatArray, closing: float) -> FloatArray:
    """Give (x, z) from the deck down to where the contour joins the upright, (n, 2), m."""
    leaving = _leaving_height(table)
    if leaving is None:
        return _bends(np.column_stack([stern, table.z]))[::-1]
    over = table.z > leaving
    ends = np.concatenate([[0.0], _overhang(table, leaving, closing, table.z[over])])
    overhang = np.sort(np.concatenate([ends, (ends[1:] + ends[:-1]) / 2.0]))
    at_draught = closing * table.length + float(table.x[0])
    z = leaving + (overhang / at_draught) ** 2 * ((table.draught or 0.0) - leaving)
    z[::2] = np.concatenate([[leaving], table.z[over]])
    return np.column_stack([table.x[0] - overhang, z])[::-1]


def _stem_points(table: OffsetTable, stem: FloatArray) -> FloatArray:
    """Give (x, z) from where the stem leaves the upright to the deck, (n, 2), m."""
    return _bends(np.column_stack([stem, table.z]))


def _bends(xz: FloatArray) -> FloatArray:
    """Leave out the points of an upright contour below its last one, (n, 2)."""
    upright = np.flatnonzero(np.abs(xz[:, 0] - xz[0, 0]) <= _UPRIGHT)
    run = int(upright[np.flatnonzero(upright == np.arange(len(upright)))][-1])
    return xz[run:] if run else xz[1:]


def net_from_table(
    table: OffsetTable,
    tolerances: Tolerances | None = None,
    *,
    deck: str = "open",
    particulars: Particulars | None = None,
    imported: bool = False,
) -> tuple[HullState, AdoptionReport]:
    """Adopt a table of offsets; profile, ends and flats as for the Series 60 example.

    A table that these rules do not fit, as of a rising keel, a bulb or a bottom without a flat,
    is adopted as it stands: its lines, and a profile only where it has heights of the keel. The
    first note tells why.

    Parameters
    ----------
    table : OffsetTable
        Offsets in metres.
    tolerances : Tolerances or None
        Defaults if None.
    deck : {"open", "closed"}
        Closed: there is a deck between the deck edges; a table does not tell.
    particulars : Particulars or None
        None: those that the table tells, with this deck.
    imported : bool
        As imports have it: lines off the flats run straight, too, between neighbours of their
        greatest offset, and sections turn in knuckles; the shipped Series 60 goes without.

    Returns
    -------
    HullState, AdoptionReport

    Raises
    ------
    BadInputError
        A table that holds too little for a net, or another word for the deck.
    """
    ship = particulars or particulars_of_table(table, deck)
    try:
        # Fits of borders know lengths: a short hull passes them at the size these hold for.
        completion = _completion(at_full_size(table))
        unused = tuple(_level_deck(table))
        if unused:
            ship = attrs.evolve(ship, depth=float(table.z[-1]))
        state, report = adopt_completed(table, completion, ship, tolerances, imported=imported)
        # Of the shipped Series 60 the ends are explained where she is made.
        stern, stem = completion.stern, completion.stem
        beyond = _drawn_ends(table, at_full_size(table), stern, stem) if imported else ()
        return state, attrs.evolve(report, notes=(*beyond, *report.notes), unused=unused)
    except (BadInputError, CoincidentPointsError, TooFewPointsError) as error:
        ends = _known_ends(table)
        state, report = net_of_lines(table, ship, tolerances, ends)
        profile = _profile_of(state)
        left = "flats" if profile is not None else "profile, ends and flats"
        note = f"{left} are left open: {_in_its_size(table, error)}"
        if profile is None and "column keel" not in note:
            note += "; a column 'keel' that goes up to the deck at both ends makes the profile"
        about = list[str]()
        if profile is not None:
            about += [] if ends is None else _drawn_ends(table, table, *ends, profile)
            about += [note, *_ends_left(table, state, profile)]
        notes = (*(about or (note,)), *report.notes, *_coarse_keel(table))
        return state, attrs.evolve(report, notes=notes)


def _level_deck(table: OffsetTable) -> Iterator[str]:
    """Tell that the rules draw a level deck edge, where the table has one with heights."""
    if table.deck_height is None or not np.isfinite(table.deck_height).any():
        return
    top, low, high = table.z[-1], np.nanmin(table.deck_height), np.nanmax(table.deck_height)
    if max(high - top, top - low) > _UPRIGHT:
        yield (
            f"its deck at {low:.6g} to {high:.6g} m is not used: the rules that close stem, stern "
            f"and flats know no sheer and end at the highest waterline, z = {top:.6g} m, as a "
            "level deck edge, which is her depth here; give her as lines to have it as drawn (vary "
            "with sheer_fore and sheer_aft gives her sheer, and stretches all lines above the "
            "draught for it)"
        )


def _profile_of(state: HullState) -> FloatArray | None:
    """Give the points of the profile, (n, 3), m, from aft; None where there is none."""
    for line in state.live("lines").tolist():
        if state.lines.name[line] == "profile":
            return state.spline(state.lines.curves[line][0]).xyz
    return None


def _ends_left(table: OffsetTable, state: HullState, profile: FloatArray) -> Iterator[str]:
    """Tell which ends are taken to be flat, and where the profile stops below the deck and why."""
    known = np.full(1, table.z[-1]) if table.deck_height is None else table.deck_height
    known = known[np.isfinite(known)]
    lines = {str(state.lines.name[line]) for line in state.live("lines").tolist()}
    for row, name, edge, place, deck, way in (
        (0, "stern", TRANSOM, profile[0], known[0], "aft"),
        (-1, "bow", BOW_END, profile[-1], known[-1], "forward"),
    ):  # fmt: skip
        if edge in lines:
            yield (
                f"assumed: {name}: the table: her {'first' if row == 0 else 'last'} station, x = "
                f"{table.x[row]:.6g} m, where the keel ends, is the edge of a flat end, '{edge}': "
                f"if she goes on, give one more station {way}, with the keel where she ends"
            )
        elif place[2] < deck - _UPRIGHT:
            yield (
                f"the {'stern' if row == 0 else 'stem'} is open from x = {place[0]:.6g} m, z = "
                f"{place[2]:.6g} m up to the deck at {deck:.6g} m: give one more station {way}, "
                f"where it meets the deck, with {_at_the_deck(table, float(deck))}; or, where it "
                f"is upright, a station of zeros a little {'abaft' if row == 0 else 'forward of'} "
                f"the last{_under_water(table, row)}"
            )


def _under_water(table: OffsetTable, row: int) -> str:
    """Say that the immersed part of a stern that is open counts as no transom; a bow has none."""
    area = 2.0 * float(half_section_areas(table.half_breadth, table.z, table.draught)[row])
    if row != 0 or not area > 0.0:
        return ""
    return f"; some {area:.2g} m2 of it are under water and count as no transom (A_T is 0)"


def _at_the_deck(table: OffsetTable, deck: float) -> str:
    """Say what the row of a stem's head, or of a stern's, has in its columns."""
    if table.deck_height is None or table.deck_half_breadth is None:
        return f"keel {deck:.6g} and blank half-breadths"
    return (
        f"keel and deck both {deck:.6g}, or how high the deck is there, 0 as half-breadth of the "
        "deck and blank half-breadths"
    )


def _drawn_ends(
    table: OffsetTable, full: OffsetTable, stern: FloatArray, stem: FloatArray,
    profile: FloatArray | None = None,
) -> Iterator[str]:  # fmt: skip
    """Tell how far waterlines were drawn beyond the last stations that have breadth there.

    `full` is the table at the size of the ends; a `profile` has to reach them.
    """
    ends = (
        ("stern", 0, full.x[0] - stern, "abaft", "aft"),
        ("stem", -1, stem - full.x[-1], "forward of", "forward"),
    )
    for name, row, beyond, way, side in ends:
        over = np.where(full.half_breadth[row] > 0.0, beyond, 0.0)
        most = int(np.nanargmax(over))
        if not over[most] > _UPRIGHT or not _reaches(profile, row, full, float(over[most])):
            continue
        part = float(over[most]) / full.length
        number = "first" if row == 0 else "last"
        other = ", or a transom by lines, a mesh or a surface" if row == 0 else ""
        yield (
            f"assumed: {name}: the table: its {number} station, x = {table.x[row]:.6g} m, has "
            f"breadth and no station stands {way} it: waterlines are drawn on to end up to "
            f"{part * table.length:.4g} m ({part:.2g} Lpp) {way} it, at z = {table.z[most]:.4g} m; "
            f"to choose their ends give one more station {side} with 0 where they end{other}"
        )


def _reaches(profile: FloatArray | None, row: int, full: OffsetTable, over: float) -> bool:
    """Tell whether a profile (n, 3) goes so far (m) beyond the last station; that of rules does."""
    if profile is None:
        return True
    beyond = float(full.x[0] - profile[0, 0] if row == 0 else profile[-1, 0] - full.x[-1])
    return abs(beyond - over) < 1e-6 * full.length


_STEEP = 0.3
"""Between two stations a keel that rises by more of the draught is told: it is not known there."""


def _coarse_keel(table: OffsetTable) -> list[str]:
    """Say where heights of the keel are too far apart to tell the profile, as at a round forefoot.

    The profile is straight there; what it may lack is the corner beside it, on both sides.
    """
    if table.keel is None:
        return []
    known = np.isfinite(table.keel)
    x, z = table.x[known], table.keel[known]
    rise, run = np.abs(np.diff(z)), np.diff(x)
    steep = np.flatnonzero(rise > _STEEP * (table.draught or float(table.z[-1])))
    return [
        f"between x = {x[i]:.6g} and {x[i + 1]:.6g} m the keel rises by {rise[i]:.4g} m and the "
        "table says no more: the profile is straight there, and S may lack up to "
        f"{rise[i] * run[i]:.3g} m2; give stations between them"
        for i in steep.tolist()
    ]


def _in_its_size(
    table: OffsetTable, error: BadInputError | CoincidentPointsError | TooFewPointsError
) -> str:
    """Say why a table has no completion, with lengths of its own and not of full size."""
    try:
        _completion(table)
    except BadInputError as own:
        return f"{own.what}; {own.remedy}"
    if isinstance(error, BadInputError):
        return f"{error.what}; {error.remedy}"
    return f"{error}; give that line one more number, or leave it out"


def _known_ends(table: OffsetTable) -> tuple[FloatArray, FloatArray] | None:
    """Give where waterlines end, None where the table has no heights of the keel, or tells none."""
    if table.keel is None:
        return None
    aft, fore = flat_ends(table)
    try:
        stern = np.full(len(table.z), table.x[0]) if aft else stern_contour(table, _closing(table))
        return stern, np.full(len(table.z), table.x[-1]) if fore else stem_contour(table)
    except BadInputError:
        return None


def _closing(table: OffsetTable) -> float:
    return CLOSING if table.closing is None else table.closing


def _completion(table: OffsetTable) -> Completion:
    stern, stem = end_contours(table, _closing(table))
    profile, kinds = centre_profile(table, _closing(table))
    # Sections begin on the profile: a stern or stem of few points may not sink below the keel.
    kinds = held_up(LineSource.make("boundary", "profile", profile, kind=kinds.tolist()), 2).kind
    border = flat_of_side(table).border
    side = fair_border(table, border) if len(border) else None
    bottom = _closed_border(flat_of_bottom(table), float(stern[0]), float(stem[0]))
    return Completion(profile, kinds, stern, stem, bottom, side)


def _closed_border(border: FloatArray, aft: float, forward: float) -> FloatArray:
    """Lead the border of a flat of bottom, (n, 3), m, to the ends of the keel where it has breadth.

    The next station is blank there: the keel rises, or the table ends.
    """
    parts = [border]
    if border[0, 1] > 0.0 and aft < border[0, 0] - _UPRIGHT:
        parts.insert(0, np.array([[aft, 0.0, 0.0]]))
    if border[-1, 1] > 0.0 and forward > border[-1, 0] + _UPRIGHT:
        parts.append(np.array([[forward, 0.0, 0.0]]))
    return np.concatenate(parts)
