"""What headers and comments of digitised lines state of the ship: used, told, held to the hull."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

import assoc_hull as ah
from tests.foreign_hulls import as_of_others, write_lines
from tests.long_forms import LONG

SAID = "Lpp = 97.5 m, B = 9.9 m, T = 6.0 m"


@cache
def wigley() -> ah.Hull:
    """Length 100 m, breadth 10 m, 9.375 m high."""
    return ah.examples.wigley(stations=9, waterlines=6)


def csv(folder: Path, said: str) -> Path:
    """A comment above the points."""
    path = write_lines(wigley(), folder / "lines.csv")
    path.write_text(f"# {said}\n{path.read_text()}")
    return path


def britfair(folder: Path, said: str) -> Path:
    """The title."""
    path = folder / "lines.bri"
    wigley().export(path, "britfair")
    rows = path.read_text().splitlines()
    path.write_text("\n".join([f"COASTER {said}", *rows[1:], ""]))
    return path


def gf(folder: Path, said: str) -> Path:
    """A comment; the origin stands in rows of its own."""
    path = folder / "lines.gf"
    wigley().export(path, "gf")
    path.write_text(path.read_text().replace("\\Sections", f"\\{said}\n\\Sections", 1))
    return path


def dxf_comment(folder: Path, said: str) -> Path:
    """A comment at its beginning."""
    path = folder / "lines.dxf"
    wigley().export(path)
    path = as_of_others(path)
    path.write_text(f"999\n{said}\n{path.read_text()}")
    return path


def dxf_text(folder: Path, said: str) -> Path:
    """A text in its title block."""
    path = folder / "title.dxf"
    wigley().export(path)
    path = as_of_others(path)
    head, mark, rest = path.read_text().rpartition("ENDSEC")
    mine, entities = head, rest
    at = mine.index("ENTITIES") + len("ENTITIES\n")
    row = f"  0\nTEXT\n  8\ntitle\n 10\n0.0\n 20\n-9.0\n 30\n0.0\n 40\n1.0\n  1\n{said}\n"
    path.write_text(mine[:at] + row + mine[at:] + mark + entities)
    return path


FORMS: dict[str, Callable[[Path, str], Path]] = {
    "csv": csv, "britfair": britfair, "gf": gf, "dxf comment": dxf_comment, "dxf text": dxf_text,
}  # fmt: skip


def notes(hull: ah.Hull, kind: str, word: str) -> list[str]:
    """What is told of one thing."""
    assert hull.adoption is not None
    return [note for note in hull.adoption.notes if note.startswith(f"{kind}: {word}:")]


@pytest.mark.parametrize("form", FORMS if LONG else ["britfair", "gf", "dxf text"])
def test_what_a_header_states_is_used_and_told_as_stated(form: str, tmp_path: Path) -> None:
    """Lpp, B and T; what is given counts before it."""
    path = FORMS[form](tmp_path, SAID)
    hull = ah.read(path, accept=True)
    ship = hull.particulars
    assert (ship.length, ship.breadth, ship.draught) == pytest.approx((97.5, 9.9, 6.0))
    (draught,) = notes(hull, "assumed", "draught")
    assert "as the file says" in draught
    # Bare sections from x = 0 on leave x = 0 the AP, and 97.5 m the FP.
    assert (
        "= 97.5 m of the file" if form == "britfair" else "97.5 m, stated in the file"
    ) in " ".join(
        notes(hull, "assumed", "aft perpendicular")
        + notes(hull, "assumed", "forward perpendicular")
    )
    given = ah.read(path, accept=True, length=98.0, draught=5.0).particulars
    assert (given.length, given.draught) == (98.0, 5.0)


@pytest.mark.parametrize("form", ["csv", "gf"] if LONG else ["gf"])
def test_what_the_hull_cannot_have_is_suspected_and_not_taken(form: str, tmp_path: Path) -> None:
    """Lpp and T of another ship: each is told with what the lines reach over, and the remedy."""
    hull = ah.read(FORMS[form](tmp_path, "Lpp = 380 m, T = 60 m"), accept=True)
    plain = ah.read(FORMS[form](tmp_path, "nothing"), accept=True)
    assert hull.particulars == plain.particulars
    length, *_ = notes(hull, "suspicion", "length")
    assert "the file says 380 m" in length
    assert "give length= in m" in length
    (draught,) = notes(hull, "suspicion", "draught")
    assert "60 m" in draught


def test_the_origin_of_a_gf_is_the_perpendicular_that_it_names(tmp_path: Path) -> None:
    """Sections alone would put the AP at the aftmost of them: OL and OV say where it is."""
    path = gf(tmp_path, "nothing")
    hull = ah.read(path, length=100.0, draught=6.25, accept=True)
    (told,) = notes(hull, "assumed", "aft perpendicular")
    assert "OL:AFTER PERPENDICULAR" in told
    assert min(float(name[3:]) for name in hull.lines if name.startswith("ST ")) > 12.0
    (base,) = notes(hull, "assumed", "base line")
    assert "OV:BASELINE" in base
    path.write_text(path.read_text().replace("OL:AFTER PERPENDICULAR", "OL:MIDSHIP"))
    (told,) = notes(ah.read(path, length=100.0, draught=6.25, accept=True), "assumed",
                    "aft perpendicular")  # fmt: skip
    assert "OL:" not in told
