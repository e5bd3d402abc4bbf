"""Hulls that are drawn, and ways to look at a picture."""

from collections.abc import Callable, Iterator

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples

pytest.importorskip("matplotlib")

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

Lines = Callable[[Figure, str], list[FloatArray]]
Boxes = Callable[[Figure], dict[str, FloatArray]]


@pytest.fixture(scope="session")
def wigley() -> Hull:
    """A hull without buttocks, edited by no test."""
    return examples.wigley()


@pytest.fixture(scope="session")
def series60(series60_70: Hull) -> Hull:
    """A hull of all families and boundaries, as it is when no test edits it."""
    return series60_70


def _lines(figure: Figure, begin: str) -> Iterator[FloatArray]:
    for line in figure.axes[0].lines:
        if f"{line.get_gid()}$".startswith(begin):
            yield np.asarray(line.get_xydata(), np.float64)


@pytest.fixture
def lines_of() -> Lines:
    """Give the polylines (mm) whose ids begin like this; a $ stands for the end of an id."""
    return lambda figure, begin: list(_lines(figure, begin))


def _boxes(figure: Figure) -> dict[str, FloatArray]:
    renderer = FigureCanvasAgg(figure).get_renderer()  # type: ignore[no-untyped-call]
    found = {}
    for i, text in enumerate(figure.axes[0].texts):
        extent = text.get_window_extent(renderer)
        box = np.array([extent.x0, extent.y0, extent.x1, extent.y1])
        found[f"{text.get_gid()} {i}"] = box * 25.4 / figure.dpi
    return found


@pytest.fixture
def boxes_of() -> Boxes:
    """Give the boxes (mm) around all words, by id."""
    return _boxes
