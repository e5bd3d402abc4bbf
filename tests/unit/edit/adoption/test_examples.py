"""What the parts of `edit.adoption` give, one small example of each."""

from __future__ import annotations

from assoc_hull.shipped.series60 import series60_adopted


def test_what_adoption_made_of_given_lines_per_curve_how() -> None:
    """What adoption made of given lines: per curve how closely, with how many points, how
    fair."""
    report = series60_adopted(0.70)[1]
    worst = report.worst
    assert (worst.line, round(1e3 * worst.deviation, 2)) == ("profile", 0.25)
    assert (report.own_points, report.inflections) == (17, (64, 0))
