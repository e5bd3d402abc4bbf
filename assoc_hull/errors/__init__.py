"""The errors this package raises: one small family, each also the fitting builtin.

Every message says what is wrong, where, how much, and what to do; the same facts are
fields of the exception, so a program need not read the text.

Examples
--------
>>> from assoc_hull.errors import UnknownNameError
>>> error = UnknownNameError("line", "WL 9", ("WL 0.5", "WL 1"))
>>> isinstance(error, KeyError) and isinstance(error, AssocHullError)
True
>>> str(error)
"there is no line named 'WL 9'; the nearest names are 'WL 1', 'WL 0.5'"
"""

from assoc_hull.errors.aiming import DependentTargetsError, TooFewFreeError, UnreachableError
from assoc_hull.errors.classical import GeometryError
from assoc_hull.errors.family import (
    AbsentParameterError,
    AssocHullError,
    BadInputError,
    CoincidentPointsError,
    DamagedFileError,
    FileBusyError,
    FoldError,
    ForeignPointError,
    FreedomError,
    HullFileError,
    MissingExtraError,
    NameTakenError,
    NeedsCadError,
    NoMeetingError,
    OutOfRangeError,
    PointRoleError,
    RefusedEditError,
    RingError,
    StaleHullError,
    TooFewPointsError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.errors.forms import DegenerateEndsError, NoMiddleVertexError
from assoc_hull.errors.meshes import OpenMeshError, OpenNetError
from assoc_hull.errors.regions import DanglingArcError

__all__ = [
    "AbsentParameterError",
    "AssocHullError",
    "BadInputError",
    "CoincidentPointsError",
    "DamagedFileError",
    "DanglingArcError",
    "DegenerateEndsError",
    "DependentTargetsError",
    "FileBusyError",
    "FoldError",
    "ForeignPointError",
    "FreedomError",
    "GeometryError",
    "HullFileError",
    "MissingExtraError",
    "NameTakenError",
    "NeedsCadError",
    "NoMeetingError",
    "NoMiddleVertexError",
    "OpenMeshError",
    "OpenNetError",
    "OutOfRangeError",
    "PointRoleError",
    "RefusedEditError",
    "RingError",
    "StaleHullError",
    "TooFewFreeError",
    "TooFewPointsError",
    "UnknownNameError",
    "UnreachableError",
    "WrongTypeError",
]

# A program meets an error by the path from which it is imported, also in tracebacks and logs.
for _name in __all__:
    globals()[_name].__module__ = __name__
del _name
