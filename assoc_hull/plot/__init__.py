"""Pictures of hulls and of reports."""

from assoc_hull.plot.lines_plan import lines_plan

__all__ = ["lines_plan"]
