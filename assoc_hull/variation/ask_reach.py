"""What a variation is to reach besides what is set, and what is free for it; checked and frozen.

{"reach": {"volume": 10500.0, "lcb": 61.9},
 "free": ["breadth", "fore_shift", {"name": "fuller", "fields": [{"hat": {...}}]}],
 "bounds": {"fore_shift": [-2.0, 2.0], "breadth": [null, 18.0]}, "exact": true}
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from numbers import Real
from types import MappingProxyType

import attrs
import numpy as np

from assoc_hull.arguments import flag, number, shown, shown_name, text
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.field_data import fields_from
from assoc_hull.variation.fields.fields_layer import FieldLayer
from assoc_hull.variation.fields.layer import Layer
from assoc_hull.variation.parameters.catalogue import NAMES
from assoc_hull.variation.parameters.freedom import scaled_layer

__all__ = ["AskReach", "acts"]

_WHERE = "in vary"
_FORM = 'give names of parameters, layers, or {"name": ..., "fields": [...]}'


@attrs.frozen(eq=False)
class AskReach:
    """Targets, and what is free to reach them.

    Attributes
    ----------
    targets : mapping of str to float
        Values of outputs by name, in their units.
    free : tuple of str or Layer
        Named parameters, and layers whose strength is free.
    bounds : mapping of str to (float, float)
        Least and greatest values by the name of what is free: m, deg, or factors on layers.
    exact : bool
        Whether all targets must be met.
    given : tuple or None
        What is free as it was given, if it was given as data.
    """

    targets: Mapping[str, float]
    free: tuple[str | Layer, ...]
    bounds: Mapping[str, tuple[float, float]]
    exact: bool = True
    given: tuple[object, ...] | None = ()

    @classmethod
    def of(cls, reach: object, free: object, bounds: object, exact: object) -> AskReach | None:
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
        return cls(
            MappingProxyType(targets), made, MappingProxyType(_bounds(limits, made)), whole,
            None if any(acts(each) for each in given) else tuple(given),
        )  # fmt: skip

    @property
    def names(self) -> tuple[str, ...]:
        """Names of what is free."""
        return tuple(_name(each) for each in self.free)

    def limits(self, present: Sequence[float]) -> FloatArray:
        """Give bounds of amplitudes, (k, 2): of values less the present ones."""
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


def acts(given: object) -> bool:
    """Tell a layer from the data of one."""
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
    """Take a finite number: a moment of inertia may be larger than any length."""
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
    alone = isinstance(given, str | Mapping) or acts(given)
    if not alone and not isinstance(given, Sequence):
        raise WrongTypeError(f"free is {type(given).__name__}", _WHERE, _FORM)
    every = [given] if alone else list(given)  # type: ignore[call-overload]
    made = tuple(_one(each) for each in every)
    names = [_name(each) for each in made]
    for name in names:
        if names.count(name) > 1:
            raise BadInputError(f"'{name}' is free twice", _WHERE, "name it once")
    return made


def _one(given: object) -> str | Layer:
    """Take one thing that is free."""
    if isinstance(given, str):
        if given not in NAMES:
            raise UnknownNameError("named parameter", shown_name(given), NAMES)
        return given
    layer = given if acts(given) else _layer(given)
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
    return FieldLayer(name, fields_from(given["fields"]))


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
    return [each if math.isfinite(each) else None for each in pair]
