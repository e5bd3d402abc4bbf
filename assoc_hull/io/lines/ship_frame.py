"""Where a ship lies among the coordinates of a file: perpendiculars, base line, design waterline.

Examples
--------
>>> from assoc_hull.io.lines.ship_frame import ShipFrame
>>> frame = ShipFrame(ap=-5.0, fp=95.0, base=-6.0, draught=6.0, breadth=16.0, depth=9.0)
>>> frame.length, frame.shift
(100.0, (5.0, 6.0))
"""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["ShipFrame", "StatedPlaces"]


@attrs.frozen(kw_only=True)
class StatedPlaces:
    """What a file says of itself; None where it is silent. All in m, places as the file has them.

    Attributes
    ----------
    length, breadth, draught, depth : float or None
        Particulars.
    base : float or None
        Height of the base line.
    ap, fp, rudder : float or None
        Where the perpendiculars and the rudder axis stand.
    evidence : mapping of str to str
        Why a value is so, by name; "as the file says" where it is silent. Empty: that is told.
    """

    length: float | None = None
    breadth: float | None = None
    draught: float | None = None
    depth: float | None = None
    base: float | None = None
    ap: float | None = None
    fp: float | None = None
    rudder: float | None = None
    evidence: Mapping[str, str] = attrs.field(factory=dict)

    def scaled(self, factor: float) -> StatedPlaces:
        """Give the same in another unit, or at another scale."""
        every = attrs.asdict(self, filter=lambda field, _: field.name != "evidence")
        known = {name: factor * value for name, value in every.items() if value is not None}
        return attrs.evolve(self, **known)

    def joined(self, other: StatedPlaces) -> StatedPlaces:
        """Give all that either says; this one counts first."""
        every = attrs.asdict(self, filter=lambda field, _: field.name != "evidence")
        missing = {name: getattr(other, name) for name, value in every.items() if value is None}
        return attrs.evolve(self, **missing, evidence={**other.evidence, **self.evidence})

    def why(self, name: str) -> str:
        """Tell why a value is so."""
        return self.evidence.get(name, "as the file says")


@attrs.frozen(kw_only=True)
class ShipFrame:
    """Where a ship lies in its file, and its particulars.

    Attributes
    ----------
    ap, fp : float, m
        x of the perpendiculars, forward positive, in the coordinates of the file.
    base : float, m
        Height of the base line in the coordinates of the file.
    draught, breadth, depth : float, m
        Design draught amidships, moulded breadth and depth.
    trim : float, m
        Design draught at the AP less that at the FP.
    rake : float, m
        By how much a raked keel lies deeper at the AP than at the FP; 0 if it is none.
    stem : float or None, m
        x where the stem meets the design waterline, in the coordinates of the file.
    origins : mapping of str to str
        Of each value by name: "given", "stated", "found" or "assumed".
    """

    ap: float
    fp: float
    base: float
    draught: float
    breadth: float
    depth: float
    trim: float = 0.0
    rake: float = 0.0
    stem: float | None = None
    origins: Mapping[str, str] = attrs.field(factory=dict, eq=False)
    given_length: float | None = None

    @property
    def length(self) -> float:
        """Length between perpendiculars, m: as given where it is, free of rounding."""
        return self.fp - self.ap if self.given_length is None else self.given_length

    @property
    def shift(self) -> tuple[float, float]:
        """What is to be added to x and z of the file, m."""
        return 0.0 - self.ap, 0.0 - self.base

    @property
    def moves(self) -> bool:
        """Whether anything is to be shifted at all."""
        return self.shift != (0.0, 0.0)

    def moved(self, xyz: FloatArray) -> FloatArray:
        """Give places of the file (n, 3), m, in ship axes: the same bits where nothing moves."""
        if not self.moves:
            return xyz
        return np.asarray(xyz + np.array([self.shift[0], 0.0, self.shift[1]]))
