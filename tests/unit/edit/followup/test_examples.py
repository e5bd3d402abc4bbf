"""What the parts of `edit.followup` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.settle_features import circle_side, find_features, followed_feature
from assoc_hull.edit.followup.take_up_definitions import CurveRecipe
from assoc_hull.model.feature_geometry import line_numbers
from assoc_hull.model.features import Feature
from assoc_hull.shipped.wigley import wigley


def test_the_points_of_a_generated_curve_made_anew_when() -> None:
    """The points of a generated curve made anew: when its pieces are others, or it needs more
    points."""
    assert CurveRecipe("curve+topside", ((0, 2.0),), (0,), ((0.0, 0.0, 0.0),)).marks == ((0, 2.0),)


def test_on_which_side_of_its_points_a_feature_lies() -> None:
    """On which side of its points a feature lies, seen against the normal of its plane."""
    arc = np.array([[0.0, 1.0, 0.0], [0.0, 0.8, 0.6], [0.0, 0.0, 1.0]])
    assert circle_side(arc, np.zeros(3), np.array([1.0, 0.0, 0.0])) == 1


def test_the_features_of_a_net_found_once_when_it() -> None:
    """The features of a net: found once, when it is adopted, where kinds of points say they
    are."""
    assert [each.name for each in find_features(wigley(stations=5, waterlines=4))] == [
        "ST 1 straight",
        "ST 2 straight",
        "ST 3 straight",
    ]


def test_a_feature_after_its_line_has_changed_its_points() -> None:
    """A feature after its line has changed: its points anew, its plane that of its line."""
    state = wigley(stations=5, waterlines=4)
    line, rows = state.lines.key[4], state.curves.rows[state.lines.curves[4][0]]
    run = Feature("run", "straight", "run", (line,), rows[[0, 2]].tolist())
    found = followed_feature(state, run, line_numbers(state))
    assert found is not None
    assert found.points == tuple(rows[:3].tolist())
