"""Texts of ships of portions, and what all texts of definitions share."""

from __future__ import annotations

from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.creation.classical.sfolds import Sfolds
from assoc_hull.errors import AssocHullError, BadInputError, GeometryError
from assoc_hull.io.classical.read import holds_definition, read_definition

HEAD = "SFOLDS Body\nlength 32\nbreadth 30.4\ndepth 12.4\ndraught 9\n"
SECTION = """section m hb=0.9 sb=3 sw=2 hd=12.4 bd=15.2 cam=0.4 nb=4 nw=7
0 0.02 0.10 0.31 0.80
12.3 14.2 14.8 15 15.1 15.2 15.2
"""
PORTION = "portion 3\n0 m\n16 m\n32 m\n"
TEXT = HEAD + SECTION + PORTION


def read(text: str) -> Sfolds:
    """Read a text that is said to be ``a.txt``."""
    found = read_definition(text, "a.txt")
    assert isinstance(found, Sfolds)
    return found


def test_a_text_is_its_ship() -> None:
    """Dimensions, sections and portions; x from AP."""
    ship = read(TEXT)
    assert ship.particulars == ah.Particulars("Body", 32.0, 30.4, 12.4, 9.0)
    assert round(ship.volume, 4) == 11618.9267
    assert ship.portions[0].stations.tolist() == [0.0, 16.0, 32.0]
    assert (ship.corner, ship.notes) == (10.0, ())


def test_x_from_midship_is_moved_to_ap() -> None:
    """And a note says so."""
    text = HEAD + "origin midship\n" + SECTION + "portion 3\n-16 m\n0 m\n16 m\n"
    ship = read(text)
    assert ship.portions[0].stations.tolist() == [0.0, 16.0, 32.0]
    assert ship.notes == ("x counted from midship was moved by +16 m: x is now from AP",)
    assert ship.report().notes == ship.notes
    assert read(HEAD + "origin ap\n" + SECTION + PORTION).notes == ()


def test_options_of_a_text() -> None:
    """Planes of the net, the corners that stay, a closed deck, comments and rows as they come."""
    text = TEXT.replace("0 0.02 0.10 0.31 0.80\n12.3", "0 0.02 0.10  # so far\n0.31 0.80 12.3")
    ship = read(text + "waterlines 3 6\nbuttocks 5\ncorner 0\ndeck Closed\n")
    assert ship.cuts == {"waterlines": (3.0, 6.0), "buttocks": (5.0,)}
    assert (ship.corner, ship.particulars.deck) == (0.0, "closed")
    assert ship.volume == read(TEXT).volume


def replaced(old: str, new: str) -> str:
    """The text with something else in it."""
    assert old in TEXT
    return TEXT.replace(old, new, 1)


REFUSED: dict[str, tuple[str, str]] = {
    "unknown card": (TEXT + "rudder 3\n", "'rudder' is no card, at line 13 of a.txt"),
    "no length": (replaced("length 32\n", ""), "the card length is missing, in a.txt"),
    "a length of nil": (replaced("length 32", "length 0"), "length is 0 m, at line 2 of a.txt"),
    "a dimension of two": (
        replaced("length 32", "length 32 33"), "length has 2 cell(s) where 1 number(s)"
    ),
    "rows below a dimension": (
        replaced("length 32", "length 32\n1 2"), "length has rows of numbers, at line 2"
    ),
    "a dimension twice": (TEXT + "length 32\n", "length is given twice, at line 13 of a.txt"),
    "another deck": (TEXT + "deck wet\n", "deck is 'wet', at line 13"),
    "another origin": (TEXT + "origin fp\n", "origin has 'fp', at line 13 of a.txt; give ap or"),
    "rows below the origin": (TEXT + "origin ap\n1\n", "origin has rows of numbers"),
    "a section without a name": (
        replaced("section m hb", "section hb"), "a section has no name, at line 6"
    ),
    "a section twice": (TEXT + SECTION, "section 'm' is given twice, at line 13"),
    "a value missing": (replaced(" cam=0.4", ""), "section 'm' lacks cam, at line 6"),
    "a value unknown": (replaced("cam=", "camber="), "section has the cell 'camber=0.4'"),
    "a value that is no number": (replaced("hb=0.9", "hb=low"), "'low'"),
    "a count that is not whole": (replaced("nb=4", "nb=4.5"), "nb is 4.5, at line 6"),
    "too few ordinates": (
        replaced(" 0.80", ""),
        "section 'm' has 11 ordinates, at line 6 of a.txt; give 5 heights (nb + 1), then 7",
    ),
    "no section that can be": (
        replaced("hd=12.4", "hd=13"),
        "section: last waterline z=12.9 must be above the deck side 13, section 'm', at line 6 of",
    ),
    "no portion": (HEAD + SECTION, "the card portion is missing, in a.txt"),
    "a portion of no kind": (
        replaced("portion 3", "portion 14"), "portion 14: number must be 1..13, at line 9 of a.txt"
    ),
    "a portion of a part": (replaced("portion 3", "portion 3.5"), "portion is 3.5, at line 9"),
    "a portion of no section": (
        replaced("16 m", "16 n"), "there is no section 'n', at line 11 of a.txt"
    ),
    "a row of another form": (replaced("16 m", "16"), "a row of portion has 1 cell(s), at line 11"),
    "unequal steps": (
        replaced("16 m", "17 m"),
        "portion 3: stations not equally spaced at index 1 (step 15, expected 17), at line 9",
    ),
    "overlapping portions": (
        TEXT + "portion 4\n24 m\n32 m\n40 m\n",
        "portions 3 and 4 of the main body overlap in x: [24,32], in a.txt",
    ),
    "a negative corner": (TEXT + "corner -1\n", "corner is -1, at line 13"),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_no_text_of_a_ship_is_refused(case: str) -> None:
    """With the line that says it, in one line."""
    text, what = REFUSED[case]
    with pytest.raises(AssocHullError) as caught:
        read(text)
    assert isinstance(caught.value, BadInputError | GeometryError)
    assert what in str(caught.value)
    assert "\n" not in str(caught.value)


def test_definitions_are_told_by_their_first_word(tmp_path: Path) -> None:
    """Whatever the file is called; `ah.read` makes the hull, judges it, and takes no places."""
    path = tmp_path / "ship.csv"
    path.write_text("# a comment\n" + TEXT, "utf-8")
    assert holds_definition(path)
    with pytest.raises(ah.errors.NotSoundError, match="1 section"):
        ah.read(path)
    hull = ah.read(path, accept=True)
    assert hull.adoption is not None
    assert hull.adoption.notes[-1].startswith("verdict: not sound")
    assert hull.check() == ()
    made = ah.create(ah.creation.read_classical(path))
    assert made.fingerprint == hull.fingerprint
    with pytest.raises(BadInputError, match="draught, scale cannot be given"):
        ah.read(path, draught=3.0, scale=2.0)


@pytest.mark.parametrize(
    ("content", "what"),
    [
        pytest.param(b"x,y\n1,2\n", "the text is no classical definition", id="a table"),
        pytest.param(b"", "the text is no classical definition", id="nothing"),
        pytest.param(b"SFOLDS a\0b", "the content is binary", id="binary"),
        pytest.param(b"SFOLDS a\n1 2\n", "a row of numbers stands before", id="row first"),
    ],
)
def test_files_that_hold_no_definition(tmp_path: Path, content: bytes, what: str) -> None:
    """The file is named."""
    path = tmp_path / "a.txt"
    path.write_bytes(content)
    with pytest.raises(BadInputError, match=what) as caught:
        ah.creation.read_classical(path)
    assert "a.txt" in str(caught.value)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    """And a folder."""
    for path in (tmp_path / "none.txt", tmp_path):
        with pytest.raises(BadInputError, match="the file cannot be read"):
            ah.creation.read_classical(path)


def test_names_in_another_encoding_are_read(tmp_path: Path) -> None:
    """As Latin-1, where the bytes are no UTF-8."""
    path = tmp_path / "a.txt"
    path.write_bytes(TEXT.replace("SFOLDS Body", 'SFOLDS "F\xe4hre"').encode("latin-1"))
    assert ah.creation.read_classical(path).particulars.name == "F\xe4hre"
