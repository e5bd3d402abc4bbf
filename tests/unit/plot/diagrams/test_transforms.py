"""Pictures of series: the curve and the series pass through their values, bars are to scale."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.testing import assert_allclose

from assoc_hull.analysis.form.curve_transform import CurveTransform, curve_transform
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.plot.diagrams.curve_series import curve_series
from assoc_hull.plot.sheet.paper import PAPERS

Lines = Callable[[Figure, str], list[FloatArray]]
Boxes = Callable[[Figure], dict[str, FloatArray]]
KINDS = ("chebyshev", "sine", "fourier")


def made(hull: Hull, kind: str) -> CurveTransform:
    """A waterline's series; around, a section."""
    name = "ST 5" if kind == "fourier" else "WL 2.5"
    return curve_transform(hull, name, kind, 16)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", KINDS)
def test_all_that_is_drawn_lies_on_the_sheet(wigley: Hull, kind: str, boxes_of: Boxes) -> None:
    """Words inside the frame, none over another, on every paper."""
    for paper in PAPERS.values():
        figure = curve_series(made(wigley, kind), terms=5, paper=paper.name)  # type: ignore[arg-type]
        boxes = np.array(list(boxes_of(figure).values()))
        assert boxes[:, :2].min() > 0.0
        assert (boxes[:, 2] < paper.width).all()
        assert (boxes[:, 3] < paper.height).all()
        for i, one in enumerate(boxes):
            rest = boxes[i + 1 :]
            apart = (rest[:, 0] >= one[2]) | (rest[:, 2] <= one[0])
            apart |= (rest[:, 1] >= one[3]) | (rest[:, 3] <= one[1])
            assert apart.all()


def test_curve_and_series_share_their_scales(wigley: Hull, lines_of: Lines) -> None:
    """With all terms of a smooth line the two are one; with one they are apart."""
    found = made(wigley, "chebyshev")
    figure = curve_series(found)
    (curve,), (series,) = lines_of(figure, "curve"), lines_of(figure, "series")
    on = np.interp(curve[:, 0], series[:, 0], series[:, 1])
    assert_allclose(curve[:, 1], on, atol=0.05)
    (level,) = lines_of(curve_series(found, terms=1), "series")
    assert np.ptp(level[:, 1]) < 1e-9 < np.ptp(curve[:, 1])


def test_a_section_is_true_to_its_shape(wigley: Hull, lines_of: Lines) -> None:
    """One metre is as long across as upward."""
    found = made(wigley, "fourier")
    (curve,) = lines_of(curve_series(found), "curve")
    across, up = np.ptp(curve, axis=0) / np.ptp(found.places, axis=0)
    assert across == pytest.approx(up)


@pytest.mark.parametrize("kind", KINDS)
def test_bars_are_decades_of_the_coefficients(wigley: Hull, kind: str) -> None:
    """Ten times the coefficient is one step more, whatever its sign."""
    found = made(wigley, kind)
    figure = curve_series(found)
    size = np.abs(found.coefficients)
    bars = [bar for bar in figure.axes[0].patches if isinstance(bar, Rectangle)]
    tall = np.array([bar.get_height() for bar in bars])
    drawn = np.sort(size)[-len(tall) :]
    assert_allclose(np.diff(np.sort(tall)) / np.ptp(tall), np.diff(np.log10(drawn)) / np.ptp(
        np.log10(drawn)), atol=1e-9)  # fmt: skip


def test_areas_say_where_the_ship_floats(wigley: Hull, tmp_path: Path, boxes_of: Boxes) -> None:
    """In a note; the same bytes each time; more terms than there are are refused."""
    found = curve_transform(wigley, "sectional areas", draught=4.0)
    figure = curve_series(found, tmp_path / "a.svg")
    curve_series(found, tmp_path / "b.svg")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    assert any("Floating at T_A 4 m" in name for name in boxes_of(figure))
    with pytest.raises(BadInputError, match="terms is 13"):
        curve_series(found, terms=13)
