"""What a network keeps is given again only while nothing it depends on was written."""

from __future__ import annotations

import numpy as np

import assoc_hull as ah
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node


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
