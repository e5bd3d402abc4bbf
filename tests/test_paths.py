"""How many modules a reader must open to follow an act through the package."""

import pytest

from benchmarks.house import TRIPS, entered

MOST = {
    # every edit asks `model.node` how the nodes of the network are numbered, which alone knows it;
    # reports name the movement along the normal, which `model.gaps` measures
    "a moved point": 55,
    "a pull": 57,
    "hydrostatics": 31,  # columns are read through `graph.table`, by `column[row]`
    # what is made of the tables is kept by `graph.derived`
    "a variation of the breadth": 113,
}
"""Modules entered, at most. A change that raises a number says why in its commit."""


@pytest.mark.parametrize("trip", TRIPS)
def test_a_trip_enters_no_more_modules_than_before(trip: str) -> None:
    """Following one act, a reader opens no more files than the number that stands here."""
    act = TRIPS[trip]()
    act()  # what is imported or made once is not the trip
    assert len(entered(act)) <= MOST[trip]
