"""What is computed of a hull is kept as long as the hull, and no longer."""

import gc
import weakref

import assoc_hull as ah
from assoc_hull.analysis.form.form_parameters import form_parameters
from assoc_hull.analysis.hydrostatics.flotation import flotation


def test_a_hull_that_was_measured_goes_when_nobody_holds_it() -> None:
    """Neither hydrostatics nor form parameters keep a hull alive."""
    hull = ah.examples.wigley()
    hull.hydrostatics(draught=5.0, estimate=False)
    form_parameters(hull, draught=5.0)
    gone = weakref.ref(hull.state)
    gc.unfreeze()  # what is loaded is set aside from collections
    del hull
    gc.collect()
    assert gone() is None


def test_form_parameters_are_kept_until_a_line_changes() -> None:
    """The same call gives the same objects; after an edit it gives new ones."""
    hull = ah.examples.wigley()
    first = form_parameters(hull)
    assert form_parameters(hull)["V"] is first["V"]
    body = flotation(hull.state)
    point = hull.points["WL 2.5 x ST 7"]
    with hull.edit("wider") as edit:
        edit.move(point, y=point.y + 0.01)
    assert flotation(hull.state) is not body
    assert form_parameters(hull)["V"] != first["V"]
