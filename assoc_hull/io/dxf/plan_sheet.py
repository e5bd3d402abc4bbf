"""What is drawn of a lines plan, put into a drawing: splines, polylines, straight lines, words.

Lengths come in m and are written in the unit of the drawing.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.control_polygon import ControlPolygon
from assoc_hull.io.dxf.document import NAMES
from assoc_hull.io.dxf.lines import SplineLine
from assoc_hull.io.dxf.plan_views import PlanView

__all__ = ["CHAIN", "PLACE", "VIEW_ORIGIN", "PlanSheet", "Side"]

VIEW_ORIGIN, PLACE = 1011, 1041
"""Codes of extended data that move, and grow, with their entity."""

CHAIN = "CHAIN"
"""Line type of axes: dash, dot."""

Side = Literal["left", "right", "middle", "above", "below"]
"""Where the words lie beside their place."""


@attrs.frozen
class PlanSheet:
    """A drawing that is being made.

    Attributes
    ----------
    space : ezdxf model space
        Takes the entities.
    scale : float
        Units of the drawing in a metre.
    letter : float, m
        Height of letters.
    """

    space: Any
    scale: float
    letter: float

    def begin(self) -> None:
        """Define the line type of axes."""
        dash = self.letter * self.scale
        pattern = [6.0 * dash, 4.0 * dash, -0.8 * dash, 0.4 * dash, -0.8 * dash]
        self.space.doc.linetypes.add(CHAIN, pattern=pattern, description="long dash, short dash")

    def spline(self, line: SplineLine, curve: ControlPolygon, flat: FloatArray, layer: str) -> Any:
        """Add a curve by its control points in the drawing, (n, 2), m; named as its line."""
        spline = self.space.add_spline(degree=3, dxfattribs={"layer": layer})
        points = np.column_stack([flat * self.scale + 0.0, np.zeros(len(flat))])
        spline.control_points = points.tolist()
        spline.knots = curve.knots.tolist()
        spline.set_xdata(NAMES, [(1000, line.name), (1000, line.family)])
        return spline

    def place(self, entity: Any, line: SplineLine, view: PlanView) -> None:
        """Tell of a curve from which view it can be read, and the place of its plane."""
        x, y = (float(each) * self.scale for each in view.origin)
        words: list[tuple[int, Any]] = [(1000, line.name), (1000, line.family), (1000, view.name)]
        words.append((VIEW_ORIGIN, (x, y, 0.0)))
        if line.axis is not None:
            words.append((PLACE, line.place * self.scale))
        entity.set_xdata(NAMES, words)

    def polyline(self, flat: FloatArray, layer: str, name: str = "", family: str = "") -> None:
        """Add straight lines between places, (n, 2), m."""
        added = self.space.add_lwpolyline(
            (flat * self.scale + 0.0).tolist(), dxfattribs={"layer": layer}
        )
        if name:
            added.set_xdata(NAMES, [(1000, name), (1000, family)])

    def rule(
        self, start: Sequence[float], end: Sequence[float], layer: str, *, chain: bool = False
    ) -> None:
        """Add a straight line between two places, m."""
        ends = [tuple(float(each) * self.scale + 0.0 for each in place) for place in (start, end)]
        look = {"layer": layer, "linetype": CHAIN} if chain else {"layer": layer}
        self.space.add_line(*ends, dxfattribs=look)

    def text(
        self,
        place: Sequence[float],
        words: str,
        side: Side = "middle",
        *,
        size: float = 1.0,
        angle: float = 0.0,
        layer: str = "labels",
    ) -> None:
        """Add words at a place, m; their height in letters, their angle in degrees."""
        from ezdxf.enums import TextEntityAlignment as Align

        aligned = {
            "left": Align.MIDDLE_RIGHT, "right": Align.MIDDLE_LEFT, "middle": Align.MIDDLE_CENTER,
            "above": Align.BOTTOM_CENTER, "below": Align.TOP_CENTER,
        }[side]  # fmt: skip
        look = {"layer": layer, "height": size * self.letter * self.scale, "rotation": angle}
        x, y = (float(each) * self.scale + 0.0 for each in place)
        self.space.add_text(words, dxfattribs=look).set_placement((x, y), align=aligned)
