"""The errors this package raises: one small family, each also the fitting builtin.

Every message says what is wrong, where, how much, and what to do; the same facts are fields
of the exception, so a program need not read the text. `AssocHullError` is the root; each
error is also a `ValueError`, `KeyError`, `OSError` or the like. First come those that
many parts raise, then those of one subject.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import attrs

__all__ = [
    "AbsentParameterError",
    "AssocHullError",
    "BadInputError",
    "BlockedRunError",
    "ClusterError",
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
    "HullBusyError",
    "HullFileError",
    "MissingExtraError",
    "NameTakenError",
    "NeedsCadError",
    "NoMeetingError",
    "NoMiddleVertexError",
    "NotSoundError",
    "OpenMeshError",
    "OpenNetError",
    "OutOfRangeError",
    "PointRoleError",
    "RefusedEditError",
    "RefusedSetError",
    "RingError",
    "StaleHullError",
    "StudyBusyError",
    "TooFewFreeError",
    "TooFewPointsError",
    "UnknownNameError",
    "UnreachableError",
    "WrongTypeError",
]


class AssocHullError(Exception):
    """The root of the family: catch this to catch every error the package raises."""

    def _render_traceback_(self) -> list[str]:
        # Asked by IPython: the caller's lines and one line of ours, our frames folded.
        import traceback
        from pathlib import Path

        own = f"{Path(__file__).parent}"
        frames = [
            each
            for each in traceback.extract_tb(self.__traceback__)
            if not each.filename.startswith(own) and "IPython" not in each.filename
        ]
        told = [f"line {each.lineno}: {each.line}" for each in frames if each.line]
        return [*told, f"{type(self).__name__}: {self}"]


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
    """Give an interval in words; an infinite end is left out."""
    unit = f" {unit}" if unit else ""
    if math.isinf(most):
        return f"from {_inward(least, least, math.ceil):.8g}{unit} up"
    if math.isinf(least):
        return f"up to {_inward(most, most, math.floor):.8g}{unit}"
    size = max(abs(least), abs(most))
    low, high = _inward(least, size, math.ceil), _inward(most, size, math.floor)
    if not low < high:  # too near one another to be rounded
        low, high = least, most
    return f"from {low:.8g} to {high:.8g}{unit}"


_DIGITS = 6
"""Digits of the ends of intervals."""


def _inward(end: float, size: float, way: Callable[[float], int]) -> float:
    """Round an end of an interval to the digits of a size, inward: what is told can be had."""
    if not size or not math.isfinite(size):
        return end
    places = _DIGITS - 1 - math.floor(math.log10(abs(size)))
    scaled = end * 10.0**places
    near = round(scaled)
    whole = near if abs(scaled - near) <= 1e-6 else way(scaled)
    return float(f"{whole}e{-places}")


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
    remedy : str
        What else could be done than give one of the range; mostly nothing.
    """

    name: str
    value: float
    where: str
    why: str
    least: float
    most: float
    unit: str
    remedy: str = ""

    def __str__(self) -> str:
        size = f"{self.value:.8g} {self.unit}".rstrip()
        what = f"{self.name} of {size} {self.why}".rstrip()
        span = f"give one {_span(self.least, self.most, self.unit)}"
        return f"{what}, {self.where}; {span}" + (f", or {self.remedy}" if self.remedy else "")


@attrs.define(slots=False, eq=False)
class RefusedSetError(BadInputError):
    """Values that were asked for together cannot be had together; the hull is unchanged.

    Attributes
    ----------
    leave_out : str or None
        The value of which leaving it out lets all others be had; None if none does alone.
    part : float
        So much of all changes together can be had, 0 to 1.
    values : mapping of str to float
        What that makes of the values; m or degrees.
    """

    leave_out: str | None
    part: float
    values: Mapping[str, float]


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
class StudyBusyError(FileBusyError):
    """Another process, or another call, is adding rows to the file of a study."""

    def __str__(self) -> str:
        return f"another study is writing to {self.path}; wait until it ends, or name another file"


@attrs.define(slots=False, eq=False)
class ClusterError(AssocHullError, ConnectionError):
    """A cluster cannot be reached, or has failed; rows that have landed in a file stay.

    Attributes
    ----------
    address : str
        Of its scheduler.
    what : str
        What is wrong.
    remedy : str
        What to do about it.
    """

    address: str
    what: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.what}, at {self.address}; {self.remedy}"


@attrs.define(slots=False, eq=False)
class HullBusyError(AssocHullError, TimeoutError):
    """Another thread, or another task of this one, is editing a hull; nothing was changed.

    Attributes
    ----------
    what : str
        What it is at: an edit by its name, or another act.
    author : str
        Who edits there; empty if nobody was named.
    waited : float
        For how long it was waited, s.
    where : str
        What was to be done.
    same_thread : bool
        Whether it is a task of the same thread: waiting would stop the loop that it needs.
    """

    what: str
    author: str
    waited: float
    where: str
    same_thread: bool = False

    def __str__(self) -> str:
        who = "another task of this thread" if self.same_thread else "another thread"
        by = f" of {self.author}" if self.author else ""
        remedy = (
            "use async with hull.edit(...), which waits for it"
            if self.same_thread
            else "try again, or give the edit a longer wait="
        )
        return (
            f"{who} is at work on this hull: {self.what}{by} (waited {self.waited:.3g} s), "
            f"{self.where}; {remedy}"
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
            f"{self.distance:.3g} m apart, closer than {self.limit:.3g} m; delete one of them, "
            "or in an edit ask for a smaller move"
        )


@attrs.define(slots=False, eq=False)
class NameTakenError(AssocHullError, ValueError):
    """A name that must be unique is in use."""

    kind: str
    name: str

    def __str__(self) -> str:
        return f"a {self.kind} named {self.name!r} exists already; choose another name"


_FEW_NAMES = 8
"""So many names a message gives where none is like the one that was asked for."""


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
        hint = "the nearest names are " + ", ".join(map(repr, near)) if near else self._all()
        return f"there is no {self.kind} named {self.name!r}; {hint}"

    def _all(self) -> str:
        """Give the names there are, the first of many."""
        if not self.known:
            return "there is none of any name"
        more = len(self.known) - _FEW_NAMES
        tail = f" and {more} more" if more > 0 else ""
        return f"there are {', '.join(map(repr, self.known[:_FEW_NAMES]))}{tail}"


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
class BlockedRunError(AssocHullError, ValueError):
    """Something on a line is in the way of a run that was to be drawn.

    Attributes
    ----------
    line : str
        The line.
    points : tuple of str
        The points in the way.
    why, remedy : str
        What is the matter with them, and what to do.
    """

    line: str
    points: tuple[str, ...]
    why: str
    remedy: str

    def __str__(self) -> str:
        more = f" and {len(self.points) - 3} more" if len(self.points) > 3 else ""
        return f"{self.line}: {self.why} ({', '.join(self.points[:3])}{more}); {self.remedy}"


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
    fair : (float, float) or None, {"m", "deg"}
        Between these of them lines stay about as fair as they are.
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
    fair: tuple[float, float] | None = None

    def __str__(self) -> str:
        x, y, z = self.witness
        at = f"x={x:.3f}" + (f" y={y:.3f}" if y else "") + f" z={z:.3f}"
        text = f"variation: '{self.field or self.layer}' {self._verdict()} at {at}"
        text += f" ({_COME_OUT[self.minor].format(f'{self.least:.3f}')})"
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
            told = f"admissible {self.field or self.layer} {self._within(self.interval)}"
            if self.fair is None or self.fair == self.interval:
                return told
            return f"{told}, with fair lines {self._within(self.fair)}"
        return "ask for less, or let the field reach further"

    def _within(self, ends: tuple[float, float]) -> str:
        # to three decimals, inward: a value that the message admits must be admitted
        low, high = (
            inward(1e3 * end) / 1e3 if math.isfinite(end) else end
            for inward, end in zip((math.ceil, math.floor), ends, strict=True)
        )
        return _span(low, high, self.unit)


_COME_OUT = {
    "X_x": "places along the ship come out {} times as far apart",
    "Y_y": "half-breadths come out {} times as far apart",
    "Z_z": "heights come out {} times as far apart",
    "D": "areas in profile come out {} times as large",
}
"""What a minor of a map tells of the hull, by its name."""


@attrs.define(slots=False, eq=False)
class MissingExtraError(AssocHullError, ImportError):
    """An optional library is not installed."""

    library: str
    extra: str

    def __str__(self) -> str:
        return f"{self.library} is not installed; run: pip install 'assoc-hull[{self.extra}]'"


# --------------------------------------------------------------------------------------
# Form-parameter curves: no middle vertex gives what was asked for.


@attrs.define(slots=False, eq=False)
class DegenerateEndsError(AssocHullError, ValueError):
    """The area under a form-parameter curve does not depend on its middle vertex.

    Attributes
    ----------
    where : str
        The curve.
    area : float
        As asked for, in square units of the plane.
    only : float
        The one area that the curve has with these ends.
    """

    where: str
    area: float
    only: float

    def __str__(self) -> str:
        return (
            f"the two ends leave the area at {self.only:.8g} whatever the middle vertex, and "
            f"{self.area:.8g} was asked for, in {self.where}; change a tangent length or an angle"
        )


@attrs.define(slots=False, eq=False)
class NoMiddleVertexError(AssocHullError, ValueError):
    """Area and centroid of a form-parameter curve cannot both be met.

    Attributes
    ----------
    where : str
        The curve.
    area, centroid : float
        As asked for; the centroid is the abscissa of that of the area.
    nearest : float
        The nearest centroid that can be reached with this area and these ends.
    discriminant : float
        Of the quadratic equation for the middle vertex, in its own units: below 0.
    """

    where: str
    area: float
    centroid: float
    nearest: float
    discriminant: float

    def __str__(self) -> str:
        way = "up" if self.nearest > self.centroid else "down"
        return (
            f"area {self.area:.8g} and centroid {self.centroid:.8g} cannot both be met, in "
            f"{self.where}; with this area and these ends give a centroid from "
            f"{self.nearest:.8g} {way}"
        )


# --------------------------------------------------------------------------------------
# Classical curves and definitions.


@attrs.define(slots=False, eq=False)
class GeometryError(AssocHullError, ValueError):
    """A classical curve, section or definition cannot be made of what is given.

    Attributes
    ----------
    what : str
        What is wrong, with its numbers; begins with the kind of object ("biarc: ...").
    remedy : str
        What to do about it.
    values : mapping of str to object
        The numbers of the message by name.
    where : str
        Line of a file or name of an object, where one is known; else empty.
    """

    what: str
    remedy: str
    values: Mapping[str, object] = attrs.field(factory=dict)
    where: str = ""

    def __str__(self) -> str:
        place = f", {self.where}" if self.where else ""
        return f"{self.what}{place}; {self.remedy}"

    def at(self, where: str) -> GeometryError:
        """Give the same error with the place it was found at, unless it has one."""
        return GeometryError(self.what, self.remedy, self.values, self.where or where)


# --------------------------------------------------------------------------------------
# Aiming: what cannot be reached, and why.


@attrs.define(slots=False, eq=False)
class TooFewFreeError(AssocHullError, ValueError):
    """There are more targets than free parameters; numbers of both."""

    targets: int
    free: int

    def __str__(self) -> str:
        return (
            f"aim: {self.targets} targets need at least {self.targets} free parameters for an "
            f"exact answer ({self.free} given); the best compromise is returned only with "
            "exact=False (--compromise)"
        )


@attrs.define(slots=False, eq=False)
class DependentTargetsError(AssocHullError, ValueError):
    """Free parameters move some targets only together, or one not at all; nothing was changed.

    Attributes
    ----------
    targets : tuple of str
        Their names; one name where nothing moves it.
    condition : float
        Of the scaled derivatives; infinite where they have no full rank.
    """

    targets: tuple[str, ...]
    condition: float

    def __str__(self) -> str:
        if len(self.targets) == 1:
            return f"aim: no free parameter moves {self.targets[0]}; drop it or free another one"
        size = f"{self.condition:.0e}".replace("e+0", "e").replace("e+", "e")  # 1e+09 is 1e9
        return (
            f"aim: targets {_in_words(self.targets)} move together (condition {size}); drop one "
            "or free another parameter"
        )


@attrs.define(slots=False, eq=False)
class UnreachableError(AssocHullError, ValueError):
    """A target cannot be reached by what is free; nothing was changed.

    Attributes
    ----------
    target, unit : str
        The one that is farthest from what was asked, in the scale of its usual size; "-" and
        nothing stand for no unit.
    asked, best, before : float
        Asked for, of the nearest hull, and of the parent.
    bounds : tuple of str
        Free parameters at their bounds.
    why : str
        What keeps the hull from coming nearer where no bound does; may be empty.
    """

    target: str
    unit: str
    asked: float
    best: float
    before: float
    bounds: tuple[str, ...] = ()
    why: str = ""

    @property
    def shortfall(self) -> float:
        """How far the nearest hull is above what was asked, in per cent of the parent."""
        return 100.0 * (self.best - self.asked) / abs(self.before) if self.before else float("inf")

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit not in ("", "-") else ""
        # as many digits as tell the two numbers apart
        digits = next(
            (n for n in (6, 8, 10, 12) if f"{self.asked:.{n}g}" != f"{self.best:.{n}g}"), 17
        )
        more = "more" if self.shortfall > 0.0 else "less"
        amount = f"{abs(self.shortfall):.3g} % of the parent's value"
        short = f" ({amount} {more} than asked)" if self.before else ""
        return (
            f"{self.target} cannot be brought to {self.asked:.{digits}g}{unit}: the nearest is "
            f"{self.best:.{digits}g}{unit}{short}{self._reason()}"
        )

    def _reason(self) -> str:
        parts, remedy = list[str](), "free another parameter, or ask for less"
        if self.bounds:
            end, wider = ("its bound", "it") if len(self.bounds) == 1 else ("their bounds", "them")
            parts.append(f", with {_in_words(self.bounds)} at {end}")
            remedy = f"widen {wider}, {remedy}"
        parts.append(f"; {self.why or remedy}")
        return "".join(parts)


def _in_words(names: tuple[str, ...]) -> str:
    """Give names as one speaks them: A, B and C."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


# --------------------------------------------------------------------------------------
# Meshes of a hull.

_SHOWN = 4
"""More findings than these are only counted in the message."""


@attrs.define(slots=False, eq=False)
class OpenNetError(AssocHullError, ValueError):
    """The lines of a hull do not part its surface into cells.

    Attributes
    ----------
    what : str
        What is wrong.
    findings : tuple of str
        The lines or crossings at fault, each with its place; none where none could be found.
    remedy : str
        What to do.
    """

    what: str
    findings: tuple[str, ...]
    remedy: str

    def __str__(self) -> str:
        shown = ", ".join(self.findings[:_SHOWN])
        left = len(self.findings) - _SHOWN
        more = f" and {left} more" if left > 0 else ""
        listed = f": {shown}{more}" if shown else ""
        return f"the lines do not part the hull into cells: {self.what}{listed}; {self.remedy}"


@attrs.define(slots=False, eq=False)
class NotSoundError(AssocHullError, ValueError):
    """A hull that was read from a file, or a surface to be written to one, is not sound.

    Nobody said to take it all the same.

    Attributes
    ----------
    source : str
        The file, or the surface.
    findings : tuple of str
        Everything that is wrong, each with its place and number.
    suspected : bool
        The hull is only under suspicion, and was to be refused for that.
    suspicions : tuple of str
        What looks wrong besides; often it names the cause of the findings.
    """

    source: str
    findings: tuple[str, ...]
    suspected: bool = False
    suspicions: tuple[str, ...] = ()

    @property
    def summary(self) -> str:
        """How many findings there are, where, and what to do; the findings stand elsewhere."""
        word = "suspicion" if self.suspected else "fault"
        count = f"{len(self.findings)} {word}{'' if len(self.findings) == 1 else 's'}"
        return f"{self._verdict()}: {count}, in {self.source}; {self._remedy()}"

    def __str__(self) -> str:
        found = "; ".join(self.findings)
        if self.suspicions:
            found += f"; what looks wrong besides: {'; '.join(self.suspicions)}"
        return f"{self._verdict()}: {found}, in {self.source}; {self._remedy()}"

    def _verdict(self) -> str:
        return "sound with suspicions, and strict" if self.suspected else "not sound"

    def _remedy(self) -> str:
        mend = "mend it" if len(self.findings) == 1 else f"mend these {len(self.findings)}"
        if self.suspected:
            return f"{mend}, or leave out strict"
        return f"{mend}, or take the hull as it is with accept=True (--accept)"


@attrs.define(slots=False, eq=False)
class OpenMeshError(AssocHullError, RuntimeError):
    """A mesh that is not closed has no volume, and is not written.

    Attributes
    ----------
    asked : str
        What was asked of it.
    edges : int
        How many edges are not those of two triangles, once in each sense.
    place : (float, float, float), m
        Where the first of them is.
    remedy : str
        What to do.
    """

    asked: str
    edges: int
    place: tuple[float, float, float]
    remedy: str

    def __str__(self) -> str:
        at = ", ".join(f"{each:.3f}" for each in self.place)
        return (
            f"{self.asked} of a mesh with {self.edges} open edges, the first at ({at}) m; "
            f"{self.remedy}"
        )


# --------------------------------------------------------------------------------------
# Curvature regions.


@attrs.define(slots=False, eq=False)
class DanglingArcError(AssocHullError, ArithmeticError):
    """A line of the zero set breaks off inside a patch, at nothing that explains it.

    Attributes
    ----------
    count : int
        How many ends break off.
    surface, patch : int
        Where the first of them lies.
    uv : (float, float)
        Its parameters on the surface.
    gap : float
        How far the nearest other end is, in parameters of the patch; infinite where there is none.
    """

    count: int
    surface: int
    patch: int
    uv: tuple[float, float]
    gap: float

    def __str__(self) -> str:
        which = "an end" if self.count == 1 else f"{self.count} ends"
        return (
            f"{which} of lines of the zero set break off, the first on surface {self.surface}, "
            f"patch {self.patch}, at u = {self.uv[0]:.9g}, v = {self.uv[1]:.9g}, {self.gap:.3g} of "
            "the patch from the next end; give a larger delta (the uncertainty of control "
            "points), so that noise is taken as zero"
        )
