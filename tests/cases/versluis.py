"""Section areas of a bulk carrier: A. Versluis 1977, Lpp 180 m, B 28 m, T 10.5 m."""

from __future__ import annotations

from assoc_hull.shipped.bulk_carrier_180m import VERSLUIS_AREAS as AREAS
from assoc_hull.shipped.bulk_carrier_180m import VERSLUIS_BREADTH as BREADTH
from assoc_hull.shipped.bulk_carrier_180m import VERSLUIS_DRAUGHT as DRAUGHT
from assoc_hull.shipped.bulk_carrier_180m import VERSLUIS_LENGTH as LPP
from assoc_hull.shipped.bulk_carrier_180m import VERSLUIS_MOMENTS as MOMENTS
from assoc_hull.shipped.bulk_carrier_180m import VERSLUIS_X as X

__all__ = ["AREAS", "BREADTH", "DRAUGHT", "LPP", "MOMENTS", "X"]
