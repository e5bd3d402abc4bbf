"""Whether anything that is computed has changed by a bit since it was recorded.

    python -m tests.unchanged [--write | --machine] [--only SHIP] [--part N/M]

Of every hull that ships, and of the DTC where its data are, are computed: fingerprint, canonical
text, records of hydrostatics, form and stability, panels, surface, every form of file, and what
40 recorded acts lead to, refusals included. Acts and hashes are kept in
``tests/data/unchanged.json``; ``--write`` computes the hashes anew, and draws acts for a ship
that has none there. Every difference is printed, and ends in 1.

The last bits of products of matrices are those of the BLAS kernel that the processor gets, and
hydrostatics hold such bits, fingerprints and lines do not. What depends on them is kept by kind of
arithmetic: `--machine`, on a tree that is known to be as it was, keeps what differs as that of
this machine; on a machine of a kind that nothing was kept for, such facts are counted and told.

An act is told as ``made``, fingerprint after it, hash of what it gave; or as ``refused``,
fingerprint, class of the error and hash of its fields, of which words count only by their
numbers.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Any

if __name__ == "__main__":
    # Sums of BLAS depend on how many threads share them: it is told before numpy is loaded.
    os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import attrs
import numpy as np
import scipy.linalg

import assoc_hull as ah
from assoc_hull.errors import MissingExtraError
from assoc_hull.io.export.write import FORMS
from assoc_hull.io.mesh.closed_mesh import write_mesh
from assoc_hull.io.rhino.read import RhinoModel, read_rhino
from tests.cases.dtc import read_dtc
from tests.twins import packed, twin
from tests.unchanged_acts import Act, draw

__all__ = ["FILE", "REPOSITORY", "SHIPS", "hash_of", "main"]

REPOSITORY = Path(__file__).resolve().parents[1]
FILE = REPOSITORY / "tests" / "data" / "unchanged.json"

Facts = dict[str, str]
"""By name of the fact: its hash, or what an act led to."""

Known = Mapping[str, str | Mapping[str, str]]
"""Facts as they are kept: one for all machines, or by the kind of their arithmetic."""


def _data() -> Path:
    """The folder of published hulls."""
    named = os.environ.get("ASSOC_HULL_DATA")
    return Path(named) if named else REPOSITORY.parent / "shared" / "data"


SHIPS: Mapping[str, Callable[[], ah.Hull]] = {
    "wigley": ah.examples.wigley,
    "series60_60": partial(ah.examples.series60, 0.60),
    "series60_70": partial(ah.examples.series60, 0.70),
    "bulk_carrier_207k": ah.examples.bulk_carrier_207k,
    "bulk_carrier_180m": ah.examples.bulk_carrier_180m,
    "container_ship_225m": ah.examples.container_ship_225m,
    "plain_ship": ah.examples.plain_ship,
    "seaking_ship": ah.examples.seaking_ship,
    "sfolds_ship": ah.examples.sfolds_ship,
    "prelikon_ship": ah.examples.prelikon_ship,
    "dtc": lambda: read_dtc(_data()),
}
"""How each hull is made."""


# What is hashed.

_OF_THE_MOMENT = frozenset({"seconds", "time", "author", "fairness"})
"""Fields of reports that tell when, by whom and how long; splines that only count inflections."""

_WORDS = frozenset({"what", "why", "findings"})
_ADVICE = frozenset({"remedy", "where"})
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def _fields(value: object) -> list[str]:
    """Name the fields of an object; none if it is not made of fields."""
    kind: Any = type(value)
    return [each.name for each in attrs.fields(kind)] if attrs.has(kind) else []


def _plain(value: object) -> Iterator[str]:
    """Give a value as text that tells every bit of it; of objects, all fields by name."""
    match value:
        case Enum():
            yield value.name
        case None | bool() | int() | str():
            yield repr(value)
        case float():
            yield float(value).hex()
        case np.generic():
            yield from _plain(value.item())
        case np.ndarray():
            yield f"{value.dtype.str} {value.shape} {np.ascontiguousarray(value).tobytes().hex()}"
        case bytes():
            yield value.hex()
        case Mapping():
            for key, each in value.items():
                yield from ("key", repr(key), *_plain(each))
        case AbstractSet():
            yield from sorted(repr(each) for each in value)
        case list() | tuple():
            yield f"{len(value)} of"
            for each in value:
                yield from _plain(each)
        case _ if attrs.has(type(value)):
            for name in _fields(value):
                if name not in _OF_THE_MOMENT:
                    yield from (name, *_plain(getattr(value, name)))
        case _:
            raise TypeError(f"nothing tells the bits of {type(value)}")


def hash_of(*values: object) -> str:
    """SHA-256 of values, or of the bytes of one file."""
    if len(values) == 1 and isinstance(values[0], bytes):
        return hashlib.sha256(values[0]).hexdigest()
    return hashlib.sha256("\n".join(_plain(values)).encode()).hexdigest()


def _refusal(error: ah.AssocHullError) -> str:
    """Give class and fields of an error; texts may be said better, their numbers stay."""
    found: dict[str, object] = {}
    for name in _fields(error):
        value = getattr(error, name)
        if name in _WORDS:
            found[name] = _NUMBER.findall(str(value))
        elif name == "known":
            found[name] = frozenset(value)  # names in the order of their hashes
        elif name not in _ADVICE:
            found[name] = value
    return f"{type(error).__name__} {hash_of(found)[:32]}"


# The facts of a hull as it is made.

_LEFT_OUT = "left out"
"""So begins what takes the place of a file for which a library is missing."""


def _written(write: Callable[[Path], object], ending: str) -> bytes:
    """What a writer puts into a file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"ship{ending}"
        write(path)
        return path.read_bytes()


def _outcome(make: Callable[[], object]) -> str:
    """Give the hash of what comes out; of what is refused, the error."""
    try:
        return hash_of(make())
    except MissingExtraError as error:
        return f"{_LEFT_OUT}: {error}"
    except ah.AssocHullError as error:
        return f"refused {_refusal(error)}"


def _records(hull: ah.Hull) -> Facts:
    """Fingerprint, text, hydrostatics, form parameters, panels."""
    ship, heel = hull.particulars, 7.5
    trimmed = (0.85 * ship.draught, 0.7 * ship.draught)
    facts = {
        "fingerprint": hull.fingerprint,
        "adoption": _outcome(lambda: str(hull.adoption)),
        "hydrostatics": _outcome(lambda: hull.hydrostatics()),
        "hydrostatics, heeled and trimmed": _outcome(
            lambda: hull.hydrostatics(draughts=trimmed, heel_deg=heel, on_error="report")
        ),
        "form parameters": _outcome(lambda: hull.form_parameters()),
        "measures": _outcome(lambda: dict(hull.measure())),
        "panels": _outcome(lambda: hull.panels(on_error="report")),
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ship.hull.json"
        hull.save(path)
        facts["canonical text"] = hash_of(path.read_bytes())
        facts["fingerprint of the text opened"] = ah.open(path).fingerprint
    return facts


def _stability(hull: ah.Hull) -> Facts:
    """All of the record but its curve, which holds the hull: of that, the heels it is made of."""
    kg = 0.75 * hull.particulars.draught
    try:
        found = hull.stability(kg=kg, on_error="report")
    except ah.AssocHullError as error:
        return {"stability": f"refused {_refusal(error)}"}
    record = [getattr(found, name) for name in _fields(found) if name != "curve"]
    return {
        "stability": hash_of(record),
        "levers": hash_of(found.columns),
        "curve of levers": hash_of(found.curve.heels),
    }


def _exports(hull: ah.Hull) -> Facts:
    """Every form of lines and offsets."""
    facts = dict[str, str]()
    for form in FORMS:
        write = partial(hull.export, form=form)
        give = _rhino_model if form == "3dm" else _written
        facts[f"file {form}"] = _outcome(partial(give, write, ".out"))
    return facts


def _rhino_model(write: Callable[[Path], object], ending: str) -> RhinoModel:
    """What a file of Rhino says of the lines; its bytes hold the time at which it was written."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"ship{ending}"
        write(path)
        return read_rhino(path)


def _surfaces(hull: ah.Hull) -> Facts:
    """The fitted surface and its files, the closed mesh and its file."""
    facts = dict[str, str]()
    try:
        mesh = hull.mesh()
        facts["closed mesh"] = hash_of(mesh)
        facts["file stl"] = hash_of(_written(partial(write_mesh, mesh), ".stl"))
    except ah.AssocHullError as error:
        facts["closed mesh"] = f"refused {_refusal(error)}"
    try:
        found = hull.surface()
    except ah.AssocHullError as error:
        return facts | {"surface": f"refused {_refusal(error)}"}
    facts["surface"] = hash_of(found.document())
    for ending in (".igs", ".step"):
        write = partial(found.write, accept=True)
        facts[f"file {ending[1:]}"] = _outcome(partial(_written, write, ending))
    return facts


# Acts.


def _carry_out(hull: ah.Hull, act: Act, new: Callable[[], ah.Hull]) -> object:
    """Carry out one act and give what it gives."""
    asked = {key: value for key, value in act.items() if key != "act"}
    match act["act"]:
        case "edit":
            with hull.edit(act["name"]) as edit:
                for each in act["edits"]:
                    given = {key: value for key, value in each.items() if key != "op"}
                    getattr(edit, each["op"])(**given)
            return edit.report
        case "apply":
            return hull.apply(act["name"], act["edits"])
        case "preview":
            found = hull.preview(act["edits"])
            words = [_NUMBER.findall(each) for each in found.refused]
            return (found.report, found.fingerprint, found.volume_change, found.lcb_change,
                    found.lines, words)  # fmt: skip
        case "undo":
            hull.undo(act["n"])
        case "redo":
            hull.redo(act["n"])
        case "checkpoint":
            hull.checkpoint(act["name"])
        case "go":
            hull.go(act["name"])
        case "vary":
            variant = hull.vary(**asked)
            return variant.hull.fingerprint, variant.report
        case "shift":
            shifted = hull.shift_sections(**asked)
            return shifted.hull.fingerprint, shifted.report
        case "replay":
            other = new()
            made = other.replay(hull, skip=True)
            return other.fingerprint, [(each.name, each.report) for each in made]
        case _:
            raise AssertionError(f"nobody knows the act {act['act']}")
    return None


def _round(new: Callable[[], ah.Hull], acts: Sequence[Act]) -> Facts:
    """Carry out acts, one after the other, on a hull as it is made."""
    hull, facts = new(), dict[str, str]()
    for number, act in enumerate(acts, start=1):
        title = f"{number} {act['act']} {act.get('name', '')}".strip()
        before = hull.fingerprint
        try:
            given = hash_of(_carry_out(hull, act, new))[:32]
        except ah.AssocHullError as error:
            assert hull.fingerprint == before, f"{title} was refused, and the hull has changed"
            facts[title] = f"refused {before} {_refusal(error)}"
        else:
            facts[title] = f"made {hull.fingerprint} {given}"
    told = [(str(each), each.inflections) for each in hull.history]
    return facts | {"history": hash_of(told)}


# All ships, or some.

_BLOCKS = {"records": _records, "stability": _stability, "exports": _exports, "surface": _surfaces}
_ROUNDS = 8


def _chosen(part: str) -> list[str]:
    """Name the blocks of facts of the N-th of M parts."""
    number, _, of = part.partition("/")
    blocks = [*_BLOCKS, *(f"round {each}" for each in range(1, _ROUNDS + 1))]
    return blocks[int(number) - 1 :: int(of)]


def _compute(
    make: Callable[[], ah.Hull], acts: Sequence[Sequence[Act]], blocks: Sequence[str]
) -> dict[str, Facts]:
    """Compute blocks of facts of a ship, each on a hull of its own."""
    pack = packed(make())
    found = dict[str, Facts]()
    for block in blocks:
        new = partial(twin, pack)
        if block in _BLOCKS:
            found[block] = _BLOCKS[block](new())
        else:
            found[block] = _round(new, acts[int(block.removeprefix("round ")) - 1])
    return found


def _arithmetic() -> str:
    """Tell the kind of this machine's arithmetic: products, solutions and angles in their bits."""
    draw = np.random.default_rng(1)
    bits = list[object]()
    for n in (3, 8, 33, 200):
        a, b = draw.normal(size=(n, n)), draw.normal(size=n)
        bits += [a @ a, a @ b, b @ b, np.linalg.solve(a, b), scipy.linalg.lstsq(a, b)[0]]
        bits += [np.sin(b), np.exp(b), np.arctan2(b, a[0])]
    return hash_of(*bits)[:12]


_NEW = "nothing"
_NOT_KEPT = "of another arithmetic"


def _as_kept(was: Known, name: str, kind: str) -> str:
    """What a fact was on machines of a kind."""
    fact = was.get(name, _NEW)
    return fact if isinstance(fact, str) else fact.get(kind, _NOT_KEPT)


def _differences(known: Mapping[str, Known], found: Mapping[str, Facts], kind: str) -> list[str]:
    """Tell every fact that is not as it was, is gone or is new."""
    told = list[str]()
    for block, facts in found.items():
        was = known.get(block, {})
        for name in sorted({*was, *facts}):
            old, new = _as_kept(was, name, kind), facts.get(name, _NEW)
            if old not in (new, _NOT_KEPT) and not new.startswith(_LEFT_OUT):
                told.append(f"{block}, {name}:\n    was {old}\n    is  {new}")
    return told


def _kept(was: Known, facts: Facts, kind: str, *, machine: bool) -> Known:
    """Facts to keep: what differs is this machine's alone if ``machine``, else that of all.

    A fact that is kept by kind and has changed is forgotten for the other kinds: they are to be
    asked again.
    """
    made = dict[str, str | Mapping[str, str]]()
    for name, new in facts.items():
        old = was.get(name, _NEW)
        if _as_kept(was, name, kind) == new:
            made[name] = old
        elif machine:
            made[name] = {**(old if isinstance(old, Mapping) else {}), kind: new}
        else:
            made[name] = new if isinstance(old, str) else {kind: new}
    return made


def _keep(kept: dict[str, Any], name: str, found: dict[str, Facts], *, machine: bool) -> None:
    """Write the facts of a ship into the file."""
    missing = _left_out(found)
    assert not missing, f"what is kept must be whole: {missing}"
    facts = kept[name]["facts"]
    for block, each in found.items():
        facts[block] = _kept(facts.get(block, {}), each, _arithmetic(), machine=machine)
    text = json.dumps(kept, indent=1, ensure_ascii=False)
    FILE.write_text(text + "\n", encoding="utf-8")


def _left_out(found: Mapping[str, Facts]) -> list[str]:
    """Facts that cannot be computed here."""
    every = [pair for block in found.values() for pair in block.items()]
    return [f"{fact} is {value}" for fact, value in every if value.startswith(_LEFT_OUT)]


def _of_other_machines(known: Mapping[str, Known], found: Mapping[str, Facts], kind: str) -> int:
    """Count the facts that were never kept for this arithmetic."""
    pairs = [(known.get(block, {}), name) for block, each in found.items() for name in each]
    return sum(_as_kept(was, name, kind) == _NOT_KEPT for was, name in pairs)


def _arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.unchanged", description=__doc__)
    parser.add_argument("--write", action="store_true", help="keep what is computed")
    parser.add_argument("--machine", action="store_true", help="keep what differs, as of here")
    parser.add_argument("--only", action="append", choices=list(SHIPS), help="ships; all if none")
    parser.add_argument("--part", default="1/1", metavar="N/M", help="every M-th block, from N")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str] | None = None) -> int:
    """Compute and compare, or write; gives what the process is to end with."""
    asked, kind = _arguments(arguments), _arithmetic()
    blocks, different, facts, ships, unknown = _chosen(asked.part), 0, 0, 0, 0
    kept = json.loads(FILE.read_text(encoding="utf-8")) if FILE.exists() else {}
    for name in asked.only or SHIPS:
        if name == "dtc" and not (_data() / "dtc").is_dir():
            print(f"dtc is left out: no published hulls in {_data()}")
            continue
        start, make = time.process_time(), SHIPS[name]
        ship = kept.setdefault(name, {})
        if "acts" not in ship:
            assert asked.write, f"no acts of {name} in {FILE.name}: run it with --write"
            ship |= {"acts": draw(make(), name), "facts": {}}
        found = _compute(make, ship["acts"], blocks)
        if asked.write or asked.machine:
            _keep(kept, name, found, machine=asked.machine)
        told = [*_left_out(found), *_differences(ship["facts"], found, kind)]
        for line in told:
            print(f"{name}: {line}")
        left = len(_left_out(found))
        count, changed = sum(map(len, found.values())) - left, len(told) - left
        unknown += _of_other_machines(ship["facts"], found, kind)
        different, facts, ships = different + changed, facts + count, ships + 1
        print(f"{name}: {count} facts, {time.process_time() - start:.1f} s", flush=True)
    if unknown:
        print(f"{unknown} facts are kept for other kinds of arithmetic than {kind} only")
    if different:
        print(f"{different} facts of {facts} in {ships} ships differ")
        return 1
    print(f"{facts} facts of {ships} ships are {'written' if asked.write else 'the same'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
