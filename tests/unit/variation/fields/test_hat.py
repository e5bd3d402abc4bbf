"""The rounded hat: anchors move by exactly what is asked, and slopes stay near the lines'."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.anchor_fields import hat_field, level_window
from assoc_hull.variation.fields.bounded_functions import CUBIC, Blend, BlendChain
from assoc_hull.variation.fields.field import StackedField
from tests.variation_strategies import blends

FULL = BlendChain.constant(1.0)
gaps = st.lists(st.floats(1.0, 9.0), min_size=1, max_size=5)


def moved(field: StackedField, z: list[float]) -> list[float]:
    """Displacements at heights."""
    found: list[float] = field.displacement(np.array([[0.0, 0.0, each] for each in z])).tolist()
    return found


@given(data=st.data(), gap=gaps, blend=blends)
def test_anchors_move_by_what_is_asked(data: st.DataObject, gap: list[float], blend: Blend) -> None:
    """To rounding, whatever the blend and wherever the windows point."""
    z = np.concatenate([[0.0], np.cumsum(gap)]).tolist()
    change = [data.draw(st.floats(-1.0, 1.0)) for _ in z]
    names = [f"a{k}" for k in range(len(z))]
    rigid = data.draw(st.sets(st.sampled_from(names)))
    anchors = list(zip(names, z, change, strict=True))
    found = moved(hat_field("hat", anchors, FULL, blend=blend, outward=sorted(rigid)), z)
    assert np.abs(np.array(found) - change).max() <= 2e-15


@given(gap=gaps, blend=blends)
def test_beyond_the_windows_nothing_moves(gap: list[float], blend: Blend) -> None:
    """Of a hat whose ends are still, 0.3 gaps outside its anchors: to the last bit."""
    z = np.concatenate([[0.0], np.cumsum([*gap, 2.0])])
    change = [0.0, *[0.3] * (len(z) - 2), 0.0]
    anchors = [(f"a{k}", *both) for k, both in enumerate(zip(z.tolist(), change, strict=True))]
    first, last = -0.3 * (z[1] - z[0]), z[-1] + 0.3 * (z[-1] - z[-2])
    field = hat_field("hat", anchors, FULL, blend=blend)
    assert moved(field, [first, first - 1.0, last, last + 1.0]) == [0.0] * 4
    region = field.region()
    assert region.z == pytest.approx((first, last), abs=1e-12)


def test_a_plateau_with_windows_outward_is_rigid() -> None:
    """Between its anchors all heights move by the same, so that a circle stays one."""
    anchors = [("base", 0.0, 0.0), ("low", 4.0, 0.7), ("high", 6.0, 0.7), ("T", 18.0, 0.0)]
    rigid = hat_field("shaft", anchors, FULL, outward=("low", "high"))
    z = np.linspace(4.0, 6.0, 201).tolist()
    assert moved(rigid, z) == [0.7] * 201
    assert max(moved(hat_field("shaft", anchors, FULL), z)) > 0.7035


def test_windows_outward_are_as_wide_as_the_gap_on_their_side_allows() -> None:
    """A low plateau does not narrow them: 0.3 of the gaps below and above it."""
    anchors = [("base", 0.0, 0.0), ("low", 4.0, 1.0), ("high", 4.5, 1.0), ("T", 18.5, 0.0)]
    field = hat_field("shaft", anchors, FULL, outward=("low", "high"))
    heights = [float(each.height.at(np.zeros(1))[0]) for each in field.boundaries]
    assert heights == pytest.approx([-1.2, 1.2, 2.8, 4.0, 4.5, 8.7, 14.3, 22.7])


@given(gap=st.tuples(st.floats(2.0, 9.0), st.floats(2.0, 9.0)), blend=blends)
def test_windows_can_make_a_hat_level_at_its_top(gap: tuple[float, float], blend: Blend) -> None:
    """Of the widths that are asked for; the anchor moves by what is asked, and its slope is nil."""
    low, high = gap
    ratio = level_window(low, high, blend)
    down = 0.6 * min(low, high / ratio)
    up = down * ratio
    windows = {"a": (0.3, 0.0), "b": (down / low, up / high), "c": (0.0, 0.3)}
    anchors = [("a", 0.0, 0.0), ("b", low, 1.0), ("c", low + high, 0.0)]
    field = hat_field("hat", anchors, FULL, blend=blend, windows=windows)
    heights = [float(each.height.at(np.zeros(1))[0]) for each in field.boundaries]
    wanted = [-0.3 * low, 0.0, low - down, low + up, low + high, low + 1.3 * high]
    assert heights == pytest.approx(wanted)
    assert moved(field, [0.0, low]) == [0.0, 1.0]
    assert abs(field.gradient(np.array([[0.0, 0.0, low]]))[0, 2]) < 1e-14


def test_windows_that_meet_are_refused() -> None:
    """With the names of the boundaries."""
    anchors = [("a", 0.0, 0.0), ("b", 2.0, 1.0), ("c", 4.0, 0.0)]
    with pytest.raises(BadInputError, match=r"'a\+' and 'b-' touch"):
        hat_field("hat", anchors, FULL, windows={"a": (0.3, 0.6), "b": (0.5, 0.3)})


@given(gap=st.tuples(st.floats(2.0, 9.0), st.floats(2.0, 9.0)), blend=blends)
def test_slopes_stay_near_those_of_the_lines(gap: tuple[float, float], blend: Blend) -> None:
    """At most 1.42 (cubic) and 1.35 (quintic) times the steeper one; steps need 1.5 and 1.875."""
    low, high = gap
    field = hat_field(
        "hat", [("a", 0.0, 0.0), ("b", low, 1.0), ("c", low + high, 0.0)], FULL, blend=blend
    )
    z = np.linspace(-3.0, low + high + 3.0, 2001)
    slope = field.gradient(np.column_stack([0.0 * z, 0.0 * z, z]))[:, 2]
    most = 1.4143 if blend is CUBIC else 1.3472
    assert np.abs(slope).max() <= most * max(1.0 / low, 1.0 / high)


@pytest.mark.parametrize(
    ("anchors", "words"),
    [
        ([("base", 0.0, 0.0)], "field 'skeg' has 1 anchors"),
        ([], "field 'skeg' has 0 anchors"),
        ([("base", 0.0, 0.0), ("T", 0.0, 1.0)], "boundary curves 'base' and 'T' touch (gap 0 m)"),
        ([("T", 9.0, 0.0), ("base", 0.0, 1.0)], "boundary curves 'T' and 'base' touch (gap -9 m)"),
    ],
)
def test_anchors_that_make_no_hat_are_refused(
    anchors: list[tuple[str, float, float]], words: str
) -> None:
    """The message names them."""
    with pytest.raises(BadInputError) as caught:
        hat_field("skeg", anchors, FULL)
    assert words in str(caught.value)
