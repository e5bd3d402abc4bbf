"""What the parts of `io.surfaces` give, one small example of each."""

from __future__ import annotations

from assoc_hull.io.surfaces.hull_surface import surface_form_of


def test_the_surface_of_a_hull_as_a_file_its() -> None:
    """The surface of a hull as a file: its patches for CAD programs, or the closed mesh of its
    lines."""
    assert (
        surface_form_of("ship.stp"),
        surface_form_of("ship.stl"),
        surface_form_of("a", "iges-brep"),
    ) == ("step", "stl", "iges-brep")
