"""A design from six numbers: main dimensions, block coefficient and centre of buoyancy.

A type of ship brings a design that is carried to the dimensions asked for. Its curve of areas is
swung to CB and LCB, which never give way; what else a design needs comes from published formulas or
from that design. A note tells of each value: its source, its range, what other sources give.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping

import attrs
import numpy as np

from assoc_hull.arguments import number, positive
from assoc_hull.creation.area_swing import half_sums, swing_areas
from assoc_hull.creation.design import Design
from assoc_hull.creation.scaled_design import CarriedDesign, carried_places, carry_design
from assoc_hull.errors import AssocHullError, BadInputError, OutOfRangeError
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.model.forms.two_halves import half_fault, half_number
from assoc_hull.model.tables import Particulars

__all__ = ["DesignNote", "ShipType", "SixNumbers", "TypedDesign", "design_for", "with_areas"]

_CALL = "in a ship from six numbers"


@attrs.frozen
class DesignNote:
    """One value of a design: where it comes from, and what other sources give.

    Attributes
    ----------
    name : str
        What the value is.
    value : float
        As it is used.
    unit : str
        Of the value.
    source : str
        The formula and who gives it; or that it was given.
    least, most : float
        The range in which the source holds; nan where none is stated.
    others : mapping of str to float
        The values of other formulas, by their source.
    remark : str
        What to look out for; mostly empty.
    """

    name: str
    value: float
    unit: str
    source: str
    least: float = math.nan
    most: float = math.nan
    others: Mapping[str, float] = attrs.field(factory=dict)
    remark: str = ""

    def __str__(self) -> str:
        words = f"{self.name:24}{self.value:12.5g} {self.unit:6} {self.source}"
        if math.isfinite(self.least):
            words += f"; for {self.least:g} to {self.most:g}"
        for source, value in self.others.items():
            words += f"; {source}: {value:.5g}"
        return words + (f"; {self.remark}" if self.remark else "")


@attrs.frozen
class SixNumbers:
    """Main dimensions (m), block coefficient on the length between perpendiculars, and LCB.

    `lcb` is in m from midship, forward positive.
    """

    length: float
    breadth: float
    draught: float
    depth: float
    cb: float
    lcb: float

    def ratios(self) -> dict[str, float]:
        """Give what the ranges of a type are about."""
        return {
            "L/B": self.length / self.breadth, "B/T": self.breadth / self.draught,
            "D/T": self.depth / self.draught, "cb": self.cb, "lcb": 100.0 * self.lcb / self.length,
        }  # fmt: skip


@attrs.frozen
class ShipType:
    """A type of ship: the design that is carried, and ranges of use.

    Attributes
    ----------
    name : str
        As it is asked for.
    parent : callable
        Gives the design that is carried.
    length, ratios : (float, float); mapping of str to (float, float)
        Ranges of use: of the length, m; of L/B, B/T, D/T, CB and LCB in % of the length.
    stern : float
        Frame abscissa abaft which lengths go with the length of the ship alone.
    midship : str
        Which formula gives CM: ``"kerlen"`` or ``"hsva"``.
    remark : str
        What the type lacks, for the notes.
    draw : callable or None
        Draws the design itself, by six numbers, CM, CW and a name; then none is carried.
    """

    name: str
    parent: Callable[[], Design]
    length: tuple[float, float]
    ratios: Mapping[str, tuple[float, float]]
    stern: float
    midship: str = "kerlen"
    remark: str = ""
    draw: Callable[[SixNumbers, float | None, float | None, str | None], TypedDesign] | None = None


@attrs.frozen
class TypedDesign:
    """A design from six numbers, with a note of each value.

    Attributes
    ----------
    design : Design
        All its values can be read and set.
    notes : tuple of DesignNote
        One for each value that was not asked for.
    held : bool
        Whether CW was asked for: then the waterline gives way to no section.
    drawn : bool
        Whether it was drawn for its numbers: then its courses are fair as they are, and are not
        solved, and its topsides flare beyond the breadth, which is that of the waterline.
    """

    design: Design
    notes: tuple[DesignNote, ...]
    held: bool = False
    drawn: bool = False


def design_for(
    kind: ShipType,
    six: SixNumbers,
    *,
    cm: float | None = None,
    bilge_radius: float | None = None,
    cw: float | None = None,
    name: str | None = None,
    advise: bool = True,
) -> TypedDesign:
    """Give the design of a ship of a type.

    Parameters
    ----------
    kind : ShipType
        What it is to be like.
    six : SixNumbers
        What it is to have.
    cm : float or None
        Midship section coefficient; by a formula if None.
    bilge_radius : float or None, m
        In the place of `cm`.
    cw : float or None
        Waterplane coefficient; as the swing leaves it if None.
    name : str or None
        Of the ship; type and length if None.
    advise : bool
        Whether an error tells what CB and LCB may be, which takes seconds; else it only refuses.

    Raises
    ------
    BadInputError
        `cm` and `bilge_radius` are both given, or there is no room for the bilge.
    OutOfRangeError
        A number far out of the range of its type, or CB and LCB that no curve of areas has; the
        error tells what the one may be at the other.
    """
    notes = _range_notes(kind, six)
    if kind.draw is not None:
        if bilge_radius is not None:
            what = f"a {kind.name} has no bilge radius"
            raise BadInputError(what, _CALL, "give cm, or leave bilge_radius out")
        drawn = kind.draw(six, cm, cw, name)
        return attrs.evolve(drawn, notes=(*notes, *drawn.notes))
    parent = kind.parent()
    ship = Particulars(
        name or f"{kind.name.capitalize()} {six.length:g} m",
        six.length, six.breadth, six.depth, six.draught, parent.particulars.deck,
    )  # fmt: skip
    bilge, full, midship = _midship(kind, six, cm, bilge_radius)
    notes += midship

    def area(block: float) -> float:
        # Of the midship section: by a formula it changes along with the block coefficient.
        return _midship(kind, attrs.evolve(six, cb=block), cm, bilge_radius)[1]

    areas, way = _areas(parent, six, area, advise)
    notes += _area_notes(areas, six, way)
    old = parent.definition("bilge_radius")
    old_bilge = old.value(f"{old.nodes[0]}_y")
    assert old_bilge is not None
    places = carried_places(parent.definition("sectional_area"), areas, kind.stern)
    first = half_number(parent.definition("sectional_area"), "full")
    carried = CarriedDesign(parent.particulars, ship, old_bilge, bilge, places, full / first)
    design = _lines(carry_design(parent, areas, carried), parent)
    if cw is not None:
        design = design.having(_with_cw(design.definition("design_waterline"), ship, cw))
    notes += _waterline_notes(design, six, cw is not None)
    return TypedDesign(design, tuple(notes), cw is not None)


# --------------------------------------------------------------------------------------
# Ranges.


_LEAST_DEPTH = 1.05
"""D/T: with less there is no freeboard to speak of."""


def _range_notes(kind: ShipType, six: SixNumbers) -> list[DesignNote]:
    """Refuse what lies far out of the ranges of a type, tell of what lies a little out."""
    for field in attrs.fields(SixNumbers):
        value = getattr(six, field.name)
        if field.name == "lcb":
            number(value, "lcb", _CALL)
        else:
            positive(value, field.name, _CALL)
    shallow, deep = kind.ratios["D/T"]
    if six.depth < six.draught * _LEAST_DEPTH * (1.0 - 1e-9):
        why = f"leaves no freeboard at a draught of {six.draught:g} m"
        low, high = (six.draught * each for each in (_LEAST_DEPTH, 2.0 * deep - shallow))
        raise OutOfRangeError("depth", six.depth, _CALL, why, low, high, "m")
    notes = []
    asked = {"length": six.length, **six.ratios()}
    for name, (least, most) in {"length": kind.length, **kind.ratios}.items():
        value, room = asked[name], most - least
        unit = {"length": "m", "lcb": "% L"}.get(name, "")
        far = max(least - room, 0.25 * least) if least > 0.0 else least - room
        far = max(far, _LEAST_DEPTH) if name == "D/T" else far
        if not far - 1e-9 <= value <= most + room + 1e-9:
            why = f"is far out of the range of a {kind.name}"
            raise OutOfRangeError(name, value, _CALL, why, far, most + room, unit)
        if not least <= value <= most:
            remark = f"out of the range of use of a {kind.name}: look at the lines"
            notes.append(DesignNote(name, value, unit, "given", least, most, remark=remark))
    if kind.remark:
        notes.append(DesignNote("type", six.length, "m", kind.name, remark=kind.remark))
    return notes


# --------------------------------------------------------------------------------------
# Midship section.

_CORNER = 2.0 - 0.5 * math.pi
"""Area that two bilges of radius 1 take from a rectangle: 2 (1 - pi/4)."""


def _midship(
    kind: ShipType, six: SixNumbers, cm: float | None, radius: float | None
) -> tuple[float, float, list[DesignNote]]:
    """Give bilge radius, area of the midship section and their notes."""
    box = six.breadth * six.draught
    if cm is not None and radius is not None:
        raise BadInputError("cm and bilge_radius are both given", _CALL, "leave one out")
    ways = {
        "Kerlen 1970, 1.006 - .0056 CB^-3.56": 1.006 - 0.0056 * six.cb**-3.56,
        "HSVA, 1/(1 + (1 - CB)^3.5)": 1.0 / (1.0 + (1.0 - six.cb) ** 3.5),
    }
    chosen, other = list(ways) if kind.midship == "kerlen" else list(ways)[::-1]
    source = chosen
    if radius is not None:
        positive(radius, "bilge_radius", _CALL)
        source = "from the bilge radius"
    elif cm is not None:
        source = "given"
        radius = _radius(positive(cm, "cm", _CALL), box)
    else:
        radius = _radius(ways[chosen], box)
    # The flats next to the bilge stay: 5 % of the breadth below, a tenth of the draught.
    most = min(0.45 * six.breadth, 0.9 * six.draught)
    least = 0.02 * six.draught
    if not least <= radius <= most:
        if cm is not None:
            room = [1.0 - _CORNER * r * r / box for r in (most, least)]
            why = f"asks for a bilge radius of {radius:.3f} m"
            raise OutOfRangeError("cm", cm, _CALL, why, room[0], room[1], "")
        why = "leaves no flat of bottom or of side"
        raise OutOfRangeError("bilge_radius", radius, _CALL, why, least, most, "m")
    # The area follows from the radius as it is, so that both fit to the last digits.
    coefficient = 1.0 - _CORNER * radius * radius / box
    return radius, coefficient * box, [
        DesignNote("CM", coefficient, "", source, 0.5, 0.85, {other: ways[other]},
                   "the range is that of CB"),
        DesignNote("bilge radius", radius, "m", "R^2 = 2.33 (1 - CM) B T, no rise of floor"),
    ]  # fmt: skip


def _radius(cm: float, box: float) -> float:
    return math.sqrt(max(1.0 - cm, 0.0) * box / _CORNER)


# --------------------------------------------------------------------------------------
# Curve of areas.


def _areas(
    parent: Design, six: SixNumbers, area: Callable[[float], float], advise: bool
) -> tuple[FormDefinition, str]:
    """Give the curve of areas that has CB and LCB; refuse them together with both intervals."""
    parents = parent.definition("sectional_area")

    def swung(cb: float, lcb: float) -> tuple[FormDefinition, str]:
        full = area(cb)
        fullness = cb * six.breadth * six.draught / full
        found = swing_areas(parents.having({"full": full}), fullness, 2.0 * lcb / six.length)
        return found.definition, found.way

    def made(cb: float, lcb: float) -> bool:
        try:
            swung(cb, lcb)
        except AssocHullError:
            return False
        return True

    try:
        return swung(six.cb, six.lcb)
    except AssocHullError as error:
        if not advise:
            raise BadInputError("no curve of areas has both", _CALL, "give others") from error
    cm = area(six.cb) / (six.breadth * six.draught)
    span = 0.06 * six.length
    at_lcb = _room(lambda cb: made(cb, six.lcb), 0.45 * cm, 0.95 * cm, six.cb)
    at_cb = _room(lambda lcb: made(six.cb, lcb), -span, span, six.lcb)
    why = f"and lcb of {six.lcb:g} m fight: no curve of areas has both"
    remedy = "another type"
    if at_cb is not None:
        remedy = f"keep cb and give an lcb from {at_cb[0]:.4g} to {at_cb[1]:.4g} m"
    if at_lcb is not None:
        raise OutOfRangeError("cb", six.cb, _CALL, why, *at_lcb, "", remedy)
    if at_cb is not None:
        why = f"and cb of {six.cb:g} fight: no curve of areas has both"
        raise OutOfRangeError("lcb", six.lcb, _CALL, why, *at_cb, "m")
    what = f"cb of {six.cb:g} {why}"
    raise BadInputError(what, _CALL, f"give other values, or {remedy}")


def _room(
    made: Callable[[float], bool], least: float, most: float, asked: float
) -> tuple[float, float] | None:
    """Give the interval nearest to a value that cannot be made; both ends can be; by few tries."""
    places = np.linspace(least, most, 21).tolist()
    good = [number for number, place in enumerate(places) if made(place)]
    if not good:
        return None
    low = high = min(good, key=lambda number: abs(places[number] - asked))
    while low - 1 in good:
        low -= 1
    while high + 1 in good:
        high += 1
    ends = []
    for inside, outside in ((low, max(low - 1, 0)), (high, min(high + 1, len(places) - 1))):
        near, far = places[inside], places[outside]
        for _ in range(9):
            middle = 0.5 * (near + far)
            near, far = (middle, far) if made(middle) else (near, middle)
        ends.append(near)
    return ends[0], ends[1]


def with_areas(design: Design, cb: float, lcb: float) -> FormDefinition:
    """Give the curve of areas of a design for a CB and an LCB (m) next to its own.

    Only the areas of both halves change; the ends of the parallel part and centroids stay, so no
    station comes to lie in another part of the ship.
    """
    areas, ship = design.definition("sectional_area"), design.particulars
    now = coefficients(areas, ship)
    scale = ship.breadth * ship.draught / half_number(areas, "full")
    mean, at = cb * scale, 2.0 * lcb / ship.length
    more = 2.0 * (mean - now.fullness)
    moment = 2.0 * (mean * at - now.fullness * 2.0 * now.centroid / ship.length)
    run, entrance = (half_number(areas, f"{half}_centroid") for half in ("run", "entrance"))
    shares = np.linalg.solve([[1.0, 1.0], [run, entrance]], [more, moment])
    found = areas.having({
        f"{half}_area": half_number(areas, f"{half}_area") + float(share)
        for half, share in zip(("run", "entrance"), shares, strict=True)
    })  # fmt: skip
    if any(half_fault(found, half) for half in ("run", "entrance")):
        # Near the last centroid that a half can have: the parallel part moves a little instead.
        return swing_areas(areas, mean, at).definition
    return found


def _with_cw(line: FormDefinition, ship: Particulars, cw: float) -> FormDefinition:
    """Give a waterline with a waterplane coefficient: both halves share in the change of area.

    Each by the room that it has, its centroid comes out fairest: so LCF moves.
    """
    spans = {
        half: abs(half_number(line, f"{half}_end") - half_number(line, f"{half}_start"))
        for half in ("run", "entrance")
    }
    now = {half: half_sums(line, half)[0] for half in spans}
    full = 2.0 * half_number(line, "full") / ship.breadth

    def filled(at: float) -> FormDefinition:
        more = 2.0 * (at / full - coefficients(line, ship).fullness)
        room = {
            half: spans[half] - now[half] if more > 0.0 else now[half] - _THIN * spans[half]
            for half in spans
        }
        total = sum(room.values())
        return line.having({
            f"{half}_area": now[half] + more * room[half] / total for half in spans
        } | {f"{half}_centroid": None for half in spans})  # fmt: skip

    def made(at: float) -> bool:
        return not any(half_fault(filled(at), half) for half in spans)

    if made(cw):
        return filled(cw)
    usual = coefficients(line, ship).fullness * full
    room = _room(made, 0.5 * usual, 1.0, usual)
    if room is None:
        raise BadInputError(f"no waterline has a cw of {cw:g}", _CALL, "leave it out")
    raise OutOfRangeError("cw", cw, _CALL, "is that of no fair waterline", *room, "")


_THIN = 0.45
"""Fullness below which no half of a waterline goes."""


def _area_notes(areas: FormDefinition, six: SixNumbers, way: str) -> list[DesignNote]:
    first, last = (half_number(areas, each) for each in ("run_end", "entrance_start"))
    entrance, run = 0.5 * (1.0 - last), 0.5 * (1.0 + first)
    cb = six.cb
    cp = coefficients(areas, Particulars("", *attrs.astuple(six)[:4])).fullness
    source = f"swing of the type's curve of areas: {way}"
    lindblad = "Lindblad"
    return [
        DesignNote("CP", cp, "", "CB / CM"),
        DesignNote("length of entrance / L", entrance, "", source, 0.55, 0.75,
                   {lindblad: 1.975 - 2.27 * cb}, "the range is that of CB for Lindblad"),
        DesignNote("length of run / L", run, "", source, 0.55, 0.75, {lindblad: 1.12 - cb}),
        DesignNote("parallel part / L", 1.0 - entrance - run, "", source, 0.55, 0.75,
                   {lindblad: 3.27 * cb - 2.095}),
    ]  # fmt: skip


def _waterline_notes(design: Design, six: SixNumbers, given: bool) -> list[DesignNote]:
    """Tell of CW and the angle of entrance, beside what formulas give."""
    line, ship = design.definition("design_waterline"), design.particulars
    found = coefficients(line, ship)
    cb, cw = six.cb, found.fullness
    cp = coefficients(design.definition("sectional_area"), ship).fullness
    angle = half_number(line, "entrance_end_angle_deg")
    entry = math.degrees(math.atan(math.tan(math.radians(-angle)) * ship.breadth / ship.length))
    lcb = 100.0 * six.lcb / six.length
    run = six.length * (1.0 - cp + 0.06 * cp * lcb / (4.0 * cp - 1.0))
    volume = cb * six.length * six.breadth * six.draught
    power = (
        (six.length / six.breadth) ** 0.80856 * (1.0 - cw) ** 0.30484
        * max(1.0 - cp - 0.0225 * lcb, 0.0) ** 0.6367 * (run / six.breadth) ** 0.34574
        * (100.0 * volume / six.length**3) ** 0.16302
    )  # fmt: skip
    return [
        DesignNote(
            "CW", cw, "", "given" if given else "the type's waterline, swung",
            others={
                "Schneekluth, (1 + 2 CB)/3": (1.0 + 2.0 * cb) / 3.0,
                "Schneekluth, U frames, .95 CP + .17 (1 - CP)^(1/3)":
                    0.95 * cp + 0.17 * (1.0 - cp) ** (1.0 / 3.0),
                "Kristensen, .55 + .45 CB": 0.55 + 0.45 * cb,
            },
        ),
        DesignNote(
            "half angle of entrance", entry, "deg", "the type's waterline, swung",
            others={"Holtrop & Mennen 1982": 1.0 + 89.0 * math.exp(-power)},
        ),
    ]  # fmt: skip


# --------------------------------------------------------------------------------------
# Lines.

_BUTTOCKS = (0.15, 0.3, 0.45, 0.6, 0.75, 0.88)
"""In parts of half the breadth; away from corners of usual transoms. With a bulb, the first would
graze its side, where it says nothing, and is left out."""


def _lines(design: Design, parent: Design) -> Design:
    """Let lines stand at round numbers, as far as the ends of flats allow."""
    ship = design.particulars
    bulb = any(each.use == "bulb_area" for each in design.definitions)
    stations = list[float]()
    for old, new in zip(parent.stations, design.stations, strict=True):
        place = round(_ROUND * new) / _ROUND if abs(new - old) > 1e-9 else old
        if abs(place - 20.0) < 0.01 and not bulb:
            # A stem that overhangs a little below the draught would ask for a bulb there.
            continue
        if not stations or place - stations[-1] >= _NEAREST:
            stations.append(place)
    stations = _without_gaps(stations, design)
    digits = 1 if ship.draught >= 8.0 else 2
    heights = {z if abs(z - ship.draught) < 1e-6 else round(z, digits) for z in design.waterlines}
    return attrs.evolve(
        design,
        stations=tuple(stations), waterlines=tuple(heights),
        buttocks=tuple(round(0.5 * ship.breadth * each, digits) for each in _BUTTOCKS[bulb:]),
    )  # fmt: skip


def _without_gaps(stations: list[float], design: Design) -> list[float]:
    """Add stations where the swing left run or entrance between two far from one another."""
    areas = design.definition("sectional_area")
    ends = [10.0 * (1.0 + half_number(areas, each)) for each in ("run_end", "entrance_start")]
    found = list(stations)
    for low, high in itertools.pairwise(stations):
        if high - low > _FARTHEST and not (low >= ends[0] - 0.1 and high <= ends[1] + 0.1):
            count = math.ceil((high - low) / _FARTHEST)
            between = np.linspace(low, high, count + 1)[1:-1].tolist()
            found += [round(_ROUND * place) / _ROUND for place in between]
    return sorted(found)


_FARTHEST = 0.6
"""Stations of run and entrance stand no farther apart, in twentieths of the length."""

_ROUND = 20.0
"""Stations stand at multiples of a twentieth of a station spacing."""

_NEAREST = 0.09
"""No two stations stand closer, in twentieths of the length."""
