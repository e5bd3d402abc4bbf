"""A change keeps what an edit did: run backward and forward it gives every bit of the tables."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import Column
from assoc_hull.model.change import apply_change, change_of
from assoc_hull.model.definition.fingerprint import HashTree, fingerprint, root_of
from assoc_hull.model.tables import TABLES, HullState, copy_state
from tests.long_forms import draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, tasks


def picture(state: HullState) -> dict[str, object]:
    """Take down every bit of every column, splines and meetings by what they hold."""
    found: dict[str, object] = {}
    for table in TABLES:
        for name, column in getattr(state, table).columns.items():
            if isinstance(column, Column):
                found[f"{table}.{name}"] = column.data.tobytes()
            else:
                found[f"{table}.{name}"] = [
                    _plain(state, table, name, x, i) for i, x in enumerate(column.data)
                ]
    return found


def _plain(state: HullState, table: str, name: str, value: object, row: int) -> object:
    if isinstance(value, np.ndarray):
        return value.tolist()
    if name == "spline":
        if value is None or not state.curves.alive[row]:
            return None  # nothing reads the spline of a curve that has gone
        return [getattr(value, each).tobytes() for each in ("knot", "xyz", "leave", "arrive")]
    if name == "meets":
        return [
            getattr(value, each).tobytes() for each in ("line", "sign", "row", "parameter", "xyz")
        ]
    return value


@settings(max_examples=draws(30))
@given(st.integers(0, POOL - 1), tasks((*SHAPES, *STRUCTURE), most=5))
def test_a_change_runs_both_ways_to_the_last_bit(which: int, todo: list[Task]) -> None:
    """Every edit of a session, taken back and made again by its change, leaves the same tables."""
    hull = fresh(which)
    pictures, changes = [picture(hull.document.state)], []
    for task in todo:
        count = len(hull.history)
        carry_out(hull, task)
        if len(hull.history) > count:
            journal = hull.document.history[-1].journal
            assert isinstance(journal, Journal)
            changes.append(change_of(hull.document.state, journal))
            pictures.append(picture(hull.document.state))
    prints = [fingerprint(hull.document.state)]
    for _ in range(2):
        for i in range(len(changes) - 1, -1, -1):
            apply_change(hull.document.state, changes[i], forward=False)
            compare(hull, pictures[i])
        for i, change in enumerate(changes, start=1):
            apply_change(hull.document.state, change, forward=True)
            compare(hull, pictures[i])
    prints.append(fingerprint(hull.document.state))
    assert prints[0] == prints[1]


def compare(hull: ah.Hull, then: dict[str, object]) -> None:
    """Compare column by column."""
    now = picture(hull.document.state)
    assert [name for name in then if now[name] != then[name]] == []


@settings(max_examples=draws(30))
@given(st.integers(0, POOL - 1), tasks((*SHAPES, *STRUCTURE), most=5))
def test_a_tree_of_which_branches_are_made_anew_is_the_one_made_from_nothing(
    which: int, todo: list[Task]
) -> None:
    """After every edit of a session, and on the way back and forward through it.

    Its root tells apart what the fingerprint does.
    """
    hull = fresh(which)
    state = hull.document.state
    tree, changes = HashTree(state), []
    roots, prints = [tree.root()], [fingerprint(state)]
    for task in todo:
        count = len(hull.history)
        carry_out(hull, task)
        if len(hull.history) > count:
            journal = hull.document.history[-1].journal
            assert isinstance(journal, Journal)
            changes.append(change_of(state, journal))
            tree.note(changes[-1])
            roots.append(tree.root())
            prints.append(fingerprint(state))
            assert roots[-1] == root_of(state)
    assert len(set(roots)) == len(set(prints)) == len({*zip(roots, prints, strict=True)})
    for i in range(len(changes) - 1, -1, -1):
        apply_change(state, changes[i], forward=False)
        tree.note(changes[i])
        assert tree.root() == roots[i]
    for i, change in enumerate(changes, start=1):
        apply_change(state, change, forward=True)
        tree.note(change)
        if i % 2:
            assert tree.root() == roots[i]
    assert tree.root() == roots[-1] == root_of(copy_state(state))
