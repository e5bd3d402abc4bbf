"""Pictures of hulls and of reports; they need the extra `plot`."""

from assoc_hull.plot.comb_plan import combs_plan
from assoc_hull.plot.combs import curvature_combs
from assoc_hull.plot.compare import before_after, snapshot
from assoc_hull.plot.deviations import adoption_deviations
from assoc_hull.plot.lines_plan import lines_plan
from assoc_hull.plot.neighbourhood import neighbourhood

__all__ = [
    "adoption_deviations",
    "before_after",
    "combs_plan",
    "curvature_combs",
    "lines_plan",
    "neighbourhood",
    "snapshot",
]
