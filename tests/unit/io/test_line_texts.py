"""What other programs may write in these forms, and we do not: read, or told."""

import os
from pathlib import Path

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.write_file import write_whole

HALF = "3\n0,0\n10,2\n12,20,0,0,DK"


def gf(*, origin: str = "", places: tuple[float, ...] = (-300, -200, -100), tail: str = "") -> str:
    """A geometry file with one shape."""
    sections = "".join(f"{x},{HALF}\n" for x in places)
    return f"Ship\n{origin}*\nHULL\n{len(places)}\n{sections}0,0,0\n{tail}****\n"


def component(side: int, shift: str) -> str:
    """A component of the shape HULL, and a part that displaces with it."""
    part = "***\nHULL\nSEA WATER\n1\n1.025\n0,0,0\n1\nHULL.C\n"
    return f"**\nHULL.C\n{side}\n1.0\n{shift}\nHULL\n{part}"


def test_britfair_buttocks_and_waterlines() -> None:
    """Types 2 and 3 are lines of their planes: x and z, x and y."""
    for kind, name, last in ((2, "BTK 3", [9.0, 3.0, 2.0]), (3, "WL 3", [9.0, 2.0, 3.0])):
        [line] = read_lines(f"S\n{kind}\n3 1 3.0\n0 1\n5 4\n9 2\n0\n0 0 0\n").lines
        assert line.name == name
        assert line.pieces[0].points[-1].tolist() == last


def test_britfair_tangents_are_passed_over_and_told() -> None:
    """One or two tangents at the ends of a curve."""
    text = "S\n1\n2 1 5.0\n0 0\n2 3\n1\n0.5\n2 2 7.0\n0 0\n2 3\n3\n0.5 0.7\n0 0 0\n"
    slices = read_lines(text)
    assert [line.offset for line in slices.lines] == [5.0, 7.0]
    assert slices.report.kinds("assumptions").count("tangents") == 1


def test_britfair_parts_that_do_not_meet_are_told() -> None:
    """A curve that goes on elsewhere behind a knuckle is joined, which is suspicious."""
    text = "S\n1\n2 1 5.0\n0 0\n2 1\n0\n2 1 -999.0\n2.5 1\n3 4\n0\n0 0 0\n"
    assert "knuckle" in read_lines(text).report.kinds()


def test_delftship_in_feet_and_along_the_ship() -> None:
    """Unit 1 is feet; longitudinal curves are waterlines, the profile, or left out and told."""
    curves = ["0 0 9.84\n50 9 9.84\n90 0 9.84", "0 0 5\n40 0 0\n90 0 12", "0 1 2\n5 3 9\n60 4 20"]
    slices = read_lines("1\n" + "\n\n".join(curves) + "\n\nEOF\n")
    assert [round(line.offset, 4) for line in slices.lines] == [2.9992]
    assert [line.name for line in slices.boundaries] == ["profile"]
    assert "curve" in slices.report.kinds()


def test_a_unit_that_contradicts_the_form_is_refused() -> None:
    """A form with a unit takes no other one."""
    text = "1\n5 0 0\n5 3 9\n\n9 0 0\n9 3 9\n\nEOF\n"
    assert read_lines(text, unit="ft").lines[0].offset == pytest.approx(1.524)
    with pytest.raises(BadInputError, match="the form has ft"):
        read_lines(text, unit="m")


def test_delftship_offsets_of_a_section_in_segments() -> None:
    """Segments are pieces of one line; diagonals are left out and told."""
    text = (
        "Station 10.000\n2 segments.\nSEGMENT 1\n 10 0 1\n 10 1 2\n 10 0 3\nSEGMENT 2\n"
        " 10 0 6\n 10 2 9\nDiagonal 3.000\n 0 1 2\n 5 2 1\n"
    )
    slices = read_lines(text)
    assert [len(piece.points) for piece in slices["ST 10"].pieces] == [3, 2]
    assert "curve" in slices.report.kinds()


@pytest.mark.parametrize(
    ("origin", "places", "wanted"),
    [
        ("OL:AFT PERP.\n", (-300, -200, -100), (100, 200, 300)),
        ("OL:A.P.\n", (-300, -100, 20), (-20, 100, 300)),
        ("", (-300, -100, 20), (-20, 100, 300)),
        ("OL:FWD PERP.\n", (0, 100, 300), (0, 200, 300)),
        ("", (0, 100, 300), (0, 200, 300)),
        ("OL:MIDSHIPS\n", (-150, 0, 150), (0, 150, 300)),
    ],
)
def test_gf_origins(origin: str, places: tuple[float, ...], wanted: tuple[float, ...]) -> None:
    """An origin aft is kept; from another one, x counts from the aftmost section; it is told."""
    slices = read_lines(gf(origin=origin, places=places))
    found = [line.offset / 0.3048 for line in slices.lines]
    np.testing.assert_allclose(found, wanted, atol=1e-5)
    assert "frame" in slices.report.kinds("assumptions")


def test_gf_components() -> None:
    """The shift of a component's origin counts, and whole outlines give their port side."""
    slices = read_lines(gf(tail=component(0, "-10,0,5")))
    assert [round(line.offset / 0.3048) for line in slices.lines] == [110, 210, 310]
    assert slices.lines[0].pieces[0].points[0, 2] == pytest.approx(5 * 0.3048)
    whole = "5\n-12,20\n-10,2\n0,0\n10,2\n12,20"
    text = gf(tail=component(1, "0,0,0")).replace(HALF, whole)
    [piece] = read_lines(text).lines[0].pieces
    np.testing.assert_allclose(piece.points[:, 1:] / 0.3048, [[0, 0], [10, 2], [12, 20]], atol=1e-9)


def test_gf_with_other_shapes() -> None:
    """Of several shapes the displacing one of most sections is the hull; others are told."""
    skeg = "*\nSKEG\n2\n-50,2\n0,0\n1,1\n-20,2\n0,0\n1,1\n0,0,0\n"
    slices = read_lines(gf(tail=skeg))
    assert len(slices.lines) == 3
    assert "shapes" in slices.report.kinds()


def test_gf_without_an_edge_of_the_deck() -> None:
    """Where no deck edge is marked, the deck is read as part of sections, and this is told."""
    slices = read_lines(gf().replace(HALF, "4\n0,0\n10,2\n12,20\n0,20.5"))
    assert len(slices.lines[0].pieces[0].points) == 4
    assert "deck" in slices.report.kinds("assumptions")


def test_a_line_in_bits_is_chained_or_refused() -> None:
    """A section exploded into its chords is one piece again; thousands of bits are refused."""

    def bits(count: int) -> str:
        step = [f"{k / 100:.2f} {k / 20:.2f}" for k in range(count + 1)]
        curves = [f"2 {k} 5.0\n{step[k]}\n{step[k + 1]}\n0" for k in range(count)]
        return "\n".join(["S", "1", *curves, "0 0 0", ""])

    [piece] = read_lines(bits(60)).lines[0].pieces
    assert len(piece.points) == 61
    with pytest.raises(BadInputError, match="5000 pieces"):
        read_lines(bits(5000))


def test_a_file_that_cannot_be_written_names_place_and_reason(tmp_path: Path) -> None:
    """A folder, and a folder that is not there."""
    with pytest.raises(BadInputError, match="folder"):
        write_whole(tmp_path, b"")
    with pytest.raises(BadInputError, match="cannot be written"):
        write_whole(tmp_path / "none" / "a", b"")


def test_a_link_is_followed(tmp_path: Path) -> None:
    """The file a link leads to is replaced, not the link."""
    (tmp_path / "a").write_text("old")
    (tmp_path / "link").symlink_to(tmp_path / "a")
    write_whole(tmp_path / "link", b"new")
    assert (tmp_path / "a").read_text() == "new"
    assert (tmp_path / "link").is_symlink()


def test_a_pipe_is_written_to_and_stays(tmp_path: Path) -> None:
    """What is no file, a device too, is not replaced by one, nor is it looked into."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    write_whole(pipe, b"lines")
    assert os.read(reader, 100) == b"lines"
    os.close(reader)
    assert pipe.is_fifo()
    assert list(tmp_path.iterdir()) == [pipe]
