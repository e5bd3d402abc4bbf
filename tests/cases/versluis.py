"""Section areas of a bulk carrier: A. Versluis 1977, Lpp 180 m, B 28 m, T 10.5 m."""

from __future__ import annotations

from assoc_hull.shipped.versluis_section_areas import AREAS, BREADTH, DRAUGHT, LPP, MOMENTS, X

__all__ = ["AREAS", "BREADTH", "DRAUGHT", "LPP", "MOMENTS", "X"]
