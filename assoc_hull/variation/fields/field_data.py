"""Raw fields as data: what a script says in JSON becomes fields and layers.

{"hat": {"name": "skeg", "along": {"x": [6, 66], "v": [1, 0]},
         "anchors": [["base", 0, 0], ["skeg", 4, 0.5], ["T", 18, 0]]}}
{"stack": {"name": "bow", "axis": "y", "boundaries": [["low", 5], ["T", 18]],
           "pieces": [{"a": {"x": [270, 300], "v": [0, 0.05]}}, {}]}}
{"rake": {"name": "stem", "along": {"x": [270, 300], "v": [0, 1]}, "q": 0.1, "z0": 18, "w": 4}}

A function of x is a number, a chain as above, a spline (``"smooth": true`` beside x and v),
straight lines (``"straight": true``), or a bump:
{"begin": 200, "end": 300, "size": 1.5, "shape": "c2"}.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, get_args

import attrs

from assoc_hull.arguments import choice, flag, number, positive, text
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import (
    BLENDS,
    Blend,
    BlendChain,
    BoundedFunction,
    Contour,
)
from assoc_hull.variation.fields.field import AffinePiece, Axis, Boundary, StackedField, Tube
from assoc_hull.variation.fields.layers import FieldLayer, Rake
from assoc_hull.variation.fields.shift_shapes import Bump, BumpShape, Polyline

__all__ = ["course_data", "fields_from_data", "layers_from_data"]

_WHERE = "in a field of vary"

_SHAPES: tuple[BumpShape, ...] = get_args(BumpShape)


def layers_from_data(given: object) -> tuple[FieldLayer, ...]:
    """Take layers of raw fields: a list of lists of fields, each list one layer.

    Raises
    ------
    BadInputError
        What is given is not that; the message names the part.

    Examples
    --------
    >>> from assoc_hull.variation.fields.field_data import layers_from_data
    >>> skeg = {"name": "skeg", "along": {"x": [6, 66], "v": [1, 0]},
    ...         "anchors": [["base", 0, 0], ["skeg", 4, 0.5], ["T", 18, 0]]}
    >>> [layer.name for layer in layers_from_data([[{"hat": skeg}]])]
    ['raw fields 1']
    """
    layers = _items(given, "layers")
    return tuple(
        FieldLayer(f"raw fields {i + 1}", fields_from_data(each)) for i, each in enumerate(layers)
    )


def fields_from_data(given: object) -> tuple[StackedField | Rake, ...]:
    """Take the fields of one layer."""
    return tuple(_field(each) for each in _items(given, "fields"))


def _field(given: object) -> StackedField | Rake:
    if isinstance(given, StackedField | Rake):
        return given
    data = _table(given, "a field", (), tuple(_KINDS))
    if len(data) != 1:
        raise BadInputError(
            f"a field has the keys {sorted(data)}", _WHERE, f"give one of {', '.join(_KINDS)}"
        )
    kind, inner = next(iter(data.items()))
    return _KINDS[kind](inner)


def _hat(given: object) -> StackedField:
    data = _table(given, "hat", ("name", "anchors", "along"), ("axis", "blend", "outward"))
    anchors = []
    for each in _items(data["anchors"], "anchors"):
        what, height, change = _row(each, 3, "an anchor", "[name, height, displacement]")
        anchors.append((text(what, "name", _WHERE), _number(height), _number(change)))
    blend = _blend(data)
    names = [each[0] for each in anchors]
    outward = [text(each, "outward", _WHERE) for each in _items(data.get("outward", []), "outward")]
    for each in outward:
        if each not in names:
            raise UnknownNameError("anchor of the hat", each, tuple(names))
    axis = choice(data.get("axis", "z"), "axis", ("x", "z"), _WHERE)
    return hat_field(
        text(data["name"], "name", _WHERE), anchors, _course(data["along"], blend, "along"),
        axis=_axis(axis), blend=blend, outward=outward,
    )  # fmt: skip


def _stack(given: object) -> StackedField:
    data = _table(given, "stack", ("name", "axis", "boundaries", "pieces"), ("blend", "tube"))
    blend, name = _blend(data), text(data["name"], "name", _WHERE)
    walls = []
    for each in _items(data["boundaries"], "boundaries"):
        what, height = _row(each, 2, "a boundary", "[name, height]")
        walls.append(Boundary(text(what, "name", _WHERE), _course(height, blend, "height")))
    pieces = [_piece(each, blend) for each in _items(data["pieces"], "pieces")]
    axis = _axis(choice(data["axis"], "axis", ("x", "y", "z"), _WHERE))
    tube = None
    if "tube" in data:
        tube = _tube(data["tube"], blend)
    return StackedField.checked(name, axis, walls, pieces, blend=blend, tube=tube)


def _rake(given: object) -> Rake:
    data = _table(given, "rake", ("name", "along", "q", "z0", "w"), ("blend",))
    blend = _blend(data)
    return Rake(
        text(data["name"], "name", _WHERE), _course(data["along"], blend, "along"),
        _number(data["q"]), _number(data["z0"]), positive(data["w"], "w", _WHERE), blend,
    )  # fmt: skip


_KINDS: Mapping[str, Callable[[object], StackedField | Rake]] = {
    "hat": _hat, "stack": _stack, "rake": _rake,
}  # fmt: skip


def _piece(given: object, blend: Blend) -> AffinePiece:
    data = _table(given, "a piece", (), ("a", "pivot", "d"))
    return AffinePiece(
        _course(data.get("a", 0.0), blend, "a"), _number(data.get("pivot", 0.0)),
        _course(data.get("d", 0.0), blend, "d"),
    )  # fmt: skip


def _tube(given: object, blend: Blend) -> Tube:
    data = _table(given, "tube", ("radius",), ("n",))
    n = positive(data.get("n", 6.0), "n", _WHERE)
    if not n > 1.0:
        raise BadInputError(f"a tube of n={n:g}", _WHERE, "give n above 1")
    return Tube(positive(data["radius"], "radius", _WHERE), n, blend)


def _course(given: object, blend: Blend, name: str) -> BoundedFunction:
    """Take a number, or a course in one of the forms that `course_data` gives."""
    if not isinstance(given, Mapping):
        return BlendChain.constant(number(given, name, _WHERE))
    if "shape" in given:
        return _bump(given, name)
    data = _table(given, name, ("x", "v"), ("smooth", "straight"))
    chain = BlendChain.through(data["x"], data["v"], blend, name)
    smooth, straight = (flag(data.get(key, False), key, _WHERE) for key in ("smooth", "straight"))
    if not smooth and not straight:
        return chain
    if smooth and straight:
        raise BadInputError(f"{name} is both smooth and straight", _WHERE, "say one of them")
    if len(chain.x) < 2:
        word = "smooth" if smooth else "straight"
        raise BadInputError(f"{name} is {word} through one node", _WHERE, "give two or more")
    return Contour(chain.x, chain.v) if smooth else Polyline(chain.x, chain.v)


def _bump(given: Mapping[str, Any], name: str) -> Bump:
    data = _table(given, name, ("begin", "end", "shape"), ("size",))
    shape = choice(data["shape"], "shape", _SHAPES, _WHERE)
    return Bump(
        _number(data["begin"]), _number(data["end"]), _number(data.get("size", 1.0)),
        next(each for each in _SHAPES if each == shape),
    )  # fmt: skip


def course_data(course: BoundedFunction) -> dict[str, Any]:
    """Give a course as data: a chain by its nodes and values, a bump by its terminals.

    Examples
    --------
    >>> from assoc_hull.variation.fields.shift_shapes import Bump
    >>> from assoc_hull.variation.fields.field_data import course_data
    >>> course_data(Bump(60.0, 120.0, 0.5))
    {'begin': 60.0, 'end': 120.0, 'size': 0.5, 'shape': 'c2'}
    """
    if isinstance(course, Bump):
        return attrs.asdict(course)
    if not isinstance(course, BlendChain | Contour | Polyline):
        raise BadInputError(
            f"a {type(course).__name__} has no form as data", _WHERE, "give it as a layer"
        )
    nodes: dict[str, Any] = {"x": course.x.tolist(), "v": course.v.tolist()}
    if isinstance(course, BlendChain):
        return nodes
    return {**nodes, "smooth" if isinstance(course, Contour) else "straight": True}


def _axis(name: str) -> Axis:
    return "x" if name == "x" else "y" if name == "y" else "z"


def _blend(data: Mapping[str, Any]) -> Blend:
    return BLENDS[choice(data.get("blend", "quintic"), "blend", tuple(BLENDS), _WHERE)]


def _number(value: object) -> float:
    return number(value, "a number", _WHERE)


def _items(given: object, name: str) -> Sequence[object]:
    if isinstance(given, str) or not isinstance(given, Sequence):
        raise WrongTypeError(f"{name} is {type(given).__name__}", _WHERE, "give a list")
    return given


def _row(given: object, size: int, name: str, form: str) -> Sequence[object]:
    row = _items(given, name)
    if len(row) != size:
        raise BadInputError(f"{name} has {len(row)} entries", _WHERE, f"give {form}")
    return row


def _table(
    given: object, name: str, needed: tuple[str, ...], further: tuple[str, ...]
) -> Mapping[str, Any]:
    """Take a mapping that has all needed keys, and no unknown one."""
    if not isinstance(given, Mapping):
        raise WrongTypeError(f"{name} is {type(given).__name__}", _WHERE, "give a mapping by name")
    for key in given:
        if key not in (*needed, *further):
            raise UnknownNameError(f"part of {name}", str(key), (*needed, *further))
    for key in needed:
        if key not in given:
            raise BadInputError(f"{name} has no '{key}'", _WHERE, f"give {', '.join(needed)}")
    return given
