"""The root of the errors, and all of them that no subject has to itself."""

from __future__ import annotations

import math

import attrs

__all__ = [
    "AbsentParameterError",
    "AssocHullError",
    "BadInputError",
    "CoincidentPointsError",
    "DamagedFileError",
    "FileBusyError",
    "FoldError",
    "ForeignPointError",
    "FreedomError",
    "HullFileError",
    "MissingExtraError",
    "NameTakenError",
    "NoMeetingError",
    "OutOfRangeError",
    "PointRoleError",
    "RefusedEditError",
    "RingError",
    "StaleHullError",
    "TooFewPointsError",
    "UnknownNameError",
    "WrongTypeError",
]


class AssocHullError(Exception):
    """The root of the family: catch this to catch every error the package raises."""


@attrs.define(slots=False, eq=False)
class BadInputError(AssocHullError, ValueError):
    """A value handed in cannot be used.

    Attributes
    ----------
    what : str
        What is wrong, with the number.
    where : str
        The object, file row or argument that holds the value.
    remedy : str
        What to do about it.
    """

    what: str
    where: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.what}, {self.where}; {self.remedy}"


@attrs.define(slots=False, eq=False)
class NeedsCadError(BadInputError):
    """A file holds surfaces that only a CAD kernel takes apart, such as trimmed ones."""


@attrs.define(slots=False, eq=False)
class WrongTypeError(BadInputError, TypeError):
    """A value of another type than can be used."""


@attrs.define(slots=False, eq=False)
class AbsentParameterError(BadInputError, KeyError):
    """A parameter was asked for that this hull does not have."""


def _span(least: float, most: float, unit: str) -> str:
    """Give an interval in words; an infinite end is not told."""
    unit = f" {unit}" if unit else ""
    if math.isinf(most):
        return f"from {least:.8g}{unit} up"
    if math.isinf(least):
        return f"up to {most:.8g}{unit}"
    return f"from {least:.8g} to {most:.8g}{unit}"


@attrs.define(slots=False, eq=False)
class OutOfRangeError(AssocHullError, ValueError):
    """A number lies outside the range that has a meaning for this hull.

    Attributes
    ----------
    name, where : str
        Of the number: what it is, and for what else given.
    value : float
        As it was given.
    least, most : float
        The admissible range.
    unit : str
        Of the three numbers.
    why : str
        What is wrong with the value.
    """

    name: str
    value: float
    where: str
    why: str
    least: float
    most: float
    unit: str

    def __str__(self) -> str:
        size = f"{self.value:.8g} {self.unit}".rstrip()
        what = f"{self.name} of {size} {self.why}".rstrip()
        return f"{what}, {self.where}; give one {_span(self.least, self.most, self.unit)}"


@attrs.define(slots=False, eq=False)
class DamagedFileError(BadInputError):
    """A hull file that does not hold what was written to it."""


@attrs.define(slots=False, eq=False)
class HullFileError(AssocHullError, OSError):
    """A file could not be reached, read or written; what was in it is there still."""

    path: str
    what: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.what}, at {self.path}; {self.remedy}"


@attrs.define(slots=False, eq=False)
class FileBusyError(AssocHullError, TimeoutError):
    """Another process is writing to a hull file; `waited` says for how long (s) it was waited."""

    path: str
    waited: float

    def __str__(self) -> str:
        return (
            f"{self.path} is being edited by another process (waited {self.waited:g} s); "
            "try again, or open it with a longer wait"
        )


@attrs.define(slots=False, eq=False)
class StaleHullError(AssocHullError, RuntimeError):
    """A hull file has moved on since it was opened, by edits `newer`; nothing was changed."""

    path: str
    newer: tuple[str, ...]

    def __str__(self) -> str:
        count = len(self.newer)
        what = f"{count} edit(s), the last {self.newer[-1]!r}" if count else "an undo or a redo"
        return (
            f"{self.path} has moved on since it was opened, by {what}; "
            "call refresh() and look at the hull again before you edit it"
        )


@attrs.define(slots=False, eq=False)
class TooFewPointsError(AssocHullError, ValueError):
    """A curve has fewer than two points."""

    curve: str
    count: int

    def __str__(self) -> str:
        return f"{self.curve} has {self.count} defining point(s); a curve needs two or more"


@attrs.define(slots=False, eq=False)
class CoincidentPointsError(AssocHullError, ValueError):
    """Two neighbouring points of one curve lie closer than they may (m)."""

    curve: str
    position: tuple[float, float, float]
    distance: float
    limit: float

    def __str__(self) -> str:
        x, y, z = self.position
        return (
            f"two neighbouring points of {self.curve} at ({x:.4f}, {y:.4f}, {z:.4f}) m lie "
            f"{self.distance:.3g} m apart, closer than {self.limit:.3g} m; delete one of them"
        )


@attrs.define(slots=False, eq=False)
class NameTakenError(AssocHullError, ValueError):
    """A name that must be unique is in use."""

    kind: str
    name: str

    def __str__(self) -> str:
        return f"a {self.kind} named {self.name!r} exists already; choose another name"


@attrs.define(slots=False, eq=False)
class UnknownNameError(AssocHullError, KeyError):
    """No object of this kind has this name or id."""

    kind: str
    name: str
    known: tuple[str, ...] = ()
    meant: str = ""

    def __str__(self) -> str:
        import difflib  # a message only: what merely starts does not wait for it

        if self.meant:
            return f"there is no {self.kind} named {self.name!r}; it is called {self.meant!r}"
        near = difflib.get_close_matches(str(self.name), self.known, n=3, cutoff=0.4)
        hint = "the nearest names are " + ", ".join(map(repr, near)) if near else "list them first"
        return f"there is no {self.kind} named {self.name!r}; {hint}"


@attrs.define(slots=False, eq=False)
class FreedomError(AssocHullError, ValueError):
    """A point was to be moved along a coordinate in which it is not free."""

    point: str
    asked: tuple[str, ...]
    free: tuple[str, ...]

    def __str__(self) -> str:
        asked, free = ", ".join(self.asked) or "nothing", ", ".join(self.free) or "nothing"
        return f"{self.point} is free along {free}, and {asked} was asked; give exactly {free}"


@attrs.define(slots=False, eq=False)
class PointRoleError(AssocHullError, ValueError):
    """The role of a point forbids the edit: it is computed, or it is a crossing.

    Attributes
    ----------
    point, role : str
        The point and its present role.
    driver : str or None
        The curve that the point is computed from.
    remedy : str
        The ways out.
    """

    point: str
    role: str
    driver: str | None
    remedy: str

    def __str__(self) -> str:
        source = f", computed from {self.driver}" if self.driver else ""
        return f"{self.point} is {self.role}{source}; {self.remedy}"


@attrs.define(slots=False, eq=False)
class ForeignPointError(AssocHullError, ValueError):
    """A handle belongs to another hull, or its object has gone."""

    handle: str

    def __str__(self) -> str:
        return f"{self.handle} does not exist in this hull (any more); look it up again"


@attrs.define(slots=False, eq=False)
class NoMeetingError(AssocHullError, ValueError):
    """A plane or line meets nothing where it was asked to, or `touches` an end only."""

    what: str
    nearest: float
    remedy: str
    touches: bool = False

    def __str__(self) -> str:
        if self.touches:
            return f"{self.what} only touches what it was to cut; {self.remedy}"
        return f"{self.what} meets nothing (nearest {self.nearest:.4g} m away); {self.remedy}"


@attrs.define(slots=False, eq=False)
class RingError(AssocHullError, ValueError):
    """Driven links would run in a ring; `path` names the nodes, first again at the end."""

    path: tuple[str, ...]

    def __str__(self) -> str:
        ring = " -> ".join(self.path)
        return f"these drive one another in a ring: {ring}; make one of the links two-way"


@attrs.define(slots=False, eq=False)
class RefusedEditError(AssocHullError, RuntimeError):
    """An edit would have left the hull inconsistent; nothing was changed.

    Attributes
    ----------
    edit : str
        The name of the edit.
    findings : tuple of str
        Every reason, each naming curve, crossing, cause and number.
    """

    edit: str
    findings: tuple[str, ...]

    def __str__(self) -> str:
        more = f" (and {len(self.findings) - 1} more)" if len(self.findings) > 1 else ""
        return f"edit {self.edit!r} refused, the hull is unchanged: {self.findings[0]}{more}"


@attrs.define(slots=False, eq=False)
class FoldError(AssocHullError, ValueError):
    """A map would fold the hull, or come too near to it; nothing was changed.

    Attributes
    ----------
    reason : {"folds", "thin", "undecided"}
    minor : str
        The minor of the Jacobian that is too small: ``"Z_z"`` is by how much heights stretch.
    least, margin : float
        Its value at the witness, and what it must reach.
    witness : (float, float, float), m
        Where.
    layer, field : str
        Of the map; the field is empty if there is none.
    between : tuple of (str, float)
        Boundary curves of the field below and above the witness, with their heights, m.
    node : float or None, m
        The nearest node along the ship.
    interval, unit : (float, float) or None, {"m", "deg"}
        Between these values the named parameter at fault may be asked for alone; infinite where
        nothing ends it.
    part : float or None
        So much of all changes that were asked for together is allowed, if each alone is.
    """

    reason: str
    minor: str
    least: float
    margin: float
    witness: tuple[float, float, float]
    layer: str
    field: str = ""
    between: tuple[tuple[str, float], ...] = ()
    node: float | None = None
    interval: tuple[float, float] | None = None
    unit: str = "m"
    part: float | None = None

    def __str__(self) -> str:
        x, y, z = self.witness
        at = f"x={x:.3f}" + (f" y={y:.3f}" if y else "") + f" z={z:.3f}"
        text = f"variation: '{self.field or self.layer}' {self._verdict()} at {at}"
        text += f" ({self.minor}={self.least:.3f})"
        if self.between:
            walls = " and ".join(f"'{name}' ({height:.3f})" for name, height in self.between)
            text += f" {'between' if len(self.between) > 1 else 'beyond'} {walls}"
        if self.node is not None:
            text += f", node x={self.node:.3f}"
        return f"{text}; {self._remedy()}"

    def _verdict(self) -> str:
        words = {"folds": "folds", "thin": f"leaves less than {self.margin:g}"}
        return words.get(self.reason, "is not decided: bounds too wide")

    def _remedy(self) -> str:
        if self.part is not None:
            return f"not beside the others asked for: admissible {100.0 * self.part:.3g} % of each"
        if self.interval is not None:
            low, high = (
                inward(1e3 * end) / 1e3 if math.isfinite(end) else end
                for inward, end in zip((math.ceil, math.floor), self.interval, strict=True)
            )
            return f"admissible {self.field or self.layer} {_span(low, high, self.unit)}"
        return "ask for less, or let the field reach further"


@attrs.define(slots=False, eq=False)
class MissingExtraError(AssocHullError, ImportError):
    """An optional library is not installed."""

    library: str
    extra: str

    def __str__(self) -> str:
        return f"{self.library} is not installed; run: pip install 'assoc-hull[{self.extra}]'"
