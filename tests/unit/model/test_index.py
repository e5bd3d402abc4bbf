"""Answers that are kept: given again only while nothing they depend on was written."""

from __future__ import annotations

import numpy as np

import assoc_hull as ah
from assoc_hull.model.index import Index, Objects, build_index
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node


def index() -> Index:
    """An index of the smallest hull at hand."""
    return build_index(ah.examples.wigley(stations=5, waterlines=3).state)


def test_an_answer_is_found_once_for_each_stamp() -> None:
    """Asked again it is the same object; after a write it is found anew."""
    of = index()
    first = of.answer("who", 1, lambda: [1])
    assert of.answer("who", 1, lambda: [2]) is first
    assert of.answer("who", 2, lambda: [3]) == [3]
    assert of.answer("who", 1, lambda: [4]) == [4]
    assert of.answer("whom", 1, lambda: [5]) == [5]


def test_few_answers_are_kept() -> None:
    """The oldest is let go; nothing grows with the number of questions."""
    of = index()
    for question in range(1000):
        of.answer(question, 0, lambda: None)
    assert of.answer(999, 0, lambda: "found") is None
    assert of.answer(0, 0, lambda: "found") == "found"


def test_objects_are_equal_only_to_the_very_same() -> None:
    """Equal numbers in another array are another object."""
    one, other = np.zeros(3), np.zeros(3)
    assert Objects([one, other]) == Objects([one, other])
    assert hash(Objects([one])) == hash(Objects([one]))
    assert Objects([one]) != Objects([other])
    assert Objects([one]) != [one]


def test_readers_follow_a_change_of_roles() -> None:
    """What a network kept of who reads whom is not believed after a role was changed."""
    hull = ah.examples.wigley()
    crossing = hull.crossings["WL 2.5 x ST 7"]
    assert crossing.role == "shared"
    node = Node.point(np.array([crossing.row]))

    def readers() -> list[int]:
        network = HullNetwork(hull.state, hull.document.index)
        return sorted(network.readers(node).reader.tolist())

    before = readers()
    with hull.edit("role") as edit:
        edit.set_role(crossing, "drives b")
    after = readers()
    hull.undo()
    assert before == readers() != after
