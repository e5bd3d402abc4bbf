"""Spline surfaces of IGES files: all that the format allows, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random

import numpy as np
import pytest

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.iges.surfaces import surfaces_of_iges
from assoc_hull.io.iges.write import iges_text
from tests.curved_patches import patch
from tests.fuzz.text import change_text
from tests.iges_files import NET, SQUARE, Entity, face, iges, matrix, surface

TURN = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
"""A quarter turn about z."""


def read(text: str, unit: str | None = None) -> tuple[list[SplineSurface], tuple[str, ...]]:
    """Surfaces and notes of a file."""
    found, _, notes = surfaces_of_iges(text, "file.igs", unit)
    return found, notes


def only(text: str, unit: str | None = None) -> SplineSurface:
    """The surface of a file that has one."""
    (found,), _ = read(text, unit)
    return found


def spline(seed: int, *, rational: bool) -> SplineSurface:
    """Some B-spline surface, not closed to a box, with a knot that is there twice."""
    rng = np.random.default_rng(seed)
    knots_u = np.array([0.0, 0, 0, 0, 0.3, 0.3, 1.7, 2, 2, 2, 2])
    knots_v = np.array([-1.0, -1, -1, 0.25, 4, 4, 4]) / 3.0
    net = rng.normal(size=(7, 4, 3)) * 10.0 ** rng.integers(-8, 3, (7, 4, 3))
    weights = rng.uniform(0.5, 2.0, (7, 4)) if rational else None
    return SplineSurface(f"plate {seed}", (3, 2), knots_u, knots_v, net, weights)


@pytest.mark.parametrize("rational", [False, True], ids=["polynomial", "rational"])
def test_what_is_written_is_read_to_the_last_bit(rational: bool) -> None:
    """Nets, knots, weights and names of several surfaces, in metres."""
    given = [spline(seed, rational=rational) for seed in range(3)]
    found, notes = read(iges_text(given))
    for one, other in zip(given, found, strict=True):
        assert (one.name, one.degrees) == (other.name, other.degrees)
        for name in ("net", "knots_u", "knots_v"):
            assert getattr(one, name).tobytes() == getattr(other, name).tobytes()
        if rational:
            assert one.weights is not None
            assert other.weights is not None
            assert one.weights.tobytes() == other.weights.tobytes()
        else:
            assert other.weights is None
    assert notes == ()
    assert iges_text(found) == iges_text(given)


@pytest.mark.parametrize("unit", ["mm", "cm", "ft", "in"])
def test_other_units_come_back_within_rounding(unit: str) -> None:
    """The file says its unit; a length changes by an ulp or two."""
    given = SplineSurface.bezier(patch("P08_wavy_plate"), "plate")
    assert only(iges_text([given], unit)).net == pytest.approx(given.net, rel=5e-16, abs=0.0)


def test_the_same_surfaces_give_the_same_bytes() -> None:
    """Nothing of time or place is in the file; its lines have 80 columns."""
    given = [spline(1, rational=True)]
    text = iges_text(given)
    assert text == iges_text(given)
    assert {len(each) for each in text.splitlines()} == {80}


@pytest.mark.parametrize(
    ("unit", "metres"),
    [
        pytest.param("1,2HIN", 0.0254, id="inch"),
        pytest.param("2,2HMM", 1e-3, id="millimetre"),
        pytest.param("4,2HFT", 0.3048, id="foot"),
        pytest.param("5,2HMI", 1609.344, id="mile"),
        pytest.param("6,1HM", 1.0, id="metre"),
        pytest.param("7,2HKM", 1e3, id="kilometre"),
        pytest.param("8,3HMIL", 2.54e-5, id="mil"),
        pytest.param("9,2HUM", 1e-6, id="micrometre"),
        pytest.param("10,2HCM", 1e-2, id="centimetre"),
        pytest.param("11,3HUIN", 2.54e-8, id="microinch"),
    ],
)
def test_every_flag_of_a_unit_is_known(unit: str, metres: float) -> None:
    """Lengths come in metres."""
    assert only(iges([surface()], unit)).net == pytest.approx(NET * metres, rel=1e-15)


@pytest.mark.parametrize("unit", ["3,5HFATHS", "0,", ",", "12,1HX"])
def test_without_a_known_unit_one_is_asked_for(unit: str) -> None:
    """A flag that means "see the name", or none: never a guess."""
    with pytest.raises(BadInputError, match=r"tells no unit of length.*give unit: m, mm, cm"):
        read(iges([surface()], unit))
    assert only(iges([surface()], unit), "mm").net == pytest.approx(NET * 1e-3)


def test_a_unit_that_is_asked_for_goes_before_that_of_the_file() -> None:
    """And the notes say so."""
    found, notes = read(iges([surface()], "2,2HMM"), "m")
    assert np.array_equal(found[0].net, NET)
    assert notes == ("file.igs says that its unit is mm; it is read in m, as asked.",)


def test_the_scale_of_the_model_is_taken_out() -> None:
    """Lengths of the model over the scale are those of the ship."""
    found, notes = read(iges([surface()], scale="0.125"))
    assert np.array_equal(found[0].net, 8.0 * NET)
    assert "model scale of 0.125" in notes[0]
    assert only(iges([surface()], scale="0.125"), "mm").net == pytest.approx(8e-3 * NET)


@pytest.mark.parametrize("marks", [("/", ";"), (",", "#"), ("|", "!")], ids="".join)
def test_delimiters_are_those_of_the_file(marks: tuple[str, str]) -> None:
    """The global section begins with them."""
    assert np.array_equal(only(iges([surface()], marks=marks)).net, NET)


@pytest.mark.parametrize("exponent", ["E", "e", "D", "d"])
def test_powers_of_ten_may_be_written_with_d(exponent: str) -> None:
    """As Fortran writes double precision."""
    net = NET * 1e-7
    assert np.array_equal(only(iges([surface(net)], exponent=exponent)).net, net)


@pytest.mark.parametrize("change", [
    pytest.param(lambda text: text.replace("\n", "\r\n"), id="lines of Windows"),
    pytest.param(lambda text: text.replace("\n", ""), id="records without ends of lines"),
    pytest.param(lambda text: text + "\n   \n\x1a", id="blank lines behind the end"),
    pytest.param(lambda text: text.replace("     1.0,", " ,"), id="nothing to change"),
])  # fmt: skip
def test_other_ends_of_lines_are_read(change: Callable[[str], str]) -> None:
    """Records of 80 columns need none."""
    assert np.array_equal(only(change(iges([surface()]))).net, NET)


def test_transformations_run_in_chains() -> None:
    """First the one that the surface names, then the one that this one names."""
    first, then = matrix(TURN, (1.0, 2.0, 3.0), moved=5), matrix(2.0 * np.eye(3), (0.0, 0.0, 7.0))
    found, notes = read(iges([surface(moved=3), first, then], "2,2HMM"))
    wanted = 2.0 * (NET @ TURN.T + [1.0, 2.0, 3.0]) + [0.0, 0.0, 7.0]
    assert found[0].net == pytest.approx(1e-3 * wanted, abs=1e-15)
    assert "stretches by up to 100 %" in notes[0]


def test_a_ring_of_transformations_is_refused() -> None:
    """It would have no end."""
    ring = [matrix(TURN, (0, 0, 0), moved=5), matrix(TURN, (0, 0, 0), moved=3)]
    with pytest.raises(BadInputError, match="run in a ring: D3 -> D5 -> D3"):
        read(iges([surface(moved=3), *ring]))


def test_a_part_of_a_moved_face_moves_with_it() -> None:
    """A dependent surface is moved by itself, then with its face; an independent one is not."""
    parts = face()
    parts[1] = Entity(144, [1, 0, 0, 0], moved=9)
    parts[4] = matrix(TURN, (0.0, 0.0, 1.0))
    assert only(iges(parts)).net == pytest.approx(NET @ TURN.T + [0.0, 0.0, 1.0])
    parts[0] = surface(status="00000000")
    assert np.array_equal(only(iges(parts)).net, NET)


def test_the_bounds_of_the_parameters_cut_the_surface() -> None:
    """What lies between them is the surface, with its parameters."""
    found = only(iges([surface(spans=(0.25, 1.0, 0.0, 0.5))]))
    whole = SplineSurface.bezier(NET)
    assert found.domain == ((0.25, 1.0), (0.0, 0.5))
    assert found.at(0.4, 0.3) == pytest.approx(whole.at(0.4, 0.3), abs=1e-15)


def test_bounds_that_lost_a_digit_are_those_of_the_knots() -> None:
    """No sliver is cut off, and the net stays as it is."""
    assert np.array_equal(only(iges([surface(spans=(1e-9, 1.0, 0.0, 0.9999999999))])).net, NET)


@pytest.mark.parametrize("kind", [143, 144, 510])
@pytest.mark.parametrize("corners", [
    pytest.param(SQUARE, id="corner to corner"),
    pytest.param(SQUARE[::-1], id="the other way round"),
    pytest.param((*SQUARE[1:3], (0.3, 1.0), *SQUARE[3:], *SQUARE[:1]), id="a side in two"),
    pytest.param(tuple((u + 1e-8, v - 1e-8) for u, v in SQUARE), id="nine digits"),
])  # fmt: skip
def test_a_face_of_its_whole_surface_is_not_trimmed(
    kind: int, corners: tuple[tuple[float, float], ...]
) -> None:
    """Its border is that of the parameters, whatever entity says so."""
    assert np.array_equal(only(iges(face(corners, kind))).net, NET)


@pytest.mark.parametrize("kind", [143, 144, 510])
@pytest.mark.parametrize("corners", [
    pytest.param((*SQUARE[:2], (1.0, 0.9), (0.0, 0.9)), id="a strip is cut off"),
    pytest.param(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0)), id="a triangle"),
    pytest.param((*SQUARE[:3], (0.0, 1.1)), id="outside the box"),
    pytest.param(((0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)), id="an island"),
    pytest.param((*SQUARE[:2], (0.0, 0.0)), id="there and back"),
])  # fmt: skip
def test_a_trimmed_face_is_refused(kind: int, corners: tuple[tuple[float, float], ...]) -> None:
    """Half a surface must not pass for the whole; the extra is named."""
    with pytest.raises(BadInputError, match=r"is trimmed.*extra 'cad'"):
        read(iges(face(corners, kind)))


def test_a_piece_of_border_across_the_surface_cuts_it() -> None:
    """Also where the sides are covered besides."""
    parts = face((*SQUARE, SQUARE[0], (0.5, 0.5)))
    with pytest.raises(BadInputError, match="is trimmed"):
        read(iges(parts))


def test_a_face_with_a_hole_is_refused() -> None:
    """Also where its outer border is that of the surface."""
    parts = face()
    parts[1] = Entity(144, [1, 1, 1, 5, 5])
    with pytest.raises(BadInputError, match="is trimmed: it has 1 holes"):
        read(iges(parts))


def test_a_border_in_space_only_is_refused() -> None:
    """Nothing tells whether it is that of the surface."""
    parts = face()
    parts[2] = Entity(142, [1, 1, 0, 7, 2])
    with pytest.raises(BadInputError, match="not given in the parameters"):
        read(iges(parts))


def test_a_side_that_is_a_point_needs_no_border() -> None:
    """Of a sphere some programs write the seam only: its poles are no curves in space."""
    net = NET.copy()
    net[0] = net[0, 0]
    corners = SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[3]
    parts = face(corners)
    parts[0] = surface(net, status="00010000")
    parts[3] = Entity(102, [3, *parts[3].values[1:4]], status="00010000")
    assert np.array_equal(only(iges(parts)).net, net)
    parts[0] = surface(status="00010000")
    with pytest.raises(BadInputError, match="is trimmed"):
        read(iges(parts))


def test_chains_of_chains_come_to_an_end() -> None:
    """Twenty of them, ten times the next each, would be more pieces than there are numbers."""
    parts, first = face()[:3], 7
    for level in range(18):
        parts.append(Entity(102, [10, *[first + 2 * level + 2] * 10], status="00010000"))
    parts.append(Entity(110, [0, 0, 0, 1, 0, 0], status="00010000"))
    with pytest.raises(BadInputError, match="more than 10000 pieces"):
        read(iges(parts))


def test_a_border_of_one_spline_is_read_piece_by_piece() -> None:
    """A spline of degree 1 through the corners: each leg lies on a side."""
    corners = [value for corner in (*SQUARE, SQUARE[0]) for value in (*corner, 0.0)]
    knots = [0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0]
    round_it = Entity(126, [4, 1, 1, 1, 1, 0, *knots, *[1.0] * 5, *corners, 0.0, 4.0, 0, 0, 1])
    parts = [*face()[:3], round_it]
    assert np.array_equal(only(iges(parts)).net, NET)
    parts[3] = Entity(106, [1, 5, 0.0, *(x for c in (*SQUARE, SQUARE[0]) for x in c)], form=11)
    assert np.array_equal(only(iges(parts)).net, NET)


@pytest.mark.parametrize(
    ("kind", "form", "name"),
    [
        (108, 1, "plane"), (114, 0, "parametric spline surface"), (118, 0, "ruled surface"),
        (120, 0, "surface of revolution"), (122, 0, "tabulated cylinder"),
        (140, 0, "offset surface"), (190, 0, "plane surface"), (192, 0, "cylinder"),
        (194, 0, "cone"), (196, 0, "sphere"), (198, 0, "torus"), (158, 0, "solid"),
    ],
)  # fmt: skip
def test_surfaces_of_other_kinds_are_refused_by_name(kind: int, form: int, name: str) -> None:
    """None is lost unseen, unless the file hides it."""
    with pytest.raises(BadInputError, match=f"entity {kind} .D3., .*|this is a {name}"):
        read(iges([surface(), Entity(kind, [1, 2, 3], form=form)]))
    hidden = Entity(kind, [1, 2, 3], form=form, status="01000000")
    found, notes = read(iges([surface(), hidden]))
    assert len(found) == 1
    assert f"1 of type {kind}" in notes[0]


def test_what_is_no_surface_is_counted() -> None:
    """Curves and points by type; transformations, colours and properties are not worth a word."""
    more = [Entity(110, [0, 0, 0, 1, 1, 1]), Entity(110, [0, 0, 0, 1, 1, 1]),
            Entity(116, [0, 0, 0, 0]), Entity(314, [0, 0, 0])]  # fmt: skip
    _, notes = read(iges([surface(), *more]))
    assert notes == (
        "Of file.igs only surfaces are read; left out are 2 of type 110 (line), 1 of type 116 "
        "(point).",
    )


def test_hidden_surfaces_are_left_out() -> None:
    """And told; a file of nothing else is refused."""
    found, notes = read(iges([surface(status="01000000"), surface(label="side")]))
    assert [each.name for each in found] == ["side"]
    assert "1 of 2 surfaces are blanked" in notes[0]
    with pytest.raises(BadInputError, match="all surfaces are blanked"):
        read(iges([surface(status="01000000")]))


def test_a_surface_is_hidden_with_its_face_and_not_without() -> None:
    """Many programs blank the parts of a face that is to be seen."""
    parts = face()
    parts[0] = surface(status="01010000")
    assert len(read(iges(parts))[0]) == 1
    parts[1] = Entity(144, [1, 0, 0, 0], status="01000000")
    with pytest.raises(BadInputError, match="all surfaces are blanked"):
        read(iges(parts))


def test_names_are_those_of_the_property_then_the_label() -> None:
    """A number where there is neither; none comes twice."""
    named = surface(after=[0, 1, 5], label="label")
    parts = [named, surface(label="deck"), Entity(406, [1, "9Hstem, low"], form=15),
             surface(label="deck"), surface(label="deck"), surface()]  # fmt: skip
    assert [each.name for each in read(iges(parts))[0]] == [
        "stem, low", "deck", "deck (2)", "deck (3)", "surface 5",
    ]  # fmt: skip


def test_a_subfigure_with_surfaces_is_refused() -> None:
    """Its copies may stand anywhere."""
    figure = Entity(308, [0, "4Hfig1", 1, 1])
    with pytest.raises(BadInputError, match="subfigure"):
        read(iges([surface(status="00010000"), Entity(308, [0, "3Hfig", 1, 1])]))
    with pytest.raises(BadInputError):
        read(iges([surface(), figure]))


def test_weights_that_are_equal_are_none() -> None:
    """A surface that only looks rational is polynomial."""
    assert only(iges([surface(weights=np.full((3, 2), 2.0))])).weights is None


Change = Callable[[str], str]


def without(mark: str) -> Change:
    """Take out the lines whose end holds something."""
    return lambda text: "".join(
        line for line in text.splitlines(keepends=True) if mark not in line[65:]
    )


def instead(old: str, new: str) -> Change:
    """Put something of the same length in its place."""
    return lambda text: text.replace(old, new, 1)


def directory_last(text: str) -> str:
    """Put the directory behind the parameters."""
    lines = text.splitlines(keepends=True)
    return "".join(sorted(lines, key=lambda line: "SGPDT".index(line[72])))


DAMAGED: dict[str, tuple[Change, str]] = {
    "cut short": (lambda text: text[:-81], "section T, is missing"),
    "cut short in a line": (lambda text: text[:600], "no letter of a section"),
    "no directory": (without("D      "), "directory section is missing"),
    "sections out of order": (directory_last, "of section D comes after section P"),
    "a line is missing": (without("P      2"), "is numbered"),
    "another count": (instead("P      3   ", "P      4   "), "section T says 4"),
    "a letter that is none": (instead("P      1", "Q      1"), "no letter of a section"),
    "no number": (instead("0.5", "a.5"), "is no number"),
    "no end of values": (instead(";  ", "   "), "ends the values"),
    "the wrong owner": (instead("       1P", "       7P"), "belongs to D7"),
    "compressed": (instead("S      1", "C      1"), "compressed"),
    "a type that differs": (instead("128,2,1", "126,2,1"), "are of an entity '126'"),
    "lines that are not there": (instead("     128       1", "     128       9"), "are not there"),
}


@pytest.mark.parametrize(("change", "words"), DAMAGED.values(), ids=DAMAGED)
def test_a_damaged_file_is_refused_in_words(change: Change, words: str) -> None:
    """What is wrong and where; nothing of the damage is taken for a surface."""
    text = iges([surface()])
    changed = change(text)
    assert changed != text
    with pytest.raises(BadInputError, match=words) as error:
        read(changed)
    assert "file.igs" in str(error.value)


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        pytest.param(0, 10**6, "can be read", id="too many points"),
        pytest.param(0, 9999, "announced", id="more points than values"),
        pytest.param(0, -1, "can be read", id="fewer points than none"),
        pytest.param(2, 3, "a degree of 1 or more needs one point more", id="degree too high"),
        pytest.param(3, 0, "a degree of 1 or more needs one point more", id="degree nil"),
        pytest.param(10, 0.5, "knot 3 is 0, below 0.5", id="a knot falls"),
        pytest.param(20, 0.0, "weights must be above 0", id="a weight of nil"),
        pytest.param(26, "9E999", "without limit", id="not finite"),
        pytest.param(26, 1e9, "give finite numbers up to", id="beyond any ship"),
        pytest.param(26, "4Htext", "is no number", id="text"),
        pytest.param(44, 2.0, "the knots allow 0 to 1", id="bounds outside"),
        pytest.param(43, 1.0, "the knots allow 0 to 1", id="bounds of nothing"),
    ],
)
def test_values_that_are_no_surface_are_refused_in_words(
    place: int, value: object, words: str
) -> None:
    """Before anything is made of their size."""
    values = list(surface().values)
    values[place] = value
    with pytest.raises(BadInputError, match=words) as error:
        read(iges([Entity(128, values)]))
    assert "file.igs" in str(error.value) or "surface 1" in str(error.value)


def test_values_that_are_missing_are_told() -> None:
    """Of the net or of the bounds; what is wanted and what is there."""
    with pytest.raises(BadInputError, match="4 values are wanted, and 1 are there"):
        read(iges([Entity(128, surface().values[:-3])]))


@pytest.mark.parametrize("make", [
    pytest.param(lambda: iges_text([spline(1, rational=True)], "mm"), id="surface"),
    pytest.param(lambda: iges(face()), id="trimmed surface"),
    pytest.param(lambda: iges([*face(kind=510), matrix(TURN, (0, 0, 0), 9)]), id="face"),
])  # fmt: skip
def test_whatever_is_changed_is_read_or_refused(make: Callable[[], str]) -> None:
    """150 changed files each: surfaces, or an error of the family."""
    text, rng = make(), Random(5)
    for _ in range(150):
        data = change_text(rng, text) if rng.random() < 0.5 else _shift(rng, text)
        try:
            found, _ = read(data.decode("latin-1"))
        except AssocHullError:
            continue
        assert all(np.isfinite(each.net).all() for each in found)


def _shift(rng: Random, text: str) -> bytes:
    """One letter for another, columns kept: what counts in this format is where it stands."""
    found = list(text)
    for _ in range(rng.choice((1, 2, 5))):
        at = rng.randrange(len(found))
        if found[at] != "\n":
            found[at] = rng.choice("0123456789,;.-EH DPGST")
    return "".join(found).encode()


def test_the_hull_of_wavebem_is_read(data_folder: Path) -> None:
    """A face that is all of its surface: half of Wigley's hull, to the 0.3 mm of the file.

    L 2.5 m, B 0.25 m, T 0.15625 m; upright above the water.
    """
    path = data_folder / "wigley" / "wavebem_wigley.iges"
    (hull,), notes = read(path.read_text("ascii"))
    t = np.linspace(0.0, 1.0, 81)
    x, y, z = np.moveaxis(hull.at(t[:, None], t), -1, 0)
    wanted = 0.125 * (1.0 - (x / 1.25) ** 2) * (1.0 - (np.minimum(z, 0.0) / 0.15625) ** 2)
    assert y == pytest.approx(wanted, abs=3.1e-4)
    assert (x.min(), x.max(), z.min(), z.max()) == pytest.approx((-1.25, 1.25, -0.15625, 0.15625))
    assert (notes, hull.degrees) == ((), (3, 4))
