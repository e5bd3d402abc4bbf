"""What a variation refuses: an error of the family, in one line, and the hull as it was."""

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import attrs
import pytest

import assoc_hull as ah
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    FoldError,
    OutOfRangeError,
    RefusedSetError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation import plan_choice
from assoc_hull.variation.aiming.reach_targets import SettledPlan, settle_plan
from assoc_hull.variation.carrying.admissible_values import AdmissibleValues
from assoc_hull.variation.carrying.carry_stages import StagedCarry
from assoc_hull.variation.certificate.fold_check import certify
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.parameters.catalogue import NAMES
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.parameter_fields import (
    aft_shift_field,
    flat_of_bottom_layer,
    fore_shift_field,
)
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent import parent_of
from assoc_hull.variation.parameters.value_limits import hull_box, present_values
from assoc_hull.variation.request import TOLERANCE, read_script
from tests.conftest import Shipped
from tests.long_forms import long_form

Given = dict[str, Any]

SCREW = {"set": {"shaft_height": 6.0}}
HAT = {"name": "skeg", "along": 1.0, "anchors": [["base", 0, 0], ["skeg", 4, 0.5], ["T", 18, 0]]}


def asked(**values: object) -> Given:
    """Named parameters only."""
    return {"set": values}


def raw(**changes: object) -> Given:
    """A hat as data, with changes."""
    return {"layers": [[{"hat": {**HAT, **changes}}]]}


WORDS: dict[str, tuple[Given, type[AssocHullError], tuple[str, ...]]] = {
    "a name with a slip": (asked(shaft_hight=6.0), UnknownNameError, ("'shaft_height'", "nearest")),
    "a name of formulas": (asked(Lpp=300.0), UnknownNameError, ("it is called 'length'",)),
    "another of these": (asked(pmb_end=1.0), UnknownNameError, ("'parallel_body_end'",)),
    "a name that is none": ({"set": {3: 6.0}}, UnknownNameError, ("'3'",)),
    "nan": (asked(breadth=math.nan), BadInputError, ("breadth is nan",)),
    "infinite": (asked(breadth=math.inf), BadInputError, ("breadth is inf",)),
    "a word": (asked(breadth="fifty"), BadInputError, ("breadth is 'fifty'",)),
    "a truth value": (asked(breadth=True), BadInputError, ("breadth is True",)),
    "nothing": (asked(breadth=None), BadInputError, ("breadth is None",)),
    "a list": (asked(breadth=[51.0, 52.0]), BadInputError, ("breadth is [51.0, 52.0]",)),
    "negative": (asked(breadth=-50.0), BadInputError, ("breadth is -50 m", "above 0")),
    "nil": (asked(bilge_radius=0.0), BadInputError, ("bilge_radius is 0 m",)),
    "no values": ({"set": {}}, BadInputError, ("nothing is asked for",)),
    "nothing at all": ({}, BadInputError, ("nothing is asked for",)),
    "values without names": ({"set": [6.0]}, WrongTypeError, ("set is list",)),
    "a reach with a slip": (
        {**SCREW, "layout": {"sten": 0.3}}, UnknownNameError, ("'stern'", "reach of a field"),
    ),
    "a reach of nil": ({**SCREW, "layout": {"stern": 0.0}}, BadInputError, ("stern is 0",)),
    "a reach of nan": ({**SCREW, "layout": {"stern": math.nan}}, BadInputError, ("stern is nan",)),
    "an unknown blend": ({**SCREW, "layout": {"blend": "septic"}}, BadInputError, ("quintic",)),
    "a layout that is none": ({**SCREW, "layout": "wide"}, WrongTypeError, ("layout is 'wide'",)),
    "a layout made amiss": ({**SCREW, "layout": Layout(stern=-1.0)}, BadInputError, ("stern is",)),
    "a reach that ends before it begins": (
        {**SCREW, "layout": {"draught_top": 0.5}}, BadInputError, ("number above 1",),
    ),
    "unknown stations": ({**SCREW, "stations": "y"}, BadInputError, ("use number or x",)),
    "no tolerance": ({**SCREW, "tolerance": 0.0}, BadInputError, ("tolerance is 0",)),
    "a fairing in words": ({**SCREW, "fair": "yes"}, BadInputError, ("fair is 'yes'",)),
    "no fairing": ({**SCREW, "fair": None}, BadInputError, ("fair is None",)),
    "a fairing of nil": ({**SCREW, "fair": 0.0}, BadInputError, ("fair is 0",)),
    "a fairing of nan": ({**SCREW, "fair": math.nan}, BadInputError, ("fair is nan",)),
    "an empty name": ({**SCREW, "name": " "}, BadInputError, ("the name is ' '",)),
    "a driver in words": ({**SCREW, "drivers": "sections"}, WrongTypeError, ("drivers is str",)),
    "layers in words": ({"layers": "skeg"}, WrongTypeError, ("layers is str",)),
    "a layer that is none": ({"layers": [3]}, WrongTypeError, ("fields is int",)),
    "the class of a layer": ({"layers": [FieldLayer]}, WrongTypeError, ("fields is type",)),
    "an unknown anchor": (raw(outward=["skig"]), UnknownNameError, ("'skeg'",)),
    "a contour of one node": (
        raw(along={"x": [6], "v": [1], "smooth": True}), BadInputError, ("smooth through one",),
    ),
    "a contour or not": (
        raw(along={"x": [6, 66], "v": [1, 0], "smooth": "no"}), WrongTypeError, ("smooth is 'no'",),
    ),
    "both a contour and straight": (
        raw(along={"x": [6, 66], "v": [1, 0], "smooth": True, "straight": True}), BadInputError,
        ("both smooth and straight",),
    ),
    "a bump of no length": (
        raw(along={"begin": 6, "end": 6, "shape": "c2"}), BadInputError, ("from 6 to 6 m",),
    ),
    "a bump of an unknown shape": (
        raw(along={"begin": 6, "end": 66, "shape": "c3"}), BadInputError, ("shape is 'c3'",),
    ),
    "a bump without an end": (
        raw(along={"begin": 6, "shape": "c2"}), BadInputError, ("has no 'end'",),
    ),
    "an unknown kind of field": (
        {"layers": [[{"hut": HAT}]]}, UnknownNameError, ("'hat'", "part of a field"),
    ),
    "an unknown part of a field": (raw(high=3.0), UnknownNameError, ("part of hat", "'high'")),
    "a field without a part": (
        {"layers": [[{"hat": {"name": "a", "along": 1.0}}]]}, BadInputError, ("no 'anchors'",),
    ),
    "a chain with nan": (raw(along={"x": [6, 66], "v": [1, math.nan]}), BadInputError, ("nan",)),
    "nodes that fall": (raw(along={"x": [66, 6], "v": [1, 0]}), BadInputError, ("must rise",)),
    "anchors that fall": (
        raw(anchors=[["T", 18, 0], ["base", 0, 0]]), BadInputError, ("touch", "'base'"),
    ),
    "two kinds in one field": (
        {"layers": [[{"hat": HAT, "stack": {}}]]}, BadInputError, ("has the keys",),
    ),
}  # fmt: skip
"""Requests that are refused whatever the hull, with what the message says."""


@pytest.fixture(scope="module")
def wigley(shipped: Callable[[str], ah.Hull]) -> ah.Hull:
    """A hull that has neither bulb nor bossing, transom, bilge or parallel body."""
    return shipped("wigley")


def refused(hull: ah.Hull, given: Given) -> AssocHullError:
    """Vary in place; give the error, which is one line and leaves the hull as it was."""
    before, steps = hull.fingerprint, hull.history
    with pytest.raises(AssocHullError) as found:
        hull.vary(**given, in_place=True)
    assert "\n" not in str(found.value)
    assert len(str(found.value)) < 400
    assert (hull.fingerprint, hull.history) == (before, steps)
    return found.value


def told_interval(error: AssocHullError) -> tuple[float, float] | None:
    """The interval that an error tells."""
    if isinstance(error, FoldError):
        return error.interval
    return (error.least, error.most) if isinstance(error, OutOfRangeError) else None


@pytest.mark.parametrize("case", WORDS)
def test_a_request_that_has_no_meaning(wigley: ah.Hull, case: str) -> None:
    """The error tells the part at fault."""
    given, kind, words = WORDS[case]
    error = refused(wigley, given)
    assert isinstance(error, kind)
    assert [word for word in words if word not in str(error)] == []


@pytest.fixture(scope="module")
def room(bulk_carrier: ah.Hull) -> AdmissibleValues:
    """What the carrier's parameters may be asked for."""
    state, usual = bulk_carrier.state, Layout()
    measures = measure_all(state)
    now, box = present_values(measures, usual), hull_box(state, TOLERANCE)
    return AdmissibleValues(state, parent_of(state, measures), now, usual, box)


FOLDS = {
    "a shaft above the deck": ("shaft_height", 30.0, "heights come out -"),
    "a bossing too large": ("bossing_radius", 5.0, "between 'boss"),
    "a deck below the waterline": ("depth", 17.0, "'T' (18.000)"),
    "a draught above the deck": ("draught", 60.0, "heights come out -"),
    "a hull of no length": ("length", 10.0, "along the ship come out"),
    "a bilge too large": ("bilge_radius", 6.0, "at x="),
    "a parallel body of a tenth": ("parallel_body_start", 198.0, "along the ship come out"),
    "a stem that leans back": ("stem_rake_deg", -79.0, " deg"),
    "stations that cross": ("fore_shift", 80.0, "along the ship come out"),
}
"""Values that fold the carrier, and what else the message says."""


SLOW = ("a bilge too large", "a stem that leans back")
"""Both are tried in up to eight parts before they are refused."""


@pytest.mark.parametrize(
    "case", [pytest.param(case, marks=long_form if case in SLOW else ()) for case in FOLDS]
)
def test_a_value_that_folds_is_told_with_its_interval(
    bulk_carrier: ah.Hull, room: AdmissibleValues, case: str
) -> None:
    """What folds, where, and between which values one may ask."""
    name, value, says = FOLDS[case]
    error = refused(bulk_carrier, asked(**{name: value}))
    assert isinstance(error, FoldError)
    assert error.reason == "folds" or name == "length"
    assert f"'{name}' " in str(error)
    assert f"; admissible {name} from " in str(error)
    assert says in str(error)
    assert told_interval(error) == room.interval(name)


OUTSIDE = {
    "a bulb of 30 m": ("bulb_length", 30.0, "stretches the bow"),
    "a transom broader than the ship": ("transom_half_breadth", 26.0, "broader than the ship"),
    "a bilge larger than the side": ("bilge_radius", 30.0, "cannot be had"),
    "a flat bottom beyond the side": ("flat_of_bottom", 25.5, "leaves no bilge"),
    "a stem that lies down": ("stem_rake_deg", 85.0, "too steep"),
    "a bottom that falls": ("deadrise_deg", -20.0, "turns the bottom too far"),
    "a parallel body of no length": ("parallel_body_start", 204.0, "less than 2 % of Lpp"),
    "a parallel body that ends before it begins": ("parallel_body_end", 110.0, "less than 2 %"),
    "a parallel body of 5 m": ("parallel_body_length", 5.0, "less than 2 % of Lpp"),
}
"""Values from which no ship comes, and what the message says."""


@pytest.mark.parametrize("case", OUTSIDE)
def test_a_value_that_makes_no_ship_is_told_with_its_interval(
    bulk_carrier: ah.Hull, room: AdmissibleValues, case: str
) -> None:
    """The map would be one to one; the interval is the same as that of folds."""
    name, value, says = OUTSIDE[case]
    error = refused(bulk_carrier, asked(**{name: value}))
    assert isinstance(error, OutOfRangeError)
    assert str(error).startswith(f"{name} of {value:g} ")
    assert says in str(error)
    assert told_interval(error) == room.interval(name)


def test_values_that_fold_together_are_told_how_much_of_them_does_not(
    bulk_carrier: ah.Hull, room: AdmissibleValues
) -> None:
    """Each is within its interval; so much of both as is told goes by one map."""
    given = {"draught": 30.0, "depth": 22.5}
    error = refused(bulk_carrier, asked(**given))
    assert isinstance(error, RefusedSetError)
    told = re.search(r"not beside the others asked for: admissible ([0-9.]+) % of each", str(error))
    assert told is not None
    for factor, fits in ((0.99, True), (1.01, False)):
        part = factor * float(told[1]) / 100.0
        values = {
            name: room.present[name] + part * (value - room.present[name])
            for name, value in given.items()
        }
        assert certify(room.map(values), room.box).certified == fits


CLASHES = [
    ("bilge_radius", "flat_of_bottom"), ("bilge_radius", "deadrise_deg"),
    ("flat_of_bottom", "deadrise_deg"), ("depth", "deck_height"),
]  # fmt: skip


@pytest.mark.parametrize(("one", "other"), CLASHES)
def test_parameters_that_contradict_each_other_are_both_named(
    bulk_carrier: ah.Hull, one: str, other: str
) -> None:
    """With the reason, even where one of them has its value already."""
    now = {"bilge_radius": 2.4, "flat_of_bottom": 22.0, "deadrise_deg": 1.0, "depth": 28.0,
           "deck_height": 27.5}  # fmt: skip
    error = refused(bulk_carrier, asked(**{one: now[one], other: now[other]}))
    assert f"'{one}' and '{other}' cannot be asked for together" in str(error)
    assert "drop one of them" in str(error)


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("bulb_length", "no profile forward of FP"),
        ("shaft_height", "no bossing end"),
        ("bossing_radius", "parent has no bossing circle"),
        ("transom_height", "parent has no transom"),
        ("bilge_radius", "parent has no bilge"),
        ("parallel_body_end", "parent has no parallel middle body"),
        ("deadrise_deg", "parent has no parallel middle body"),
    ],
)
def test_what_a_parent_has_not_cannot_be_varied(wigley: ah.Hull, name: str, why: str) -> None:
    """The parameter and the reason; what cannot be had names what it needs."""
    error = refused(wigley, asked(**{name: 3.0}))
    assert f"cannot vary '{name}': " in str(error)
    assert why in str(error)


@pytest.mark.parametrize("given", [3, None, "ship.hull"])
def test_what_is_no_hull_is_not_varied(given: Any) -> None:
    """Neither by a call nor by a script."""
    for act in (ah.Hull.vary, ah.Hull.vary_by):
        with pytest.raises(WrongTypeError, match=r"the hull is .*, in vary; give a Hull"):
            act(given, **({"set": {"breadth": 11}} if act is ah.Hull.vary else {"script": SCREW}))


def test_a_hull_that_is_being_edited_is_not_varied(wigley: ah.Hull) -> None:
    """Neither it nor a copy of it: what would be varied is not there yet."""
    with wigley.edit("open"), pytest.raises(AssocHullError, match="vary"):
        wigley.vary(set={"breadth": 11.0})
    assert wigley.history == ()


def certify_alone(room: AdmissibleValues, name: str, value: float) -> bool:
    """Check a value, lay it out, certify the map."""
    asked_for = {name: value}
    room.check(asked_for)
    return room.certified(room.map(asked_for), asked_for).certified


@pytest.mark.parametrize("name", NAMES)
def test_intervals_are_true(room: AdmissibleValues, name: str) -> None:
    """Within, the map is certified; beyond, the value is refused, and the error says how far."""
    now, ends = room.present[name], room.interval(name)
    assert ends[0] < now < ends[1]
    for end in ends:
        if math.isinf(end):
            assert certify_alone(room, name, 3.0 * now)
            continue
        assert certify_alone(room, name, end - 1e-4 * (end - now))
        beyond = end + 1e-4 * (end - now)
        if beyond > 0.0 or end < 0.0:
            with pytest.raises((FoldError, OutOfRangeError)) as found:
                certify_alone(room, name, beyond)
            assert told_interval(found.value) == ends


def test_a_target_that_set_values_fix_is_refused_by_all_their_names() -> None:
    """Nothing free could move it; of one that is not set the request goes on."""
    hull = ah.examples.wigley()
    with pytest.raises(BadInputError, match="'B/T' is to be reached, but 'breadth' and 'draught'"):
        hull.vary(set={"breadth": 10.2, "draught": 6.2}, reach={"B/T": 1.7}, free=["fore_shift"])
    found = hull.vary(set={"breadth": 10.2}, reach={"B/T": 1.7}, free=["draught"])
    assert found.hull.particulars.draught == pytest.approx(6.0, abs=1e-8)


def test_targets_that_no_plan_reaches_are_refused_with_what_the_values_give(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It is told that the values by themselves can be had, and at which targets they arrive."""

    def without_targets(
        carry: StagedCarry, room: AdmissibleValues, before: FloatArray | None
    ) -> SettledPlan:
        if carry.ask.reach is not None:
            raise BadInputError("a line folds", "in vary", "ask for less")
        return settle_plan(carry, room, before)

    monkeypatch.setattr(plan_choice, "settle_plan", without_targets)
    hull = ah.examples.wigley()
    was = hull.fingerprint
    with pytest.raises(BadInputError, match="breadth can be had, but not while volume") as caught:
        hull.vary(set={"breadth": 10.2}, reach={"volume": 2800.0}, free=["fore_shift"])
    given = float(re.findall(r"volume ([0-9.]+)\)", str(caught.value))[0])
    alone = hull.vary(set={"breadth": 10.2}).hull.hydrostatics(estimate=False).volume
    assert given == pytest.approx(alone, rel=1e-5)
    assert hull.fingerprint == was


def test_a_plane_that_comes_to_touch_the_hull_is_told_by_its_line(shipped: Shipped) -> None:
    """Where a buttock closes to a point, two of its crossings are one; a little more goes."""
    hull = shipped("container_ship_225m")
    says = r"two points of BTK 2 come to lie in one place, \(225.000, 2.000, 4.707\) m"
    with pytest.raises(BadInputError, match=says):
        hull.vary(set={"bulb_half_breadth": 2.0})
    assert hull.vary(set={"bulb_half_breadth": 2.05}).report.edit.changed


class Rising:
    """A parent whose bottom rises from x = 20 m aft and from 40 m forward."""

    def __init__(self, inner: str) -> None:
        self.inner = inner

    def has(self, place: str) -> bool:
        """Whether there is such a place."""
        return place.startswith(self.inner)

    def at(self, place: str, _name: str) -> tuple[float]:
        """Where it is, m."""
        return (20.0 if "aft" in place or "start" in place else 40.0,)


@pytest.mark.parametrize(
    ("field", "inner", "remedy"),
    [
        (aft_shift_field, "body", "parallel_body_start"),
        (fore_shift_field, "body", "parallel_body_end"),
        (aft_shift_field, "largest", "fore_shift"),
        (fore_shift_field, "largest", "aft_shift"),
    ],
    ids=["body aft", "body fore", "largest aft", "largest fore"],
)
def test_a_shift_without_a_run_names_what_this_parent_can_vary(
    field: Callable[..., object], inner: str, remedy: str
) -> None:
    """The end of a parallel body where there is one, else the shift of the other end."""
    with pytest.raises(BadInputError, match=r"shift: the bottom rises .* at x = [24]0 m") as caught:
        field(cast(Any, Rising(inner)), 1.0, Layout())
    assert caught.value.remedy == f"vary {remedy}"


def test_a_flat_of_bottom_without_a_parallel_body_is_refused_for_that(shipped: Shipped) -> None:
    """And not for its size: no other size could be had."""
    hull = shipped("container_ship_225m")
    parent = parent_of(hull.state)
    lacking = attrs.evolve(parent, places={
        key: place for key, place in parent.places.items() if not key.startswith("body")
    })  # fmt: skip
    for asked in (0.01, 99.0):
        with pytest.raises(BadInputError, match="no parallel middle body"):
            flat_of_bottom_layer(lacking, asked, Layout())


def test_a_script_may_begin_with_a_byte_order_mark(tmp_path: Path) -> None:
    """Editors of Windows put one before the text."""
    path = tmp_path / "wider.json"
    path.write_text('{"set": {"breadth": 33.0}}', encoding="utf-8-sig")
    assert read_script(path) == {"name": "wider", "set": {"breadth": 33.0}}


def test_a_plane_that_comes_to_touch_the_flat_of_bottom_is_told_by_its_line(
    shipped: Shipped,
) -> None:
    """A buttock through the widest place of the border meets it once, not twice: told by name."""
    hull = shipped("series60_70")
    state = hull.document.state
    widest = float(state.lines.offset[state.lines.name.data.index("BTK 0.76")])
    with pytest.raises(BadInputError, match=r"two points of BTK 0.76 come to lie in one place"):
        hull.vary(set={"flat_of_bottom": widest})
