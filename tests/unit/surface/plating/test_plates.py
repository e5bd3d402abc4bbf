"""Plates: shares, classes, order, roll axis, strain, advice; seams; what does not matter."""

import math

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.plate_class import CAVEAT, KINDS, SUGGESTIONS, PlateShares
from assoc_hull.surface.plating.plate_table import COLUMNS, PlateTable
from assoc_hull.surface.plating.surface_plates import Seams, cut_at_seams
from tests import bent_plates
from tests.curved_patches import nets, patch

NAMES = (
    "P08_wavy_plate", "P09_bow_plate", "P11_hypar", "P12_bowl", "P13_plane", "P14_cyl",
    "P16_cone_rot",
)  # fmt: skip


def surface(name: str) -> SplineSurface:
    """A reference patch."""
    return SplineSurface.bezier(patch(name), name)


@pytest.fixture(scope="module")
def shell() -> PlateTable:
    """Seven of the reference patches as plates."""
    return ah.surface.plates([surface(name) for name in NAMES])


@pytest.mark.parametrize(
    ("name", "convex", "saddle", "cylinder", "flat", "kind", "order"),
    [
        pytest.param("P08_wavy_plate", 1.7, 48.9, 49.4, 0.0, "mixed", 3, id="wavy"),
        pytest.param("P09_bow_plate", 0.0, 0.0, 100.0, 0.0, "cylinder", 2, id="bow"),
        pytest.param("P11_hypar", 0.0, 100.0, 0.0, 0.0, "saddle", 3, id="hypar"),
        pytest.param("P12_bowl", 100.0, 0.0, 0.0, 0.0, "convex", 3, id="bowl"),
        pytest.param("P13_plane", 0.0, 0.0, 0.0, 100.0, "flat", 1, id="plane"),
        pytest.param("P14_cyl", 0.0, 0.0, 98.6, 1.4, "cylinder", 2, id="inflected cylinder"),
        pytest.param("P16_cone_rot", 0.0, 0.0, 100.0, 0.0, "cylinder", 2, id="cone"),
    ],
)
def test_plates_are_what_their_regions_make_them(
    shell: PlateTable, name: str, convex: float, saddle: float, cylinder: float, flat: float,
    kind: str, order: int,
) -> None:  # fmt: skip
    """Shares of the reference plates in per cent, their class and order."""
    plate = shell[name]
    found = [100.0 * getattr(plate.shares, each) for each in ("convex", "saddle")]
    assert found == pytest.approx([convex, saddle], abs=0.051)
    found = [100.0 * plate.shares.cylinder, 100.0 * plate.shares.flat]
    assert found == pytest.approx([cylinder, flat], abs=0.4)
    assert (plate.kind, plate.order) == (kind, order)
    assert sum(attrs.astuple(plate.shares)) == pytest.approx(1.0, abs=1e-6)


def test_an_inflected_cylinder_is_rollable_though_mixed() -> None:
    """With the curvature 0.064 y over a breadth of 2 m, 6 % lie below 3.84e-3: it is called mixed,
    but it is rolled, about its long axis.
    """
    x, y = np.mgrid[-3:3:2j, -1:1:4j]
    cubic = 0.064 / 6.0 * np.array([-1.0, 1.0, -1.0, 1.0])
    plate = ah.surface.plates(np.stack([x, y, cubic + 0.0 * x], axis=-1))[0]
    assert plate.shares.flat == pytest.approx(0.06, abs=0.008)
    assert plate.shares.cylinder == pytest.approx(0.94, abs=0.008)
    assert (plate.kind, plate.order) == ("mixed", 2)
    assert plate.rollable
    assert not plate.heating
    assert plate.roll_axis == pytest.approx(0.0, abs=1e-6)
    assert plate.suggestion == SUGGESTIONS["cylinder"]
    assert plate.least_radius == pytest.approx(1 / 0.064, rel=0.01)
    assert plate.largest_radius is None


def test_a_bow_plate_is_rollable_in_the_band_only(shell: PlateTable) -> None:
    """Strictly a fifth of it is convex and the rest a saddle; with the band it is a cylinder, of
    mean strain 2.5e-4, rolled 5.1 degrees off its long side.
    """
    strict = ah.surface.plates(surface("P09_bow_plate"), zero="exact")[0].shares
    assert [strict.convex, strict.saddle] == pytest.approx([0.219, 0.781], abs=5e-4)
    plate = shell["P09_bow_plate"]
    assert plate.mean_strain == pytest.approx(2.5e-4, rel=0.02)
    assert plate.roll_axis == pytest.approx(5.1, abs=0.05)
    assert plate.k0 == pytest.approx(1.28e-3)


def test_a_flat_plate_has_no_roll_axis(shell: PlateTable) -> None:
    """Noise may have a direction as well; the class is asked first."""
    plate = shell["P13_plane"]
    assert plate.roll_axis is None
    assert plate.roll_direction is None
    assert plate.least_radius is None
    slight = ah.surface.plates(bent_plates.cylinder(6.0, 2.0, 1000.0))[0]
    assert slight.kind == "flat"
    assert slight.coherence > 0.99
    assert slight.roll_axis is None


def test_a_plate_bent_all_ways_has_no_roll_axis() -> None:
    """Where directions do not agree none is given; the advice for a developable one says so."""
    dome = bent_plates.sphere(3.0, 3.0, 4.0)
    assert ah.surface.plates(dome)[0].roll_axis is None
    fan = ah.surface.plates(bent_plates.cone(0.5, 1.5, 60.0, 330.0))[0]
    assert fan.rollable
    assert fan.coherence < 0.8
    assert fan.roll_axis is None
    assert fan.suggestion == SUGGESTIONS["cone"]
    assert fan.surface is not None
    assert f"  rulings: {fan.rulings(5)}" in str(ah.surface.plates(fan.surface))
    assert str(fan.rulings(5)).count(" deg R ") == 5


def test_strain_is_that_of_the_breadth() -> None:
    """Of a sphere strip with K = 0.01: total curvature K A, strain K b**2/8 with its own b."""
    plate = ah.surface.plates(bent_plates.sphere(6.0, 2.0))[0]
    assert plate.total_curvature == pytest.approx(0.01 * plate.area, rel=1e-7)
    assert plate.breadth == pytest.approx(2.0, rel=0.01)
    assert plate.mean_strain == pytest.approx(0.01 * plate.breadth**2 / 8.0, rel=1e-7)
    assert plate.largest_strain == pytest.approx(plate.mean_strain, rel=1e-5)
    assert plate.least_radius == pytest.approx(10.0, rel=1e-4)
    assert plate.heating


def test_weights_are_part_of_the_shape() -> None:
    """A quarter of a tube as a conic: rolled to its radius, laid flat to its girth."""
    net = np.zeros((3, 2, 3))
    net[..., :2] = np.array([[2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])[:, None]
    net[:, 1, 2] = 6.0
    weights = np.array([[1.0], [np.sqrt(0.5)], [1.0]]) * np.ones((1, 2))
    plate = ah.surface.plates(SplineSurface.bezier(net, "quarter", weights))[0]
    assert plate.kind == "cylinder"
    assert plate.area == pytest.approx(6.0 * np.pi, rel=1e-9)
    assert [plate.least_radius, plate.largest_radius] == pytest.approx([2.0, 2.0])
    assert plate.development((9, 9)).size == pytest.approx([6.0, np.pi], rel=1e-4)


def test_a_band_for_each_breadth() -> None:
    """breadth=None gives each plate the K0 of its own breadth; the notes tell a plate that is too
    broad for the common one.
    """
    wide = SplineSurface.bezier(2.0 * patch("P12_bowl"), "wide")
    both = ah.surface.plates([surface("P12_bowl"), wide], breadth=None)
    for plate in both:
        assert plate.band_breadth == plate.breadth
        assert plate.k0 == pytest.approx(8e-3 / plate.breadth**2)
    assert both[1].k0 == pytest.approx(both[0].k0 / 4.0)
    assert not any("breadth=None" in note for note in both.notes)
    assert any(
        "wide is 4.1" in note and "breadth=None" in note for note in ah.surface.plates(wide).notes
    )


def test_plates_do_not_know_each_other(shell: PlateTable) -> None:
    """Asked for alone, or in another order, a plate has the same numbers to the last bit."""
    for name in ("P08_wavy_plate", "P14_cyl"):
        alone = ah.surface.plates(surface(name))
        assert _numbers(alone) == [_numbers(shell)[NAMES.index(name)]]
    turned = ah.surface.plates([surface(name) for name in NAMES[::-1]])
    assert _numbers(turned)[::-1] == _numbers(shell)


def _numbers(found: PlateTable) -> list[list[object]]:
    """All columns of all plates, so that equal means equal bits."""
    return [[repr(value) for value in row.values()] for row in found.table()]


def test_earlier_plates_are_taken_over(shell: PlateTable) -> None:
    """What did not change is not computed again, and nothing differs."""
    moved = [surface(name) for name in NAMES]
    net = patch("P12_bowl").copy()
    net[1, 1, 2] += 0.01
    moved[3] = SplineSurface.bezier(net, "P12_bowl")
    found = ah.surface.plates(moved, previous=shell)
    assert found.computed == 1
    assert _numbers(found) == _numbers(ah.surface.plates(moved))


def test_seams_cut_a_surface_into_plates() -> None:
    """Areas add up; extents are lengths of seams; names tell the place."""
    whole = surface("P08_wavy_plate")
    seams = Seams(u=(0.3,), v=(0.5, 0.75))
    found = ah.surface.plates(whole, seams=seams)
    assert [plate.name[-3:] for plate in found] == ["1.1", "1.2", "1.3", "2.1", "2.2", "2.3"]
    total = math.fsum(plate.area for plate in found)
    assert total == pytest.approx(ah.surface.plates(whole)[0].area, rel=1e-12)
    one = ah.surface.plates(bent_plates.cylinder(6.0, 2.0, 2.5), seams=Seams(u=0.25))[1]
    assert [one.length, one.breadth] == pytest.approx([4.5, 2.0], rel=1e-5)
    assert ah.surface.plates([whole, whole], seams=[None, seams]).rows[1].name.endswith(" 1.1")


@pytest.mark.parametrize(
    ("seams", "message"),
    [
        pytest.param(Seams(u=1.0), "u = 1 does not cut it", id="on the border"),
        pytest.param(Seams(v=-3.0), "v = -3 does not cut it", id="off the surface"),
        pytest.param([None, None], "2 seams for 1 surfaces", id="for another surface"),
        pytest.param("middle", "seams is 'middle'", id="text"),
        pytest.param([0.5], "an item of seams is 0.5", id="numbers"),
    ],
)
def test_seams_that_cut_nothing_are_refused(seams: object, message: str) -> None:
    """The message says which, where, and what to give."""
    with pytest.raises((BadInputError, WrongTypeError), match=message):
        ah.surface.plates(surface("P11_hypar"), seams=seams)  # type: ignore[call-overload]
    with pytest.raises(BadInputError, match="u is"):
        Seams(u=(0.5, 0.2))
    assert cut_at_seams(surface("P11_hypar"), Seams())[0].name == "P11_hypar"


def test_the_class_needs_its_share() -> None:
    """95 % by default; another share another class; 94 % is none."""
    for kind in KINDS[:-1]:
        parts = dict.fromkeys(("convex", "saddle", "cylinder", "flat", "unresolved"), 0.0)
        shares = PlateShares(**parts | {kind: 0.95, "unresolved": 0.05})
        assert shares.kind(0.95) == kind
        assert shares.kind(0.96) == "mixed"
        assert shares.order(0.95) == {"flat": 1, "cylinder": 2}.get(kind, 3)


def test_advice_is_the_yards_own() -> None:
    """Texts are replaced by class; unknown classes and empty texts are refused."""
    found = ah.surface.plates(surface("P13_plane"), suggestions={"flat": "cut only"})
    assert found[0].suggestion == "cut only"
    assert CAVEAT in str(found)
    for wrong in ({"round": "?"}, {"flat": ""}, ["flat"]):
        with pytest.raises((BadInputError, WrongTypeError), match=r"suggestions|text of flat"):
            ah.surface.plates(surface("P13_plane"), suggestions=wrong)


def test_what_is_flat_depends_on_the_length_of_the_sagitta() -> None:
    """3 mm over a breadth of 2.5 m leave radii of 260 m flat; over 8 m they do not."""
    slight = bent_plates.cylinder(8.0, 2.0, 400.0)
    assert ah.surface.plates(slight)[0].kind == "flat"
    assert ah.surface.plates(slight, sagitta_length=8.0)[0].kind == "cylinder"
    assert ah.surface.plates(slight, sagitta_tol=0.001)[0].kind == "cylinder"


def test_the_table_has_all_columns_once(shell: PlateTable) -> None:
    """Plain values by name, as attributes have them; print has those with a head."""
    rows = shell.table()
    assert [list(row) for row in rows] == [[each.name for each in COLUMNS]] * len(NAMES)
    assert shell.column("area") == [plate.area for plate in shell]
    assert rows[0]["saddle"] == 100.0 * shell[0].shares.saddle
    printed = str(shell).splitlines()
    assert len(printed[0]) < 170
    for head in ("plate", "K0", "convex", "class", "axis", "int |K|", "strain", "lines"):
        assert head in printed[0]
    assert all(name in line for name, line in zip(NAMES, printed[2:], strict=False))
    assert "2.5e-04" in printed[2 + NAMES.index("P09_bow_plate")]
    assert "K0 = 0.00128 1/m2 (strain 0.001 over 2.5 m)" in str(shell)


def test_a_plate_of_a_surface_lies_on_no_hull_and_is_not_in_doubt(shell: PlateTable) -> None:
    """Its shape is given, not fitted."""
    assert shell.surfaces == tuple(plate.surface for plate in shell)
    for plate in shell:
        assert (plate.extent, plate.range, plate.blocks, plate.dk) == (None, None, (), None)
        assert (plate.doubt, plate.is_doubtful) == (0.0, False)
    assert shell.area == pytest.approx(shell.results[0].total)


def test_lines_are_counted_by_plate(shell: PlateTable) -> None:
    """The loop and the open lines of the wavy plate; none on plates of one region."""
    regions = ah.surface.curvature_regions(surface("P08_wavy_plate"))
    assert shell["P08_wavy_plate"].lines == len(regions.components) > 0
    assert shell["P12_bowl"].lines == 0


def test_plates_are_found_by_number_and_name(shell: PlateTable) -> None:
    """Unknown ones are refused in words."""
    assert shell[1].name == shell["P09_bow_plate"].name == shell[int(np.int64(1))].name
    with pytest.raises(UnknownNameError, match="P09_bow_plate"):
        shell["P09_bow"]
    with pytest.raises(BadInputError, match="no plate 9"):
        shell[9]
    with pytest.raises(WrongTypeError, match="a plate is True"):
        shell[True]
    with pytest.raises(UnknownNameError, match="colour"):
        shell.column("colour")
    twice = ah.surface.plates([surface("P13_plane")] * 2)
    with pytest.raises(BadInputError, match="2 plates are named"):
        twice["P13_plane"]
    assert ah.surface.plates(nets()["P13_plane"])[0].name == "plate 1"


def test_slivers_squares_and_poles_are_told() -> None:
    """What makes a number doubtful is said in a sentence."""
    notes = ah.surface.plates(SplineSurface.bezier(patch("P17_pole_sphere"), "octant")).notes
    assert any("without a normal" in note for note in notes)
    x, y = np.mgrid[0:4, 0:4] / 3.0
    sliver = np.stack([3.0 * x, 0.02 * y, 0.0 * x], axis=-1)
    assert any("sliver" in note for note in ah.surface.plates(sliver).notes)
    square = np.stack([x, y, 0.1 * x * x], axis=-1)
    assert any("as long as it is broad" in note for note in ah.surface.plates(square).notes)
    assert any(
        "lie side" in note or "beside" in note
        for note in ah.surface.plates(patch("P08_wavy_plate")).notes
    )


@pytest.mark.parametrize(
    "options",
    [
        {"share": 0.5}, {"share": 1.1}, {"breadth": 0.0}, {"sagitta_tol": -1.0},
        {"sagitta_length": "long"}, {"sagitta_length": 1e-308},
        {"zero": "absolute", "k0": 1e-3, "breadth": 1e-308}, {"previous": 3}, {"zero": "absolute"},
        {"k0": 1e-3}, {"zero": "exact", "strain_tol": 2e-3},
    ],
    ids=str,
)  # fmt: skip
def test_options_that_mean_nothing_are_refused(options: dict[str, object]) -> None:
    """Nothing is ignored in silence."""
    with pytest.raises((BadInputError, WrongTypeError)):
        ah.surface.plates(surface("P13_plane"), **options)  # type: ignore[call-overload]
