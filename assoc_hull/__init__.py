"""Associative ship hull forms: lines that follow one another when one is changed.

Examples
--------
>>> import assoc_hull as ah
>>> hull = ah.examples.wigley()
>>> hull.points["WL 2.5 x ST 7"].free
('y',)
"""

from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    ForeignPointError,
    FreedomError,
    NoMeetingError,
    PointRoleError,
    RefusedEditError,
    RingError,
    UnknownNameError,
)
from assoc_hull.geometry.curves import PointKind
from assoc_hull.geometry.plane import Plane
from assoc_hull.hull import Hull, examples, open, read
from assoc_hull.model.family import BoundaryKind
from assoc_hull.model.handles import Crossing, Curve, Group, Line, Point
from assoc_hull.model.source import LineSource
from assoc_hull.model.state import Association, Ends, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = [
    "AssocHullError",
    "Association",
    "BadInputError",
    "BoundaryKind",
    "Crossing",
    "Curve",
    "Ends",
    "ForeignPointError",
    "FreedomError",
    "Group",
    "Hull",
    "Line",
    "LineSource",
    "NoMeetingError",
    "Particulars",
    "Plane",
    "Point",
    "PointKind",
    "PointRoleError",
    "RefusedEditError",
    "RingError",
    "Tolerances",
    "UnknownNameError",
    "__version__",
    "examples",
    "open",
    "read",
]

__version__ = "0.1.0"
