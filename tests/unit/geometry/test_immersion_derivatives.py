"""Derivatives of the immersion by the plane and by the hull's form, carried through its sums."""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
import pytest
from numpy.polynomial import Polynomial

from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves
from assoc_hull.geometry.floating.immersed_strips import prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from assoc_hull.geometry.numeric.dual import Dual, as_array
from tests.exact_hulls import FormStrips

SUMS = [
    field.name for field in attrs.fields(ImmersedIntegrals) if field.name[:2] not in ("x_", "y_")
]
STEP = 1e-5

FORM = FormStrips(
    breadth=16.0 * Polynomial([0.5, 1.0]) * Polynomial([1.0, -1.0]),
    keel=Polynomial([1.0, -4.0, 4.0]),
    height=Polynomial([10.0, 1.0, 2.0]),
    rake=Polynomial([0.0, 0.0]),
)


@attrs.frozen
class Changed:
    """The form, broader, higher and bent by so much; numbers of any kind."""

    change: Any

    @property
    def count(self) -> int:
        return FORM.count

    @property
    def order(self) -> IntArray:
        return FORM.order

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """y grows by change[0], z by change[1], and z with x by change[2]."""
        plain = FORM.curves(strip, v)
        point, across = (self._changed(each) for each in (plain.point, plain.across))
        return IsoCurves(plain.start, as_array(point), as_array(across), plain.deck)

    def _changed(self, given: FloatArray) -> Any:
        x, y, z = given[..., 0], given[..., 1], given[..., 2]
        broader, higher, bent = (self.change[i] for i in range(3))
        return np.stack(
            [x + 0.0 * broader, y * (1.0 + broader), z * (1.0 + higher) + 0.01 * bent * x], axis=-1
        )


def below(change: Any, trim: float, heel: float, height: float = 5.3) -> Any:
    """The integrals of the changed form as one row."""
    planes = FloatingPlanes(np.array([height]), np.array([trim]), np.array([heel]))
    found = integrate_immersed(prepare_strips(Changed(change)), planes)
    return np.stack([getattr(found, name) for name in [*SUMS, "y_most", "x_least", "x_most"]])[:, 0]


@pytest.mark.parametrize(("trim", "heel"), [(0.0, 0.0), (0.02, 0.0), (0.0, 0.2), (-0.03, -0.6)])
@pytest.mark.parametrize("height", [0.6, 5.3, 10.6])
def test_tangents_of_the_form_are_its_derivatives(trim: float, heel: float, height: float) -> None:
    """Three changes of form at once, against central differences; also where events move."""
    found = below(Dual(np.zeros(3), np.eye(3)), trim, heel, height)
    plain = below(np.zeros(3), trim, heel, height)
    assert np.abs(found.value - plain).max() <= 1e-14 * np.abs(plain).max()
    for which in range(3):
        step = STEP * np.eye(3)[which]
        ahead, back = (below(sign * step, trim, heel, height) for sign in (1.0, -1.0))
        slope = (ahead - back) / (2.0 * STEP)
        size = np.maximum(np.abs(plain), np.abs(slope))
        size = np.maximum(size, 1e-3 * np.abs(plain).max())
        assert (np.abs(found.dot[which] - slope) <= 1e-7 * size).all()


@pytest.mark.parametrize("height", [0.6, 5.3, 10.6])
def test_complex_steps_and_tangents_agree(height: float) -> None:
    """The same derivative both ways, to rounding, also where keel or deck edge pass the plane."""
    dual = below(Dual(np.zeros(3), np.eye(3)), 0.02, 0.2, height)
    for which in range(3):
        step = below(1e-30j * np.eye(3)[which], 0.02, 0.2, height).imag / 1e-30
        assert np.abs(step - dual.dot[which]).max() <= 1e-12 * np.abs(step).max()
