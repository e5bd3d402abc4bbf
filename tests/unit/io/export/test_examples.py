"""What the parts of `io.export` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.production_arcs import arc_lines
from assoc_hull.io.export.arcs import arc_table
from assoc_hull.io.export.delftship import (
    is_delftship,
    is_delftship_offsets,
    parse_delftship,
    parse_delftship_offsets,
)
from assoc_hull.io.export.ghs_geometry import FOOT, dumps_gf, is_gf, parse_gf
from assoc_hull.io.export.offset_table import coordinate_ranges, lines_in_planes, offsets_of
from assoc_hull.io.export.sections import sections_to_export
from assoc_hull.io.reports import ExportBook, Notebook
from assoc_hull.shipped.wigley import wigley


def test_arcs_of_lines_as_files_a_drawing_for_machines() -> None:
    """Arcs of lines as files: a drawing for machines and drawing programs, or a table."""
    assert (
        str(arc_table(arc_lines(wigley(), "WL 5", 0.01, 0.0)).splitlines()[0])
        == "group,line,number,x,y,z,dx,dy,dz,nx,ny,nz,curvature,length,cx,cy,cz,radius"
    )


def test_curves_for_delftship_and_freeship_the_text_that_their() -> None:
    """Curves for DELFTship and FREE!ship: the text that their import of a surface reads."""
    text = "0\n50.0 0.0 0.0\n50.0 4.0 1.0\n\n60.0 0.0 0.5\n60.0 3.0 1.0\nEOF\n"
    raw = parse_delftship(text, "text", Notebook())
    assert (is_delftship(text), raw.unit, [piece.line for piece in raw.pieces]) == (
        True,
        "m",
        ["ST 50", "ST 60"],
    )


def test_offsets_as_3d_points_the_list_that_freeship() -> None:
    """Offsets as 3D points: the list that FREE!ship and DELFTship write of all their lines."""
    text = "Station  50.000\n   50.0 0.0 0.0\n   50.0 4.0 1.0  KNUCKLE\n   50.0 4.0 6.0\n"
    raw = parse_delftship_offsets(text, "text", Notebook())
    assert (is_delftship_offsets(text), raw.pieces[0].line, len(raw.pieces[0].points)) == (
        True,
        "ST 50",
        3,
    )


def test_ghs_geometry_files_gf_the_sections_of_the_hull() -> None:
    """GHS geometry files (.GF): the sections of the hull as one displacing part; writing."""
    book = ExportBook(decimals=4, scale=1.0 / FOOT)
    text = dumps_gf("Wigley", 100.0, 10.0, sections_to_export(wigley(), book), book)
    assert text.splitlines()[10:14] == ["*", "HULL", "21", "-328.0840,2"]


def test_ghs_geometry_files_gf_reading_the_sections() -> None:
    """GHS geometry files (.GF): reading the sections of the hull; see
    `assoc_hull.io.export.ghs_geometry`."""
    section = "3\n0,0\n10,0\n10,20,0,0,DK"
    text = f"Barge\n*\nHULL\n2\n-100,{section}\n0,{section}\n0,0,0\n****\n"
    raw = parse_gf(text, "text", Notebook())
    assert (is_gf(text), raw.unit, raw.pieces[0].line, raw.pieces[0].points[1].tolist()) == (
        True,
        "ft",
        "ST 30.48",
        [100.0, 10.0, 0.0],
    )


def test_lines_of_a_hull_by_planes_and_where_they() -> None:
    """Lines of a hull by planes, and where they meet other planes: what a table of offsets
    holds."""
    sections = lines_in_planes(wigley(), "sections", 0)
    assert coordinate_ranges(sections.curves[:2], np.eye(3)[2], np.array([2.5, 5.0]), 1).high.round(
        4
    ).tolist() == [[0.608, 0.912], [1.152, 1.728]]


def test_the_table_of_offsets_of_a_hull_half_breadths() -> None:
    """The table of offsets of a hull: half-breadths by station and waterline, heights of
    buttocks."""
    sheet = offsets_of(wigley(), ExportBook(decimals=4))
    assert ([block[0][:4] for block in sheet.blocks], sheet.blocks[0][7][:4]) == (
        [["station", "x_m", "wl_0", "wl_0.625"]],
        ["6", "30", "0.0000", "0.7980"],
    )
