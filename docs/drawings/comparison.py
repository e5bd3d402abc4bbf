"""The bulk carrier with its shaft raised, over its parent."""

from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.plot.lines_plan.comparison import comparison_plan

__all__ = ["comparison"]


def comparison() -> Figure:
    """Draw both lines plans over one another, with the lines that moved farthest."""
    parent = ah.examples.bulk_carrier_207k()
    variant = parent.vary(set={"shaft_height": 6.0}).hull
    return comparison_plan(parent, variant, paper="A4", found=parent.compare(variant))
