"""The first waterline, buttock or section of a hull that was given without any."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, NoMeetingError, UnknownNameError
from tests.cases.test_hydrostatics_of_a_box import box_net


@pytest.fixture
def box() -> ah.Hull:
    """A box of boundary curves and five sections, as a file of sections gives it."""
    return box_net()


def test_a_hull_of_sections_gets_waterlines_and_buttocks_that_shape_it(box: ah.Hull) -> None:
    """Each goes through all sections; moving its points moves these; undo gives all back."""
    before = box.fingerprint
    with box.edit("lines") as edit:
        low = edit.add_line("waterlines", 3.0)
        edit.add_line("waterlines", 6.0)
        edit.add_line("buttocks", 4.0)
    assert (low.name, list(box.groups["buttocks"].lines)) == ("WL 3", ["BTK 4"])
    assert all(f"ST {k} x WL 3" in box for k in range(1, 6))
    assert box.check() == ()
    with box.edit("out") as edit:
        edit.move("ST 3 x WL 3", y=10.1)
    at = box.lines["ST 3"].curves[0].at(np.linspace(0.0, box.lines["ST 3"].curves[0].span, 400))
    assert at[:, 1].max() > 10.05
    box.undo(2)
    assert box.fingerprint == before


def test_the_order_of_cutting_does_not_matter_to_who_meets_whom(box: ah.Hull) -> None:
    """Associations run from sections to waterlines to buttocks, as in every other hull."""
    with box.edit("lines") as edit:
        edit.add_line("buttocks", 4.0)
        edit.add_line("waterlines", 3.0)
    pairs = {(each.a, each.b) for each in box.document.state.associations}
    assert {("sections", "waterlines"), ("waterlines", "buttocks")} <= pairs


def test_a_table_of_offsets_that_is_refused_says_how_to_cut_what_it_needs(
    box: ah.Hull, tmp_path: Path
) -> None:
    """The counts are those of the hull's own lines; following the advice writes the table."""
    sheered = box.vary(set={"sheer_fore": 1.0}).hull
    path = tmp_path / "box.csv"
    with pytest.raises(BadInputError, match=r"has 0 waterlines and 1 level") as caught:
        sheered.export(path)
    assert "add_line waterlines 6`" in str(caught.value)
    with sheered.edit("as told") as edit:
        edit.add_line("waterlines", 6.0)
    sheered.export(path)
    assert path.exists()


def test_an_unknown_group_names_those_there_are_and_those_that_can_be_made(box: ah.Hull) -> None:
    """So that the next call works."""
    with pytest.raises(UnknownNameError, match="'sections', 'waterlines', 'buttocks'"):  # noqa: SIM117
        with box.edit("x") as edit:
            edit.add_line("qqq", 3.0)


def test_a_line_given_for_a_point_is_answered_with_points_of_that_line(box: ah.Hull) -> None:
    """As every point has a name of its own."""
    with pytest.raises(UnknownNameError) as caught, box.edit("x") as edit:
        edit.pull("ST 3", 0.05)
    near = str(caught.value)
    assert "ST 3 " in near.partition(";")[2]


@pytest.mark.parametrize("place", [0.0, 5.0], ids=["at the centre plane", "at half the breadth"])
def test_a_plane_at_the_edge_of_the_hull_touches_and_is_told_so(place: float) -> None:
    """It cuts no line there; just within the ends that the error tells it does."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    before = hull.fingerprint
    with pytest.raises(NoMeetingError, match=r"touches .* above 0.000 and below 5.000 m") as told:
        hull.apply("edge", [{"op": "add_line", "group": "buttocks", "position": place}])
    assert told.value.touches
    assert hull.fingerprint == before
    for inside in (0.01, 4.99):
        hull.apply("within", [{"op": "add_line", "group": "buttocks", "position": inside}])
    assert hull.check() == ()
