"""What is derived from columns: given again only while nothing it depends on was written."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.graph.derived import Derived, Objects
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import NumberColumn, Table, ValueColumn, numbers, values


@attrs.frozen(eq=False)
class Towers(Table):
    """A column of each kind that things depend on."""

    height: NumberColumn[np.float64] = numbers(np.float64)
    name: ValueColumn[str] = values("")


def towers() -> Towers:
    """Three towers."""
    found = Towers()
    found.resize(3)
    return found


def test_a_thing_is_made_once_until_a_column_is_written() -> None:
    """Asked again it is the same object; after a write it is made anew, by any kind of column."""
    table, derived, journal = towers(), Derived(), Journal()
    depends_on = table.height, table.name, "flag"
    first = derived.give(("sum",), depends_on, lambda: [1])
    assert derived.give(("sum",), depends_on, lambda: [2]) is first
    assert derived.give(("other",), depends_on, lambda: [3]) == [3]
    journal.put(table.height, [1], [5.0])
    assert derived.give(("sum",), depends_on, lambda: [4]) == [4]
    journal.set(table.name, [1], ["north"])
    assert derived.give(("sum",), depends_on, lambda: [5]) == [5]
    assert derived.give(("sum",), (*depends_on[:2], "another"), lambda: [6]) == [6]


def test_objects_are_the_very_same_ones() -> None:
    """Equal lists are other objects."""
    one = [1.0]
    assert Objects([one]) == Objects([one])
    assert Objects([one]) != Objects([[1.0]])
    assert Objects([one]) != Objects([one, one])


def test_few_of_a_kind_are_kept() -> None:
    """What was not asked for longest goes; other kinds stay."""
    derived = Derived()
    derived.give(("lone",), (), lambda: "here")
    for number in range(100):
        derived.give(("many", number), (), lambda: "made")
        derived.give(("many", 0), (), lambda: "made")
    assert derived.give(("many", 99), (), lambda: "anew") == "made"
    assert derived.give(("many", 0), (), lambda: "anew") == "made"
    assert derived.give(("many", 1), (), lambda: "anew") == "anew"
    assert derived.give(("lone",), (), lambda: "anew") == "here"


def test_what_was_kept_comes_back_with_the_columns() -> None:
    """Made anew in between or not; of what was made meanwhile, what is true stays."""
    table, derived, journal = towers(), Derived(), Journal()
    first = derived.give(("sum",), (table.height,), lambda: [1])
    mark = derived.mark()
    true = derived.give(("true",), (table.height, table.name), lambda: [2])
    journal.put(table.height, [1], [5.0])
    assert derived.give(("sum",), (table.height,), lambda: [3]) == [3]
    derived.give(("false",), (table.height,), lambda: [4])
    journal.undo()
    derived.restore(mark)
    assert derived.give(("sum",), (table.height,), lambda: [5]) is first
    assert derived.give(("true",), (table.height, table.name), lambda: [6]) is true
    assert derived.give(("false",), (table.height,), lambda: [7]) == [7]


def test_what_is_true_again_is_not_replaced_by_what_was_out_of_date() -> None:
    """Of what was kept and what a trial made before it wrote, that which holds now stays."""
    height, derived = NumberColumn(np.float64, (), 0.0), Derived()
    height.resize(1)
    derived.give(("count",), (height,), lambda: "out of date")
    height.resize(2)
    mark = derived.mark()
    assert derived.give(("count",), (height,), lambda: "true") == "true"
    derived.restore(mark)
    assert derived.give(("count",), (height,), lambda: "made anew") == "true"


def test_what_is_handed_on_is_no_more_than_is_kept() -> None:
    """States take over from one another what was made of them: of each kind so many, no more."""
    column, live = NumberColumn(np.float64, (), 0.0), Derived()
    for number in range(20):
        published = Derived()
        published.give(("kind", number), (column,), lambda: [0], most=3)
        published.give(("single",), (column, number), lambda: [0], most=1)
        live.add(published)
    held = live.mark()
    assert {kind: len(entries) for kind, entries in held.items()} == {"kind": 3, "single": 1}
    assert ("kind", 19) in held["kind"]
    other = Derived()
    other.add(live)
    other.give(("kind", 20), (column,), lambda: [0], most=3)
    other.restore(held)
    assert len(other.mark()["kind"]) == 3
