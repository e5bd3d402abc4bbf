"""The minors of a layer of additive functions, told as those of other layers are."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.additive import AdditiveLayer
from assoc_hull.variation.additive_fold import additive_fold
from assoc_hull.variation.certify_cells import Found

__all__ = ["additive_minors"]


def additive_minors(layer: AdditiveLayer, box: FloatArray, margin: float) -> list[Found]:
    """Give the least minor met, and the bound of all."""
    fold = additive_fold(layer, box, margin)
    name = "D" if " " in fold.minor else fold.minor
    if fold.place is not None:
        return [Found(name, fold.least, -np.inf, fold.place, fold.boxes, fold.boxes)]
    x, y, z = box.mean(axis=0).tolist()
    if fold.verdict == "undecided":
        return [Found(name, margin, fold.least, (x, y, z), fold.boxes, fold.boxes)]
    return [Found(name, fold.least, fold.least, (x, y, z), fold.boxes, fold.boxes)]
