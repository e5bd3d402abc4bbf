"""Pictures of fields: boundary curves, regions and tints are where the fields act."""

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.figure import Figure
from numpy.testing import assert_allclose

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.plot.lines_plan.variation_fields import variation_fields
from assoc_hull.plot.sheet.paper import PAPERS
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.fields.layers import FieldLayer, Rake

Lines = Callable[[Figure, str], list[FloatArray]]
Boxes = Callable[[Figure], dict[str, FloatArray]]


def layer() -> FieldLayer:
    """A hat at the stern, a wider stern, and a raked stem."""
    aft, fore = (
        BlendChain.through([5.0, 40.0], [1.0, 0.0]),
        BlendChain.through([80.0, 100.0], [0.0, 1.0]),
    )
    shaft = hat_field("shaft", [("base", 0, 0), ("shaft", 3, 0.4), ("T", 6.25, 0)], aft)
    pieces = AffinePiece.along(aft, 0.0, 0.0), AffinePiece.along(aft, 0.05, 0.0)
    wide = StackedField("transom", "y", level_boundaries(["foot", "deck"], [3.0, 6.0]), pieces)
    return FieldLayer("local", (shaft, wide, Rake("stem", fore, 0.05, 6.25, 1.5)))


def test_all_that_is_drawn_lies_on_the_sheet(wigley: Hull, boxes_of: Boxes) -> None:
    """Words inside the sheet, none over another, on every paper."""
    for paper in PAPERS.values():
        figure = variation_fields(wigley, layer(), paper=paper.name)  # type: ignore[arg-type]
        boxes = np.array(list(boxes_of(figure).values()))
        assert boxes[:, :2].min() > 0.0
        assert (boxes[:, 2] < paper.width).all()
        assert (boxes[:, 3] < figure.get_figheight() * 25.4).all()
        for i, one in enumerate(boxes):
            rest = boxes[i + 1 :]
            apart = (rest[:, 0] >= one[2]) | (rest[:, 2] <= one[0])
            apart |= (rest[:, 1] >= one[3]) | (rest[:, 3] <= one[1])
            assert apart.all()


def test_boundaries_and_regions_are_to_scale(wigley: Hull, lines_of: Lines) -> None:
    """Measured against the profile of the hull in the same panel."""
    figure = variation_fields(wigley, layer())
    (region,) = lines_of(figure, "region/transom")
    (foot,) = lines_of(figure, "boundary/transom/foot")
    (deck,) = lines_of(figure, "boundary/transom/deck")
    marks = {x: np.concatenate(lines_of(figure, f"upright/{x}$"))[0, 0] for x in (0, 100)}
    metre = (marks[100] - marks[0]) / 100.0
    assert_allclose(region[:, 0].max(), marks[0] + 40.0 * metre, atol=0.05)
    assert_allclose(foot[[0, -1], 0], [region[:, 0].min(), region[:, 0].max()], atol=0.05)
    assert_allclose(region[:, 1].min(), foot[0, 1], atol=0.05)
    tall = [line[0, 1] for line in lines_of(figure, "level/")]
    assert min(tall) < foot[0, 1] < deck[0, 1] < max(tall)


def test_a_panel_for_each_coordinate_that_moves(wigley: Hull) -> None:
    """One, two or three; their captions tell the unit."""
    whole = layer()
    for count in (1, 2, 3):
        figure = variation_fields(wigley, FieldLayer("some", whole.fields[:count]))
        captions = [each for each in figure.axes[0].texts if "caption" in str(each.get_gid())]
        assert len(captions) == count


def test_a_layer_without_fields_is_refused(wigley: Hull) -> None:
    """There is nothing to draw."""
    with pytest.raises(BadInputError, match="layer 'none' has no fields"):
        variation_fields(wigley, FieldLayer("none", ()))
