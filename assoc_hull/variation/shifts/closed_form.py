"""The closed form of a shift: sizes from volume and moment, certified, or the limits.

A task is two changes that are asked for: of the whole hull (volume and centre), or of fore and
after body each on its own. It is solved for the sizes c_f and c_a (m, + forward) of the shift, and
1 + delta' is certified. A shift whose sections would cross is refused, with the largest change
that can be had.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol

import attrs
import numpy as np

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.variation.certificate.fold_check import Certificate, certify
from assoc_hull.variation.shifts.shift_terms import ShiftTerms
from assoc_hull.variation.shifts.shifted_areas import ShiftSums, VolumeElements

__all__ = [
    "CertifiedShift",
    "HalfBodyTask",
    "ShiftTask",
    "WholeHullTask",
    "certify_shift",
    "closed_form",
]


class ShiftTask(Protocol):
    """Two changes that are to be had together.

    `changes` are what is asked for, `words` says of each what it is a change of, with its unit.
    """

    @property
    def changes(self) -> tuple[float, float]:
        """What is asked for."""
        ...

    @property
    def words(self) -> tuple[str, str]:
        """Unit and quantity of each, as in "a change of 0.02 in CB"."""
        ...

    def sizes(self, changes: tuple[float, float]) -> FloatArray | None:
        """Give c_f and c_a, (2,), m, for changes; None where there are none."""
        ...


@attrs.frozen(eq=False)
class WholeHullTask:
    """A change of the volume of the whole hull, and of its centre.

    Attributes
    ----------
    elements, sums
        Of the curve of areas.
    block : float, m3
        L B T.
    length : float, m
        L.
    cb : float
        By how much the block coefficient is to change.
    lcb : float, % of L
        By how much the centre is to move, + forward.

    Examples
    --------
    >>> from assoc_hull.variation.shifts.shifted_areas import VolumeElements
    >>> from assoc_hull.variation.shifts.shifted_areas import ShiftSums
    >>> from assoc_hull.variation.shifts.closed_form import WholeHullTask
    >>> from assoc_hull.variation.shifts.shift_terms import ShiftTerms, Terminals
    >>> terms = ShiftTerms(Terminals(0.0, 5.0, 5.0, 10.0), "lackenby")
    >>> curve = VolumeElements.of(lambda x: x * (10.0 - x), terms.nodes, 5.0)
    >>> task = WholeHullTask(curve, ShiftSums.of(curve, terms), 250.0, 10.0, cb=0.02, lcb=0.0)
    >>> task.sizes(task.changes).round(9).tolist()
    [0.6, -0.6]
    """

    elements: VolumeElements
    sums: ShiftSums
    block: float
    length: float
    cb: float
    lcb: float

    @property
    def changes(self) -> tuple[float, float]:
        """Of CB, and of LCB in % of L."""
        return self.cb, self.lcb

    @property
    def words(self) -> tuple[str, str]:
        """What they change."""
        return "in CB", "% Lpp in LCB"

    def sizes(self, changes: tuple[float, float]) -> FloatArray | None:
        """Give c_f and c_a, (2,), m."""
        volume = self.elements.total + changes[0] * self.block
        centre = self.elements.moment / self.elements.total + 0.01 * changes[1] * self.length
        return self.sums.whole(volume, centre * volume)


@attrs.frozen(eq=False)
class HalfBodyTask:
    """Changes of the volumes of fore and after body, each on its own.

    Attributes
    ----------
    elements, sums
        Of the curve of areas.
    prism : float, m3
        Area of the largest section times L / 2.
    fore, aft : float
        By how much the prismatic coefficients of the bodies are to change.
    """

    elements: VolumeElements
    sums: ShiftSums
    prism: float
    fore: float
    aft: float

    @property
    def changes(self) -> tuple[float, float]:
        """Of the prismatic coefficients of fore and after body."""
        return self.fore, self.aft

    @property
    def words(self) -> tuple[str, str]:
        """What they change."""
        return "in CP of the fore body", "in CP of the after body"

    def sizes(self, changes: tuple[float, float]) -> FloatArray | None:
        """Give c_f and c_a, (2,), m."""
        fore, aft = changes
        bodies = self.elements.bodies.copy()
        bodies[0] += fore * self.prism
        bodies[1] += aft * self.prism
        return self.sums.each(bodies)


_WHERE = "in shift_sections"

_SAMPLES = 4001
"""Places among which the largest movement is sought."""

_FINE = 2.0**-20
"""The largest change is found to this part of itself."""

_FARTHEST = 8
"""A range is doubled so many times at most while its end is sought; then it has none."""


@attrs.frozen(eq=False)
class CertifiedShift:
    """A shift that is certified.

    Attributes
    ----------
    terms : ShiftTerms
        Its parts.
    sizes : (2,), m
        c_f and c_a.
    certificate : Certificate
        Of 1 + delta', on all the way between the terminals.
    """

    terms: ShiftTerms
    sizes: FloatArray
    certificate: Certificate

    def __attrs_post_init__(self) -> None:
        freeze(self.sizes)

    @property
    def least(self) -> float:
        """The least 1 + delta'."""
        return self.certificate.least

    @property
    def largest(self) -> float:
        """The largest movement of a section, m."""
        at = self.terms.terminals
        x = np.concatenate([np.linspace(at.aft, at.fore, _SAMPLES), self.terms.tops])
        return float(np.abs(self.moved(x)).max())

    def moved(self, x: FloatArray) -> FloatArray:
        """Give by how much sections at x (n,), m, move, (n,), m, + forward."""
        moved = np.zeros(len(x))
        for each in self.terms.sized(*self.sizes.tolist()):
            moved += each.at(x)
        return moved


def certify_shift(terms: ShiftTerms, sizes: FloatArray, margin: float) -> Certificate:
    """Check that 1 + delta' reaches a margin between the terminals, of sizes (2,), m.

    It is a polynomial between the nodes: its Bernstein coefficients enclose it.
    """
    at = terms.terminals
    box = np.array([[at.aft, 0.0, 0.0], [at.fore, 1.0, 1.0]])
    return certify(terms.layer(*sizes.tolist()), box, margin)


def closed_form(task: ShiftTask, terms: ShiftTerms, margin: float = 0.0) -> CertifiedShift:
    """Solve for the sizes of a shift.

    Parameters
    ----------
    task : WholeHullTask or HalfBodyTask
        What is asked for.
    terms : ShiftTerms
        What sections move by; the same that the sums of the task were made of.
    margin : float
        What 1 + delta' must be more than everywhere; where it is zero, sections cross.

    Raises
    ------
    OutOfRangeError
        Sections would cross, or no shift gives what is asked for; with the range that can be had.

    Examples
    --------
    >>> from assoc_hull.variation.shifts.shifted_areas import VolumeElements
    >>> from assoc_hull.variation.shifts.closed_form import closed_form
    >>> from assoc_hull.variation.shifts.shifted_areas import ShiftSums
    >>> from assoc_hull.variation.shifts.closed_form import WholeHullTask
    >>> from assoc_hull.variation.shifts.shift_terms import ShiftTerms, Terminals
    >>> terms = ShiftTerms(Terminals(0.0, 5.0, 5.0, 10.0), "lackenby")
    >>> curve = VolumeElements.of(lambda x: x * (10.0 - x), terms.nodes, 5.0)
    >>> found = closed_form(
    ...     WholeHullTask(curve, ShiftSums.of(curve, terms), 250.0, 10.0, 0.02, 0.0), terms
    ... )
    >>> found.sizes.round(9).tolist(), round(found.least, 9)
    ([0.6, -0.6], 0.88)
    """
    found = _tried(task.sizes(task.changes), terms, margin)
    if isinstance(found, CertifiedShift):
        return found
    raise _refusal(task, terms, margin, found)


def _tried(
    sizes: FloatArray | None, terms: ShiftTerms, margin: float
) -> CertifiedShift | Certificate | None:
    """Give the shift of sizes; the certificate that refuses it; None if there are no sizes."""
    if sizes is None or not np.isfinite(sizes).all():
        return None
    found = certify_shift(terms, sizes, margin)
    return CertifiedShift(terms, sizes, found) if found.certified else found


def _refusal(
    task: ShiftTask, terms: ShiftTerms, margin: float, found: Certificate | None
) -> OutOfRangeError | BadInputError:
    """Say which of two changes is too large, and between which limits it works."""

    def works(changes: tuple[float, float]) -> bool:
        return isinstance(_tried(task.sizes(changes), terms, margin), CertifiedShift)

    first, second = task.changes
    # blame the first beside the second, else the second beside the first, else the second alone
    ways = _Way(0, (0.0, second)), _Way(1, (first, 0.0)), _Way(1, (0.0, 0.0))
    way = next((each for each in ways if works(each.foot)), None)
    if way is None:
        return _given_folds(terms, margin)
    asked = task.changes[way.blamed]
    least, most = (_end(lambda t: works(way.at(t)), sign * abs(asked)) for sign in (-1.0, 1.0))
    why = _why(task, way, found, margin)
    return OutOfRangeError("a change", asked, _WHERE, why, least, most, task.words[way.blamed])


@attrs.frozen
class _Way:
    """A pair of changes, one of them varying from zero.

    Attributes
    ----------
    blamed : {0, 1}
        Which varies.
    foot : (float, float)
        Both, where that is zero.
    """

    blamed: int
    foot: tuple[float, float]

    def at(self, t: float) -> tuple[float, float]:
        """Give both changes where the one is t."""
        return (t, self.foot[1]) if self.blamed == 0 else (self.foot[0], t)


def _why(task: ShiftTask, way: _Way, found: Certificate | None, margin: float) -> str:
    """Say why a change cannot be had: no shift gives it, sections cross, or they come too near."""
    other = 1 - way.blamed
    asked = task.changes[other]
    beside = f" beside {asked:+.6g} {task.words[other]}" if asked else ""
    alone = f", even without {beside.removeprefix(' beside ')}" if asked != way.foot[other] else ""
    if found is None:
        return f"is out of reach{alone or beside}: no shift gives it"
    at = f"at x={found.witness[0]:.2f} m (1+delta'={found.least:.3f})"
    if found.least <= 0.0:
        return f"makes sections cross {at}{alone or beside}"
    return f"leaves less than {margin:g} of the distance of sections {at}{alone or beside}"


def _given_folds(terms: ShiftTerms, margin: float) -> BadInputError:
    """Refuse what moves the ends of the parallel body too far."""
    found = certify_shift(terms, np.zeros(2), margin)
    if not found.certified:
        what = f"moving the ends of the parallel body by {terms.start:+g} and {terms.end:+g} m"
        at = f"makes sections cross at x={found.witness[0]:.2f} m (1+delta'={found.least:.3f})"
        return BadInputError(f"{what} {at}", _WHERE, "move them less, or set the terminals wider")
    return BadInputError(
        "no shift holds volume and its centre while the ends of the parallel body move", _WHERE,
        "move them less, or set the terminals wider",
    )  # fmt: skip


def _end(works: Callable[[float], bool], far: float) -> float:
    """Find by bisection how far a change works, from zero outward; infinite if without end."""
    near = 0.0
    for _ in range(_FARTHEST):
        if not works(far):
            break
        near, far = far, 2.0 * far
    else:
        return math.copysign(math.inf, far)
    while abs(far - near) > _FINE * abs(far):
        half = 0.5 * (near + far)
        near, far = (half, far) if works(half) else (near, half)
    return _inward(near)


def _inward(value: float) -> float:
    """Round toward zero to six digits, so that the reported limit can be had."""
    if value == 0.0:
        return 0.0
    unit = 10.0 ** (math.floor(math.log10(abs(value))) - 5)
    return math.copysign(math.floor(abs(value) / unit) * unit, value)
