"""Adoption adds points where crossings do not hold a shape, and nowhere else."""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import given, settings

from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, adopt
from assoc_hull.edit.checks.hull_findings import check
from assoc_hull.geometry.curves import PointKind
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import Tolerances
from tests.long_forms import draws
from tests.strategies import Net, nets, wigley_sources


def adopted(net: Net) -> tuple[HullState, AdoptionReport]:
    """Adopt a net."""
    return adopt(net.sources, net.particulars, net.associations)


def beside(state: HullState, driven: bool = False) -> float:
    """Give the least distance of an adopted point inside a curve from another of its points, m.

    Driven crossings are left out, or only they are looked at.
    """
    least = np.inf
    for curve in state.live("curves").tolist():
        rows = state.curves.rows[curve]
        step = np.diff(state.rows.xyz[rows], axis=0)
        chord = np.sqrt((step * step).sum(axis=1))
        own = (state.rows.sort[rows] == Sort.ADOPTED) & (
            state.rows.kind[rows, 0] == PointKind.SMOOTH
        )
        own[[0, -1]] = False
        computed = state.rows.driver[rows] >= 0
        pair = (own[:-1] & (computed[1:] == driven)) | (own[1:] & (computed[:-1] == driven))
        least = min(least, chord[pair].min(initial=least))
    return float(least)


def test_no_point_is_adopted_beside_an_end_that_its_boundary_moved() -> None:
    """A deck edge of seven points passes the ends of a buttock 95 mm off; the end is the edge's.

    A point at the given end, 95 mm from the curve's own, folded the buttock there; so did one
    2 mm from a crossing whose section passes beside the buttock.
    """
    state, report = adopted(wigley_sources(5, 3, 2))
    assert check(state) == ()
    assert beside(state) >= state.tolerances.adopted_spacing
    notes = [note for note in report.notes if "BTK 3.333 passes the given point" in note]
    assert len(notes) == 5
    assert "(21.132, 3.333, 6.250) m 81.6 mm off, over its tolerance of 1 mm" in notes[0]
    assert "94.7 mm beside a point of the curve, closer than 0.2 m" in notes[0]


@settings(max_examples=draws(25))
@given(nets())
def test_adopted_points_keep_their_distance(net: Net) -> None:
    """From all points of their curve, on every net.

    A driven crossing is set on its driver when all curves are made, up to some centimetres from
    where its line was given: half the distance is left beside these.
    """
    state, _ = adopted(net)
    assert beside(state) >= state.tolerances.adopted_spacing
    assert beside(state, driven=True) >= 0.5 * state.tolerances.adopted_spacing


@pytest.mark.parametrize("spacing", [0.05, 0.2, 1.0])
def test_the_distance_is_a_tolerance_of_the_hull(spacing: float) -> None:
    """A designer who wants points closer may say so."""
    net = wigley_sources(5, 3, 2)
    own = attrs.evolve(Tolerances(), adopted_spacing=spacing)
    state = adopt(net.sources, net.particulars, net.associations, own)[0]
    assert beside(state) >= spacing
