"""All definitions of a hull by their use, read where a line stands.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.model.definition_part import FormDefinition
>>> from assoc_hull.model.forms.forms import Forms
>>> from assoc_hull.model.state import Particulars
>>> flare = FormDefinition(
...     "flare", "waterline_angle", "course", rule="straight", nodes=("AP", "FP"),
...     values={"AP_x": 0.0, "AP_y": 30.0, "FP_x": 180.0, "FP_y": 0.0},
... )
>>> forms = Forms.of([flare], Particulars("ship", 180.0, 28.0, 15.5, 10.5))
>>> forms.value("waterline_angle", np.array([90.0, 181.0])), forms.has("profile")
(array([15.,  0.]), False)
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.chain import FormChain
from assoc_hull.model.definition_part import FormDefinition
from assoc_hull.model.forms.chains import chain_of
from assoc_hull.model.state import Particulars
from assoc_hull.model.uses import USES

__all__ = ["Forms"]

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
