"""The picture of an adoption shows every curve, its deviations to scale, and the worst by name."""

from collections.abc import Callable
from pathlib import Path

import attrs
import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.plot.lines_plan.adoption_deviations import adoption_deviations
from assoc_hull.plot.sheet.paper import PAPERS, TINT

Lines = Callable[[Figure, str], list[FloatArray]]
Boxes = Callable[[Figure], dict[str, FloatArray]]


def test_every_curve_has_its_deviations_to_scale(bulk_carrier: Hull, lines_of: Lines) -> None:
    """Ten times the deviation lies one decade, always the same width, farther right."""
    report = bulk_carrier.adoption
    assert report is not None
    figure = adoption_deviations(bulk_carrier)
    seen = []
    for line in report.lines:
        (median,), (most,) = (
            lines_of(figure, f"{part}/{line.curve}$") for part in ("median", "max")
        )
        assert median[0, 1] == most[0, 1]
        seen.append((1e3 * line.deviation, most[0, 0]))
    value, x = np.array([each for each in seen if each[0] > 0.01]).T
    wide, start = np.polyfit(np.log10(value), x, 1)
    assert np.abs(start + wide * np.log10(value) - x).max() < 1e-6
    assert wide > 10.0


def test_what_is_worse_than_allowed_is_red(series60: Hull) -> None:
    """A deviation over the tolerance, and inflections that the given line has not."""
    report = series60.adoption
    assert report is not None
    first = attrs.evolve(report.lines[0], deviation=0.02, tolerance=0.01)
    second = attrs.evolve(report.lines[1], inflections_given=1, inflections=3)
    calm = [attrs.evolve(each, tolerance=1.0, inflections=0) for each in report.lines[2:]]
    spoilt = attrs.evolve(report, lines=(first, second, *calm))
    figure = adoption_deviations(series60, spoilt)
    drawn = {str(line.get_gid()): line for line in figure.axes[0].lines}
    red = {name for name, line in drawn.items()
           if name.startswith("max/") and line.get_markerfacecolor() == TINT}  # fmt: skip
    assert red == {f"max/{first.curve}"}
    bends = [text for text in figure.axes[0].texts if text.get_gid() == "label/bends"]
    assert [text.get_text() for text in bends if to_hex(text.get_color()) == TINT] == ["1 > 3"]


@pytest.mark.parametrize("name", ["series60", "bulk_carrier", "dtc"])
@pytest.mark.parametrize("paper", ["A3", "A4"])
def test_words_are_apart_and_within_the_frame(
    name: str, paper: str, boxes_of: Boxes, request: pytest.FixtureRequest
) -> None:
    """No word covers another, on any paper; the largest deviation is named in the views."""
    hull: Hull = request.getfixturevalue(name)
    figure = adoption_deviations(hull, paper=paper)  # type: ignore[arg-type]
    found = boxes_of(figure)
    boxes, names = np.array(list(found.values())), list(found)
    for i, box in enumerate(boxes):
        apart = (boxes[:, :2] >= box[2:] - 1e-6).any(axis=1)
        apart |= (boxes[:, 2:] <= box[:2] + 1e-6).any(axis=1)
        assert [names[k] for k in np.flatnonzero(~apart).tolist() if k != i] == [], names[i]
    size = PAPERS[paper]
    assert (boxes[:, :2] > 8.0 * size.factor).all()
    assert (boxes[:, 2:] < np.array([size.width, size.height]) - 8.0 * size.factor).all()
    assert hull.adoption is not None
    worst = hull.adoption.worst
    words = [text.get_text() for text in figure.axes[0].texts]
    assert f"{worst.line} {1e3 * worst.deviation:.3g}" in words


def test_a_hull_without_a_report_is_refused(wigley: Hull, tmp_path: Path) -> None:
    """A hull that was opened or made of a formula tells nothing of an adoption."""
    with pytest.raises(BadInputError, match="report="):
        adoption_deviations(wigley, path=tmp_path / "p.png")
    assert list(tmp_path.iterdir()) == []


def test_the_same_report_gives_the_same_bytes(series60: Hull, tmp_path: Path) -> None:
    """No dates, no chance."""
    for name in ("a.svg", "b.svg"):
        adoption_deviations(series60, path=tmp_path / name)
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
