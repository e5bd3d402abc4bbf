"""Combs of all lines in their views, of a hull and of the lines it was adopted from."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.hull import Hull
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Particulars
from assoc_hull.plot import combs_plan
from assoc_hull.plot.lines_plan.drawing import drawing, given_lines
from assoc_hull.plot.sheet.paper import PaperName
from tests import meshes

Lines = Callable[[Figure, str], list[FloatArray]]


def test_every_line_has_its_comb_once(bulk_carrier: Hull, lines_of: Lines) -> None:
    """Each curve of a section, waterline or buttock; midship on both halves of the body plan."""
    figure, plan = combs_plan(bulk_carrier), drawing(bulk_carrier)
    middle = 0.5 * plan.particulars.length
    for family in ("sections", "waterlines", "buttocks"):
        for line in plan.of(family):
            twice = 2 if family == "sections" and abs(line.offset - middle) < 1e-6 else 1
            for part in ("teeth", "tips", "line"):
                found = lines_of(figure, f"{part}/{line.name}$")
                assert len(found) == twice * len(line.splines), line.name


@pytest.mark.parametrize(("paper", "scale"), [("A3", 0.3), ("A4", 0.3), ("A1", 0.2)])
def test_teeth_are_as_long_as_the_stated_scale_says(
    paper: PaperName, scale: float, lines_of: Lines
) -> None:
    """Circular sections of 5 and 10 m: teeth outward, as the scale says on each paper."""
    angle = np.linspace(-0.5 * np.pi, 0.0, 90)
    ship = Particulars("pipes", 30.0, 20.0, 10.0, 5.0)
    sources = []
    for x, radius in ((20.0, 5.0), (25.0, 10.0)):
        places = [np.full(90, x), radius * np.cos(angle), radius * np.sin(angle) + 10.0]
        sources.append(LineSource.make("sections", f"ST {x:g}", np.column_stack(places)))
    figure = combs_plan(given_lines(sources, ship), paper=paper)
    stated = [text.get_text() for text in figure.axes[0].texts if "BODY" in text.get_text()]
    assert stated[0].endswith(f"tooth of 10 mm: {scale:g} 1/m")
    for name, radius in (("ST 20", 5.0), ("ST 25", 10.0)):
        long = 10.0 / (scale * radius)
        (teeth,) = lines_of(figure, f"teeth/{name}$")
        foot, tip = teeth[0::3], teeth[1::3]
        length = np.hypot(*(tip - foot).T)[20:-20]  # ends of a spline are free
        assert length == pytest.approx(long, rel=0.02)
        outward = (tip - foot) @ np.array([1.0, -1.0])
        assert (outward[20:-20] > 0.0).all()


def test_inflections_are_counted_by_view(bulk_carrier: Hull) -> None:
    """The block tells those of all lines of a view."""
    figure, plan = combs_plan(bulk_carrier), drawing(bulk_carrier)
    words = [text.get_text() for text in figure.axes[0].texts]
    middle = 0.5 * plan.particulars.length
    for view, family in (("profile", "buttocks"), ("half-breadth plan", "waterlines"),
                         ("body plan", "sections")):  # fmt: skip
        count = sum(
            int(inflections(spline, line.normal)[0][0])
            * (2 if family == "sections" and abs(line.offset - middle) < 1e-6 else 1)
            for line in plan.of(family) for spline in line.splines
        )  # fmt: skip
        assert words[words.index(f"Inflections, {view}") + 1] == str(count)


def test_given_lines_are_lofted_through_their_own_points() -> None:
    """Every point of every piece lies on the drawn line; pieces of one name are one line."""
    z = np.linspace(0.0, 6.0, 9)
    upper = np.column_stack([np.full(9, 50.0), meshes.wigley_y(np.full(9, 50.0), z), z])
    lower = upper - np.array([0.0, 0.0, 7.0])
    sources = [LineSource.make("sections", "ST 50", each) for each in (upper, lower)]
    line = given_lines(sources, Particulars("w", 100.0, 10.0, 6.0, 4.0)).line("ST 50")
    assert (line.label, line.offset, len(line.splines)) == ("50", 50.0, 2)
    for source, spline, points in zip(sources, line.splines, line.polylines, strict=True):
        assert np.allclose(spline.xyz, source.points)
        assert np.allclose(points[[0, -1]], source.points[[0, -1]])


def test_the_same_hull_gives_the_same_bytes(wigley: Hull, tmp_path: Path) -> None:
    """No dates, no chance; a hull without buttocks is drawn too."""
    for name in ("a.svg", "b.svg"):
        combs_plan(wigley, tmp_path / name)
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
