"""Bodies beside the net on the lines plan: in all views, the side to port."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.plot.lines_plan.drawing import drawn_outlines
from assoc_hull.plot.lines_plan.plan import lines_plan
from assoc_hull.shipped.classical_ships import classical_ship

Lines = Callable[[Figure, str], list[FloatArray]]


def test_each_view_shows_the_outlines_of_bodies(lines_of: Lines) -> None:
    """By group and name; a hull without them has none."""
    figure = lines_plan(ah.create(classical_ship("prelikon_ship")))
    for view in ("profile", "half-breadth", "body"):
        assert lines_of(figure, f"{view}/deck houses/deck house$")
        assert lines_of(figure, f"{view}/boxes/sea chest$")
    assert not lines_of(lines_plan(ah.examples.wigley()), "profile/boxes/sea chest$")


def test_what_of_a_body_stands_abaft_the_middle_is_drawn_in_the_aft_body(lines_of: Lines) -> None:
    """Its after end to the left of the centre line, its fore end to the right."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    with hull.edit("keel") as edit:
        edit.body("bar keel", "keels", x=(20, 80), y=(-1, 1), z=(0.1, 0.6))
        edit.body("abaft", "keels", x=(20, 40), y=(-1, 1), z=(0.1, 0.6))
    figure = lines_plan(hull)
    across = {
        name: np.concatenate(lines_of(figure, f"body/keels/{name}$"))[:, 0]
        for name in ("bar keel", "abaft")
    }
    centre = across["abaft"].max()
    assert across["bar keel"].max() - centre == centre - across["bar keel"].min()
    assert across["bar keel"].min() == across["abaft"].min()


def test_outlines_are_cut_at_the_centre_plane_and_taken_to_port() -> None:
    """A body to starboard alone is drawn in its mirror image."""
    ring = np.array([[0.0, -3.0, 9.0], [0.0, 3.0, 9.0], [0.0, 3.0, 11.0], [0.0, -3.0, 11.0]])
    for off, least in ((0.0, 0.0), (-4.0, 1.0)):
        moved = ring + np.array([0.0, off, 0.0])
        body = AttachedBody(
            "b", "boxes", [moved, moved + np.array([8.0, 0, 0])], range(4), False, 1
        )
        y = np.concatenate([each[:, 1] for each in drawn_outlines(body)])
        assert y.min() == least
