"""A refusal says what to do, and whoever does it gets the right hull.

Each case is a file, and what its owner knows of the ship. What is done is read from the message
alone: an option that it names is given, with the value it proposes or else the known one; one that
it says to leave out goes; a cell, row or name in the file that it points at is corrected.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, BadInputError, NotSoundError
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.hull import Hull
from tests import meshes

L, B, T, D = 100.0, 10.0, 4.5, 6.25
KNOWN: dict[str, Any] = {"length": L, "draught": T}
Numbers = Any


def half_breadth(x: Numbers, z: Numbers) -> Numbers:
    """Wigley's hull of 100 x 10 m, 6.25 m deep, m."""
    return 0.5 * B * (1.0 - (2.0 * x / L - 1.0) ** 2) * (1.0 - (1.0 - z / D) ** 2)


def volume(draught: float) -> float:
    """Its volume below a draught, m3."""
    return B * L * 2.0 / 3.0 * (draught**2 / D - draught**3 / (3.0 * D**2))


def table(size: float = 1.0, said: str = "# station 0 = AP", digits: int = 4) -> str:
    """Offsets of it, in units of which a metre has so many."""
    z = np.linspace(0.0, D, 11)
    rows = [said, "station," + ",".join(f"wl_{size * each:.7g}" for each in z)]
    for i, x in enumerate(np.linspace(0.0, L, 21).tolist()):
        cells = (f"{size * each:.{digits}f}" for each in half_breadth(x, z))
        rows.append(",".join([f"{i / 2:g}", *cells]))
    return "\n".join(rows) + "\n"


def normalised() -> str:
    """Offsets as parts of B/2, heights as parts of the draught."""
    z = np.linspace(0.0, D, 11)
    rows = ["# y/(B/2), z/T; station 0 = AP", "station," + ",".join(f"wl_{h / T:.9f}" for h in z)]
    for i, x in enumerate(np.linspace(0.0, L, 21).tolist()):
        cells = (f"{2.0 * each / B:.6f}" for each in half_breadth(x, z))
        rows.append(",".join([f"{i / 2:g}", *cells]))
    return "\n".join(rows) + "\n"


def cell(text: str, row: int, column: int, value: str) -> str:
    """A table with another text in a cell; rows and columns count from 1, as in a spreadsheet."""
    rows = [line.split(",") for line in text.splitlines()]
    rows[row - 1][column - 1] = value
    return "\n".join(map(",".join, rows)) + "\n"


def doubled(row: int) -> str:
    """A table with a row that comes again with another number."""
    rows = table().splitlines()
    other = rows[row - 1].split(",")
    other[5] = f"{float(other[5]) + 0.3:.4f}"
    return "\n".join([*rows[:row], ",".join(other), *rows[row:]]) + "\n"


def lines(size: float = 1.0, profile: tuple[str, str] = ("profile", "profile")) -> str:
    """Sections, waterlines, deck edge and profile as lists of points."""
    found: list[tuple[str, Numbers]] = []
    heights, places = np.linspace(0.0, D, 26), np.linspace(0.0, L, 81)
    for i in range(1, 20):
        x = 5.0 * i + 0.0 * heights
        found.append((f"ST {i / 2:g}", np.stack([x, half_breadth(x, heights), heights], axis=1)))
    for z in (1.25, 2.5, 3.75, 5.0, D):
        name = "deck edge" if z == D else f"WL {z:g}"
        level = np.full_like(places, z)
        found.append((name, np.stack([places, half_breadth(places, z), level], axis=1)))
    aft, fore = np.zeros((26, 3)), np.zeros((26, 3))
    aft[:, 2], fore[:, 2], fore[:, 0] = heights[::-1], heights, L
    keel = np.zeros((81, 3))
    keel[:, 0] = places
    found.append((profile[0], np.concatenate([aft, keel[1:41]])))
    found.append((profile[1], np.concatenate([keel[40:-1], fore])))
    rows = [
        ",".join([name, *(f"{size * each:.6f}" for each in point)])
        for name, points in found
        for point in points.tolist()
    ]
    return "\n".join(["line,x,y,z", *rows]) + "\n"


def mesh(size: float = 1.0) -> Triangles:
    """Half of it, open at the deck."""
    half = meshes.wigley_half(81, 41)
    return Triangles(half.xyz * size, half.face)


def pair(off: float) -> Triangles:
    """A catamaran of two of them."""
    whole = meshes.mirrored(mesh())
    shift = np.array([0.0, off, 0.0])
    face = np.concatenate([whole.face, whole.face + len(whole.xyz)])
    return Triangles(np.concatenate([whole.xyz + shift, whole.xyz - shift]), face)


CUTS: dict[str, Any] = {"stations": 15, "waterlines": 8, "buttocks": 1}


@attrs.frozen
class Case:
    """A file that is refused.

    Attributes
    ----------
    file : str
        Its name.
    make : callable
        Gives its text or mesh.
    given : mapping
        The options it is read with first.
    known : mapping
        What else its owner knows.
    steps : int
        How many refusals may come before the hull.
    """

    file: str
    make: Callable[[], str | Triangles]
    given: dict[str, Any]
    known: dict[str, Any] = attrs.field(factory=dict)
    steps: int = 1


CASES = {
    "stations by number": Case("a.csv", table, {"draught": T}, {"length": L}),
    "units that disagree": Case(
        "a.csv", lambda: table(1e3, "# half-breadths in mm; 0 = AP", 0), {**KNOWN, "unit": "m"}
    ),
    "normalised offsets": Case(
        "a.csv", normalised, {}, {**KNOWN, "breadth": B},
    ),
    "an unknown station 0": Case("a.csv", lambda: table(said="#"), KNOWN, {"station_zero": "ap"}),
    "a breadth too small": Case(
        "a.csv", table, {**KNOWN, "breadth": 8.0}, {"breadth": B, "unit": "m"}, steps=2
    ),
    "a breadth too large": Case("a.csv", table, {**KNOWN, "breadth": 12.0}, {"breadth": B}),
    "a draught in decimetres": Case("a.csv", table, {"length": L, "draught": 45.0}, {"draught": T}),
    "half of a design trim": Case(
        "a.csv", table, {"length": L, "draught_aft": T}, {"draught_fwd": T}
    ),
    "an option of other forms": Case("a.csv", table, {**KNOWN, "join": 0.1}),
    "a letter for a number": Case(
        "a.csv", lambda: cell(table(), 13, 8, "x"), KNOWN
    ),
    "a decimal point left out": Case(
        "a.csv", lambda: cell(table(), 13, 8, "42000"), KNOWN
    ),
    "a half-breadth to starboard": Case(
        "a.csv", lambda: cell(table(), 13, 8, "-4.2"), KNOWN
    ),
    "a station twice": Case("a.csv", lambda: doubled(9), KNOWN),
    "a profile of two names": Case("a.csv", lambda: lines(profile=("keel a", "keel b")), KNOWN),
    "lines in feet": Case("a.csv", lambda: lines(1.0 / 0.3048), KNOWN),
    "millimetres said to be metres": Case("a.csv", lambda: lines(1e3), {**KNOWN, "unit": "m"}),
    "a model": Case("a.stl", lambda: mesh(1.0 / 25.0), {**KNOWN, **CUTS}, {"scale": 25.0}),
    "two hulls": Case("a.stl", lambda: pair(12.0), {**KNOWN, **CUTS}),
    "a hull on its side": Case(
        "a.stl", mesh, {**KNOWN, **CUTS, "axes": "+x+z+y"}, {"axes": "+x+y+z"}
    ),
    "a hull athwart": Case(
        "a.stl", mesh, {**KNOWN, **CUTS, "axes": "+y+x+z"}, {"axes": "+x+y+z"}
    ),
    "a hull on end": Case(
        "a.stl", mesh, {**KNOWN, **CUTS, "axes": "+z+y+x"}, {"axes": "+x+y+z"}
    ),
}  # fmt: skip

OPTION = re.compile(r"\b([a-z_]+)=('[^']*'|\"[^\"]*\"|[-+]?[\d.]+(?:e-?\d+)?)?")
SPOT = re.compile(r"row (\d+) \(.*?\), column '(.+?)'")


def advice(error: AssocHullError) -> str:
    """The part of a message that says what to do."""
    if isinstance(error, BadInputError):
        return error.remedy
    assert isinstance(error, NotSoundError)
    # What is to be done about a finding stands after the last colon of it.
    return error.findings[0].rpartition(": ")[2]


def corrected(case: Case, path: Path, message: str) -> bool:
    """Correct the cell, row or names in the file that a message points at; tell whether it does."""
    text = path.read_text("latin-1")
    if "delete one of the two rows" in message:
        row = int(SPOT.search(message)[1])  # type: ignore[index]
        rows = text.splitlines()
        path.write_text("\n".join(rows[: row - 1] + rows[row:]) + "\n")
        return True
    if "give their pieces one name" in message:
        for name in re.findall(r"'(keel \w)'", message):
            text = text.replace(name, "profile")
        path.write_text(text)
        return True
    spot = SPOT.search(message)
    if spot is None:
        return False
    row, right = int(spot[1]), table().splitlines()
    column = right[1].split(",").index(spot[2])
    path.write_text(cell(text, row, column + 1, right[row - 1].split(",")[column]))
    return True


def followed(case: Case, error: AssocHullError, used: dict[str, Any]) -> dict[str, Any]:
    """Give the options that a message asks for."""
    said, found = advice(error), dict(used)
    leave = re.search(r"leave (?:the (\w+)|(\w+)=|it) out", said)
    if leave is not None:
        name = leave[1] or leave[2] or str(error).partition(" cannot")[0]
        del found[name]
        return found
    words = {name: value.strip("'\"") for name, value in OPTION.findall(said)}
    for name in re.findall(r"\b(draught)s\b", said):  # both of a trim
        words |= {f"{name}_aft": "", f"{name}_fwd": ""}
    for name, value in words.items():
        if name in case.known:
            found[name] = case.known[name]
        elif value and name != "accept":
            found[name] = float(value) if re.fullmatch(r"[-+]?[\d.]+(e-?\d+)?", value) else value
    return found


@pytest.mark.parametrize("name", CASES)
def test_what_a_refusal_says_leads_to_the_right_hull(name: str, tmp_path: Path) -> None:
    """The volume is within .05 % of the formula's, and every step changes something."""
    case = CASES[name]
    path, made = tmp_path / case.file, case.make()
    path.write_text(made) if isinstance(made, str) else meshes.write(made, path)
    hull: Hull | None = None
    used, said = dict(case.given), list[str]()
    while hull is None:
        try:
            hull = ah.read(path, **used)
        except (BadInputError, NotSoundError) as error:
            said.append(str(error))
            assert len(said) <= case.steps, said
            if not corrected(case, path, said[-1]):
                options = followed(case, error, used)
                assert options != used, said
                used = options
    assert said, "it was not refused"
    assert hull.hydrostatics(draught=T).volume == pytest.approx(volume(T), rel=5e-4), said


def sheered() -> str:
    """A table of it with a deck that is lowest amidships, at 5 m."""
    z = np.array([0.0, 0.625, 1.25, 1.875, 2.5, 3.125, 3.75, 4.375, 5.0])
    head = ["station", *(f"wl_{each:g}" for each in z), "deck_height", "deck_half_breadth"]
    rows = ["# station 0 = AP, metres", ",".join(head)]
    for i, x in enumerate(np.linspace(0.0, L, 21).tolist()):
        deck = 5.0 + (2.0 * x / L - 1.0) ** 2
        places = np.append(z, deck)
        cells = [f"{each:.5f}" for each in half_breadth(x, places)]
        rows.append(",".join([f"{i / 2:g}", *cells[:-1], f"{deck:.5f}", cells[-1]]))
    return "\n".join(rows) + "\n"


def under(x: Numbers, height: Numbers) -> Numbers:
    """Area of a section up to a height, m2."""
    return B * (1.0 - (2.0 * x / L - 1.0) ** 2) * (height**2 / D - height**3 / (3.0 * D**2))


def test_an_open_deck_that_drowns_may_be_closed(tmp_path: Path) -> None:
    """`deck="closed"`, as the message says: amidships the deck is under water then."""
    path = tmp_path / "a.csv"
    path.write_text(sheered())
    with pytest.raises(ah.errors.OutOfRangeError, match='deck="closed"'):
        ah.read(path, **KNOWN).hydrostatics(draught=5.2)
    hull = ah.read(path, **KNOWN, deck="closed")
    x = np.linspace(0.0, L, 20001)
    height = np.minimum(5.2, 5.0 + (2.0 * x / L - 1.0) ** 2)
    truth = float(np.trapezoid(under(x, height), x))
    assert hull.hydrostatics(draught=5.2).volume == pytest.approx(truth, rel=5e-4)


def test_no_deck_is_proposed_where_it_helps_nothing(tmp_path: Path) -> None:
    """Over the top of a hull there is no draught, with a deck or without."""
    path = tmp_path / "a.csv"
    path.write_text(table())
    for deck in ("open", "closed"):
        with pytest.raises(ah.errors.OutOfRangeError) as refused:
            ah.read(path, **KNOWN, deck=deck).hydrostatics(draught=7.0)
        assert "closed" not in str(refused.value)


def test_a_hull_that_is_not_sound_is_taken_on_demand(tmp_path: Path) -> None:
    """`accept=True`, as the message says; the lines are right, and the verdict is kept."""
    path = tmp_path / "a.csv"
    path.write_text(table())
    with pytest.raises(NotSoundError, match="accept=True"):
        ah.read(path, **KNOWN, breadth=12.0)
    hull = ah.read(path, **KNOWN, breadth=12.0, accept=True)
    assert hull.hydrostatics(draught=T).volume == pytest.approx(volume(T), rel=5e-4)
    assert hull.adoption is not None
    assert any(each.startswith("verdict: not sound (1 fault") for each in hull.adoption.notes)


def test_a_scene_is_exported_again_as_a_mesh(tmp_path: Path) -> None:
    """glTF is for viewers: the message names the forms that are read."""
    import trimesh

    half, path = mesh(), tmp_path / "a.glb"
    trimesh.Trimesh(half.xyz, half.face, process=False).export(path)
    with pytest.raises(BadInputError, match="glTF") as refused:
        ah.read(path, **KNOWN)
    ending = re.search(r"\.[a-z]{3}\b", refused.value.remedy)
    assert ending is not None
    other = meshes.write(half, tmp_path / f"a{ending[0]}")
    hull = ah.read(other, **KNOWN, **CUTS)
    assert hull.hydrostatics(draught=T).volume == pytest.approx(volume(T), rel=5e-4)
