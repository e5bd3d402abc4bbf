"""What a variation is asked for, checked and frozen; also as data, for a script file.

{"version": 1, "set": {"shaft_height": 6.0, "bossing_radius": 1.0},
 "layout": {"stern": 0.3}, "drivers": ["sections", "buttocks"], "stations": "number",
 "planes": "follow", "layers": [[{"hat": {...}}]], "tolerance": 0.002, "name": "larger screw"}

No key must be there but ``set``, ``reach`` or ``layers``; ``version`` is that of this form. What
belongs to ``reach`` stands in `assoc_hull.variation.ask_reach`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, Literal, get_args

import attrs

from assoc_hull.arguments import choice, number, positive, shown, shown_name, text
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.model.line import Group, Line
from assoc_hull.variation.ask_reach import AskReach, acts
from assoc_hull.variation.fields.field_data import layers_from
from assoc_hull.variation.fields.layer import Layer
from assoc_hull.variation.parameters.catalogue import CATALOGUE, NAMES
from assoc_hull.variation.parameters.layout import Layout

__all__ = ["TOLERANCE", "VERSION", "Ask", "Planes", "Stations", "ask_from"]

TOLERANCE = 2e-3
"""How far drivers may leave their exact images, m, unless it is said."""

Stations = Literal["number", "x"]
Planes = Literal["follow", "stay"]

VERSION = 1
"""Of the form of scripts."""

_KEYS = ("version", "set", "reach", "free", "bounds", "exact", "layers", "layout", "drivers",
         "stations", "planes", "tolerance", "name")  # fmt: skip
_SPOKEN = {each.short: each.name for each in CATALOGUE.values()} | {
    "pmb_start": "parallel_body_start", "pmb_end": "parallel_body_end", "LPP": "length",
}  # fmt: skip
"""What parameters are called in formulas."""


@attrs.frozen(eq=False)
class Ask:
    """What a variation is asked for.

    Attributes
    ----------
    values : mapping of str to float
        Named parameters, m or degrees.
    layers : tuple of Layer
        Raw layers, which act after those of the named parameters.
    layout : Layout
        How far the fields of named parameters reach.
    drivers : tuple of Group, Line, str, or None
        Groups or lines, or their names; None for those whose planes the map keeps.
    stations : {"number", "x"}
        Whether sections keep their numbers and go with the map, or stay where they are.
    planes : {"follow", "stay"}
        Whether waterlines and buttocks go with a map that keeps all their planes.
    tolerance : float, m
        How far drivers may leave their exact images.
    name : str
        Of the step in the history.
    given : tuple or None
        The layers as they were given, if they were given as data.
    reach : AskReach or None
        What outputs are to be reached, and what is free for it.
    """

    values: Mapping[str, float]
    layers: tuple[Layer, ...] = ()
    layout: Layout = attrs.field(factory=Layout)
    drivers: tuple[Group | Line | str, ...] | None = None
    stations: Stations = "number"
    planes: Planes = "follow"
    tolerance: float = TOLERANCE
    name: str = "vary"
    given: tuple[object, ...] | None = ()
    reach: AskReach | None = None

    @classmethod
    def of(
        cls,
        values: Mapping[str, float] | None = None,
        *,
        reach: Mapping[str, float] | None = None,
        free: object = (),
        bounds: Mapping[str, object] | None = None,
        exact: bool = True,
        layers: Sequence[object] = (),
        layout: Mapping[str, Any] | Layout | None = None,
        drivers: Sequence[Group | Line | str] | None = None,
        stations: str = "number",
        planes: str = "follow",
        tolerance: float = TOLERANCE,
        name: str | None = None,
    ) -> Ask:
        """Take what a designer gives.

        Raises
        ------
        UnknownNameError
            No such parameter, or no such reach of a field.
        BadInputError
            A value that is no number or has no meaning; nothing is asked for.
        """
        found, aimed = _values(values), AskReach.of(reach, free, bounds, exact)
        if not found and not layers and aimed is None:
            raise BadInputError(
                "nothing is asked for", "in vary", "give values of named parameters, or fields"
            )
        _refuse_both(found, aimed)
        wanted = choice(stations, "stations", get_args(Stations), "in vary")
        level = choice(planes, "planes", get_args(Planes), "in vary")
        made = _layers(layers)
        return cls(
            MappingProxyType(found), made, _layout(layout), _drivers(drivers),
            "x" if wanted == "x" else "number", "stay" if level == "stay" else "follow",
            positive(tolerance, "tolerance", "in vary"),
            _title(found, aimed) if name is None else text(name, "the name", "in vary"),
            None if any(acts(each) for each in layers) else tuple(layers), aimed,
        )  # fmt: skip


def ask_from(data: object) -> Ask:
    """Take what a script file says.

    Raises
    ------
    UnknownNameError
        A key that is none.
    WrongTypeError, BadInputError
        A part of another form.

    Examples
    --------
    >>> from assoc_hull.variation.ask import ask_from
    >>> dict(ask_from({"set": {"breadth": 51.5}}).values)
    {'breadth': 51.5}
    """
    if not isinstance(data, Mapping):
        raise WrongTypeError(
            f"a variation is {type(data).__name__}", "in vary", "give a mapping with 'set'"
        )
    for key in data:
        if key not in _KEYS:
            raise UnknownNameError("part of a variation", shown_name(key), _KEYS)
    version = data.get("version", VERSION)
    if isinstance(version, bool) or version != VERSION:
        raise BadInputError(
            f"the script is of version {shown(version)}", "in vary", f"give version {VERSION}"
        )
    return Ask.of(
        data.get("set"), reach=data.get("reach"), free=data.get("free", ()),
        bounds=data.get("bounds"), exact=data.get("exact", True),
        layers=data.get("layers", ()), layout=data.get("layout"), drivers=data.get("drivers"),
        stations=data.get("stations", "number"), planes=data.get("planes", "follow"),
        tolerance=data.get("tolerance", TOLERANCE), name=data.get("name"),
    )  # fmt: skip


def _values(given: object) -> dict[str, float]:
    """Take values by name, in the order of the catalogue."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise WrongTypeError(
            f"set is {type(given).__name__}", "in vary", "give values by the names of parameters"
        )
    for name in given:
        if name not in NAMES:
            word = shown_name(name)
            raise UnknownNameError("named parameter", word, NAMES, _SPOKEN.get(word, ""))
    found = {name: number(given[name], name, "in vary") for name in NAMES if name in given}
    for name, value in found.items():
        if CATALOGUE[name].positive and not value > 0.0:
            raise BadInputError(f"{name} is {value:g} m", "in vary", "give one above 0")
    return found


def _layers(given: object) -> tuple[Layer, ...]:
    """Take layers as they are, or lists of fields as data."""
    if isinstance(given, str) or not isinstance(given, Sequence):
        raise WrongTypeError(
            f"layers is {type(given).__name__}", "in vary", "give a list of layers"
        )
    made = list[Layer]()
    for i, each in enumerate(given):
        if acts(each):
            made.append(each)
        else:
            made += [attrs.evolve(one, name=f"raw fields {i + 1}") for one in layers_from([each])]
    return tuple(made)


def _layout(given: Mapping[str, Any] | Layout | None) -> Layout:
    """Take reaches by name, or a layout, whose reaches are looked at as well."""
    return Layout.of(attrs.asdict(given) if isinstance(given, Layout) else given)


def _drivers(given: object) -> tuple[Group | Line | str, ...] | None:
    if given is None:
        return None
    if isinstance(given, str) or not isinstance(given, Sequence):
        raise WrongTypeError(
            f"drivers is {type(given).__name__}", "in vary", "give a list of groups or lines"
        )
    return tuple(given)


def _refuse_both(values: Mapping[str, float], reach: AskReach | None) -> None:
    """Refuse parameters that are set and free."""
    for name in () if reach is None else reach.names:
        if name in values:
            raise BadInputError(f"'{name}' is set and free", "in vary", "leave it out of one")


def _title(values: Mapping[str, float], reach: AskReach | None) -> str:
    words = ", ".join(f"{name}={value:g}" for name, value in values.items())
    found = f"vary {words}" if words else "vary by fields"
    if reach is None:
        return found
    goal = ", ".join(f"{name}={value:g}" for name, value in reach.targets.items())
    return f"{found} to reach {goal}" if words else f"vary to reach {goal}"
