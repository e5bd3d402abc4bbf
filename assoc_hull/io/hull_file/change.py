"""A change to bytes and back: what an edit did, as a hull file keeps it.

Examples
--------
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.edit.session import Edit
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.hull_file.change import pack_change, unpack_change
>>> from assoc_hull.model.change import change_of
>>> document = Document(wigley())
>>> with Edit(document, "move") as edit:
...     edit.move("WL 2.5 x ST 7", y=2.95)
>>> change = change_of(document.state, document.history[-1].journal)
>>> again = unpack_change(pack_change(change))
>>> sorted(again.bits) == sorted(change.bits), again.lofted.tolist() == change.lofted.tolist()
(True, True)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.io.hull_file.packed_arrays import pack, unpack
from assoc_hull.model.change import Change
from assoc_hull.model.definition_part import FormDefinition, GeneratedCurve
from assoc_hull.model.features import Feature
from assoc_hull.model.places_on_curves import PlacesOn
from assoc_hull.model.state import Association, Ends, Particulars

__all__ = ["pack_change", "unpack_change"]

Arrays = dict[str, NDArray[Any]]

_PLACES = ("curve", "count", "line", "sign", "row")
_SHAPE = ("knot", "xyz", "leave", "arrive")


def pack_change(change: Change) -> bytes:
    """Put a change into bytes."""
    arrays: Arrays = {"lofted": _short(change.lofted), "moved": _short(change.moved[0])}
    # Bytes of equal weight lie side by side: most of them agree, which is what compresses.
    arrays["moved.bits"] = change.moved[1].T
    for name, (rows, bits) in change.bits.items():
        arrays |= {f"{name}.rows": _short(rows), f"{name}.bits": bits.T}
    arrays |= _pack_places("before", change.before, change.before.at)
    arrays |= _pack_places("after", change.after, _against(change.before, change.after))
    for when, shapes in enumerate(change.kept):
        for curve, spline in shapes.items():
            arrays |= {f"kept.{when}.{curve}.{part}": getattr(spline, part) for part in _SHAPE}
    return pack(arrays, _facts(change))


def _facts(change: Change) -> dict[str, Any]:
    objects = {
        name: [
            rows.tolist(),
            [_say(name, each) for each in old],
            [_say(name, each) for each in new],
        ]
        for name, (rows, old, new) in change.objects.items()
    }
    return {
        "sizes": change.sizes,
        "bits": list(change.bits),
        "objects": objects,
        "births": [[*pair, *counts] for pair, counts in change.births.items()],
        "kept": [list(shapes) for shapes in change.kept],
    }


def _short(numbers: IntArray) -> NDArray[np.int32]:
    return numbers.astype(np.int32)


def _long(numbers: NDArray[Any]) -> IntArray:
    return numbers.astype(np.int64)


def _against(before: PlacesOn, after: PlacesOn) -> FloatArray:
    """Give places as the exclusive or with where the same crossing lay on the curve before.

    A line that is added or taken away changes what many curves list, and where nothing of that
    lies. Crossings that were not there before stand as they are. Twice, it takes itself back.
    """
    found = after.at.copy()
    keys = [_keys(places) for places in (before, after)]
    _, old, new = np.intersect1d(keys[0][:, 0], keys[1][:, 0], return_indices=True)
    old, new = keys[0][old, 1], keys[1][new, 1]
    found[new] = (before.at[old].view(np.int64) ^ found[new].view(np.int64)).view(np.float64)
    return found


def _keys(places: PlacesOn) -> IntArray:
    """Give a number for each crossing on a curve, and where it stands, (k, 2)."""
    actual = np.flatnonzero(places.row >= 0)
    curve = places.curve[places.owner[actual]]
    return np.column_stack([(curve << 32) + places.row[actual], actual])


def _pack_places(title: str, places: PlacesOn, at: FloatArray) -> Arrays:
    if not len(places.curve):
        return {}
    whole = {f"{title}.{name}": _short(getattr(places, name)) for name in _PLACES}
    bits = np.frombuffer(at.tobytes(), np.uint8).reshape(len(at), 32)
    return {**whole, f"{title}.bits": bits.T}


def _unpack_places(title: str, arrays: Arrays) -> PlacesOn:
    if f"{title}.curve" not in arrays:
        arrays = {f"{title}.{name}": np.zeros(0, np.int32) for name in _PLACES}
        arrays[f"{title}.bits"] = np.zeros((32, 0), np.uint8)
    curve, count, line, sign, row = (_long(arrays[f"{title}.{name}"]) for name in _PLACES)
    if f"{title}.at" in arrays:  # as early files of versions 1 and 2 hold it
        at = arrays[f"{title}.at"]
    else:
        at = np.frombuffer(arrays[f"{title}.bits"].T.tobytes(), "<f8").reshape(-1, 4)
    return PlacesOn(curve, count, line, sign, row, at.astype(np.float64))


def _both_places(arrays: Arrays) -> tuple[PlacesOn, PlacesOn]:
    """Give the places on curves that list other crossings, before and after."""
    before, after = _unpack_places("before", arrays), _unpack_places("after", arrays)
    plain = "after.at" in arrays or not len(before.curve)
    return before, after if plain else attrs.evolve(after, at=_against(before, after))


def unpack_change(data: bytes) -> Change:
    """Take a change out of bytes.

    Raises
    ------
    ValueError, KeyError, TypeError
        They hold no change.
    """
    arrays, facts = unpack(data)
    before, after = _both_places(arrays)
    objects = {
        name: (
            np.array(rows, np.int64),
            [_hear(name, each) for each in old],
            [_hear(name, each) for each in new],
        )
        for name, (rows, old, new) in facts["objects"].items()
    }
    return Change(
        {name: (int(old), int(new)) for name, (old, new) in facts["sizes"].items()},
        {name: _bits(arrays, name) for name in facts["bits"]},
        objects,
        {(a, b): (int(old), int(new)) for a, b, old, new in facts["births"]},
        (_long(arrays["moved"]), np.ascontiguousarray(arrays["moved.bits"].T)),
        before,
        after,
        _long(arrays["lofted"]),
        (_kept(arrays, facts, 0), _kept(arrays, facts, 1)),
    )


def _bits(arrays: Arrays, name: str) -> tuple[IntArray, NDArray[np.uint8]]:
    return _long(arrays[f"{name}.rows"]), np.ascontiguousarray(arrays[f"{name}.bits"].T)


def _kept(arrays: Arrays, facts: dict[str, Any], when: int) -> dict[int, SplineBatch]:
    found = {}
    for curve in facts["kept"][when]:
        knot, xyz, leave, arrive = (arrays[f"kept.{when}.{curve}.{part}"] for part in _SHAPE)
        start = np.array([0, len(knot)], np.int64)
        found[int(curve)] = SplineBatch(start, knot, xyz, leave, arrive)
    return found


def _same(value: Any) -> Any:
    return value


def _numbers(value: Any) -> list[int]:
    return [int(each) for each in value]


def _frozen(value: Any) -> IntArray:
    found = np.array(value, np.int64)
    freeze(found)
    return found


def _ends_of(value: Any) -> Ends:
    (first, last), (start, finish) = value
    return Ends((int(first), int(last)), (tuple(start), tuple(finish)))


def _plain(thing: Feature | GeneratedCurve | None) -> Any:
    return None if thing is None else attrs.asdict(thing)


def _feature(said: Any) -> Feature | None:
    return None if said is None else Feature(**said)


def _said_form(form: FormDefinition | None) -> Any:
    return (
        None if form is None else {**attrs.asdict(form, recurse=False), "values": {**form.values}}
    )


def _form(said: Any) -> FormDefinition | None:
    return None if said is None else FormDefinition(**said)


def _made(said: Any) -> GeneratedCurve | None:
    if said is None:
        return None
    marks = tuple((int(piece), float(t)) for piece, t in said["marks"])
    return GeneratedCurve(**{**said, "rows": tuple(_numbers(said["rows"])), "marks": marks})


_CODES: Mapping[str, tuple[Callable[[Any], Any], Callable[[Any], Any]]] = {
    "curves.rows": (_numbers, _frozen),
    "curves.side": (_numbers, _frozen),
    "curves.ends": (lambda ends: [_numbers(ends.kind), ends.vector], _ends_of),
    "lines.curves": (_numbers, tuple),
    "settings.failed": (_numbers, tuple),
    "featured.feature": (_plain, _feature),
    "formed.definition": (_said_form, _form),
    "produced.curve": (_plain, _made),
    "settings.particulars": (attrs.asdict, lambda said: Particulars(**said)),
    "settings.associations": (
        lambda links: [[each.a, each.b, each.two_way] for each in links],
        lambda said: tuple(Association(a, b, two_way) for a, b, two_way in said),
    ),
}
"""By column: to what JSON can say, and back. All other columns of objects hold texts."""


def _say(name: str, value: Any) -> Any:
    return _CODES.get(name, (_same, _same))[0](value)


def _hear(name: str, said: Any) -> Any:
    return _CODES.get(name, (_same, _same))[1](said)
