"""The wetted surface against triangulations that share nothing with it.

`python -m tests.wetted_surfaces` prints the table of all ships; a part of it is tried here.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.surface.cells.closed_mesh import ClosedMesh
from tests.long_forms import LONG
from tests.raked_stern import DEPTH, FOOT, half_breadth, keel, raked_ship, shell
from tests.shell_area import triangles_below
from tests.wetted_surfaces import FEW, NEAR, SHIPS

NAMES = tuple(SHIPS) if LONG else FEW
"""All ships of the table where time is given, else a formula and a ship with bulb and transom."""


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.usefixtures("made_already")
def test_s_is_that_of_fine_triangles_within_its_own_estimate(
    name: str, request: pytest.FixtureRequest
) -> None:
    """Of each shipped hull, of a frigate and of formulas: within 0.3 %, and within the estimate."""
    if "DTC" in name:
        request.getfixturevalue("data_folder")
    one = SHIPS[name]()
    assert abs(one.off) < NEAR
    assert abs(one.found - one.truth) <= one.stated


@pytest.mark.parametrize(
    ("rake", "across"),
    [(0.05, None), (0.3, -1.0), (-0.4, 1.0), (1.0, None)],
    ids=["hardly raked", "aft, with a station across", "forward, with one", "far aft"],
)
def test_s_of_a_flat_run_before_a_raked_transom_is_that_of_the_formula(
    rake: float, across: float | None
) -> None:
    """Within 0.03 %: neither transom nor deck count, nor does the run fold.

    The edge of the transom was taken for a deck edge: the last strip was up to 1.6 % too large, and
    what closes it at deck level was counted as wetted surface.
    """
    hull = raked_ship(rake, across=across)
    for draught in (5.2, 8.0):
        found, truth = hull.hydrostatics(draught=draught), shell(rake, draught)
        assert found.wetted_surface == pytest.approx(truth, rel=3e-4)
        assert abs(found.wetted_surface - truth) <= (found.error["wetted_surface"] or 0.0)
    with_it = hull.hydrostatics(draught=8.0, transom=True)
    assert with_it.wetted_surface == pytest.approx(
        found.wetted_surface + found.transom_area, rel=1e-12
    )


@pytest.fixture(scope="module")
def ferry(shipped: Callable[[str], ah.Hull]) -> tuple[ah.Hull, ClosedMesh]:
    """The ferry, which has a closed deck, and her mesh."""
    hull = shipped("sfolds_ship")
    return hull, hull.mesh(points=24)


@pytest.mark.parametrize(
    ("draught", "heel"), [(9.3, 0.0), (10.0, 0.0), (9.3, 25.0), (10.0, -40.0), (7.0, 55.0)]
)
def test_a_closed_deck_under_water_counts_nothing_in_s_nor_does_the_transom(
    ferry: tuple[ah.Hull, ClosedMesh], draught: float, heel: float
) -> None:
    """The ferry over her deck, which is lowest at 9 m, and heeled until its edge is deep.

    The deck was a third of S. Volumes keep it, by both routes; the transom is told beside.
    """
    hull, mesh = ferry
    found = hull.hydrostatics(draught=draught, heel_deg=heel)
    shell, transom, deck = (
        triangles_below(mesh.xyz[mesh.triangle[mesh.group == part]], draught, heel)
        for part in map(mesh.names.index, ("shell", "aft end", "deck"))
    )
    assert deck > 0.1 * shell
    assert found.wetted_surface == pytest.approx(shell, rel=NEAR)
    assert abs(found.wetted_surface - shell) <= (found.error["wetted_surface"] or 0.0)
    assert found.wetted_surface_girth < found.wetted_surface
    assert found.transom_area == pytest.approx(transom, rel=NEAR)
    with_it = hull.hydrostatics(draught=draught, heel_deg=heel, transom=True).wetted_surface
    assert with_it == pytest.approx(found.wetted_surface + found.transom_area, rel=1e-12)
    # At heel a coefficient may exceed 1, which is told and no doubt of the hull.
    assert [note for note in found.notes if "may exceed 1 at trim or heel" not in note] == []


@pytest.mark.parametrize("rake", [0.3, -0.4])
def test_a_raked_transom_is_measured_in_its_own_plane(rake: float) -> None:
    """Twice the integral of y along its slope, from its foot to the water."""
    found = raked_ship(rake).hydrostatics(draught=8.0)
    z = np.linspace(3.0, 8.0, 20001)
    x = -rake * (z - FOOT)
    y = np.where(z > keel(x), half_breadth(x, np.maximum(z, keel(x))), 0.0)
    truth = 2.0 * float(np.trapezoid(y, z)) * float(np.hypot(1.0, rake))
    assert found.transom_area == pytest.approx(truth, rel=1e-4)


def test_the_deck_that_limits_a_draught_is_no_transom() -> None:
    """An open deck is wet at its edge, 12 m up, not where the transom has its foot, at 5 m."""
    hull = raked_ship(-0.4, across=1.0, deck="open")
    assert hull.hydrostatics(draught=11.0).volume > 0.0
    with pytest.raises(ah.errors.OutOfRangeError) as refused:
        hull.hydrostatics(draught=12.5)
    assert refused.value.most == pytest.approx(DEPTH)


def test_an_open_deck_is_named_where_it_limits_and_report_measures_up_to_it() -> None:
    """The message names the lowest place of the edge and its station, and what to do works."""
    hull = raked_ship(0.3, deck="open")
    with pytest.raises(ah.errors.OutOfRangeError, match=r"z 12\.000 m at x .*near ST .* to 12 m"):
        hull.hydrostatics(draught=13.0)
    told = hull.hydrostatics(draught=13.0, on_error="report")
    assert told.draught_mean == pytest.approx(DEPTH)
    assert "drowns the open deck: measured up to 12 m" in told.notes[0]
    assert told.volume == pytest.approx(hull.hydrostatics(draught=DEPTH).volume, rel=1e-9)
    table = hull.hydrostatic_table([6.0, 13.0], [0.0, 0.5], on_error="report")
    assert table.columns["draught_mean"].tolist() == pytest.approx(
        [6.0, 6.0, 12.0, 11.75], abs=0.02
    )
    assert raked_ship(0.3, deck="closed").hydrostatics(draught=11.9).notes == ()
