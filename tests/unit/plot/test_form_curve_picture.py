"""The picture of a form-parameter curve."""

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.plot.diagrams.form_curve import form_curve_picture


def test_a_picture_is_true() -> None:
    """Both axes have one scale; a falling curve with a message is drawn whole."""
    curve = ah.creation.FormCurve.of(
        (0.2, 1.0), (1.0, 0.0), start_angle_deg=0.0, finish_angle_deg=-50.0,
        finish_curvature=-2.0, area=0.6, centroid=0.52, tangents="auto",
    )  # fmt: skip
    axes = form_curve_picture(curve, title="Entrance").axes[0]
    drawn = {line.get_gid(): np.column_stack(line.get_data()) for line in axes.lines}
    polygon, vertices = np.diff(drawn["polygon"], axis=0), np.diff(curve.vertices, axis=0)
    moved = np.abs(vertices) > 1e-9
    scales = (polygon / np.where(moved, vertices, 1.0))[moved]
    assert np.ptp(scales) < 1e-9 * scales.mean()
    assert len(drawn["inflections"]) == len(curve.inflections)
    words = [text.get_text() for text in axes.texts]
    assert "Entrance" in words
    assert any(word.startswith("bound info: the tangent at the finish") for word in words)


def test_only_curves_are_drawn() -> None:
    """Anything else is of the wrong type."""
    with pytest.raises(ah.errors.BadInputError, match="give a FormCurve"):
        form_curve_picture(None)  # type: ignore[arg-type]
