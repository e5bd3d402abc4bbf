"""Form parameters of hulls that formulas give, against the formulas."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import attrs
import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.catalogue import CATALOGUE
from assoc_hull.analysis.form.screw import Screw
from assoc_hull.sources import examples
from tests import form_truths
from tests.nets import ellipsoid_net, wigley_net


@attrs.frozen
class Ship:
    """A hull, and its form parameters by another route; `part` is how near they must be.

    Lengths count in parts of Lpp, heights too; everything else in parts of itself.
    """

    make: Callable[[], ah.Hull]
    draught: float
    truth: Callable[[], dict[str, float]]
    part: float
    screw: Screw | None = None


SHIPS = {
    "Wigley": Ship(lambda: ah.Hull(wigley_net(41, 21)), 6.25, form_truths.wigley, 4e-6),
    "ellipsoid": Ship(lambda: ah.Hull(ellipsoid_net(41, 21)), 6.0, form_truths.ellipsoid, 8e-6),
    "207k": Ship(
        examples.bulk_carrier_207k, 18.0, form_truths.carrier, 2e-5,
        Screw(form_truths.SHAFT, form_truths.SCREW, form_truths.SCREW_AT),
    ),
}  # fmt: skip
LENGTH = {"m": "Lpp", "% Lpp": 100.0}
