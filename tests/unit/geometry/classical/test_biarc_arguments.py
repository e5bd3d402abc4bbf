"""Whatever is handed to arcs, biarcs and chains: a result, or an error of one line."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.classical.biarc_chain import biarc_chain, biarc_tangents
from assoc_hull.geometry.classical.biarcs import biarcs, free_biarcs
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from tests.unit.test_bad_arguments import BAD

FIVE = np.array([[0, 0], [1, 0.8], [2.5, 1.5], [4, 1.7], [6, 1.2]])
CHAIN = biarc_chain(FIVE)
SPAN = {"start": FIVE[:-1], "start_angle": [0.1] * 4, "end": FIVE[1:], "end_angle": [0.2] * 4}
LINE = {"points": FIVE, "start": (1, 1), "end": (1, 0), "knuckles": [2], "form": "chord"}

CALLS: dict[str, tuple[Callable[..., object], dict[str, Any]]] = {
    "biarcs": (biarcs, {**SPAN, "rule": "inverse", "least_radius": 0.0}),
    "free biarcs": (free_biarcs, {**SPAN, "share": [0.5] * 4}),
    "tangents": (biarc_tangents, {**LINE, "collinear": 1e-9}),
    "chain": (biarc_chain, {**LINE, "rule": "min_jump", "least_radius": 0.0}),
    "place": (CHAIN.at, {"s": 1.0}),
    "direction": (CHAIN.direction, {"s": 1.0}),
    "distances": (CHAIN.distances, {"points": FIVE}),
    "arcs": (
        PlaneArcs.make,
        {"start": FIVE, "angle": [0] * 5, "curvature": [0] * 5, "length": [1] * 5},
    ),
    "arcs through": (
        PlaneArcs.through,
        {"start": FIVE[:-1], "end": FIVE[1:], "curvature": [0] * 4},
    ),
}


@pytest.mark.parametrize("name", CALLS)
def test_nothing_is_taken_amiss(name: str) -> None:
    """Every argument in turn is something else; a refusal is of the family and has one line."""
    function, given = CALLS[name]
    function(**given)
    refusals = list[str]()
    for argument in given:
        for bad in BAD.values():
            try:
                function(**{**given, argument: bad})
            except AssocHullError as error:
                refusals.append(str(error))
    assert len(refusals) > 10
    assert not any("\n" in each for each in refusals)
