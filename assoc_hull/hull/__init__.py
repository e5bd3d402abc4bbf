"""The public hull: its class, where hulls come from, what its methods give back, its pictures."""

from assoc_hull.hull.hull import Hull

__all__ = ["Hull"]
