"""Random drags of shipped hulls: nothing is published, and the commit is the edit alone."""

from __future__ import annotations

import threading

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.drag import Drag
from assoc_hull.model.address import address
from tests.long_forms import LONG
from tests.twins import packed, twin

HULLS = {
    "wigley": lambda: ah.examples.wigley(),
    "series60": lambda: ah.examples.series60(0.70),
    "container ship": lambda: ah.examples.container_ship_225m(),
}
PARTS = 10 if LONG else 1
SEQUENCES = 17 if LONG else 2
"""Sequences a part: 510 in the long form."""


@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize("name", HULLS if LONG else ["series60"])
def test_what_is_committed_is_what_the_edit_alone_does(name: str, part: int) -> None:
    """After any steps, refusals and stops; until then nobody sees anything of them."""
    pack = packed(HULLS[name]())
    draw = np.random.default_rng([part, len(name)])
    for _ in range(SEQUENCES):
        ship, other = twin(pack), twin(pack)
        point, how = _point(ship, draw), str(draw.choice(["pull", "move"]))
        before = (ship.fingerprint, len(ship.history), ship.state_number)
        with ship.drag(point, how) as drag:
            if how == "move" and not drag.free:
                continue
            for _ in range(int(draw.integers(1, 6))):
                asked = _asked(drag, how, draw)
                timer = threading.Timer(float(draw.uniform(0.0, 0.03)), drag.stop)
                if draw.random() < 0.2:
                    timer.start()
                live = drag.to(**asked)
                timer.cancel()
                assert (ship.fingerprint, len(ship.history), ship.state_number) == before
            if "it was stopped" in live.refused:
                live = drag.to(**asked)
            if live.refused:
                with pytest.raises(ah.AssocHullError):
                    drag.commit("it")
                assert ship.fingerprint == before[0]
                with pytest.raises(ah.AssocHullError):
                    _alone(other, point, how, asked)
                continue
            drag.commit("it")
        _alone(other, point, how, asked)
        assert ship.fingerprint == other.fingerprint


def _point(ship: ah.Hull, draw: np.random.Generator) -> str:
    return address(ship.state, int(draw.choice(ship.state.live("rows"))))


def _asked(drag: Drag, how: str, draw: np.random.Generator) -> dict[str, float]:
    """Draw what is asked for: mostly a little, at times far too much, or no number."""
    size = float(draw.choice([0.002, 0.02, 0.1, 50.0, np.nan], p=[0.4, 0.3, 0.2, 0.05, 0.05]))
    if how == "pull":
        return {"d": size * float(draw.uniform(-1.0, 1.0))}
    axes = "xyz"
    return {
        axis: float(drag.start[axes.index(axis)]) + size * float(draw.uniform(-1.0, 1.0))
        for axis in drag.free
    }


def _alone(ship: ah.Hull, point: str, how: str, asked: dict[str, float]) -> None:
    with ship.edit("it") as edit:
        if how == "pull":
            edit.pull(point, asked["d"])
        else:
            edit.move(point, lead=False, **asked)
