"""The map of a hull's plates, its sheets, and the shaded picture of its surface."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.plot.plates.curvature_map import curvature_figure
from assoc_hull.plot.plates.hull_map import hull_map, hull_sheet
from assoc_hull.plot.plates.lit_surface import surface_figure
from assoc_hull.plot.plates.paint_tiles import hull_tiles
from assoc_hull.plot.plates.plate_book import plate_sheet
from assoc_hull.surface.plating.hull_plates import HullPlateTable, hull_plates
from assoc_hull.surface.plating.hull_seams import HullSeams
from assoc_hull.surface.plating.hull_shell import HullShell
from tests.formula_sides import BOWL

AFT = BOWL.surface((-12.0, 0.0), (-5.0, 5.0), (2, 2), "body")
FORE = BOWL.surface((0.0, 9.0), (-5.0, 5.0), (2, 2), "bow")


@pytest.fixture(scope="module")
def plates() -> HullPlateTable:
    """Plates of two blocks."""
    seams = HullSeams(x=(-6.0, 4.0), girth=(3.0, 7.0))
    return hull_plates((AFT, FORE), seams, zero="absolute", k0=7e-3)


def test_every_view_has_tiles_lines_and_plates_their_names(plates: HullPlateTable) -> None:
    """Also hatching where curvature is contested; a plate in doubt has a question mark."""
    figure = hull_map(plates)
    drawn = figure.axes[0]
    ids = {each.get_gid() for each in (*drawn.collections, *drawn.patches)}
    for view in ("expansion", "profile", "bottom", "fore", "aft"):
        assert {f"{view}/tiles", f"{view}/lines"} <= ids
    assert "expansion/contested" in ids
    words = {text.get_text() for text in drawn.texts}
    for plate in plates:
        assert (f"{plate.name}?" if plate.is_doubtful or not plate.kind else plate.name) in words
    assert any(plate.is_doubtful or plate.kind is None for plate in plates)


def test_the_ending_of_the_name_chooses_the_picture(plates: HullPlateTable, tmp_path: Path) -> None:
    """Of the map and of the surface; another ending, and what is neither, is refused."""
    hull_map(plates, tmp_path / "map.svg", paper="A4")
    surface_figure((AFT, FORE), tmp_path / "surface.png")
    assert (tmp_path / "map.svg").read_text().startswith("<?xml")
    assert (tmp_path / "surface.png").read_bytes().startswith(b"\x89PNG")
    with pytest.raises(WrongTypeError):
        hull_map(3)  # type: ignore[arg-type]
    with pytest.raises(WrongTypeError):
        surface_figure(3)  # type: ignore[arg-type]
    with pytest.raises(BadInputError):
        surface_figure((AFT, FORE), tmp_path / "surface.txt")
    assert len(list(tmp_path.iterdir())) == 2


def test_the_sheet_has_the_map_the_table_and_the_notes(
    plates: HullPlateTable, tmp_path: Path
) -> None:
    """Three pages."""
    path = tmp_path / "plates.pdf"
    hull_sheet(plates, path, paper="A4")
    assert b"/Count 3" in path.read_bytes()
    with pytest.raises(BadInputError):
        hull_sheet(plates, tmp_path / "plates.png")


def test_a_book_of_plates_of_a_hull_is_its_sheet(plates: HullPlateTable, tmp_path: Path) -> None:
    """The same file, whichever is called; pages of plates laid flat are refused."""
    one, other = tmp_path / "one.pdf", tmp_path / "other.pdf"
    hull_sheet(plates, one, title="Shell plates")
    plate_sheet(plates, other)
    assert one.read_bytes() == other.read_bytes()
    with pytest.raises(BadInputError, match="no surface of its own"):
        plate_sheet(plates, other, developments=True)


def test_a_map_plate_by_plate_is_for_surfaces_and_regions(plates: HullPlateTable) -> None:
    """Plates of a hull are refused; the regions that they were cut from are drawn."""
    with pytest.raises(WrongTypeError, match="give a RegionResult"):
        curvature_figure(plates)
    assert curvature_figure(plates.regions).axes


def test_lines_of_tiles_lie_where_a_value_has_its_level() -> None:
    """Pieces x = constant, from the lower edge of the side to the upper."""
    tiles = hull_tiles(HullShell.of((AFT, FORE)).patches, aim=64)
    pieces, normals = tiles.contour(tiles.grid[..., 0], -5.3)
    assert np.abs(pieces[..., 0] + 5.3).max() < 1e-12
    assert (pieces[..., 2].min(), pieces[..., 2].max()) == (-5.0, 5.0)
    assert np.ptp(pieces[..., 2], axis=1).sum() == pytest.approx(10.0)
    assert normals[:, 1].min() > 0.0


def test_the_surface_shows_the_borders_of_its_blocks() -> None:
    """Four sides of each, from ahead and from astern."""
    figure = surface_figure((AFT, FORE), title="Two blocks")
    borders = [line for line in figure.axes[0].lines if str(line.get_gid()).endswith("/border")]
    assert len(borders) == 2 * 2 * 4
    assert "Two blocks" in {text.get_text() for text in figure.axes[0].texts}
