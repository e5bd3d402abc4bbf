"""A bulb of one formula on a neck: measured on the net, and on the function that it is."""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np
import pytest
from scipy.optimize import brentq

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.form_parameters import CATALOGUE, shape_of
from assoc_hull.analysis.form.parameter import FormValue, evaluate
from tests.cases.bulb import breadth_at, bulb_hull, contour, fullness, gradient

FP, DRAUGHT = 94.0, 7.0
"""FP is taken where the neck begins, so that the bulb stands before it."""

WANTED = (
    "BL", "BH", "BW", "Abulb", "LBA", "LIBA", "V_PR", "L_PR", "Z_B", "B_B", "A_BT", "A_BL", "h_B",
)  # fmt: skip


@pytest.fixture(scope="module")
def found() -> Mapping[str, FormValue]:
    """Entries of the bulb, with FP and the draught of this test."""
    shape = shape_of(bulb_hull(), draught=DRAUGHT)
    header = attrs.evolve(shape.header, length=FP, draught=DRAUGHT)
    moved = FloatingShape(shape.body, header, shape.position, shape.depth)
    return evaluate(CATALOGUE, WANTED, moved, {})


def number(found: Mapping[str, FormValue], symbol: str) -> float:
    """The number of an entry, which must be there."""
    value = found[symbol]
    assert value.number is not None, value.reason
    return value.number


def tip() -> tuple[float, float]:
    """Where the contour of the function has its foremost x on the bulb: no slope along z."""

    def at(z: float) -> float:
        return brentq(lambda x: float(fullness(np.array([x]), np.array([z]))[0]), 96.0, 101.0)

    z = brentq(lambda z: float(gradient(fullness, np.array([[at(z), z]]))[0, 1]), 4.0, 6.0)
    return at(z), z


def test_the_tip_is_that_of_the_function(found: Mapping[str, FormValue]) -> None:
    """BL, BH, L_PR, Z_B; the line is drawn within 1e-3 m, and blunt at the tip."""
    x, z = tip()
    assert number(found, "BL") == pytest.approx(x - FP, abs=1e-3)
    assert number(found, "BH") == pytest.approx(z, abs=2e-2)
    assert (number(found, "L_PR"), number(found, "Z_B")) == (found["BL"].number, found["BH"].number)


def test_the_section_at_fp_is_that_of_the_function(found: Mapping[str, FormValue]) -> None:
    """BW, B_B, Abulb, A_BT, h_B; a station stands there."""
    z = np.linspace(0.0, DRAUGHT, 200_001)
    y = np.maximum(breadth_at(0.0 * z + FP, z), 0.0)
    assert number(found, "BW") == pytest.approx(2.0 * y.max(), abs=2e-3)
    assert number(found, "Abulb") == pytest.approx(2.0 * np.trapezoid(y, z), rel=1e-3)
    assert number(found, "h_B") == pytest.approx(
        np.trapezoid(y * z, z) / np.trapezoid(y, z), rel=1e-3
    )
    assert (number(found, "B_B"), number(found, "A_BT")) == (
        found["BW"].number,
        found["Abulb"].number,
    )


def test_what_lies_before_fp_is_that_of_the_function(found: Mapping[str, FormValue]) -> None:
    """LBA, LIBA, A_BL, V_PR, on a grid of 2 mm and 5 mm."""
    x, z = np.arange(FP, 101.0, 0.002), np.arange(0.0025, DRAUGHT, 0.005)
    y = np.concatenate([breadth_at(x, 0.0 * x + each)[None] for each in z.tolist()])
    cell = 0.002 * 0.005
    assert contour(0.0)[:, 0].max() < 101.0
    assert number(found, "LBA") == pytest.approx((y > 0.0).sum() * cell, rel=2e-3)
    assert number(found, "LIBA") == number(found, "A_BL") == number(found, "LBA")
    assert number(found, "V_PR") == pytest.approx(2.0 * y[y > 0.0].sum() * cell, rel=2e-3)
