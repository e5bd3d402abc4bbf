"""stub until ENDS lands"""

from __future__ import annotations
import attrs
import numpy as np
from assoc_hull.geometry.fitting.samples import Samples


@attrs.frozen(eq=False)
class Stretch:
    low: float
    high: float
    centre: bool = False
    parts: tuple = ()
    master: str = ""
    master_side: str = ""
    master_low: float = 0.0
    master_high: float = 0.0


@attrs.frozen(eq=False)
class Block:
    name: str
    kind: str
    rank: int
    extent: np.ndarray
    reach: np.ndarray
    samples: Samples
    inside: np.ndarray
    sides: dict
    knots_u: np.ndarray
    knots_v: np.ndarray
    singular: tuple = ()
    notes: tuple = ()
