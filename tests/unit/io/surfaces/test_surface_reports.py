"""What the report of a file for CAD programs says of the hull that is written."""

from pathlib import Path

import assoc_hull as ah
from assoc_hull.io.cad.write import CadReport


def test_a_report_names_the_worst_place_and_what_is_not_in_the_file(tmp_path: Path) -> None:
    """The line and a line that it crosses; bodies and tunnels, which no surface is made of."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    with hull.edit("beside") as edit:
        edit.body("hatch 1", "hatches", x=(40.0, 52.0), y=(-3.0, 3.0), z=(10.0, 11.2))
        edit.tunnel("bow thruster", x=90.0, z=2.0, radius=0.2)
    report = hull.export(tmp_path / "ship.igs", "iges-surfaces")
    assert isinstance(report, CadReport)
    assert report.residual is not None
    line, _, other = report.residual_place.removeprefix("on ").partition(" near ")
    assert line in hull.lines
    assert other in hull.lines
    assert report.left_out == (
        "not in the surface: body hatch 1", "not in the surface: tunnel bow thruster",
    )  # fmt: skip
    words = str(report).splitlines()
    assert (
        f"lines lie up to {1e3 * report.residual:.1f} mm off it, {report.residual_place}" in words
    )
    assert "not in the surface: body hatch 1" in words


def test_a_hull_of_lines_alone_leaves_nothing_out(tmp_path: Path) -> None:
    """Nothing is said of bodies where there are none."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    report = hull.export(tmp_path / "ship.igs", "iges-surfaces")
    assert isinstance(report, CadReport)
    assert report.left_out == ()
