"""Boundary curves of a stack never touch: the least gap is found wherever it lies."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_allclose

from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.bounded_functions import BlendChain, BoundedFunction, Contour
from assoc_hull.variation.fields.field import AffinePiece, Boundary, StackedField, least_gap
from tests.variation_strategies import courses

NONE = AffinePiece.along(BlendChain.constant(0.0), 0.0, 0.0)


@given(lower=courses(), upper=courses())
def test_the_least_gap_is_least(lower: BoundedFunction, upper: BoundedFunction) -> None:
    """No sample of the gap is less, and it is met at the place told."""
    x, gap = least_gap(lower, upper)
    one, many = np.array([x]), np.linspace(-60.0, 400.0, 20_001)
    assert_allclose(upper.at(one) - lower.at(one), [gap], rtol=0, atol=1e-15)
    assert gap <= (upper.at(many) - lower.at(many)).min() + 1e-9


def test_a_dip_between_nodes_is_found() -> None:
    """A spline swings below a level that all its nodes lie above."""
    dips = Contour(np.array([0.0, 10.0, 12.0, 22.0]), np.array([9.0, 5.1, 5.1, 9.0]))
    x, gap = least_gap(BlendChain.constant(5.0), dips)
    assert_allclose(x, 11.0, atol=1e-4)
    assert gap < 0.1


def test_boundaries_that_touch_somewhere_are_refused() -> None:
    """The message names field, both curves, the place and the gap there."""
    walls = (
        Boundary("base", BlendChain.constant(0.0)),
        Boundary("shaft+r", BlendChain.through([0.0, 12.5, 60.0], [5.0, 10.84, 5.0])),
        Boundary("T", BlendChain.constant(10.8)),
    )
    with pytest.raises(BadInputError) as caught:
        StackedField.checked("shaft_height", "z", walls, (NONE, NONE, NONE))
    assert str(caught.value) == (
        "boundary curves 'shaft+r' and 'T' of field 'shaft_height' touch at x=12.500 "
        "(gap -0.04 m), in vary; move one or reduce the range"
    )


def test_boundaries_that_only_just_miss_are_taken() -> None:
    """A millimetre is a gap, as long as it is one all along."""
    wave = BlendChain.through([0.0, 12.5, 60.0], [5.0, 10.799, 5.0])
    walls = (Boundary("shaft+r", wave), Boundary("T", BlendChain.constant(10.8)))
    field = StackedField.checked("shaft_height", "z", walls, (NONE, NONE))
    assert field.boundaries == walls
