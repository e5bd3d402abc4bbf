"""The curves of all definitions of a hull by their use, read where a line stands.

A definition becomes a chain of form-parameter curves in the units of the ship, by the rule of
its kind: two halves, or a course. Abscissae are x, m from AP; the ordinate is that of the use
(m2, m, degrees, 1/m). Everything that makes sections and waterlines reads `Forms`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.chain import FormChain
from assoc_hull.geometry.form_curves.shape import least_rate
from assoc_hull.model.form_definition import USES, FormDefinition
from assoc_hull.model.forms.courses import course_vertices
from assoc_hull.model.forms.two_halves import halves_vertices
from assoc_hull.model.tables import Particulars

__all__ = [
    "Forms",
    "chain_of",
]

_SLACK = 1e-9
"""So far (m in t) a course may run backward: rounding."""


def chain_of(definition: FormDefinition, particulars: Particulars) -> FormChain:
    """Give the curve of a definition in the units of the ship.

    Raises
    ------
    OutOfRangeError
        A value between ends that do not admit it, with the interval that they do admit.
    BadInputError
        A value that is missing, a curve that folds back.
    """
    return _chain(definition, particulars.length)


@lru_cache(maxsize=4096)
def _chain(definition: FormDefinition, length: float) -> FormChain:
    where = f"in the definition {definition.name!r}"
    if definition.kind == "halves":
        return _in_the_ship(definition, length, where)
    vertices = course_vertices(definition)
    if definition.use != "profile":  # a bulb or a stern may overhang
        _forward(definition, vertices, where)
    return FormChain(vertices)


def _in_the_ship(definition: FormDefinition, length: float, where: str) -> FormChain:
    """Scale a curve of two halves from its frame (x from -1 to 1, ordinates by ``full``)."""
    full = definition.value("full")
    if full is None or not full > 0.0:
        raise BadInputError(f"full is {full}", where, "give a number above 0")
    vertices = halves_vertices(definition)
    scaled = np.stack([(vertices[..., 0] + 1.0) * (0.5 * length), vertices[..., 1] * full], axis=-1)
    return FormChain(scaled)


def _forward(
    definition: FormDefinition, vertices: np.typing.NDArray[np.float64], where: str
) -> None:
    """Refuse a course with two ordinates at one abscissa."""
    for piece in np.flatnonzero(least_rate(vertices, 0) < -_SLACK).tolist():
        one, two = definition.nodes[piece : piece + 2]
        raise BadInputError(
            f"the course folds back between {one!r} and {two!r}: two ordinates at one x", where,
            "give the nodes by rising x, other angles, or shorter tangents",
        )  # fmt: skip


# --------------------------------------------------------------------------------------
# All definitions of a hull.

_ON_END = 1e-9
"""So near (m) to an end of a course it is met there."""


@attrs.frozen(eq=False)
class Forms:
    """Definitions by use, with their curves.

    Attributes
    ----------
    definitions : mapping of str to FormDefinition
        By use.
    particulars : Particulars
        Of the hull.
    """

    definitions: Mapping[str, FormDefinition]
    particulars: Particulars

    @classmethod
    def of(cls, definitions: Iterable[FormDefinition], particulars: Particulars) -> Self:
        """Gather definitions.

        Raises
        ------
        BadInputError
            Two of one use.
        """
        found: dict[str, FormDefinition] = {}
        for each in definitions:
            if each.use in found:
                raise BadInputError(
                    f"the definition {found[each.use].name!r} is used for {each.use} already",
                    f"in the definition {each.name!r}", "leave one out",
                )  # fmt: skip
            found[each.use] = each
        return cls(MappingProxyType(found), particulars)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        """Let other processes have them: a read-only mapping is not taken along."""
        return Forms.of, (tuple(self.definitions.values()), self.particulars)

    def has(self, use: str) -> bool:
        """Tell whether there is a definition for a use."""
        return use in self.definitions

    def needed(self, use: str, where: str) -> FormDefinition:
        """Give the definition for a use.

        Raises
        ------
        BadInputError
            There is none.
        """
        found = self.definitions.get(use)
        if found is None:
            what = USES[use].what if use in USES else use
            raise BadInputError(
                f"no definition is used for {use} ({what})", where, f"give one, use={use!r}"
            )
        return found

    def chain(self, use: str, where: str = "in the definitions") -> FormChain:
        """Give the curve of the definition for a use, in the units of the ship; made once."""
        return chain_of(self.needed(use, where), self.particulars)

    def value(self, use: str, x: ArrayLike, default: float = np.nan) -> FloatArray:
        """Read a definition at abscissae.

        Parameters
        ----------
        use : str
            Of a definition whose curve is a function of x.
        x : (n,), m
            From AP.
        default : float
            Where there is none, or where it does not reach; the first and last ordinates of
            angles, curvatures and tangents hold beyond their ends.

        Returns
        -------
        (n,)
        """
        at = np.atleast_1d(np.asarray(x, np.float64))
        if not self.has(use):
            return np.full(len(at), default)
        chain = self.chain(use)
        low, high = float(chain.start[0]), float(chain.finish[0])
        near = np.inf if USES[use].held else _ON_END
        inside = (at >= low - near) & (at <= high + near)
        found = chain.ordinate(np.clip(at, low, high))
        return np.where(inside, found, default)

    def contour(self, x: float) -> tuple[float, ...]:
        """Give the heights (m) at which the profile stands at an abscissa, from below.

        Parameters
        ----------
        x : float, m
            From AP.

        Returns
        -------
        tuple of float
            Empty ahead and abaft of the ship.
        """
        chain = self.chain("profile")
        places = chain.meets(0, x)
        if not places:
            for end in (chain.start, chain.finish):
                if abs(float(end[0]) - x) <= _ON_END:
                    return (float(end[1]),)
            return ()
        piece, t = (np.array(each) for each in zip(*places, strict=True))
        return tuple(sorted(chain.at(piece, t)[:, 1].tolist()))
