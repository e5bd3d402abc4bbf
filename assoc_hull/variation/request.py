"""What a variation is asked for, checked and frozen; also as data, and as a script file of it.

A request holds set values, targets with what is free to reach them, raw layers, and how lines are
to be carried. The same parent and the same request give the same hull to the last bit, in
whichever form and process. The keys of a script are the arguments of `hull.vary`; lengths are in
m.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from numbers import Real
from os import PathLike
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, get_args

import attrs
import numpy as np

from assoc_hull.analysis.form.form_parameters import CATALOGUE as FORM_PARAMETERS
from assoc_hull.analysis.hydrostatics.record import FIELDS
from assoc_hull.arguments import (
    choice,
    file_path,
    flag,
    number,
    once,
    positive,
    shown,
    shown_name,
    text,
)
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.objects import Group, Line
from assoc_hull.variation.fields.field_data import fields_from_data, layers_from_data
from assoc_hull.variation.fields.layers import FieldLayer, Layer, scaled_layer
from assoc_hull.variation.parameters.catalogue import CATALOGUE, NAMES
from assoc_hull.variation.parameters.field_layout import Layout

__all__ = [
    "TOLERANCE",
    "VERSION",
    "Planes",
    "Stations",
    "TargetRequest",
    "VariationRequest",
    "is_layer",
    "rank_of_output",
    "read_script",
    "request_from_data",
    "script_of",
    "title_of",
]

# --------------------------------------------------------------------------------------
# Targets, and what is free for them:
#
# {"reach": {"volume": 10500.0, "lcb": 61.9},
#  "free": ["breadth", "fore_shift", {"name": "fuller", "fields": [{"hat": {...}}]}],
#  "bounds": {"fore_shift": [-2.0, 2.0], "breadth": [null, 18.0]}, "exact": true}

_WHERE = "in vary"
_FORM = 'give names of parameters, layers, or {"name": ..., "fields": [...]}'
_OUTPUTS = {name: place for place, name in enumerate((*FIELDS, *FORM_PARAMETERS))}
"""The places of outputs that have names of their own."""


@attrs.frozen(eq=False)
class TargetRequest:
    """Targets, and what is free to reach them.

    Attributes
    ----------
    targets : mapping of str to float
        Values of outputs by name, in their units: fields of hydrostatics in the order of the
        record, form parameters in that of their catalogue, then others by name.
    free : tuple of str or Layer
        Named parameters in the order of their catalogue, then layers whose strength is free, by
        name.
    bounds : mapping of str to (float, float)
        Least and greatest values by the name of what is free: m, deg, or factors on layers.
    exact : bool
        Whether all targets must be reached; else they are reached as nearly as can be.
    given : tuple or None
        What is free as it was given, if it was given as data.
    """

    targets: Mapping[str, float]
    free: tuple[str | Layer, ...]
    bounds: Mapping[str, tuple[float, float]]
    exact: bool = True
    given: tuple[object, ...] | None = ()

    @classmethod
    def of(cls, reach: object, free: object, bounds: object, exact: object) -> TargetRequest | None:
        """Take what a designer gives; None if there is nothing to reach.

        Raises
        ------
        UnknownNameError
            Something free, or bounded, that is no parameter.
        BadInputError
            Targets without anything free, or the other way round; a name twice; no numbers.
        """
        targets, limits = _numbers(reach), _mapping(bounds)
        made = _free(free)
        whole = flag(exact, "exact", _WHERE)
        if not targets:
            if made or limits:
                raise BadInputError(
                    f"{'free' if made else 'bounds'} is given, but nothing to reach", _WHERE,
                    "give reach={name: value}",
                )  # fmt: skip
            return None
        if not made:
            raise BadInputError(
                f"nothing is free to reach {', '.join(targets)}", _WHERE, "give free=[names]"
            )
        given = list(free) if isinstance(free, Sequence) and not isinstance(free, str) else [free]
        # Sums in another order have other last bits: the order asked in must not matter.
        turn = sorted(range(len(made)), key=lambda i: _rank_of_free(made[i]))
        return cls(
            MappingProxyType({name: targets[name] for name in sorted(targets, key=rank_of_output)}),
            tuple(made[i] for i in turn), MappingProxyType(_bounds(limits, made)), whole,
            None if any(is_layer(each) for each in given) else tuple(given[i] for i in turn),
        )  # fmt: skip

    @property
    def names(self) -> tuple[str, ...]:
        """Names of what is free."""
        return tuple(_name(each) for each in self.free)

    def limits(self, present: Sequence[float]) -> FloatArray:
        """Give bounds of amplitudes, (k, 2), m or deg: of values less the present ones (k,)."""
        none = -math.inf, math.inf
        pairs = [self.bounds.get(name, none) for name in self.names]
        return np.asarray(np.array(pairs) - np.array(present)[:, None])

    def data(self) -> dict[str, object]:
        """Give it as data, as a script has it."""
        found: dict[str, object] = {"reach": dict(self.targets), "free": list(self.given or ())}
        if self.bounds:
            found["bounds"] = {name: _open(pair) for name, pair in self.bounds.items()}
        if not self.exact:
            found["exact"] = False
        return found


def is_layer(given: object) -> bool:
    """Tell whether something is a layer, and not the data of one."""
    parts = ("name", "displacement", "jacobian", "regions")
    return not isinstance(given, type) and all(hasattr(given, part) for part in parts)


def _numbers(given: object) -> dict[str, float]:
    """Take targets by name."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise WrongTypeError(
            f"reach is {type(given).__name__}", _WHERE, "give values by the names of outputs"
        )
    for name in given:
        text(name, "a name in reach", _WHERE)
    return {name: _target(value, name) for name, value in given.items()}


def _target(given: object, name: str) -> float:
    """Take a finite number, of any size: a moment of inertia may be larger than any length."""
    found = _real(given)
    if not math.isfinite(found):
        raise BadInputError(f"{name} is {shown(given)}", _WHERE, "give a finite number")
    return found


def _real(given: object) -> float:
    """Give a number, infinite ones as well; nan where it is none, or one beyond all floats."""
    if not isinstance(given, Real) or isinstance(given, bool):
        return math.nan
    try:
        return float(given)
    except OverflowError:
        return math.nan


def _free(given: object) -> tuple[str | Layer, ...]:
    """Take names of parameters, and layers; one alone may come without a list."""
    if given is None:
        return ()
    alone = isinstance(given, str | Mapping) or is_layer(given)
    if not alone and not isinstance(given, Sequence):
        raise WrongTypeError(f"free is {type(given).__name__}", _WHERE, _FORM)
    every = [given] if alone else list(given)  # type: ignore[call-overload]
    made = tuple(_one(each) for each in every)
    names = [_name(each) for each in made]
    for name in names:
        if names.count(name) > 1:
            raise BadInputError(f"'{name}' is free twice", _WHERE, "name it once")
    return made


def _rank_of_free(given: str | Layer) -> tuple[int, str]:
    """Give the place of a parameter, or of a layer, among all that may be free."""
    return (NAMES.index(given), "") if isinstance(given, str) else (len(NAMES), given.name)


def rank_of_output(name: str) -> tuple[int, str]:
    """Give the place of an output among all that there are."""
    return _OUTPUTS.get(name, len(_OUTPUTS)), name


def _output_like(name: str) -> str:
    """Give the output that has this name, in any case; empty if none has."""
    return next((each for each in _OUTPUTS if each.lower() == name.lower()), "")


def _one(given: object) -> str | Layer:
    """Take one thing that is free."""
    if isinstance(given, str):
        if given not in NAMES:
            raise UnknownNameError("named parameter", shown_name(given), NAMES)
        return given
    layer = given if is_layer(given) else _layer(given)
    name = text(layer.name, "the name of a free layer", _WHERE)  # type: ignore[attr-defined]
    if name in NAMES:
        raise BadInputError(
            f"a free layer has the name of the parameter '{name}'", _WHERE, "give it another one"
        )
    scaled_layer(layer, 1.0)  # type: ignore[arg-type]  # refuses what cannot be scaled
    return layer  # type: ignore[return-value]


def _layer(given: object) -> FieldLayer:
    """Take the data of a layer."""
    if not isinstance(given, Mapping) or set(given) != {"name", "fields"}:
        raise WrongTypeError(f"free holds {shown(given)}", _WHERE, _FORM)
    name = text(given["name"], "the name of a free layer", _WHERE)
    return FieldLayer(name, fields_from_data(given["fields"]))


def _name(free: str | Layer) -> str:
    return free if isinstance(free, str) else free.name


def _mapping(given: object) -> Mapping[str, object]:
    """Take bounds as they are given, by name."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise WrongTypeError(
            f"bounds is {type(given).__name__}", _WHERE, "give (low, high) by what is free"
        )
    return given


def _bounds(
    given: Mapping[str, object], free: Sequence[str | Layer]
) -> dict[str, tuple[float, float]]:
    """Take bounds of what is free."""
    names = [_name(each) for each in free]
    for name in given:
        if name not in names:
            raise UnknownNameError("free parameter", shown_name(name), tuple(names))
    return {name: _pair(given[name], name) for name in names if name in given}


def _pair(given: object, name: str) -> tuple[float, float]:
    """Take a least and a greatest value; None leaves an end open."""
    if isinstance(given, str) or not isinstance(given, Sequence) or len(given) != 2:
        raise BadInputError(
            f"bounds of '{name}' are {shown(given)}", _WHERE, "give (low, high); None leaves open"
        )
    ends = [
        limit
        if each is None or _real(each) == limit
        else number(each, f"a bound of '{name}'", _WHERE)
        for each, limit in zip(given, (-math.inf, math.inf), strict=True)
    ]
    if not ends[0] <= ends[1]:
        raise BadInputError(
            f"bounds of '{name}' are {ends[0]:g} and {ends[1]:g}", _WHERE, "give the lower first"
        )
    return ends[0], ends[1]


def _open(pair: tuple[float, float]) -> list[float | None]:
    """Give bounds as JSON has them: null for an end that is open."""
    return [each if math.isfinite(each) else None for each in pair]


# --------------------------------------------------------------------------------------
# The whole request:
#
# {"version": 1, "set": {"shaft_height": 6.0, "bossing_radius": 1.0},
#  "layout": {"stern": 0.3}, "drivers": ["sections", "buttocks"], "stations": "number",
#  "planes": "follow", "layers": [[{"hat": {...}}]], "tolerance": 0.002, "fair": true,
#  "accept": false, "name": "larger screw"}
#
# No key must be there but ``set``, ``reach`` or ``layers``; ``version`` is that of this form.

TOLERANCE = 2e-3
"""How far drivers may leave their exact images, m, unless the request says so."""

Stations = Literal["number", "x"]
Planes = Literal["follow", "stay"]

VERSION = 1
"""Of the form of scripts."""

_KEYS = ("version", "set", "reach", "free", "bounds", "exact", "layers", "layout", "drivers",
         "stations", "planes", "tolerance", "fair", "accept", "name")  # fmt: skip
_SPOKEN = {each.short: each.name for each in CATALOGUE.values()} | {
    "pmb_start": "parallel_body_start", "pmb_end": "parallel_body_end", "LPP": "length",
}  # fmt: skip
"""What parameters are called in formulas, to suggest the full name in an error."""


@attrs.frozen(eq=False)
class VariationRequest:
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
    reach : TargetRequest or None
        What outputs are to be reached, and what is free for it.
    fair : float or bool, m
        How far points that have moved may move once more, so that lines stay as fair as they were;
        True: as far as is usual, False: not at all.
    accept : bool
        Whether a hull is taken whose lines bend as no one would have it.
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
    reach: TargetRequest | None = None
    fair: float | bool = False
    accept: bool = False

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
        fair: float | bool = False,
        accept: bool = False,
        name: str | None = None,
    ) -> VariationRequest:
        """Take what a designer gives.

        Raises
        ------
        UnknownNameError
            No such parameter, or no such reach of a field.
        BadInputError
            A value that is no number or has no meaning; nothing is asked for.
        """
        found, aimed = _values(values), TargetRequest.of(reach, free, bounds, exact)
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
            title_of(found, aimed) if name is None else text(name, "the name", "in vary"),
            None if any(is_layer(each) for each in layers) else tuple(layers), aimed,
            fair if isinstance(fair, bool) else positive(fair, "fair", "in vary"),
            flag(accept, "accept", "in vary"),
        )  # fmt: skip


def request_from_data(data: object) -> VariationRequest:
    """Take what a script file says.

    Raises
    ------
    UnknownNameError
        A key that is none.
    WrongTypeError, BadInputError
        A part of another form.

    Examples
    --------
    >>> from assoc_hull.variation.request import request_from_data
    >>> dict(request_from_data({"set": {"breadth": 51.5}}).values)
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
    return VariationRequest.of(
        data.get("set"), reach=data.get("reach"), free=data.get("free", ()),
        bounds=data.get("bounds"), exact=data.get("exact", True),
        layers=data.get("layers", ()), layout=data.get("layout"), drivers=data.get("drivers"),
        stations=data.get("stations", "number"), planes=data.get("planes", "follow"),
        tolerance=data.get("tolerance", TOLERANCE), fair=data.get("fair", False),
        accept=data.get("accept", False), name=data.get("name"),
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
            if word not in _SPOKEN and (output := _output_like(word)):
                raise BadInputError(
                    f"{word} is no named parameter: it is what a hull comes to have", "in vary",
                    f"ask for reach={{{output!r}: ...}} with free=[...] "
                    f"(--reach {output}=... --free ...)",
                )  # fmt: skip
            raise UnknownNameError("named parameter", word, NAMES, _SPOKEN.get(word, ""))
    found = {name: number(given[name], name, "in vary") for name in NAMES if name in given}
    for name, value in found.items():
        if CATALOGUE[name].positive and not value > 0.0:
            unit = CATALOGUE[name].unit.replace("-", "")
            said = f"{name} is {value:g} {unit}".rstrip()
            raise BadInputError(said, "in vary", "give one above 0")
    return found


def _layers(given: object) -> tuple[Layer, ...]:
    """Take layers as they are, or lists of fields as data."""
    if isinstance(given, str) or not isinstance(given, Sequence):
        raise WrongTypeError(
            f"layers is {type(given).__name__}", "in vary", "give a list of layers"
        )
    made = list[Layer]()
    for i, each in enumerate(given):
        if is_layer(each):
            made.append(each)
        else:
            made += [
                attrs.evolve(one, name=f"raw fields {i + 1}") for one in layers_from_data([each])
            ]
    return tuple(made)


def _layout(given: Mapping[str, Any] | Layout | None) -> Layout:
    """Take reaches by name, or a layout; its reaches are checked as well."""
    return Layout.of(attrs.asdict(given) if isinstance(given, Layout) else given)


def _drivers(given: object) -> tuple[Group | Line | str, ...] | None:
    """Take drivers as a tuple; None lets the map choose them."""
    if given is None:
        return None
    if isinstance(given, str) or not isinstance(given, Sequence):
        raise WrongTypeError(
            f"drivers is {type(given).__name__}", "in vary", "give a list of groups or lines"
        )
    return tuple(given)


def _refuse_both(values: Mapping[str, float], reach: TargetRequest | None) -> None:
    """Refuse parameters that are both set and free, and targets that set values fix."""
    if reach is None:
        return
    for name in reach.names:
        if name in values:
            raise BadInputError(f"'{name}' is set and free", "in vary", "leave it out of one")
    for output in reach.targets:
        sizes = _dimensions(output)
        if sizes and sizes <= values.keys():
            told = " and ".join(f"'{name}'" for name in sorted(sizes))
            raise BadInputError(
                f"'{output}' is to be reached, but {told}, which alone it is made of, "
                f"{'is' if len(sizes) == 1 else 'are'} set", "in vary",
                f"leave out '{output}', or let one of {told} be free instead of setting it",
            )  # fmt: skip


_SIZES = {"Lpp": "length", "B": "breadth", "D": "depth", "T_A": "draught", "T_F": "draught"}
"""Form parameters that are dimensions, and the parameter that sets each."""


def _dimensions(output: str) -> set[str]:
    """Give the parameters that set all that an output is made of; nothing where more is in it."""
    if output in _SIZES:
        return {_SIZES[output]}
    needs = FORM_PARAMETERS[output].needs if output in FORM_PARAMETERS else ()
    parts = [_dimensions(each) for each in needs]
    return set().union(*parts) if all(parts) else set()


def title_of(values: Mapping[str, float], reach: TargetRequest | None) -> str:
    """Give the usual name of the step in the history, from what is asked for."""
    words = ", ".join(f"{name}={value:g}" for name, value in values.items())
    found = f"vary {words}" if words else "vary by fields"
    if reach is None:
        return found
    goal = ", ".join(f"{name}={value:g}" for name, value in reach.targets.items())
    return f"{found} to reach {goal}" if words else f"vary to reach {goal}"


def read_script(path: str | PathLike[str]) -> dict[str, Any]:
    """Read a script file; a script without a name is called as the file is.

    Parameters
    ----------
    path : path
        A JSON file with one object; `assoc_hull.variation.request` says what it may hold.

    Raises
    ------
    BadInputError
        It cannot be read, is no JSON, holds no object, or a key twice.
    """
    file = Path(file_path(path, "in vary"))
    try:
        found = json.loads(file.read_text(encoding="utf-8-sig"), object_pairs_hook=once)
    except OSError as error:
        raise BadInputError(
            f"script {file}: {error.strerror or error}", "in vary", "check name and place"
        ) from error
    except (ValueError, RecursionError) as error:
        raise BadInputError(f"script {file} is no JSON: {error}", "in vary", "mend it") from error
    if not isinstance(found, dict):
        raise BadInputError(
            f"script {file} holds a {type(found).__name__}", "in vary", "give an object"
        )
    return {"name": file.stem, **found}


def script_of(ask: VariationRequest) -> Mapping[str, Any] | None:
    """Give what was asked for as data; None where layers were not given as data.

    Examples
    --------
    >>> from assoc_hull.variation.request import VariationRequest
    >>> from assoc_hull.variation.request import script_of
    >>> dict(script_of(VariationRequest.of({"breadth": 51.5}, layout={"stern": 0.3})))["layout"]
    {'stern': 0.3}
    """
    if ask.given is None or (ask.reach is not None and ask.reach.given is None):
        return None
    usual = attrs.asdict(Layout())
    found: dict[str, Any] = {"version": VERSION, "set": dict(ask.values)}
    if ask.reach is not None:
        found.update(ask.reach.data())
    layout = {name: each for name, each in attrs.asdict(ask.layout).items() if each != usual[name]}
    if layout:
        found["layout"] = layout
    if ask.given:
        found["layers"] = list(ask.given)
    if ask.drivers is not None:
        found["drivers"] = [_driver_name(each) for each in ask.drivers]
    found.update(stations=ask.stations, planes=ask.planes, tolerance=ask.tolerance, name=ask.name)
    if ask.fair:
        found["fair"] = ask.fair
    if ask.accept:
        found["accept"] = True
    return MappingProxyType(found)


def _driver_name(driver: Group | Line | str) -> str:
    return driver if isinstance(driver, str) else driver.name
