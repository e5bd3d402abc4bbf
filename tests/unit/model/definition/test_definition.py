"""The definition of a hull, its published values, its fingerprint, and the way back."""

from __future__ import annotations

import copy
import hashlib
import json
from typing import Any
from unittest import mock

import attrs
import numpy as np
import pytest

from assoc_hull.edit.crossings.adopted_points import link_adopted_points
from assoc_hull.edit.document import Document
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, CoincidentPointsError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.run_update import Evaluation, FailurePolicy
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.records import definition, published
from assoc_hull.model.definition.restore import from_definition, verify
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.tables import HullState
from tests.strategies import Move, Net, PinnedEdit, apply_edit, make_document, wigley_sources

Record = dict[str, Any]


def one_way() -> Net:
    """A net of three families in which sections drive waterlines, and these buttocks."""
    net = wigley_sources(5, 3, 2)
    links = tuple(attrs.evolve(link, two_way=link.a == "boundary") for link in net.associations)
    return attrs.evolve(net, associations=links)


@pytest.fixture(params=["two-way", "one-way"])
def document(request: pytest.FixtureRequest) -> Document:
    """A small net after a few edits, its adopted points linked to their neighbours."""
    found = make_document(wigley_sources(5, 3, 2) if request.param == "two-way" else one_way())
    link_adopted_points(found.state, found.state.live("curves"), Journal())
    found.refresh()
    for which in (3, 11, 25):
        assert apply_edit(found, PinnedEdit((Move(which, 0.01),), False))
    return found


def records(state: HullState) -> Record:
    """The definition, read back from JSON."""
    found: Record = json.loads(json.dumps(definition(state), allow_nan=False))
    return found


def test_everything_is_plain_and_sorted(document: Document) -> None:
    """A definition holds JSON values only, sorted by key, and knows no row number."""
    found = definition(document.state)
    assert json.loads(json.dumps(found, allow_nan=False)) == found
    for name in ("lines", "curves", "points"):
        keys = [record["key"] for record in found[name]]  # type: ignore[attr-defined]
        assert keys == sorted(keys)
    values = published(document.state)
    assert json.loads(json.dumps(values, allow_nan=False)) == values


def test_only_values_that_nothing_else_gives_are_defined(document: Document) -> None:
    """A value stands at shared crossings and at points that do not ride, nowhere else."""
    for point in records(document.state)["points"]:
        own = point.get("role") == "shared" or point["sort"] == "placed"
        own |= point["sort"] == "adopted" and "riding" not in point
        assert ("value" in point) == own
        assert ("limit" in point) == (point.get("role") == "watched")


def test_published_values_come_back_as_they_are(document: Document) -> None:
    """With published values given, nothing is lofted or met, and every bit comes back."""
    state = document.state
    given, values = records(state), published(state)
    with mock.patch.object(HullNetwork, "evaluate", side_effect=AssertionError):
        back = from_definition(given, values)
    assert definition(back) == given
    assert published(back) == values
    assert fingerprint(back) == fingerprint(state)


def test_the_definition_alone_gives_all_the_rest(document: Document) -> None:
    """Without published values they are made again, with the same bits."""
    back = from_definition(records(document.state))
    assert published(back) == published(document.state)
    assert fingerprint(back) == fingerprint(document.state)
    assert verify(back) == []


def test_each_part_of_the_definition_shows_in_the_fingerprint(document: Document) -> None:
    """Changing any one number, name or code of a definition changes the fingerprint."""
    given, values = records(document.state), published(document.state)
    prints = {fingerprint(from_definition(given, values))}
    changes = [
        ("particulars", "draught", 6.0),
        ("particulars", "name", "Other"),
        ("tolerances", "adoption", 0.004),
        ("associations", 0, {**given["associations"][0], "two_way": False}),
        ("lines", 3, {**given["lines"][3], "name": "another"}),
        ("lines", 3, {**given["lines"][3], "note": "a note"}),
        ("births", 0, [*given["births"][0][:2], 9]),
        ("retired", "points", ["a point that was"]),
    ]
    first = next(i for i, point in enumerate(given["points"]) if point.get("role") == "shared")
    point = given["points"][first]
    for name, value in (
        ("value", [0.0, 0.0, 0.5]),
        ("override", "watched"),
        ("label", "mine"),
        ("kinds", ["knuckle", "smooth"]),
        ("directions", [[0.0, 0.0, 1.0]] * 2),
        ("sign", -point["sign"]),
    ):
        changes.append(("points", first, {**point, name: value}))
    for part, key, value in changes:
        changed = copy.deepcopy(given)
        changed[part][key] = value
        prints.add(fingerprint(from_definition(changed, values)))
    assert len(prints) == len(changes) + 1


def test_the_fingerprint_is_a_sha256_and_knows_the_sign_of_nil() -> None:
    """The bits count: 0.0 and -0.0 are two definitions; history and revisions are not."""
    document = make_document(wigley_sources(3, 2))
    before = fingerprint(document.state)
    assert len(before) == len(hashlib.sha256().hexdigest())
    assert apply_edit(document, PinnedEdit((Move(4, 0.01),), False))
    assert fingerprint(document.state) != before
    document.undo()
    assert document.state.revision_curve
    assert fingerprint(document.state) == before
    given, values = records(document.state), published(document.state)
    nil = next(point for point in given["points"] if point.get("value", [1.0])[0] == 0.0)
    nil["value"][0] = -0.0
    assert fingerprint(from_definition(given, values)) != before


def test_keys_that_were_taken_out_stay_known() -> None:
    """A dead key is no part of the points, but it never comes back, saved or not."""
    document = make_document(wigley_sources(3, 2))
    state, maker = document.state, Maker(document.state, Journal())
    curve = int(state.live("curves")[-1])
    spec = PointSpec(curve, (1.0, 2.0, 3.0), Sort.PLACED)
    maker.remove_rows(maker.points([spec]))
    back = from_definition(records(state), published(state))
    assert fingerprint(back) == fingerprint(state)
    where = back.curves.key.data.index(state.curves.key[curve])
    key = back.rows.key[Maker(back, Journal()).points([attrs.evolve(spec, curve=where)])[0]]
    assert key == state.rows.key[maker.points([spec])[0]]
    assert key.endswith("~2")


def test_a_point_that_rode_with_a_dead_one_keeps_its_value(document: Document) -> None:
    """A link to a point that was taken out is none: the value itself is the definition."""
    state = document.state
    dead = Maker(state, Journal()).points([PointSpec(0, (0.0, 0.0, 0.0), Sort.PLACED)])
    state.rows.alive.store[dead] = False
    alone = next(row for row in state.live("rows").tolist() if state.rows.sort[row] == Sort.ADOPTED)
    state.rows.anchor.put(np.array([alone]), np.array([(dead[0], -1)]))
    assert verify(state) == []
    assert fingerprint(from_definition(records(state))) == fingerprint(state)


def failing(name: str) -> Any:
    """Make the evaluation of one curve fail."""
    original = HullNetwork.evaluate

    def evaluate(network: HullNetwork, nodes: IntArray, journal: Journal) -> Evaluation:
        if any(network.name(node) == name for node in nodes.tolist()):
            raise CoincidentPointsError(name, (0.0, 0.0, 0.0), 0.0, 1e-6)
        return original(network, nodes, journal)

    return mock.patch.object(HullNetwork, "evaluate", evaluate)


def test_a_failed_curve_keeps_its_shape_and_blocks_its_readers() -> None:
    """What could not be made is kept in the definition: loading and rebuilding give it back."""
    document = make_document(one_way())
    state = document.state
    row = next(
        row
        for row in state.live("rows").tolist()
        if state.rows.sort[row] == Sort.ADOPTED
        and state.curves.key[state.rows.curve[row, 0]].startswith("sections:50")
    )
    value = state.rows.xyz[[row]] + np.array([0.0, 0.01, 0.0])
    with (
        failing("waterlines:3.125000/1"),
        Transaction(document, "go on", Settings(FailurePolicy.KEEP_GOING, False)) as edit,
    ):
        edit.write(np.array([row]), value, "go on")
    assert [state.curves.key[curve] for curve in state.failed] == ["waterlines:3.125000/1"]
    assert verify(state) == []
    back = from_definition(records(state), published(state))
    assert fingerprint(back) == fingerprint(from_definition(records(state))) == fingerprint(state)
    assert [back.curves.key[curve] for curve in back.failed] == ["waterlines:3.125000/1"]


def pick(records: list[Record], **wanted: str) -> Record:
    """The first record with these values."""
    return next(each for each in records if all(each.get(k) == v for k, v in wanted.items()))


def drop(record: Record, key: str) -> None:
    """Take a key out."""
    del record[key]


BAD_DEFINITIONS = {
    "missing key": lambda d: drop(d, "births"),
    "unknown key": lambda d: d.update(colour="red"),
    "text for a number": lambda d: d["particulars"].update(length="100"),
    "true for a number": lambda d: d["particulars"].update(length=True),
    "nan": lambda d: d["particulars"].update(length=float("nan")),
    "a number too large": lambda d: d["particulars"].update(length=10**400),
    "list for a record": lambda d: d.update(particulars=[]),
    "unknown family": lambda d: d["groups"][0].update(family="ribs"),
    "unknown role": lambda d: pick(d["points"], role="shared").update(role="leads"),
    "point of two coordinates": lambda d: pick(d["points"], role="shared").update(value=[1.0, 2.0]),
    "curve of one point": lambda d: d["curves"][0].update(points=d["curves"][0]["points"][:1]),
    "unknown point": lambda d: d["curves"][0]["points"].append("nobody"),
    "point twice on a curve": lambda d: d["curves"][0]["points"].append(
        d["curves"][0]["points"][0]
    ),
    "point of another curve": lambda d: d["curves"][0]["points"].append(
        d["curves"][-1]["points"][-1]
    ),
    "point lost from a curve": lambda d: d["curves"][0]["points"].pop(),
    "unknown line": lambda d: d["curves"][0].update(line="nobody"),
    "unknown group": lambda d: d["lines"][0].update(group="nobody"),
    "unknown group of an association": lambda d: d["associations"][0].update(a="nobody"),
    "association twice": lambda d: d["associations"].append(d["associations"][0]),
    "line twice": lambda d: d["lines"].append(d["lines"][0]),
    "live and retired": lambda d: d["retired"]["lines"].append(d["lines"][0]["key"]),
    "half a plane": lambda d: drop(d["lines"][0], "offset"),
    "two lines of one name": lambda d: d["lines"][-1].update(name=d["lines"][-2]["name"]),
    "pair of births twice": lambda d: d["births"].append(d["births"][0]),
    "fewer births than crossings": lambda d: d["births"].pop(),
    "crossing on one curve": lambda d: pick(d["points"], role="shared")["curves"].pop(),
    "crossing without role": lambda d: drop(pick(d["points"], role="shared"), "role"),
    "crossing without value": lambda d: drop(pick(d["points"], role="shared"), "value"),
    "value of a driven crossing": lambda d: pick(d["points"], role="drives b").update(
        value=[0.0, 0.0, 0.0]
    ),
    "limit out of place": lambda d: pick(d["points"], role="shared").update(limit=0.1),
    "role of an adopted point": lambda d: pick(d["points"], sort="adopted").update(role="shared"),
    "sign of an adopted point": lambda d: pick(d["points"], sort="adopted").update(sign=1),
    "a riding crossing": lambda d: pick(d["points"], role="shared").update(
        riding={"anchors": [None, None], "base": [0.0] * 3, "from": [[0.0] * 3] * 2, "weight": 0.0}
    ),
    "too few kinds": lambda d: pick(d["points"], role="shared").update(kinds=["smooth"]),
    "meeting with an unknown line": lambda d: d["curves"][-1]["meets"].update(nobody=[[1, None]]),
    "meeting with its own group": lambda d: d["curves"][-1]["meets"].update(
        {d["curves"][-1]["line"]: [[1, None]]}
    ),
    "meeting at a foreign crossing": lambda d: next(iter(d["curves"][-1]["meets"].values()))[
        0
    ].__setitem__(1, d["points"][0]["key"]),
    "sense of nil": lambda d: next(iter(d["curves"][-1]["meets"].values()))[0].__setitem__(0, 0),
    "driven crossing without a meeting": lambda d: pick(
        d["curves"], key="boundary:profile/1"
    ).update(meets={}),
    "meetings that are not there": lambda d: [
        met.append([1, None]) for met in d["curves"][-1]["meets"].values()
    ],
    "curve kept without its shape": lambda d: d["curves"][0].update(kept={"state": "failed"}),
}


@pytest.mark.parametrize("change", BAD_DEFINITIONS.values(), ids=BAD_DEFINITIONS.keys())
def test_a_bad_definition_is_refused(change: Any) -> None:
    """Each error of form or reference is refused, with place and remedy."""
    given = records(one_way().adopt())
    change(given)
    with pytest.raises(BadInputError) as caught:
        from_definition(given)
    assert caught.value.what
    assert caught.value.where
    assert caught.value.remedy


def first_curve(values: Record) -> Record:
    """The first published curve."""
    found: Record = next(iter(values["curves"].values()))
    return found


BAD_VALUES = {
    "curve missing": lambda p: p["curves"].popitem(),
    "unknown curve": lambda p: p["curves"].update(nobody=first_curve(p)),
    "point missing": lambda p: p["points"].popitem(),
    "unknown point": lambda p: p["points"].update(nobody={"value": [0.0, 0.0, 0.0]}),
    "knots that stand": lambda p: first_curve(p)["knot"].__setitem__(1, 0.0),
    "knots that begin late": lambda p: first_curve(p)["knot"].__setitem__(0, 1e-3),
    "too few knots": lambda p: first_curve(p)["knot"].pop(),
    "too few derivatives": lambda p: first_curve(p)["leave"].pop(),
    "infinite derivative": lambda p: first_curve(p)["leave"][0].__setitem__(0, float("inf")),
    "places missing": lambda p: first_curve(p)["meets"].popitem(),
    "one place too many": lambda p: next(iter(first_curve(p)["meets"].values())).append([0.0] * 4),
}


@pytest.mark.parametrize("change", BAD_VALUES.values(), ids=BAD_VALUES.keys())
def test_bad_published_values_are_refused(change: Any) -> None:
    """Values that do not fit the definition are refused, with place and remedy."""
    state = one_way().adopt()
    values = json.loads(json.dumps(published(state)))
    change(values)
    with pytest.raises(BadInputError) as caught:
        from_definition(records(state), values)
    assert caught.value.remedy


def test_a_fingerprint_is_quick() -> None:
    """A fingerprint of 40 curves takes a few milliseconds: it is taken after each edit."""
    import time

    state = wigley_sources(24, 14).adopt()
    best = 1.0
    for _ in range(5):
        begin = time.perf_counter()
        fingerprint(state)
        best = min(best, time.perf_counter() - begin)
    assert best < 0.03
