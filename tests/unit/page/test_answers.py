"""What panels of the page say in numbers."""

from __future__ import annotations

import assoc_hull as ah
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.model.objects import Curve, Line
from assoc_hull.page.answers import describe_fairness


def test_the_list_of_wavy_lines_counts_the_inflections_that_the_picture_marks(
    series60_70: ah.Hull,
) -> None:
    """Between bends of .2 degree, as marks in the browser are tested to be, and no fainter ones."""
    state, listed = series60_70.state, describe_fairness(series60_70)["lines"]
    assert len(listed) == 15
    fainter = 0
    for each in listed:
        found = series60_70.find(each["line"])
        assert isinstance(found, Line | Curve)
        line = state.lines.name.data.index(each["line"])
        (curve,) = state.lines.curves[line]
        batch = SplineBatch.join([state.spline(curve)])
        counts = [
            int(inflections(batch, state.lines.normal[line][None], lobe)[0][0])
            for lobe in (0.2, 0.0)
        ]
        assert each["inflections"] == counts[0]
        fainter += counts[1] > counts[0]
    assert fainter
