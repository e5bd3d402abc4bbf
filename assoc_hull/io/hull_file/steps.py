"""Committed steps to the rows of a hull file, and back.

A step holds what was asked for and the report as JSON, and the change of every row as packed arrays
(`pack_change`), so that undoing and redoing give the same bits. Its digest covers all of the row.
`docs/file_format.md` lists the columns.
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.document import Label
from assoc_hull.edit.recording import Script, VariedValues
from assoc_hull.edit.step import Counting, EditReport, Led, Movement, Rerun, Step, StepBody
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.graph.run_update import Readers
from assoc_hull.io.hull_file.guard import MOST_BYTES, MOST_TEXT, parse_json, read_rows
from assoc_hull.io.hull_file.packed_arrays import pack_arrays, unpack_arrays
from assoc_hull.model.attachments import ATTACHMENTS, Attachment
from assoc_hull.model.change import CrossingPositions, TableChange, positions_against
from assoc_hull.model.features import Feature
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.tables import Association, Ends, HullState, Particulars, Ruling

__all__ = [
    "body_of",
    "newest_fault",
    "pack_change",
    "read_labels",
    "report_from",
    "report_text",
    "step_digest",
    "steps_of",
    "unpack_change",
    "write_labels",
    "write_step",
]

# --------------------------------------------------------------------------------------
# A change to bytes and back.

Arrays = dict[str, NDArray[Any]]

_PLACES = ("curve", "count", "line", "sign", "row")
_SHAPE = ("knot", "xyz", "leave", "arrive")


def pack_change(change: TableChange) -> bytes:
    """Put a change into bytes."""
    arrays: Arrays = {"lofted": _short(change.lofted), "moved": _short(change.moved[0])}
    arrays |= _pack_bits("moved", change.moved[1])
    arrays["moved.odd"] = np.zeros(len(change.moved[1]) % 2, np.uint8)
    for name, (rows, bits) in change.bits.items():
        arrays |= {f"{name}.rows": _short(rows), **_pack_bits(name, bits)}
    arrays |= _pack_places("before", change.before, change.before.at)
    arrays |= _pack_places("after", change.after, positions_against(change.before, change.after))
    for when, shapes in enumerate(change.kept):
        for curve, spline in shapes.items():
            arrays |= {f"kept.{when}.{curve}.{part}": getattr(spline, part) for part in _SHAPE}
    # The bits of an edit of shape are noise but for the zeros, which are left out already.
    keeps_structure = not (change.objects or change.sizes or len(change.before.curve))
    return pack_arrays(arrays, _facts(change), 0 if keeps_structure else _LEVEL)


_LEVEL = 6
"""How hard changes of structure are compressed, which name all that came and went."""

_WORD, _WIDEST = 8, 48
"""Bytes of a word, and of the widest row: two vectors."""


def _pack_bits(name: str, bits: NDArray[np.uint8]) -> Arrays:
    """Put the bits of rows, (k, bytes), into arrays: only words that are not nil, where there are.

    A place of which one coordinate changed, as in a plane, is nil for the most part.
    """
    if bits.shape[1] % _WORD:
        return {f"{name}.bits": bits.T}
    words = np.ascontiguousarray(bits).view("<i8").reshape(-1)
    there = words != 0
    return {f"{name}.mask": np.packbits(there), f"{name}.words": words[there]}


def _unpack_bits(arrays: Arrays, name: str, count: int, width: int | None) -> NDArray[np.uint8]:
    """Give the bits of so many rows, (count, bytes); early files do not tell the width.

    Raises
    ------
    ValueError, KeyError
        They are of another shape, or do not lie there as they should.
    """
    if f"{name}.mask" not in arrays:
        bits = np.ascontiguousarray(_array(arrays, f"{name}.bits", np.uint8, 2).T)
        if len(bits) != count or width not in (None, bits.shape[1]):
            raise ValueError(f"{name} has the shape {bits.shape}")
        return bits
    if width is None or width % _WORD or not 0 < width <= _WIDEST:
        raise ValueError(f"{name} has rows of {width} bytes")
    mask, words = (
        _array(arrays, f"{name}.mask", np.uint8),
        _array(arrays, f"{name}.words", np.int64),
    )
    size = count * width // _WORD
    if len(mask) != -(-size // 8):
        raise ValueError(f"{name} has a mask of {len(mask)} bytes for {count} rows")
    there = np.unpackbits(mask).view(np.bool_)
    if there[size:].any() or np.count_nonzero(there) != len(words):
        raise ValueError(f"{name} has {len(words)} words, and its mask another number")
    found = np.zeros(size, np.int64)
    found[there[:size]] = words
    return found.view(np.uint8).reshape(count, width)


def _array(arrays: Arrays, name: str, kind: type[np.generic], axes: int = 1) -> NDArray[Any]:
    """Give an array of a type and number of axes.

    Raises
    ------
    ValueError, KeyError
        It is missing, or another.
    """
    found = arrays[name]
    if found.dtype != np.dtype(kind).newbyteorder("<") or found.ndim != axes:
        raise ValueError(f"{name} is of {found.dtype} with {found.ndim} axes")
    return found


def _facts(change: TableChange) -> dict[str, Any]:
    """Give what of a change is no array, for JSON: sizes, columns, objects, births, splines."""
    objects = {
        name: [
            rows.tolist(),
            [_to_json(name, each) for each in old],
            [_to_json(name, each) for each in new],
        ]
        for name, (rows, old, new) in change.objects.items()
    }
    return {
        "sizes": change.sizes,
        "bits": {name: bits.shape[1] for name, (_, bits) in change.bits.items()},
        "objects": objects,
        "births": [[*pair, *counts] for pair, counts in change.births.items()],
        "kept": [list(shapes) for shapes in change.kept],
    }


def _short(numbers: IntArray) -> NDArray[np.int32]:
    return numbers.astype(np.int32)


def _long(numbers: NDArray[Any]) -> IntArray:
    return numbers.astype(np.int64)


def _pack_places(title: str, places: CrossingPositions, at: FloatArray) -> Arrays:
    if not len(places.curve):
        return {}
    whole = {f"{title}.{name}": _short(getattr(places, name)) for name in _PLACES}
    bits = np.frombuffer(at.tobytes(), np.uint8).reshape(len(at), _PLACE_BYTES)
    return {**whole, **_pack_bits(title, bits)}


_PLACE_BYTES = 32
"""Parameter, x, y, z."""


def _unpack_places(title: str, arrays: Arrays) -> CrossingPositions:
    if f"{title}.curve" not in arrays:
        none = np.zeros(0, np.int64)
        return CrossingPositions(none, none, none, none, none, np.zeros((0, 4)))
    curve, count, line, sign, row = (
        _long(_array(arrays, f"{title}.{name}", np.int32)) for name in _PLACES
    )
    if len(curve) != len(count) or (count < 0).any() or count.sum() != len(row):
        raise ValueError(f"the counts of places {title} do not fit")
    if not len(line) == len(sign) == len(row):
        raise ValueError(f"the places {title} are of several lengths")
    if f"{title}.at" in arrays:  # as early files of versions 1 and 2 hold it
        at = _array(arrays, f"{title}.at", np.float64, 2)
    else:
        bits = _unpack_bits(arrays, title, len(row), _PLACE_BYTES)
        at = np.frombuffer(bits.tobytes(), "<f8").reshape(-1, 4)
    if at.shape != (len(row), 4):
        raise ValueError(f"the places {title} have the shape {at.shape}")
    return CrossingPositions(curve, count, line, sign, row, at.astype(np.float64))


def _both_places(arrays: Arrays) -> tuple[CrossingPositions, CrossingPositions]:
    """Give the positions on curves that list other crossings, before and after."""
    before, after = _unpack_places("before", arrays), _unpack_places("after", arrays)
    plain = "after.at" in arrays or not len(before.curve)
    return before, after if plain else attrs.evolve(after, at=positions_against(before, after))


def unpack_change(data: bytes) -> TableChange:
    """Take a change out of bytes.

    Raises
    ------
    ValueError, KeyError, TypeError
        They hold no change.
    """
    arrays, facts = unpack_arrays(data)
    before, after = _both_places(arrays)
    objects = {
        name: (
            np.array(rows, np.int64),
            [_from_json(name, each) for each in old],
            [_from_json(name, each) for each in new],
        )
        for name, (rows, old, new) in facts["objects"].items()
    }
    return TableChange(
        _sizes(facts),
        _all_bits(arrays, facts["bits"]),
        objects,
        {(a, b): (int(old), int(new)) for a, b, old, new in facts["births"]},
        (_long(_array(arrays, "moved", np.int32)), _moved_bits(arrays)),
        before,
        after,
        _long(_array(arrays, "lofted", np.int32)),
        (_kept(arrays, facts, 0), _kept(arrays, facts, 1)),
    )


def _sizes(facts: dict[str, Any]) -> dict[str, tuple[int, int]]:
    """Give how tables grew: by rows that are all named, for each has a key or a name."""
    found = {name: (int(old), int(new)) for name, (old, new) in facts["sizes"].items()}
    for name, (old, new) in found.items():
        named = sum(
            len(each[0]) for column, each in facts["objects"].items() if column.startswith(name)
        )
        if not 0 <= old <= new <= old + named:
            raise ValueError(f"a table grows from {old} to {new} rows, and {named} are named")
    return found


def _all_bits(
    arrays: Arrays, said: list[str] | dict[str, int]
) -> dict[str, tuple[IntArray, NDArray[np.uint8]]]:
    """Give rows and bits by column; early files list the names alone."""
    found = {}
    for name in said:
        rows = _long(_array(arrays, f"{name}.rows", np.int32))
        width = said[name] if isinstance(said, dict) else None
        found[name] = rows, _unpack_bits(arrays, name, len(rows), width)
    return found


def _moved_bits(arrays: Arrays) -> NDArray[np.uint8]:
    """Give the bits of the places that moved; how many there are is told by those alone."""
    if "moved.mask" not in arrays:
        return np.ascontiguousarray(_array(arrays, "moved.bits", np.uint8, 2).T)
    count = 2 * len(_array(arrays, "moved.mask", np.uint8))  # a byte for two places of four
    odd = _array(arrays, "moved.odd", np.uint8)
    if len(odd) > 1 or len(odd) > count:
        raise ValueError("it is not told how many places moved")
    return _unpack_bits(arrays, "moved", count - len(odd), _PLACE_BYTES)


def _kept(arrays: Arrays, facts: dict[str, Any], when: int) -> dict[int, SplineBatch]:
    found = {}
    for curve in facts["kept"][when]:
        knot, xyz, leave, arrive = (
            _array(arrays, f"kept.{when}.{curve}.{part}", np.float64, 1 if part == "knot" else 2)
            for part in _SHAPE
        )
        if len(knot) < 2 or any(each.shape != (len(knot), 3) for each in (xyz, leave, arrive)):
            raise ValueError(f"the shape of curve {curve} is none")
        start = np.array([0, len(knot)], np.int64)
        found[int(curve)] = SplineBatch(start, knot, xyz, leave, arrive)
    return found


def _unchanged(value: Any) -> Any:
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


def _plain_form(form: FormDefinition | None) -> Any:
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


def _held(held: Iterable[Attachment]) -> list[Any]:
    return [list(attrs.astuple(each, recurse=False)) for each in held]


def _held_of(made: type[Attachment], said: Iterable[Any]) -> tuple[Attachment, ...]:
    return tuple(made(*each) for each in said)


_CODES: Mapping[str, tuple[Callable[[Any], Any], Callable[[Any], Any]]] = {
    "curves.rows": (_numbers, _frozen),
    "curves.side": (_numbers, _frozen),
    "curves.ends": (lambda ends: [_numbers(ends.kind), ends.vector], _ends_of),
    "lines.curves": (_numbers, tuple),
    "groups.members": (list, tuple),
    "settings.failed": (_numbers, tuple),
    "featured.feature": (_plain, _feature),
    "formed.definition": (_plain_form, _form),
    "produced.curve": (_plain, _made),
    "settings.particulars": (attrs.asdict, lambda said: Particulars(**said)),
    "settings.associations": (
        lambda links: [[each.a, each.b, each.two_way] for each in links],
        lambda said: tuple(Association(a, b, two_way) for a, b, two_way in said),
    ),
    "settings.rulings": (
        lambda rulings: [list(attrs.astuple(each)) for each in rulings],
        lambda said: tuple(Ruling(a, b, w, tuple(low), tuple(high)) for a, b, w, low, high in said),
    ),
    **{f"settings.{kind.column}": (_held, partial(_held_of, kind.made)) for kind in ATTACHMENTS},
}
"""By column: to what JSON can say, and back. All other columns of objects hold texts."""


def _to_json(name: str, value: Any) -> Any:
    return _CODES.get(name, (_unchanged, _unchanged))[0](value)


def _from_json(name: str, said: Any) -> Any:
    return _CODES.get(name, (_unchanged, _unchanged))[1](said)


# --------------------------------------------------------------------------------------
# Steps and labels as rows.


def write_step(database: sqlite3.Connection, step: Step, change: TableChange) -> None:
    """Write a step, with the fingerprint of the hull after it; the file is inside a transaction."""
    report, cause = step.report, step.cause
    nodes = {"reader": cause.reader, "source": cause.source, "changed": step.changed}
    trace = pack_arrays(
        {name: _short(each) for name, each in nodes.items()}
        | {"moved": step.moved, "seeds": _short(step.seeds)}, None, 0,
    )  # fmt: skip
    row = (
        step.number, step.parent, step.name, report.author, report.time, int(step.structural),
        step.fingerprint, script_text(step.script), report_text(report), trace, pack_change(change),
    )  # fmt: skip
    for what, each in zip(("script", "report", "trace", "change"), row[7:], strict=True):
        most = MOST_TEXT if isinstance(each, str) else MOST_BYTES
        if len(each) > most:
            raise BadInputError(
                f"its {what} has {len(each)} bytes, and a hull file takes {most}",
                f"in the edit {step.name!r}", "divide it into several edits",
            )  # fmt: skip
    database.execute(
        "INSERT INTO steps VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        (*row[:7], step_digest(row), *row[7:]),
    )


def step_digest(row: tuple[Any, ...]) -> str:
    """Give the SHA-256 of all that a row of steps holds, its own digest left out."""
    found = hashlib.sha256()
    for each in row:
        data = each if isinstance(each, bytes) else json.dumps(each).encode()
        found.update(f"{len(data)}:".encode() + data)
    return found.hexdigest()


def script_text(script: Script) -> str:
    """Give what an edit was asked for as JSON."""
    said = attrs.asdict(script)
    if script.variation is None:
        del said["variation"]
    return json.dumps(said, separators=(",", ":"))


def script_from(text: str) -> Script:
    """Give what an edit was asked for from JSON.

    Raises
    ------
    ValueError, KeyError, TypeError
        It is no script.
    """
    said = parse_json(text)
    # files of older versions do not tell what a variation gave the hull
    varied, before = (VariedValues(**said.get(name, {})) for name in ("varied", "before"))
    return Script(
        tuple(map(dict, said["edits"])), said["policy"], said["gaps"], varied, before,
        said.get("variation"),
    )  # fmt: skip


def report_text(report: EditReport) -> str:
    """Give a report as JSON; lengths in m, times in s.

    Inflections are in it if they are counted: that takes longer than all else of a commit.
    """
    said = attrs.asdict(report, filter=lambda field, _: field.name not in ("fairness", "counted"))
    if not report.led:
        del said["led"], said["followed"]
    known = {"inflections": report.counted} if report.fairness is None else {}
    return json.dumps({**said, **known}, separators=(",", ":"))


def _movement(said: Any) -> Movement | None:
    if said is None:
        return None
    return Movement(said["point"], said["distance"], tuple(said["place"]), said.get("name", ""))


def _led(said: Any) -> Led:
    first, second = said["stretch"]
    asked, crossings = _amounts(said["asked"]), _amounts(said["crossings"])
    return Led(said["line"], said["along"], (first, second), asked, crossings)


def _amounts(said: Any) -> tuple[tuple[str, float], ...]:
    return tuple((key, float(amount)) for key, amount in said)


def report_from(text: str, late: Counting | None = None) -> EditReport:
    """Give a report from JSON; `late` counts inflections that were not.

    Raises
    ------
    ValueError, KeyError, TypeError
        It is no report.
    """
    said = parse_json(text)
    known = said.pop("inflections", None)
    counted = tuple((key, int(count)) for key, count in known or ())
    largest, normal = (_movement(said.pop(name, None)) for name in ("largest", "largest_normal"))
    changes = tuple(tuple(each) for each in said.pop("definitions", ()))
    led = tuple(_led(each) for each in said.pop("led", ()))
    followed = _amounts(said.pop("followed", ()))
    plain: dict[str, Any] = {
        name: tuple(x) if isinstance(x, list) else x for name, x in said.items()
    }
    return EditReport(
        **plain,
        largest=largest,
        largest_normal=normal,
        counted=counted,
        definitions=changes,
        led=led,
        followed=followed,
        fairness=late if known is None else None,
    )


def steps_of(
    database: sqlite3.Connection,
    after: int,
    load: Callable[[int], StepBody],
    tell: Callable[[int], EditReport],
) -> list[Step]:
    """Give the steps beyond the number `after`; `load` and `tell` fetch bodies and reports."""
    rows = read_rows(
        database,
        "SELECT number, parent, name, structural, script, fingerprint FROM steps "
        f"WHERE number > {after:d} ORDER BY number",
    )
    return [
        Step(
            name, bool(structural), number, parent, script_from(script), fingerprint,
            partial(load, number), partial(tell, number),
        )
        for number, parent, name, structural, script, fingerprint in rows
    ]  # fmt: skip


def body_of(row: tuple[Any, ...], state: HullState, late: Counting | None = None) -> StepBody:
    """Give the body of a step from its row (``SELECT *``); its change runs over the tables `state`.

    `late` counts the inflections of its report.

    Raises
    ------
    ValueError, KeyError, TypeError
        The row is not as it was written.
    """
    # Column 7 is the digest itself.
    if step_digest((*row[:7], *row[8:])) != row[7]:
        raise ValueError("its digest is another one")
    trace = unpack_arrays(row[10])[0]
    reader, source, changed, seeds = (
        _nodes(trace, name) for name in ("reader", "source", "changed", "seeds")
    )
    moved = _array(trace, "moved", np.float64)
    if len(reader) != len(source) or len(changed) != len(moved):
        raise ValueError("its trace is of several lengths")
    return StepBody(
        Rerun(state, unpack_change(row[11])), Readers(reader, source), changed,
        moved.astype(np.float64), seeds, report_from(row[9], late),
    )  # fmt: skip


def _nodes(trace: Arrays, name: str) -> IntArray:
    """Give nodes; up to version 6 they lie there as eight bytes each."""
    return _long(_array(trace, name, np.int64 if trace[name].dtype == np.int64 else np.int32))


_NEWEST = 1 << 22
"""So many bytes of the newest steps are looked at when a file is opened."""


def newest_fault(database: sqlite3.Connection) -> str:
    """Say which of the newest steps is not as it was written; empty if all are."""
    left = _NEWEST
    for row in database.execute("SELECT * FROM steps ORDER BY number DESC"):
        if step_digest((*row[:7], *row[8:])) != row[7]:
            return f"step {row[0]} is not as it was written"
        left -= sum(len(each) for each in row if isinstance(each, bytes | str))
        if left < 0:
            break
    return ""


def write_labels(database: sqlite3.Connection, labels: Sequence[Label]) -> None:
    """Write names of states."""
    rows = [(each.name, each.step, int(each.branch), each.author, each.time) for each in labels]
    database.executemany("INSERT INTO labels VALUES (?, ?, ?, ?, ?)", rows)


def read_labels(database: sqlite3.Connection) -> list[Label]:
    """Read all names of states, in the order of the steps."""
    rows = read_rows(
        database, "SELECT name, step, branch, author, time FROM labels ORDER BY step, name"
    )
    return [
        Label(name, step, bool(branch), author, time) for name, step, branch, author, time in rows
    ]
