"""Base line, perpendiculars and particulars of a hull: as given, as stated in the file, or found.

One rule for all readers; each value that was not given is told with its evidence. x = 0 of the
file counts as a perpendicular or as midship if it lies within half a per cent of Lpp of where the
rule finds it, z = 0 as the base line within a thousandth: so much do printed lengths, the plating
and the choice of draught shift the stem, and a hull that is in ship axes already keeps its bits.
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.io.lines.ship_frame import ShipFrame, StatedPlaces
from assoc_hull.io.placing.options import FileAxes, FrameOptions, same_place
from assoc_hull.io.placing.outline import HullOutline, Keel, Level, find_stem, measure_keel
from assoc_hull.io.reports import Notebook
from assoc_hull.io.units import METRES

__all__ = ["find_frame", "fitting_places"]

_LEVEL = 1e-3
"""Heights this part of Lpp apart are one: z = 0 is the base line, what is lower hangs below it."""

_SIDES = 1e-3
"""Breadth or depth this part less than that of all of the hull is that of all of the hull."""

_DEPTH = 0.01
"""A depth that differs from the height of the drawn deck edge by more than this part is told."""

_WET, _DRY = 0.1, 0.95
"""z = 0 of the file between these parts of the depth is taken for the waterline."""

_FAR = 0.25
"""A perpendicular this part of the length beyond the hull is a mistake."""

_NEAR = 0.03
"""x = 0 of the file this part of Lpp from a perpendicular that was found may be meant for it."""

_ROUNDS = 3
"""Stretch of the keel, base line and draught follow from one another: so often."""

_UNITS_HINT = "in units of the file, or with a unit, as '12.5 m'"


@attrs.define
class _Heights:
    """Base line and design waterline, m in coordinates of the file, with the evidence of each."""

    base: float
    base_from: tuple[str, str]
    draught: float
    draught_from: tuple[str, str]
    keel: Keel
    level: Level

    @property
    def waterline(self) -> float:
        return self.base + self.draught


@attrs.define
class _Ends:
    """Perpendiculars, m in coordinates of the file, with the evidence of each."""

    ap: float
    ap_from: tuple[str, str]
    fp: float
    fp_from: tuple[str, str]
    length: float | None
    suspicion: str | None = None


def find_frame(
    outline: HullOutline,
    options: FrameOptions,
    book: Notebook,
    where: str,
    *,
    axes: FileAxes | None = None,
    stated: StatedPlaces | None = None,
) -> ShipFrame:
    """Find where a hull lies in its file.

    Parameters
    ----------
    outline : HullOutline
        The hull, m, forward, to port and upward positive, with the origin of the file.
    options : FrameOptions
        What the caller says.
    book : Notebook
        Takes an assumption for each value found, and suspicions.
    where : str
        What was read, for notes and messages: "the mesh".
    axes : FileAxes or None
        How places that were given become m; None: they are.
    stated : StatedPlaces or None
        What the file says of itself.

    Raises
    ------
    BadInputError
        A place or particular that the hull does not reach, or that contradicts another.
    """
    asked = options.in_metres(axes or FileAxes())
    said = stated or StatedPlaces()
    heights = _heights(outline, asked, said, where)
    trim = (asked.draught_aft or 0.0) - (asked.draught_fwd or 0.0)
    stem = _stem(outline, heights, trim, book, where)
    ends = _ends(outline, heights, stem, asked, said, where)
    _check_ends(outline, ends, where)
    length = ends.fp - ends.ap if ends.length is None else ends.length
    _tell_heights(outline, heights, length, (axes or FileAxes()).z_sign, book, where)
    _tell_waterline(outline, heights, said, book, where)
    _tell_ends(outline, ends, stem, length, book, where)
    if ends.length is not None and ends.ap_from[0] == ends.fp_from[0] == "found":
        _tell_zero(ends, length, (axes or FileAxes()).x_sign, book, where)
    breadth = _breadth(outline, heights, asked, said, book, where)
    depth = _depth(outline, heights, ends, asked, said, book, where)
    if trim:
        what = f"{trim:.6g} m by the stern; the draught amidships is {heights.draught:.6g} m"
        book.assume("design trim", where, f"{what}, the hull stays in its own axes", trim)
    _tell_mean(asked, heights.draught, book, where)
    frame = ShipFrame(
        ap=ends.ap, fp=ends.fp, base=heights.base, draught=heights.draught, breadth=breadth[0],
        depth=depth[0], trim=trim, rake=heights.keel.rise * length, stem=stem,
        given_length=ends.length,
        origins={
            "base": heights.base_from[0], "draught": heights.draught_from[0],
            "ap": ends.ap_from[0], "fp": ends.fp_from[0], "breadth": breadth[1],
            "depth": depth[1],
        },
    )  # fmt: skip
    _tell_shift(frame, outline, book, where)
    return frame


def _tell_mean(asked: FrameOptions, draught: float, book: Notebook, where: str) -> None:
    """Tell which draught counts where one was given beside both of a design trim."""
    mean = attrs.evolve(asked, draught=None).mean_draught
    if asked.draught is not None and mean is not None and asked.draught != mean:
        what = f"{draught:.6g} m, as given; the mean of draught_aft and draught_fwd is {mean:.6g} m"
        book.assume("draught", where, f"{what}, and they give the trim alone", draught - mean)


# --------------------------------------------------------------------------------------
# What a file states, held against the extents.

_FITS = {"length": (0.7, 1.1), "breadth": (0.7, 1.05), "depth": (0.4, 1.05), "draught": (0.05, 1.0)}
"""Between these parts of the extent a particular that a file states can be that of the hull."""


def fitting_places(
    stated: StatedPlaces, outline: HullOutline, options: FrameOptions, book: Notebook, where: str
) -> StatedPlaces:
    """Give what a file states of those values that its hull can have; suspect the others."""
    low, high = outline.low, outline.high
    tall = float(high[2]) - (float(low[2]) if stated.base is None else stated.base)
    sizes = {
        "length": outline.size, "breadth": 2.0 * float(np.abs(outline.xyz[:, 1]).max()),
        "depth": tall, "draught": tall,
    }  # fmt: skip
    # Bare sections end up to a spacing short of either end of the hull.
    more = {"length": 4.0 * outline.doubt}
    wrong: dict[str, Any] = {}
    for name, size in sizes.items():
        value, (least, most) = getattr(stated, name), _FITS[name]
        if value is None or getattr(options, name) is not None:
            continue
        if not least * size <= value <= most * size + more.get(name, 0.0):
            wrong[name] = None
            what = f"the file says {value:.6g} m, and the lines reach over {size:.6g} m: not taken"
            book.suspect(name, where, f"{what}; give {name}= in m, and check unit= and scale=",
                         value)  # fmt: skip
    slack = _FAR * outline.size
    for name in ("ap", "fp", "rudder"):
        value = getattr(stated, name)
        if value is not None and not low[0] - slack <= value <= high[0] + slack:
            wrong[name] = None
            what = f"the file has it at x = {value:.6g} m, and the hull runs from {low[0]:.6g} to"
            book.suspect(name, where, f"{what} {high[0]:.6g} m: not taken; give {name}=", value)
    return attrs.evolve(stated, **wrong)


# --------------------------------------------------------------------------------------
# Heights: base line and design waterline.


def _heights(outline: HullOutline, asked: FrameOptions, said: StatedPlaces, where: str) -> _Heights:
    low, high = float(outline.low[2]), float(outline.high[2])
    level = _level(outline, 0.5 * (low + high))
    _check_heights(asked, low, high, where)
    for _ in range(_ROUNDS):
        keel = measure_keel(outline, level.aft, level.fore)
        length = asked.length or said.length or level.fore - level.aft
        base, base_from = _base(keel, length, asked, said)
        draught, draught_from = _draught(base, low, high, asked, said)
        _check_draught(base, draught, draught_from, high, where)
        level = _level(outline, base + draught)
    return _Heights(base, base_from, draught, draught_from, keel, level)


def _level(outline: HullOutline, z: float) -> Level:
    """Measure a waterline; that of the whole extent where the hull has none at this height."""
    x = outline.xyz[:, 0]
    half = float(np.abs(outline.xyz[:, 1]).max())
    return outline.level(outline.inside(z)) or Level(float(x.min()), float(x.max()), half)


def _base(
    keel: Keel, length: float, asked: FrameOptions, said: StatedPlaces
) -> tuple[float, tuple[str, str]]:
    """Give the height of the base line in the file, whence it is known, and the evidence."""
    given, waterline, draught = asked.metres("base"), asked.metres("waterline"), asked.mean_draught
    if given is not None:
        return given, ("given", f"at z = {given:.6g} m of the file, as given")
    if waterline is not None and draught is not None:
        base = waterline - draught
        return base, ("given", f"at z = {base:.6g} m, the draught below the waterline, as given")
    if said.base is not None:
        return said.base, ("stated", f"at z = {said.base:.6g} m, {said.why('base')}")
    stretch = "the bottom on the centre line between .3 and .7 of the waterline"
    if abs(keel.low) <= _LEVEL * length:
        off = f"within {1e3 * abs(keel.low):.3g} mm of it" if keel.low else "there"
        return 0.0, ("found", f"z = 0 of the file, since {stretch} lies {off}")
    what = f"at z = {keel.low:.6g} m of the file, the lowest place of {stretch}"
    return keel.low, ("found", f"{what}, at x = {keel.at:.6g} m")


def _draught(
    base: float, low: float, high: float, asked: FrameOptions, said: StatedPlaces
) -> tuple[float, tuple[str, str]]:
    """Give the draught (m), whence it is known, and the evidence."""
    given, waterline = asked.mean_draught, asked.metres("waterline")
    if given is not None:
        return given, ("given", f"{given:.6g} m, as given")
    if waterline is not None:
        draught = waterline - base
        what = f"{draught:.6g} m, up to the waterline given at z = {waterline:.6g} m of the file"
        return draught, ("given", what)
    if said.draught is not None:
        why = said.why("draught")
        return said.draught, ("stated", why and f"{said.draught:.6g} m, {why}")
    depth = high - base
    # A hull drawn up to its waterline only ends there; a deck near z = 0 is no waterline.
    ends = abs(high) <= _LEVEL * depth
    if base < 0.0 and (_WET * depth < -base <= _DRY * depth or ends):
        what = f"{-base:.6g} m: z = 0 of the file cuts the hull and is taken for the waterline"
        return -base, ("found", f"{what}; if it is not, give draught= or waterline=")
    what = f"{0.5 * depth:.6g} m, half the height of the hull, because nothing tells it"
    return 0.5 * depth, ("assumed", f"{what}; give draught= or waterline=")


def _check_heights(asked: FrameOptions, low: float, high: float, where: str) -> None:
    """Refuse a base line or a waterline that the hull does not reach."""
    reach = f"the hull runs from z = {low:.6g} to {high:.6g} m of the file at full scale"
    slack = _FAR * (high - low)
    for name, least, most in (("base", low - slack, high), ("waterline", low, high)):
        value = asked.metres(name)
        if value is not None and not least <= value <= most + _LEVEL * (high - low):
            raise BadInputError(
                f"{name} is z = {value:.6g} m, and {reach}", f"in {where}",
                f"give {name} {_UNITS_HINT}",
            )  # fmt: skip


def _check_draught(
    base: float, draught: float, source: tuple[str, str], high: float, where: str
) -> None:
    """Refuse a waterline over the top of the hull, or at the base line."""
    top = high - base
    if not draught > 0.0:
        raise BadInputError(
            f"the waterline lies {-draught:.6g} m below the base line", f"in {where}",
            f"give base and waterline {_UNITS_HINT}",
        )  # fmt: skip
    if source[0] == "given" and draught > (1.0 + _SIDES) * top:
        raise BadInputError(
            f"the design waterline, {draught:.6g} m above the base line, lies over the top of the "
            f"hull, {top:.6g} m above it", f"in {where}",
            "give draught= in m at full scale, and check unit=, scale=, base= and axes=",
        )  # fmt: skip


def _tell_heights(
    outline: HullOutline,
    heights: _Heights,
    length: float,
    z_sign: float,
    book: Notebook,
    where: str,
) -> None:
    keel, base = heights.keel, heights.base
    if heights.base_from[0] != "given":
        book.assume("base line", where, heights.base_from[1], base)
    # The base line of a raked keel may be through any place of it.
    elif abs(keel.low - base) > (_LEVEL + abs(keel.rise)) * length:
        what = f"{heights.base_from[1]}; the bottom amidships lies at z = {keel.low:.6g} m"
        book.suspect("base line", where, f"{what}, {abs(keel.low - base):.4g} m off: check it",
                     keel.low - base)  # fmt: skip
    if keel.rise:
        rake = abs(keel.rise) * length
        end = "aft" if keel.rise > 0.0 else "forward"
        what = f"the keel is raked, over Lpp {rake:.4g} m deeper {end}; the base line is level"
        book.assume("raked keel", where, f"{what}, through its lowest place amidships", rake)
        _tell_raked_zero(heights, length, z_sign, book, where)
    if heights.draught_from[0] != "given" and heights.draught_from[1]:
        book.assume("draught", where, heights.draught_from[1], heights.draught)
    _tell_below(outline, heights, length, book, where)


def _tell_raked_zero(
    heights: _Heights, length: float, z_sign: float, book: Notebook, where: str
) -> None:
    """Suspect a draught given over a raked keel, below which the file has its z = 0 elsewhere."""
    base, (base_from, draught_from) = heights.base, (heights.base_from[0], heights.draught_from[0])
    # Farther off z = 0 is no base line of any draught.
    near = _LEVEL * length < abs(base) < 0.5 * heights.draught
    if near and base_from == "found" and draught_from == "given":
        side = "over" if base > 0.0 else "below"
        what = f"the keel is raked, and the draught counts from {abs(base):.4g} m {side} z = 0"
        place = f"'{z_sign * base:.6g} m'"
        what += f" of the file: if it is meant from z = 0 give base=0; if not, give base={place}"
        book.suspect("base line", where, what, base)


_SHOWN = 0.01
"""A draught this part of the depth off the waterline that the file shows is doubtful."""


def _tell_waterline(
    outline: HullOutline, heights: _Heights, said: StatedPlaces, book: Notebook, where: str
) -> None:
    """Suspect a draught that was given and is not up to the waterline that the file shows."""
    low, high = (float(end) for end in (outline.xyz[:, 2].min(), outline.xyz[:, 2].max()))
    shown, (origin, why) = _draught(heights.base, low, high, FrameOptions(), said)
    off = heights.draught - shown
    known = heights.draught_from[0] == "given" and origin != "assumed"
    if known and abs(off) > _SHOWN * (high - heights.base):
        what = f"{heights.draught:.6g} m was given, and the file shows {why}"
        book.suspect("draught", where, f"{what}; {abs(off):.4g} m off", off)


def _tell_below(
    outline: HullOutline, heights: _Heights, length: float, book: Notebook, where: str
) -> None:
    """Tell what hangs below the base line: it was not taken for the bottom."""
    row = int(outline.xyz[:, 2].argmin())
    deep = heights.base - float(outline.xyz[row, 2])
    if deep <= _LEVEL * length:
        return
    x, level = float(outline.xyz[row, 0]), heights.level
    part = (x - level.aft) / max(level.fore - level.aft, 1e-300)
    raked = abs(heights.keel.rise) * length > 0.5 * deep
    kind = "a dome or bulb" if part > 0.7 else "a skeg or bossing" if part < 0.3 else "a fin"
    name = "the raked keel" if raked else kind
    what = f"{name} reaches {deep:.4g} m below the base line, at x = {x:.6g} m of the file"
    book.assume("below the base line", where, what, deep)


# --------------------------------------------------------------------------------------
# Ends: the perpendiculars.


def _stem(
    outline: HullOutline, heights: _Heights, trim: float, book: Notebook, where: str
) -> float:
    """Give x where the stem meets the design waterline, which may be inclined."""
    z = heights.waterline - 0.5 * trim
    found = find_stem(outline, z, heights.level)
    if found.doubt is not None and heights.draught_from[0] != "assumed":
        book.suspect("stem", where, found.doubt, found.x)
    elif found.note or found.doubt:
        book.assume("stem", where, found.note or found.doubt or "", found.x)
    return found.x


def _ends(
    outline: HullOutline,
    heights: _Heights,
    stem: float,
    asked: FrameOptions,
    said: StatedPlaces,
    where: str,
) -> _Ends:
    """Find both perpendiculars: as given, as stated, by the stem and Lpp, by the waterline."""
    length, length_from = _length(asked, said)
    ap, fp = asked.metres("ap"), asked.metres("fp")
    _check_reach(outline, {"ap": ap, "fp": fp}, where)
    if asked.origin is not None:
        ap, fp = _by_origin(asked.origin, length, stem)
    why = "as given" if asked.origin is None else f"x = 0 of the file is {asked.origin}, as given"
    if ap is not None and fp is not None:
        _check_length(ap, fp, length, where)
        return _Ends(ap, ("given", why), fp, ("given", why), length)
    if ap is not None:
        return _from_ap(ap, why, stem, length)
    fp_from = ("given", why) if fp is not None else ("found", f"the stem meets the waterline at "
               f"z = {heights.waterline:.6g} m there")  # fmt: skip
    if fp is None and said.fp is not None:
        fp, fp_from = said.fp, ("stated", said.why("fp"))
    fixed = fp is not None
    fp = stem if fp is None else fp
    if said.ap is not None and length is not None and not fixed:
        ahead = ("found", f"Lpp = {length:.6g} m, {length_from}, forward of the AP")
        return _Ends(said.ap, ("stated", said.why("ap")), said.ap + length, ahead, length)
    if said.ap is not None and fp_from[0] == "stated":
        return _Ends(said.ap, ("stated", said.why("ap")), fp, fp_from, length)
    if length is not None:
        found = _from_fp(fp, fp_from, length, length_from)
        return found if fixed else _snapped(found, length, outline.doubt)
    if said.ap is not None or said.rudder is not None:
        axis = said.ap if said.ap is not None else said.rudder
        name = said.why("ap") if said.ap is not None else "the rudder axis that the file tells"
        return _Ends(float(axis or 0.0), ("stated", name), fp, fp_from, None)
    return _by_waterline(outline, heights, fp, fp_from)


def _length(asked: FrameOptions, said: StatedPlaces) -> tuple[float | None, str]:
    if asked.length is not None:
        return asked.length, "given"
    return said.length, "stated in the file"


def _check_reach(outline: HullOutline, places: dict[str, float | None], where: str) -> None:
    """Refuse a perpendicular far beyond the hull."""
    low, high = float(outline.low[0]), float(outline.high[0])
    slack = _FAR * (high - low)
    for name, x in places.items():
        if x is not None and not low - slack <= x <= high + slack:
            raise BadInputError(
                f"{name} is x = {x:.6g} m, and the hull runs from x = {low:.6g} to {high:.6g} m "
                "of the file at full scale, forward positive", f"in {where}",
                f"give {name} {_UNITS_HINT}, or axes= if the bow is at the other end",
            )  # fmt: skip
    ap, fp = places["ap"], places["fp"]
    if ap is not None and fp is not None and not ap < fp:
        raise BadInputError(
            f"ap is x = {ap:.6g} m and fp x = {fp:.6g} m, forward positive", f"in {where}",
            "exchange them, or give axes= if the bow is at the other end",
        )  # fmt: skip


def _check_ends(outline: HullOutline, ends: _Ends, where: str) -> None:
    """Refuse perpendiculars between which the hull does not lie."""
    low, high = float(outline.low[0]), float(outline.high[0])
    common = min(ends.fp, high) - max(ends.ap, low)
    if common < 0.5 * (high - low) or common < 0.5 * (ends.fp - ends.ap):
        raise BadInputError(
            f"the perpendiculars would stand at x = {ends.ap:.6g} and {ends.fp:.6g} m of the file, "
            f"and the hull runs from {low:.6g} to {high:.6g} m at full scale", f"in {where}",
            f"{_other_unit(high - low, ends.fp - ends.ap, where)}give length= in m at full scale, "
            "ap= and fp= as they are in the file, origin= and scale= as they are, and axes= if the "
            "bow is at the other end",
        )  # fmt: skip


_NEAR = 0.03
"""Lpp and the length over all differ by so much, and units by ten times more."""


def _other_unit(size: float, length: float, where: str) -> str:
    """Ask for the unit in which a hull of this size (m) has Lpp, if there is one.

    Only a table has columns, of which one alone may be in another unit.
    """
    if not length > 0.0:
        return ""  # a waterline that is a point has no length to compare with
    for unit in ("ft", "in", "cm", "mm"):
        if abs(size * METRES[unit] / length - 1.0) < _NEAR:
            named = f" (or, if x alone is, name its column 'x_{unit}')" if "table" in where else ""
            return f"are these {_WORDS[unit]}? give unit='{unit}'{named}; else "
    return ""


_WORDS = {"ft": "feet", "in": "inches", "cm": "centimetres", "mm": "millimetres"}


def _by_origin(origin: str, length: float | None, stem: float) -> tuple[float | None, float | None]:
    """Give the perpendiculars that follow from where x = 0 is: one, or both."""
    if origin == "ap":
        return 0.0, None
    if origin == "fp":
        return None, 0.0
    half = stem if length is None else 0.5 * length
    return -half, half


def _check_length(ap: float, fp: float, length: float | None, where: str) -> None:
    if length is not None and not same_place(fp - ap, length, length):
        raise BadInputError(
            f"length is {length:.6g} m and from ap to fp are {fp - ap:.6g} m", f"in {where}",
            f"leave one out, or give ap and fp {_UNITS_HINT}",
        )  # fmt: skip


def _from_ap(ap: float, why: str, stem: float, length: float | None) -> _Ends:
    """Go forward from a given AP: by Lpp, else to the stem."""
    if length is None:
        return _Ends(ap, ("given", why), stem, ("found", "the stem meets the waterline there"),
                     None)  # fmt: skip
    return _Ends(ap, ("given", why), ap + length, ("given", "Lpp forward of the AP"), length)


def _from_fp(fp: float, fp_from: tuple[str, str], length: float, length_from: str) -> _Ends:
    what = f"Lpp = {length:.6g} m, {length_from}, aft of the FP"
    return _Ends(fp - length, ("found", what), fp, fp_from, length)


def _snapped(ends: _Ends, length: float, doubt: float) -> _Ends:
    """Let x = 0 of the file be a perpendicular or midship where it lies beside it.

    `doubt` (m) is how far the stem may be off, by which all hang on Lpp.
    """
    middle = 0.5 * (ends.ap + ends.fp)
    for name, x in (("AP", ends.ap), ("FP", ends.fp), ("midship", middle)):
        if same_place(x, 0.0, length) or abs(x) <= doubt:
            near = f"{abs(x):.4g} m" if abs(x) > 1e-6 * length else "nothing"
            what = f"x = 0 of the file is {name}, which stem and Lpp put {near} from it"
            ap = {"AP": 0.0, "FP": -length, "midship": -0.5 * length}[name]
            return attrs.evolve(
                ends, ap=ap, fp=ap + length, ap_from=("found", what), fp_from=("found", what)
            )
    return ends


def _by_waterline(
    outline: HullOutline, heights: _Heights, fp: float, fp_from: tuple[str, str]
) -> _Ends:
    """Take the aft end of the design waterline for the AP, and say what hangs on it."""
    aft = heights.level.aft
    ap = 0.0 if same_place(aft, 0.0, fp - aft) else aft
    what = "nothing tells Lpp: the AP is the aft end of the design waterline"
    hint = ""
    # x = 0 of the file farther inside the hull may be the AP of a long stern.
    inside = outline.low[0] < 0.0 < -aft < 0.25 * outline.size
    if ap != 0.0 and (inside or abs(aft) <= _NEAR * (fp - aft)):
        way = "forward" if aft < 0.0 else "aft"
        hint = f"; if x = 0 of the file, {abs(aft):.4g} m {way} of it, is the AP give origin='ap'"
    doubt = (
        f"the AP is taken at the aft end of the design waterline, x = {aft:.6g} m of the file, and "
        f"Lpp = LWL = {fp - ap:.6g} m: LCB in % of Lpp and station numbers hang on it{hint}; give "
        "length= or ap="
    )
    return _Ends(ap, ("assumed", what), fp, fp_from, None, doubt)


def _tell_ends(
    outline: HullOutline, ends: _Ends, stem: float, length: float, book: Notebook, where: str
) -> None:
    if ends.fp_from[0] != "given":
        what = f"at x = {ends.fp:.6g} m of the file: {ends.fp_from[1]}"
        book.assume("forward perpendicular", where, what, ends.fp)
    if ends.ap_from[0] != "given":
        what = f"at x = {ends.ap:.6g} m of the file: {ends.ap_from[1]}"
        book.assume("aft perpendicular", where, what, ends.ap)
    if ends.suspicion is not None:
        book.suspect("aft perpendicular", where, ends.suspicion, ends.ap)
    if ends.length is None:
        name = "LWL" if ends.ap_from[0] == "assumed" else "the distance of the perpendiculars"
        book.assume("length", where, f"Lpp = {name} = {length:.6g} m", length)
    out = float(outline.low[0]) - ends.ap
    if ends.length is not None and out > 0.01 * length + _beyond(outline, fore=False):
        what = f"the AP lies {out:.4g} m aft of the hull, which Lpp = {length:.6g} m does not fit"
        book.suspect("aft perpendicular", where, f"{what}: check length=", out)
    off = abs(ends.fp - stem) - _beyond(outline, fore=True) * (ends.fp > stem)
    if ends.fp_from[0] != "stated" and not same_place(off, 0.0, 2.0 * length) and off > 0.0:
        what = (
            f"the FP lies at x = {ends.fp:.6g} m of the file, and the stem meets the design "
            f"waterline at {stem:.6g} m, {abs(ends.fp - stem):.4g} m off: check length=, draught= "
            "and where x = 0 is"
        )
        book.suspect("forward perpendicular", where, what, ends.fp - stem)


_BLUNT = 0.02
"""A last section this part of the greatest half-breadth broad is not the end of the hull."""


def _beyond(outline: HullOutline, *, fore: bool) -> float:
    """Give how far (m) a hull known by sections alone may go on beyond a last one that is broad."""
    x = float(outline.high[0] if fore else outline.low[0])
    places = outline.cut(0, x)
    broad = float(np.abs(places[:, 1]).max(initial=0.0))
    most = float(np.abs(outline.xyz[:, 1]).max())
    return 2.0 * outline.doubt if broad > _BLUNT * most else 0.0


def _tell_zero(ends: _Ends, length: float, sign: float, book: Notebook, where: str) -> None:
    """Suspect perpendiculars by stem and Lpp where x = 0 of the file is near one and not at it."""
    places = {"ap": ends.ap, "fp": ends.fp, "midship": 0.5 * (ends.ap + ends.fp)}
    name = min(places, key=lambda each: abs(places[each]))
    x = places[name]
    if not 0.0 < abs(x) <= _NEAR * length:
        return
    said = name if name == "midship" else f"the {name.upper()}"
    kind = "forward perpendicular" if name == "fp" else "aft perpendicular"
    way = "aft" if x > 0.0 else "forward"
    also = "" if name == "midship" else f" ({name}=0)"
    what = (
        f"stem and Lpp put {said} at x = {x:.6g} m of the file, and x = 0 lies {abs(x):.4g} m "
        f"{way} of that: if x = 0 is {said} give origin={name!r}{also}; if not, give "
        f"ap='{sign * ends.ap + 0.0:.6g} m'"
    )
    book.suspect(kind, where, what, x)


# --------------------------------------------------------------------------------------
# Breadth, depth, and what is moved.


def _breadth(
    outline: HullOutline, heights: _Heights, asked: FrameOptions, said: StatedPlaces,
    book: Notebook, where: str,
) -> tuple[float, str]:  # fmt: skip
    """Give the breadth (m) and whence it is known."""
    if asked.breadth is not None:
        return asked.breadth, "given"
    if said.breadth is not None:
        _tell_stated("breadth", said.breadth, said, book, where)
        return said.breadth, "stated"
    widest = 2.0 * float(np.abs(outline.xyz[:, 1]).max())
    found = 2.0 * heights.level.half_breadth
    breadth = widest if found <= 0.0 or found > (1.0 - _SIDES) * widest else found
    what = f"{breadth:.6g} m, the greatest of the design waterline"
    book.assume("breadth", where, what, breadth)
    return breadth, "found"


def _depth(
    outline: HullOutline, heights: _Heights, ends: _Ends, asked: FrameOptions, said: StatedPlaces,
    book: Notebook, where: str,
) -> tuple[float, str]:  # fmt: skip
    """Give the depth (m) and whence it is known."""
    top = float(outline.high[2]) - heights.base
    edge = outline.deck_height(0.5 * (ends.ap + ends.fp)) - heights.base
    told = asked.depth or said.depth
    if told and outline.deck is not None and abs(told - edge) > _DEPTH * abs(edge):
        what = f"{told:.6g} m, and the deck edge amidships is at {edge:.6g} m"
        book.suspect("contradiction", "depth", what, told - edge)
    if asked.depth is not None:
        _check_depth(asked.depth, top, where)
        return asked.depth, "given"
    if said.depth is not None:
        _tell_stated("depth", said.depth, said, book, where)
        return said.depth, "stated"
    depth = top if edge <= 0.0 or edge > (1.0 - _SIDES) * top else edge
    book.assume("depth", where, f"{depth:.6g} m, the height of the deck edge amidships", depth)
    return depth, "found"


def _tell_stated(name: str, value: float, said: StatedPlaces, book: Notebook, where: str) -> None:
    if said.why(name):
        book.assume(name, where, f"{value:.6g} m, {said.why(name)}", value)


def _check_depth(depth: float, top: float, where: str) -> None:
    if depth > 1.25 * top:
        raise BadInputError(
            f"depth is {depth:.6g} m, and the hull reaches {top:.6g} m above its base line",
            f"in {where}", "give depth= in m at full scale, and check unit= and scale=",
        )  # fmt: skip


def _tell_shift(frame: ShipFrame, outline: HullOutline, book: Notebook, where: str) -> None:
    """Tell what is moved, or that all stays where it is in the file."""
    x, z = frame.shift
    low = outline.low
    if not frame.moves:
        what = f"x = 0 and z = 0 as in the file; x from {low[0]:.6g} m, z from {low[2]:.6g} m"
        book.assume("origin", where, what)
        return
    parts: list[Any] = [f"{name} by {by:.6g} m" for name, by in (("x", x), ("z", z)) if by]
    book.repair("origin", where, f"moved: {' and '.join(parts)}", x or z)
