"""Digitised lines and surfaces of two hulls: refused, told what to give, and read so."""

from __future__ import annotations

import itertools
import re
from pathlib import Path
from typing import Any

import attrs
import ezdxf.filemanagement
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.lines.line_points import lines_as_points
from assoc_hull.io.lines.several_hulls import HullChoice
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.slicing.surface_lines import read_surface_lines
from assoc_hull.io.surfaces.surface_file import write_surfaces
from tests import cad_hulls, meshes, several_hulls

PLACES = np.linspace(2.0, 98.0, 9)


def check_wigley(lines: HullSlices) -> None:
    """All points lie on the formula to the digits of the text."""
    for line in lines.lines:
        for piece in line.pieces:
            # Where a section is cut off its point lies on a chord.
            x, y, z = piece.points[piece.points[:, 2] != several_hulls.ROOF].T
            assert np.abs(y - meshes.wigley_y(x, z)).max() <= 2e-5


@pytest.mark.parametrize("deck", [False, True], ids=["apart", "with a bridge deck"])
def test_the_remedy_for_lines_of_two_hulls_leads_to_one(deck: bool) -> None:
    """To the letter, and without depth as well; to port and to starboard."""
    text = several_hulls.digitised(PLACES, 8.0, deck=deck)
    with pytest.raises(BadInputError, match=r"there are two hulls side by side") as found:
        read_lines(text)
    given = {name: float(value) for name, value in re.findall(r"(\w+)=([0-9.]+)", str(found.value))}
    assert given == ({"centre": 8.0, "depth": 5.5} if deck else {"centre": 8.0})
    for choice in (given, {"centre": 8.0}, {"centre": -8.0}, {"centre": "8 m"}):
        lines = read_lines(text, choice=HullChoice(**choice))
        check_wigley(lines)
        assert lines.report.kinds() == ()
        assert float(lines.high[2]) == pytest.approx(5.5 if deck else meshes.T)


def test_a_centre_in_the_unit_of_the_file_is_taken_so() -> None:
    """Lines in mm: 8000, and what is proposed is in mm too."""
    rows = several_hulls.digitised(PLACES, 8.0, deck=False).splitlines()
    scaled = [rows[0]]
    for row in rows[1:]:
        name, piece, *place = row.split(",")
        scaled.append(",".join([name, piece, *(f"{1e3 * float(each):.2f}" for each in place)]))
    text = "\n".join(scaled) + "\n"
    with pytest.raises(BadInputError, match=r"centre=8000$"):
        read_lines(text)
    check_wigley(read_lines(text, choice=HullChoice(8000.0)))


def test_a_centre_is_taken_along_the_axes_of_the_file() -> None:
    """With y to starboard the hull at y = 8 is the one at -8 m of the ship, in any unit."""
    text = several_hulls.digitised(PLACES, 8.0, deck=False)
    for centre in (8.0, "8 m", -8.0):
        lines = read_lines(text, axes="+x-y+z", choice=HullChoice(centre))
        check_wigley(lines)
    with pytest.raises(BadInputError, match=r"give centre=8$"):
        read_lines(text, axes="+x-y+z", choice=HullChoice(7.0))


def test_half_a_demihull_beside_the_centre_plane_is_told_and_read() -> None:
    """Its sections all begin at y = 8 m: the remedy names that."""
    text = several_hulls.digitised(PLACES, 8.0, deck=False, half=True)
    with pytest.raises(BadInputError, match=r"begin 8 m off the centre plane.* give centre=8$"):
        read_lines(text)
    check_wigley(read_lines(text, choice=HullChoice(8.0)))


def test_a_wrong_centre_of_lines_is_answered_with_the_right_one() -> None:
    """With its largest difference; so is a wet deck below the depth."""
    text = several_hulls.digitised(PLACES, 8.0, deck=True)
    with pytest.raises(BadInputError, match=r"by up to 2 m .* give centre=8$"):
        read_lines(text, choice=HullChoice(7.0))
    with pytest.raises(BadInputError, match=r"hangs down to 5.5 m.* give depth=5.5 or less"):
        read_lines(text, choice=HullChoice(8.0, depth=6.0))


def test_lines_of_one_hull_stay_as_they_are() -> None:
    """With knuckles and all: a centre of 0 changes nothing either."""
    text = several_hulls.digitised(PLACES, 0.0, deck=False, half=True)
    one, other = read_lines(text), read_lines(text, choice=HullChoice(0.0))
    for mine, theirs in zip(one.lines, other.lines, strict=True):
        for a, b in zip(mine.pieces, theirs.pieces, strict=True):
            assert np.array_equal(a.points, b.points)


def test_a_drawing_of_two_hulls_is_refused_and_its_remedy_leads_to_one(tmp_path: Path) -> None:
    """A DXF with a layer a line, both demihulls on it: V of the one that is read."""
    alone = ah.examples.wigley(stations=9, waterlines=6)
    drawing = ezdxf.filemanagement.new()
    drawing.units = 6
    for line in lines_as_points(alone.state, ("sections", "waterlines", "boundary")):
        drawing.layers.add(line.name)
        for piece in line.pieces if line.name not in ("flat of side",) else ():
            sides = (1.0,) if line.name == "profile" else (1.0, -1.0)
            for off, side in itertools.product((8.0, -8.0), sides):
                places = piece.points * [1.0, side, 1.0] + [0.0, off, 0.0]
                drawing.modelspace().add_polyline3d(
                    places.tolist(), dxfattribs={"layer": line.name}
                )
    path = tmp_path / "two.dxf"
    drawing.saveas(path)
    with pytest.raises(BadInputError, match=r"there are two hulls side by side.*centre=8$"):
        ah.read(path, draught=5.0)
    hull = ah.read(path, draught=5.0, centre=8.0)
    truth = alone.hydrostatics(draught=5.0).volume
    assert hull.hydrostatics().volume == pytest.approx(truth, rel=3e-3)


def test_surfaces_of_two_hulls_are_refused_and_one_of_them_is_cut(tmp_path: Path) -> None:
    """Lines lie on the surfaces of the demihull to rounding, as if it stood there alone."""
    one = [*cad_hulls.port(), *cad_hulls.starboard()]
    both = [
        attrs.evolve(each, name=f"{each.name} {side:g}", net=each.net + np.array([0.0, side, 0.0]))
        for side in (14.0, -14.0)
        for each in one
    ]
    path, alone = tmp_path / "cat.igs", tmp_path / "mono.igs"
    write_surfaces(both, path)
    write_surfaces(one, alone)
    cuts: dict[str, Any] = {"stations": [20.0, 60.0], "waterlines": [4.0], "buttocks": [2.0]}
    with pytest.raises(BadInputError, match=r"two hulls side by side.*centre=14"):
        read_surface_lines(path, **cuts)
    lines = read_surface_lines(path, choice=HullChoice("14 m"), **cuts)
    truth = read_surface_lines(alone, **cuts)
    for mine, theirs in zip(lines.lines, truth.lines, strict=True):
        for a, b in zip(mine.pieces, theirs.pieces, strict=True):
            assert len(a.points) == len(b.points)
            assert np.abs(a.points - b.points).max() <= 1e-9
