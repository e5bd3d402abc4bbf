"""Pictures of panels: to scale, all views there, words apart and on the sheet."""

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from assoc_hull.analysis.panels.hull_panels import panels
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.plot.plates.panel_plan import panel_plan
from assoc_hull.plot.sheet.paper import PAPERS

Boxes = Callable[[Figure], dict[str, FloatArray]]


@pytest.fixture(scope="module")
def meshes(series60_70: Hull) -> dict[str, PanelMesh]:
    """A slender ship upright, a full one heeled."""
    return {
        "upright": panels(examples.wigley(), count=120),
        "heeled": panels(series60_70, heel_deg=15.0, count=240),
    }


def _views(figure: Figure) -> dict[str, list[FloatArray]]:
    """Corners of the panels of each view, mm."""
    found: dict[str, list[FloatArray]] = {}
    for each in figure.axes[0].collections:
        if isinstance(each, PolyCollection):
            corners = [np.asarray(path.vertices) for path in each.get_paths()]
            found.setdefault(str(each.get_gid()), []).extend(corners)
    return found


@pytest.mark.parametrize("paper", ["A1", "A3", "A4"])
@pytest.mark.parametrize("name", ["upright", "heeled"])
def test_all_views_lie_on_the_sheet_and_words_apart(
    name: str, paper: str, meshes: dict[str, PanelMesh], boxes_of: Boxes
) -> None:
    """Hull from below, profile, plan and body plan, on every size of paper."""
    figure = panel_plan(meshes[name], paper=paper)  # type: ignore[arg-type]
    views = _views(figure)
    assert set(views) == {"seen/panels", "profile/panels", "plan/panels", "body/panels"}
    size = PAPERS[paper]
    for corners in views.values():
        every = np.concatenate(corners)
        assert (every > 0.0).all()
        assert (every < [size.width, size.height]).all()
    spread = {name: np.concatenate(corners) for name, corners in views.items()}
    assert spread["body/panels"][:, 1].min() > spread["profile/panels"][:, 1].max()
    (body,) = [box for name, box in boxes_of(figure).items() if "caption/BODY PLAN" in name]
    assert body[1] > spread["profile/panels"][:, 1].max()
    words = list(boxes_of(figure).values())
    for i, one in enumerate(words):
        for other in words[:i]:
            apart = (one[:2] >= other[2:] - 1e-6) | (other[:2] >= one[2:] - 1e-6)
            assert apart.any()


def test_the_profile_is_to_scale(meshes: dict[str, PanelMesh]) -> None:
    """100 m by 6.25 m at 1:300."""
    views = _views(panel_plan(meshes["upright"]))
    every = np.concatenate(views["profile/panels"])
    assert np.ptp(every, axis=0) == pytest.approx([1e5 / 300.0, 6.25e3 / 300.0])
