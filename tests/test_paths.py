"""How many modules a reader must open to follow an act through the package."""

import pytest

from benchmarks.house import TRIPS, entered

MOST = {
    # every edit asks `model.node` how the nodes of the network are numbered, which alone knows it;
    # reports name the movement along the normal, which `model.gaps` measures; `edit.write_lock`
    # lets one write at a time; `edit.program_edit` asks whether the program answers for the edit
    # what is published has look-ups of its own, for others who read it meanwhile: `model.index`
    # `model.change` tells what an edit changed: old steps of a hull in memory hold that alone
    # keys of points are texts when they are asked for, of `model.keys`
    # a move asks `modifications.lead` whether its point leads
    "a moved point": 49,
    # one run stands in the place of the passes; in numpy it enters what they do to loft and cut
    "a moved point, by the program": 43,
    # where points of features moved, `redraw_features` looks whether any is bent
    "a pull": 55,
    # columns are read through `graph.table`, by `column[row]`; a surface that is laid out and one
    # that is put on other lines are one thing, `net_surface`
    "hydrostatics": 27,
    # what is made of the tables is kept by `graph.derived`, behind the lock of `graph.derived`
    # its result stands in a module that loads nothing of studies and surfaces
    # counts of crossings by pairs of lines are `model.births`, arrays of their own
    # stages of a set, the choice of a plan and the combs of its lines are modules of their own
    # a map drawn anew asks `model.program.engine` whether it is compiled
    # what earlier variations of the hull set and reached is `earlier_values`
    # where the map is compiled its flat form and its kernels are four modules more
    # the search of the certificate, images of points, and the program that then serves are compiled
    # too: 107 without any of that, which serves from the twentieth run of a process on
    # tunnels and bodies beside the net are carried by a hook of `edit.space_map`, and
    # reports name the points that moved most by their lines (`model.address`)
    "a variation of the breadth": 115,
}
"""Modules entered, at most. A change that raises a number says why in its commit."""


@pytest.mark.parametrize("trip", TRIPS)
def test_a_trip_enters_no_more_modules_than_before(trip: str) -> None:
    """Following one act, a reader opens no more files than the number that stands here."""
    act = TRIPS[trip]()
    act()  # what is imported or made once is not the trip
    assert len(entered(act)) <= MOST[trip]
