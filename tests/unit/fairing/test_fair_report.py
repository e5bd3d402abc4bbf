"""What fairing tells of the lines: also those that gain inflections are named."""

import attrs

import assoc_hull as ah


def test_lines_that_gain_inflections_are_named() -> None:
    """A fairing that makes a line less fair does not go by without a word."""
    report = ah.examples.wigley(stations=9, waterlines=6).fair(noise=1e-3, dry_run=True)
    first, second, *rest = report.lines
    report.__dict__["lines"] = (
        attrs.evolve(first, inflections=(1, 3)), attrs.evolve(second, inflections=(4, 2)),
        *(attrs.evolve(each, inflections=(0, 0)) for each in rest),
    )  # fmt: skip
    assert f"more inflections on {first.line}" in report.notes
    assert f"fewer inflections on {second.line}" in report.notes
    assert "inflections  5 > 5, between bends of 0.2 degree or more" in str(report)
