"""Bodies beside a net: hatches, deck houses, boxes, appendages and bossings of the texts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.classical.sfolds import Sfolds, portion_body
from assoc_hull.errors import BadInputError, GeometryError
from assoc_hull.io.classical.read import read_definition
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.shipped.classical_ships import classical_ship, classical_text

BOX = """SEAKING "Box"
length 40
breadth 16
depth 9
draught 6
keel 0 40
contour aft
-2 9
0 0
contour forward
40 0
42 9
tangent
0 4
40 4
waterline 3
0 6
40 6
deckside
-2 8 9 1
42 8 9 0
camber parabola
-2 0.4
42 0.4
frames 5 12 20 28 35
"""
BODIES = """hatch hold from=12 to=24 breadth=8 height=1
house bridge from=2 to=8 breadth=16 height=5 camber=0.4
appendage keel at=10,30 sides=1
-0.5 -1
0.5 -1
0.5 0
-0.5 0
"""


@pytest.fixture(scope="module")
def bare() -> ah.Hull:
    """A box of a ship."""
    return ah.create(read_definition(BOX, "box.txt"))


@pytest.fixture(scope="module")
def made() -> ah.Hull:
    """The same with a hatch, a deck house and a bar keel."""
    return ah.create(read_definition(BOX + BODIES, "box.txt"))


def test_bodies_are_lines_of_groups_of_their_own(made: ah.Hull) -> None:
    """The foot follows the camber of the deck; the top has its own."""
    hold = made.bodies["hold"]
    groups = {each.name: each.group for each in made.bodies.values()}
    assert groups == {
        "bridge": "deck houses", "deck camber": "decks", "hold": "hatches", "keel": "appendages",
    }  # fmt: skip
    assert list(hold.outlines) == ["aft end", "fore end", "edge 1", "edge 2", "edge 3", "edge 4"]
    end = hold.outlines["aft end"]
    assert (end[0] == end[-1]).all()
    foot = end[: len(end) // 2]
    np.testing.assert_allclose(foot[:, 2], 9.4 - 0.4 * (foot[:, 1] / 8.0) ** 2, atol=1e-12)
    np.testing.assert_allclose(hold.outlines["edge 3"][:, 2], 9.3 + 1.0, atol=1e-12)


def test_a_body_encloses_its_volume(made: ah.Hull) -> None:
    """A top of the deck's own camber over its whole breadth: breadth by height by length."""
    assert made.bodies["bridge"].volume == pytest.approx(16.0 * 5.0 * 6.0, rel=1e-12)
    assert made.bodies["keel"].volume == pytest.approx(20.0, rel=1e-12)


def test_the_net_keeps_its_bits(bare: ah.Hull, made: ah.Hull) -> None:
    """And so do hydrostatics; nothing is found by a check."""
    live = bare.state.live("rows")
    np.testing.assert_array_equal(bare.state.rows.xyz[live], made.state.rows.xyz[live])
    assert bare.hydrostatics().volume == made.hydrostatics().volume
    assert made.check() == ()
    assert bare.fingerprint != made.fingerprint


@pytest.mark.parametrize("name", ["ship.hull", "ship.hull.json"])
def test_a_file_keeps_bodies(made: ah.Hull, tmp_path: Path, name: str) -> None:
    """To the bit."""
    made.save(tmp_path / name)
    again = ah.open(tmp_path / name)
    assert again.state.bodies == made.state.bodies
    assert again.fingerprint == made.fingerprint


def test_a_transformation_carries_bodies_and_undo_brings_them_back(tmp_path: Path) -> None:
    """Both sides alike; the step lies in the file as well."""
    hull = ah.create(read_definition(BOX + BODIES, "box.txt"))
    hull.save(tmp_path / "ship.hull")
    hull = ah.open(tmp_path / "ship.hull")
    before = hull.state.bodies
    with hull.edit("wider") as edit:
        edit.transform(lambda xyz: xyz * [1.0, 1.5, 1.0], drivers=["sections", "boundary"])
    for old, new in zip(before, hull.state.bodies, strict=True):
        np.testing.assert_allclose(new.points, old.points * [1.0, 1.5, 1.0], atol=1e-12)
    hull.close()
    again = ah.open(tmp_path / "ship.hull")
    assert again.bodies["bridge"].points[..., 1].max() == pytest.approx(12.0)
    again.undo()
    assert again.state.bodies == before


def test_an_export_says_that_it_leaves_bodies_out(made: ah.Hull, tmp_path: Path) -> None:
    """By their names; the closed mesh is that of the hull."""
    report = made.export(tmp_path / "ship.dxf")
    assert "bodies beside its net (bridge, deck camber, hold, keel)" in str(report)


@pytest.mark.parametrize(
    ("card", "error", "message"),
    [
        ("hatch hold from=12 to=24 breadth=8", BadInputError, "hatch lacks height"),
        ("hatch hold from=12 to=24 breadth=x height=1", BadInputError, "in breadth, at line 26"),
        ("hatch from=12 to=24 breadth=8 height=1", BadInputError, "a hatch has no name"),
        ("house h from=12 to=24 breadth=8 height=1 roof=2", BadInputError, "the cell 'roof=2'"),
        ("house h from=24 to=12 breadth=8 height=1", GeometryError, "h: length -12, at line 26"),
        ("house h from=12 to=24 breadth=8 height=0", GeometryError, "h: height 0, at line 26"),
        ("house h from=12 to=50 breadth=8 height=1", GeometryError, "to is x=50, where no deck"),
        ("house h from=12 to=24 breadth=17 height=1", GeometryError, "breadth 17 exceeds the deck"),
    ],
)
def test_a_wrong_card_is_refused_with_its_line_and_cell(
    card: str, error: type[Exception], message: str
) -> None:
    """Nothing is guessed."""
    with pytest.raises(error) as raised:
        read_definition(f"{BOX}{card}\n", "box.txt")
    assert message in str(raised.value)
    assert "at line 26 of box.txt" in str(raised.value)


def test_prelikon_has_hatches_beside_houses_and_boxes() -> None:
    """A hatch is a block on a deck; two bodies of one name are numbered."""
    text = classical_text("prelikon_ship")
    cards = "hatch hold deck=1 breadth=10 height=1.2 from=-10 to=10\n"
    ship = read_definition(text + cards + cards, "ship.txt")
    bodies = {each.name: each for each in ship.bodies()}
    assert bodies["deck house"].volume == pytest.approx(624.0, rel=1e-12)
    assert bodies["hold"].volume == pytest.approx(240.0, rel=1e-12)
    assert bodies["sea chest"].sign == -1
    assert ship.report().figure("hold: volume").value == pytest.approx(240.0)
    assert "2 hatches are outlined beside the net" in ship.notes
    names = set(ah.create(ship).bodies)
    assert {"hold", "hold 2"} <= names


def test_portions_of_their_own_are_outlined_as_their_sections_are() -> None:
    """Areas are those of the ordinates; volumes those of straight lines between sections."""
    ship = classical_ship("sfolds_ship")
    assert isinstance(ship, Sfolds)
    rest = {each.kind: each.volume for each in ship.portions if not each.is_main}
    found = {each.name: each.volume for each in ship.bodies()}
    assert list(found) == [*rest, "deck camber"]
    # Three stations: between them Simpson's rule has a parabola, and the outline is straight.
    assert found["bossing"] == pytest.approx(rest["bossing"], rel=0.12)
    for portion in (each for each in ship.portions if not each.is_main):
        rings = portion_body(portion).points[..., 1:]
        after = np.roll(rings, -1, axis=1)
        swept = rings[..., 0] * after[..., 1] - after[..., 0] * rings[..., 1]
        areas = [each.area for each in portion.sections]
        np.testing.assert_allclose(0.5 * swept.sum(axis=1), areas, rtol=5e-3)


def test_the_camber_of_a_deck_lies_between_its_sides(made: ah.Hull, bare: ah.Hull) -> None:
    """A parabola over a constant breadth; its centre line is the edge along; sections turn left."""
    camber = made.bodies["deck camber"]
    assert camber == bare.bodies["deck camber"]
    assert camber.volume == pytest.approx(2.0 / 3.0 * 16.0 * 0.4 * 44.0, rel=5e-3)
    centre = camber.outlines["edge 1"]
    np.testing.assert_allclose(centre[:, 1:], [[0.0, 9.4]] * len(centre), atol=1e-12)
    assert (centre[0, 0], centre[-1, 0]) == (-2.0, 42.0)


@pytest.mark.parametrize(
    ("ship", "whole"),
    [
        ("seaking_ship", "volume with its decks"),
        ("prelikon_ship", "hull to the deck, with camber: volume"),
        ("sfolds_ship", "main body: volume, with camber"),
    ],
)
def test_mesh_and_camber_enclose_what_the_definition_does(ship: str, whole: str) -> None:
    """Two routes: chords of lines and of the deck here, exact areas there."""
    said = classical_ship(ship)
    mesh = ah.create(said).mesh()
    camber = [each for each in mesh.bodies if each.name == "deck camber"]
    assert len(camber) == 1
    enclosed = mesh.volume + float(camber[0].report.fluxes[0])
    assert enclosed == pytest.approx(said.report().figure(whole).value, rel=1e-3)


def test_a_body_of_the_name_of_a_line_is_numbered() -> None:
    """However it is written; what reads as an address is written so that it can be looked up."""
    cards = [f"hatch {name} from=12 to=24 breadth=8 height=1\n" for name in ("Profile", "a/b")]
    ship = ah.create(read_definition(BOX + "".join(cards), "box.txt"))
    assert set(ship.bodies) == {"Profile 2", "a-b", "deck camber"}
    assert ship["a-b"] is ship.bodies["a-b"]


def test_triangles_close_a_body_that_is_not_convex() -> None:
    """Each edge is that of two triangles, once in each sense; they face outward."""
    drawn = np.array([[0, 0, 0], [0, 4, 0], [0, 4, 3], [0, 2, 1], [0, 0, 3]], np.float64)
    for ring in (drawn, drawn[::-1]):
        body = AttachedBody("w", "boxes", [ring, ring + np.array([2, 0, 0])], (), False, 1)
        edges = np.concatenate([body.triangles[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))])
        assert len(np.unique(edges, axis=0)) == len(edges)
        assert {tuple(each) for each in edges} == {tuple(each) for each in edges[:, ::-1]}
        corner = body.points.reshape(-1, 3)[body.triangles]
        flux = (corner[:, 0] * np.cross(corner[:, 1], corner[:, 2])).sum() / 6.0
        assert flux == pytest.approx(16.0)
