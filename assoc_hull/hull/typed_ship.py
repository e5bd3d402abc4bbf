"""Ships from six numbers: the hull closed to CB and LCB, and refusals that can be followed.

A refusal names the two numbers that fight, or the further value that does not go with the six. The
interval that it gives was tried: a ship was made at both of its ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.arguments import number, positive, shown, text
from assoc_hull.creation.six_numbers import (
    DesignNote,
    ShipType,
    SixNumbers,
    TypedDesign,
    design_for,
    with_areas,
)
from assoc_hull.creation.six_numbers_net import (
    build_typed,
    dips_below_base,
    passes_side,
    with_room,
)
from assoc_hull.errors import AssocHullError, BadInputError, OutOfRangeError, RefusedEditError
from assoc_hull.hull.hull import Hull
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.shipped.ship_types import ship_type

__all__ = ["typed_ship"]

_CALL = "in a ship from six numbers"

_MISFITS = (BadInputError, OutOfRangeError, RefusedEditError)
"""What numbers that do not go together end in."""

_OPTIONS = ("cw", "cm", "bilge_radius")
"""Values that may be given beside the six."""


@attrs.frozen
class _Request:
    """What was asked for; `percent` if LCB came in % of the length."""

    kind: ShipType
    six: SixNumbers
    percent: bool
    cm: float | None = None
    bilge_radius: float | None = None
    cw: float | None = None
    name: str | None = None

    def design(self, advise: bool = False) -> TypedDesign:
        return design_for(
            self.kind, self.six, cm=self.cm, bilge_radius=self.bilge_radius, cw=self.cw,
            name=self.name, advise=advise,
        )  # fmt: skip

    def value(self, name: str) -> float:
        """Give one of the numbers as it is asked for."""
        if name == "lcb" and self.percent:
            return 100.0 * self.six.lcb / self.six.length
        found = getattr(self if name in _OPTIONS else self.six, name)
        return float(found)

    def having(self, name: str, value: float | None) -> _Request:
        """Give the same with another value of one number."""
        if name == "cw":
            return attrs.evolve(self, cw=value)
        if name == "cm":
            return attrs.evolve(self, cm=value)
        if name == "bilge_radius":
            return attrs.evolve(self, bilge_radius=value)
        assert value is not None
        if name == "lcb" and self.percent:
            value = 0.01 * value * self.six.length
        if name == "length" and self.percent:
            lcb = self.six.lcb * value / self.six.length
            return attrs.evolve(self, six=attrs.evolve(self.six, length=value, lcb=lcb))
        return attrs.evolve(self, six=attrs.evolve(self.six, **{name: value}))

    def unit(self, name: str) -> str:
        if name == "lcb" and self.percent:
            return "%"
        return "" if name in ("cb", "cw", "cm") else "m"

    def title(self, name: str) -> str:
        return "lcb_percent" if name == "lcb" and self.percent else name

    def words(self, name: str) -> str:
        return f"{self.title(name)} of {self.value(name):g} {self.unit(name)}".rstrip()


def typed_ship(
    kind: str, six: dict[str, float | None], lcb: float | None, percent: float | None,
    given: dict[str, float | None], name: str | None,
) -> Hull:  # fmt: skip
    """Create a hull from six numbers, its net closed to CB and LCB; see `create`."""
    missing = [word for word, value in six.items() if value is None]
    if lcb is None and percent is None:
        missing.append("lcb")
    if missing:
        raise BadInputError(f"{', '.join(missing)} is missing", _CALL, "give it, or a design")
    if lcb is not None and percent is not None:
        raise BadInputError("lcb and lcb_percent are both given", _CALL, "leave one out")
    for word, value in {**six, "lcb": lcb, "lcb_percent": percent, **given}.items():
        # a text is a value that nobody has looked at: of a form, in other units
        if isinstance(value, str):
            what = f"{word} is the text {shown(value)}"
            raise BadInputError(what, _CALL, "give a number, without quotes")
    numbers = {word: positive(value, word, _CALL) for word, value in six.items()}
    if percent is not None:
        lcb = 0.01 * number(percent, "lcb_percent", _CALL) * numbers["length"]
    asked = SixNumbers(**numbers, lcb=number(lcb, "lcb", _CALL))
    known = {word: None if v is None else positive(v, word, _CALL) for word, v in given.items()}
    if known.get("cm") is not None and known.get("bilge_radius") is not None:
        raise BadInputError("cm and bilge_radius are both given", _CALL, "leave one out")
    title = None if name is None else text(name, "name", _CALL)
    found = ship_type(text(kind, "type", _CALL))
    if found.draw is not None and known.get("bilge_radius") is not None:
        what = f"a {found.name} has no bilge radius"
        raise BadInputError(what, _CALL, "give cm, or leave bilge_radius out")
    request = _Request(found, asked, percent is not None, **known, name=title)
    try:
        return _made(request)
    except _MISFITS as error:
        if isinstance(error, OutOfRangeError) and "far out of the range" in error.why:
            raise
        if isinstance(error, OutOfRangeError) and error.name == "depth":
            raise
        raise _refusal(request, error) from error


# --------------------------------------------------------------------------------------
# The ship.


def _made(request: _Request) -> Hull:
    """Make the ship, with its notes."""
    state, report, typed = build_typed(_nearly_closed(request.design(), request.six))
    hull, typed = _closed(Hull(state), request.six, typed)
    found = hull.check()
    doubts = [
        DesignNote("finding", float(count), "", "hull.check()", remark=str(each))
        for count, each in enumerate(found, 1)
    ]
    hull.adoption = report
    measured = dips_below_base(hull.state)
    if not typed.drawn:
        measured += passes_side(hull.state)
    hull.notes = (*typed.notes, *measured, *doubts)
    return hull


_NEAR = 5e-4
"""CB, and LCB in parts of the length, that miss by less before lines are cut are near enough."""


def _nearly_closed(typed: TypedDesign, asked: SixNumbers) -> TypedDesign:
    """Give the design with the areas that its sections need, before courses are solved for good.

    A bulb ahead of FP and a counter abaft AP are no part of the curve of areas. Areas that change
    by half a percent after courses were solved for others would bring waves back.
    """
    if typed.drawn:
        return typed
    try:
        design, notes, state, _ = with_room(typed, _FIRST)
        found = Hull(state).hydrostatics(estimate=False)
        more = asked.cb - found.cb
        ahead = asked.lcb - (found.lcb - 0.5 * asked.length)
        if max(abs(more), abs(ahead) / asked.length) <= _NEAR:
            return typed
        now = coefficients(design.definition("sectional_area"), design.particulars)
        assert now.block is not None
        areas = with_areas(design, now.block + more, now.centroid + ahead)
    except _MISFITS:
        # What is wrong is told, or mended, where the ship is made.
        return typed
    return attrs.evolve(typed, design=design.having(areas), notes=(*typed.notes, *notes))


_FIRST = 4
"""Rounds of the first solution of courses."""


_CLOSE = 2e-7
"""CB, and LCB in parts of the length, are met within this."""


def _closed(hull: Hull, asked: SixNumbers, typed: TypedDesign) -> tuple[Hull, TypedDesign]:
    """Give the hull with curves of areas by which its net has CB and LCB, without history.

    The net has parts beyond the ends of the curve of areas, and is a spline between stations: so
    CB and LCB as measured are not those of the curve, by some thousandths.
    """
    design = typed.design
    for _ in range(4):
        found = hull.hydrostatics(estimate=False)
        more = asked.cb - found.cb
        ahead = asked.lcb - (found.lcb - 0.5 * asked.length)
        if max(abs(more), abs(ahead) / asked.length) <= _CLOSE:
            break
        now = coefficients(design.definition("sectional_area"), design.particulars)
        assert now.block is not None
        areas = with_areas(design, now.block + more, now.centroid + ahead)
        before = design.definition("sectional_area").values
        changes = {name: v for name, v in areas.values.items() if v != before.get(name)}
        design = design.having(areas)
        try:
            with hull.edit("close CB and LCB") as edit:
                edit.set_form(areas.name, **changes)
        except (BadInputError, RefusedEditError):
            # A net that does not follow is made anew.
            state, _, typed = build_typed(attrs.evolve(typed, design=design), solve=False)
            hull = Hull(state)
            design = typed.design
    hull = Hull(hull.state)
    # What hydrostatics doubt is no ship: it refuses here, not when somebody asks for a volume.
    hull.hydrostatics()
    return hull, typed


# --------------------------------------------------------------------------------------
# Refusals.

_PAIRS = (("lcb", "cb"), ("cb", "lcb"))
_OTHERS = (("draught", "breadth"), ("depth", "draught"), ("breadth", "length"))
"""Numbers that may fight; with the other one kept, the first is tried."""

_PLACES, _HALVINGS, _PULLS = 7, 4, 4
"""Values tried over a range; halvings toward its end; steps back from an end that fails yet."""


def _refusal(request: _Request, error: AssocHullError) -> AssocHullError:
    """Give the error that names who fights, with intervals in which ships were made."""
    for name in _OPTIONS:
        if getattr(request, name) is None:
            continue
        without = request.having(name, None)
        usual = _usual(without, name)
        if usual is None:
            continue
        room = _interval(request, name, usual, _limits(name, request.six))
        if room is not None:
            why = "does not go with the other numbers"
            return OutOfRangeError(
                name, request.value(name), _CALL, f"{why} ({_reason(error)})", *room,
                request.unit(name), f"leave {name} out",
            )  # fmt: skip
    found = {name: _room(request, name) for name, _ in _PAIRS}
    for name, other in (*reversed(_PAIRS), *_OTHERS):
        room = found[name] if name in found else _room(request, name)
        if room is None:
            continue
        remedy = ""
        if found.get(other) is not None:
            low, high = found[other] or room
            unit = request.unit(other)
            remedy = (
                f"keep {name} and give {request.title(other)} from {low:.8g} to {high:.8g} {unit}"
            ).rstrip()
        return OutOfRangeError(
            request.title(name), request.value(name), _CALL,
            f"and {request.words(other)} fight: {_reason(error)}", *room, request.unit(name),
            remedy,
        )  # fmt: skip
    what = f"{request.words('cb')} and {request.words('lcb')} fight with lines of this type"
    remedy = f"give numbers nearer to the middle of the ranges of a {request.kind.name}"
    return BadInputError(f"{what}: {_reason(error)}", _CALL, remedy)


def _reason(error: AssocHullError) -> str:
    """Tell in a few words what failed."""
    if isinstance(error, RefusedEditError):
        return "no sound net can be made"
    where = getattr(error, "where", "")
    if "x = " in where:
        return f"no section can be made at x = {where.rpartition('x = ')[2]}"
    if isinstance(error, OutOfRangeError):
        return f"it {error.why}"
    return error.what if isinstance(error, BadInputError) else str(error)


def _usual(request: _Request, name: str) -> float | None:
    """Give a value that the ship has if it is not asked for; None if there is no ship then."""
    if not _can(request):
        return None
    notes = {each.name: each.value for each in request.design().notes}
    # A type of round sections has no bilge radius.
    return notes.get({"cw": "CW", "cm": "CM", "bilge_radius": "bilge radius"}[name])


def _limits(name: str, six: SixNumbers) -> tuple[float, float]:
    """Give between which values one beside the six is looked for."""
    return (0.02 * six.draught, six.draught) if name == "bilge_radius" else (0.4, 1.0)


def _room(request: _Request, name: str) -> tuple[float, float] | None:
    """Give an interval of one of the six, with the others kept."""
    low, high = _range(request, name)
    asked = request.value(name)
    places = sorted(
        np.linspace(low, high, _PLACES).tolist(), key=lambda place: (abs(place - asked), place)
    )
    for place in places:
        if _can(request.having(name, place)):
            limits = min(low, asked), max(high, asked)
            return _interval(request, name, place, limits)
    return None


def _range(request: _Request, name: str) -> tuple[float, float]:
    """Give the range of use of one of the six, beside the others."""
    six, ratios = request.six, request.kind.ratios
    if name == "lcb" and not request.percent:
        low, high = (0.01 * each * six.length for each in ratios["lcb"])
        return low, high
    if name in ("cb", "lcb"):
        return ratios[name]
    if name == "depth":
        low, high = (six.draught * each for each in ratios["D/T"])
    elif name == "draught":
        high, low = (six.breadth / each for each in ratios["B/T"])
    else:
        high, low = (six.length / each for each in ratios["L/B"])
    return low, high


def _interval(
    request: _Request, name: str, good: float, limits: tuple[float, float]
) -> tuple[float, float] | None:
    """Give an interval about a value that can be; a ship was made at either end."""
    ends = [_end(request, name, good, limit) for limit in limits]
    low, high = ends
    return None if low is None or high is None else (low, high)


def _end(request: _Request, name: str, good: float, limit: float) -> float | None:
    """Give the last value, from a good one to a limit, that can be: a whole ship was made there."""

    def can(value: float) -> bool:
        return _can(request.having(name, value))

    near, far = good, limit
    if can(limit):
        near = limit
    else:
        for _ in range(_HALVINGS):
            middle = 0.5 * (near + far)
            near, far = (middle, far) if can(middle) else (near, middle)
    for pull in np.linspace(0.0, 1.0, _PULLS + 1).tolist():
        at = _short(near + pull * (good - near), good)
        if _sound(request.having(name, at)):
            return at
    return None


def _short(value: float, toward: float) -> float:
    """Give a value with four figures, rounded toward another."""
    if value == 0.0 or value == toward:
        return float(f"{value:.8g}")
    step = 10.0 ** (math.floor(math.log10(abs(value))) - 3)
    part = value / step
    found = math.ceil(part - 1e-9) if toward > value else math.floor(part + 1e-9)
    return float(f"{found * step:.8g}")


def _can(request: _Request) -> bool:
    """Tell whether sections can be made; in a fraction of the time of a ship."""
    return _goes(lambda: with_room(request.design()))


def _sound(request: _Request) -> bool:
    """Tell whether the ship can be made."""
    return _goes(lambda: _made(request))


def _goes(act: Callable[[], object]) -> bool:
    try:
        act()
    except _MISFITS:
        return False
    return True
