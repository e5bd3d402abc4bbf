"""A variant in numbers is the hull that an edit makes by the same map, to the bit."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit.document import Document
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.model.tables import copy_state
from assoc_hull.study.design import StudyDesign
from assoc_hull.study.prepared_parent import StudyParent, VariantNumbers

SHIPS: dict[str, tuple[Callable[[], ah.Hull], dict[str, float]]] = {
    "wigley": (ah.examples.wigley, {"breadth": 0.4, "draught": 0.2, "fore_shift": 0.5}),
    "series60": (ah.examples.series60, {"breadth": 0.4, "length": 2.0, "stem_rake_deg": 0.4}),
    "carrier": (ah.examples.bulk_carrier_207k, {"breadth": 1.0, "draught": 0.4}),
}
"""Hulls, and parameters with changes by which most variants keep the structure."""


@pytest.fixture(scope="module")
def parents() -> dict[str, StudyParent]:
    """Studies of these parameters; no test changes them."""
    found = {}
    for ship, (make, changes) in SHIPS.items():
        design = StudyDesign.of(set=dict.fromkeys(changes, 10.0))
        found[ship] = StudyParent.of(copy_state(make().state), design)
    return found


@pytest.mark.parametrize("ship", SHIPS)
@settings(max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(parts=st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=3))
def test_a_variant_in_numbers_has_the_bits_of_the_edited_hull(
    parents: dict[str, StudyParent], ship: str, parts: list[float]
) -> None:
    """Points, lines, crossings and all outputs, or both are refused."""
    parent = parents[ship]
    steps = [part * most for part, most in zip(parts, SHIPS[ship][1].values(), strict=False)]
    values = parent.present + np.array(steps)
    try:
        variant = parent.variant(values)
    except AssocHullError:
        with pytest.raises(AssocHullError):
            parent.document(values, "again")
        return
    state = parent.document(values, "again").state
    if variant.anew or isinstance(variant.made, Document):
        return
    program, numbers = variant.made.carried.program, variant.made.carried
    live = state.live("rows")
    assert np.array_equal(variant.made.xyz[live], state.rows.xyz[live])
    curves = program.number
    expected = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    lines = numbers.splines(curves)
    for name in ("start", "knot", "xyz", "leave", "arrive"):
        assert np.array_equal(getattr(lines, name), getattr(expected, name))
    meets = [state.curves.meets[curve] for curve in curves.tolist()]
    assert np.array_equal(numbers.values.at, np.concatenate([each.parameter for each in meets]))
    assert np.array_equal(numbers.values.place, np.concatenate([each.xyz for each in meets]))
    assert np.array_equal(parent.fully(variant), parent.outputs.values(state))
    assert variant.made.particulars == state.particulars


@pytest.mark.parametrize("ship", SHIPS)
def test_small_changes_are_told_by_numbers(parents: dict[str, StudyParent], ship: str) -> None:
    """The quick way is not left for good by a hull that could take it."""
    parent = parents[ship]
    steps = 0.02 * np.array(list(SHIPS[ship][1].values()))
    assert isinstance(parent.variant(parent.present + steps).made, VariantNumbers)


def test_a_hull_that_definitions_make_has_no_numbers_and_is_varied_all_the_same() -> None:
    """Its generated sections are made by more than their points."""
    hull = ah.examples.plain_ship()
    breadth = hull.particulars.breadth
    found = hull.study(set={"breadth": [1.01 * breadth]}, outputs=["volume"])
    assert found.rows[0].failure == ""
    assert found.hull(0).hydrostatics(estimate=False).volume == found.rows[0].outputs[0]


@pytest.mark.parametrize("shift", ["fore_shift", "aft_shift"])
def test_sections_that_move_along_a_straight_keel_are_cut_by_it_where_they_stand(
    shift: str,
) -> None:
    """The keel stays as it is to the bit, and the hull is that of `vary`."""
    hull = ah.examples.plain_ship()
    found = hull.study(set={shift: [-0.0375, 0.75]}, outputs=["volume"])
    for row in found.rows:
        assert row.failure == ""
        made = found.hull(row.number)
        assert made.verify() == ()
        assert all("detached" in str(each) for each in made.check())
        varied = hull.vary(set={shift: row.values[0]}).hull
        assert row.outputs[0] == pytest.approx(varied.hydrostatics(estimate=False).volume, rel=1e-9)
