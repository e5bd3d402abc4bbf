"""The bulk carrier with its shaft raised, over its parent."""

from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.plot import comparison_plan

__all__ = ["comparison"]


def comparison() -> Figure:
    """Draw both lines plans over one another, with the lines that moved farthest."""
    parent = ah.examples.bulk_carrier_207k()
    variant = ah.vary(parent, set={"shaft_height": 6.0}).hull
    return comparison_plan(parent, variant, paper="A4", found=ah.compare(parent, variant))
