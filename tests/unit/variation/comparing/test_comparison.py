"""A parent and a variant side by side: shifts known in closed form, signs, what came and went."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from importlib import resources
from typing import Any

import pytest
from jsonschema import Draft202012Validator

import assoc_hull as ah
from assoc_hull.errors import BadInputError, OutOfRangeError, UnknownNameError
from assoc_hull.io.tables.comparison import comparison_schema
from assoc_hull.io.tables.json_schema import dumps_schema
from assoc_hull.variation.comparing.comparison import HullComparison
from assoc_hull.variation.comparing.line_comparison import compare_lines
from assoc_hull.variation.comparing.line_fairness import compare_fairness, measure_fairness
from assoc_hull.variation.comparing.number_comparison import (
    NumberComparison,
    Numbers,
    compare_numbers,
    numbers_of,
)
from tests.taken_back import taken_back


@pytest.fixture(scope="module")
def parent() -> ah.Hull:
    """The Wigley hull, 100 x 10 x 6.25 m; a test that edits it takes the edit back."""
    return ah.examples.wigley()


@pytest.fixture(scope="module")
def broader(parent: ah.Hull) -> ah.Hull:
    """A tenth broader."""
    return parent.vary(set={"breadth": 11.0}).hull


@pytest.fixture(scope="module")
def found(parent: ah.Hull, broader: ah.Hull) -> HullComparison:
    """Both side by side."""
    return parent.compare(broader)


@pytest.fixture(scope="module")
def other(parent: ah.Hull) -> HullComparison:
    """The Wigley hull beside a broader one with fewer lines, of which one is elsewhere."""
    return parent.compare(ah.examples.wigley(breadth=11.0, stations=11, waterlines=6))


def half_breadth(x: float, z: float) -> float:
    """Half-breadth of the parent, m."""
    along, down = (x - 50.0) / 50.0, max(6.25 - z, 0.0) / 6.25
    return 5.0 * (1.0 - along**2) * (1.0 - down**2)


def test_every_shift_is_that_of_the_formula(parent: ah.Hull, found: HullComparison) -> None:
    """A tenth of the half-breadth, outward, where the line is broadest; planes have not moved."""
    assert [line.name for line in found.lines] == list(parent.lines)
    for name, line in parent.lines.items():
        shift = found.line(name).shift
        assert shift is not None
        if name == "profile":
            assert (shift.length, shift.direction, found.line(name).what) == (0.0, "-", "same")
            continue
        x, z = (line.curves[0].points[0].x, 9.0) if name.startswith("ST") else (50.0, 9.0)
        if name.startswith("WL"):
            z = line.curves[0].points[0].z
        away = 0.1 * half_breadth(x, z)
        assert shift.vector == pytest.approx((0.0, away, 0.0), abs=1e-9), name
        assert shift.length == pytest.approx(away, abs=1e-9), name
        assert (shift.direction, shift.plane or 0.0) == ("out", 0.0), name
        assert shift.after[0] == pytest.approx(x, abs=1e-6)


def test_a_plane_that_went_is_told_apart_from_the_course(parent: ah.Hull) -> None:
    """A deeper hull's waterlines lie lower or higher, and keep their shape in their planes."""
    deeper = parent.vary(set={"draught": 7.5}).hull
    lines = {each.name: each for each in compare_lines(parent.state, deeper.state)}
    for name in ("WL 0.625", "WL 2.5", "WL 6.25"):
        shift = lines[name].shift
        assert shift is not None
        up = 0.2 * parent.lines[name].curves[0].points[0].z
        assert shift.plane == pytest.approx(up, abs=1e-9)
        assert shift.course == pytest.approx(0.0, abs=1e-9)
        assert (shift.direction, lines[name].what) == ("up", "moved")
        assert shift.length == pytest.approx(up, abs=1e-9)


def test_numbers_are_those_of_the_formula(found: HullComparison) -> None:
    """Volume as the breadth, BM as its square, KB as nothing; per cent of what is nil is none.

    Splines by chord lengths follow the formula within 1e-6 of the volume.
    """
    assert found.hydrostatic("volume").percent == pytest.approx(10.0, abs=1e-4)
    assert found.parameter("BMT").percent == pytest.approx(21.0, abs=3e-4)
    assert found.hydrostatic("kb").difference == pytest.approx(0.0, abs=1e-5)
    assert found.hydrostatic("bwl").difference == pytest.approx(1.0, abs=1e-9)
    middle = found.hydrostatic("lcb_percent")
    assert (middle.is_same, middle.percent) == (True, None)
    with pytest.raises(UnknownNameError, match="volume"):
        found.hydrostatic("volum")


def test_what_has_no_number_has_a_reason(parent: ah.Hull, found: HullComparison) -> None:
    """That of both hulls once; that of one with its name."""
    bulb = found.parameter("BL")
    assert (bulb.before, bulb.after, bulb.difference, bulb.percent) == (None,) * 4
    assert "bulb" in str(bulb.reason)
    whole = numbers_of(parent, None, None)
    (volume, *_), (length, *_) = compare_numbers(whole, Numbers(None, {}, "it leaks"))
    assert (volume.reason, volume.difference, volume.is_same) == ("variant: it leaks", None, False)
    assert length.reason == "variant: it leaks"
    (volume, *_), _ = compare_numbers(Numbers(None, {}, "it leaks"), whole)
    assert volume.reason == "parent: it leaks"


def test_a_hull_differs_not_from_itself(parent: ah.Hull) -> None:
    """Every shift and difference is nil; the text says that it is one hull."""
    same = parent.compare(parent)
    assert same.is_same
    assert {line.what for line in same.lines} == {"same"}
    assert {line.length for line in same.lines} == {0.0}
    assert {each.difference for each in same.hydrostatics} == {0.0}
    assert all(each.is_same for each in same.parameters)
    assert (same.points.came, same.points.went, same.worst()) == ((), (), ())
    assert {each.what for each in same.features} == {"same"}
    assert same.fairness.changed == ()
    assert "one fingerprint" in str(same)


def test_lines_and_points_that_came_or_went_are_named(other: HullComparison) -> None:
    """With the points that they bring; a line of one hull only has no shift."""
    went = {line.name for line in other.of("went")}
    assert {"ST 11", "ST 19", "WL 0.625", "WL 5.625"} <= went
    assert other.of("came") == ()
    line = other.line("WL 0.625")
    assert (line.was, line.shift, line.fairness, line.points) == ("WL 0.625", None, None, (21, 0))
    assert "WL 0.625 x ST 10" in other.points.went
    lost = other.points.before["crossing"] - other.points.after["crossing"]
    assert lost == len(other.points.went) - len(other.points.came) - 10  # adopted at the deck


def test_exchanged_hulls_turn_the_signs(parent: ah.Hull, other: HullComparison) -> None:
    """What went came, every shift points the other way, every difference is its negative."""
    turned = ah.examples.wigley(breadth=11.0, stations=11, waterlines=6).compare(parent)
    assert {line.name for line in turned.of("came")} == {line.name for line in other.of("went")}
    assert turned.points.came == other.points.went
    for line in other.lines:
        there, back = line.shift, turned.line(line.name).shift
        assert (there is None) == (back is None)
        if there is not None and back is not None:
            assert back.length == pytest.approx(there.length, abs=1e-12)
            assert back.vector == pytest.approx([-part for part in there.vector], abs=1e-6)
    for mine, theirs in zip(other.parameters, turned.parameters, strict=True):
        if mine.difference is not None:
            assert theirs.difference == -mine.difference


@pytest.fixture
def renamed(broader: ah.Hull) -> Iterator[ah.Hull]:
    """The broader hull with another name for a waterline, for one test."""
    with taken_back(broader) as hull:
        with hull.edit("another name") as edit:
            edit.rename("WL 2.5", "low water")
        yield hull


def test_a_renamed_line_is_paired_by_its_key(parent: ah.Hull, renamed: ah.Hull) -> None:
    """It is told by its new name, and was the old one; nothing came or went."""
    lines = compare_lines(parent.state, renamed.state)
    (line,) = (each for each in lines if each.name != each.was)
    assert (line.name, line.was, line.what) == ("low water", "WL 2.5", "moved")
    assert line.length == pytest.approx(0.1 * half_breadth(50.0, 2.5), abs=1e-9)


def test_fairness_is_that_of_the_fairness_table(
    parent: ah.Hull, broader: ah.Hull, found: HullComparison
) -> None:
    """Changes of sign and comb ratios, line by line, and over all lines."""
    before = measure_fairness(parent.state)
    table = compare_fairness(before, measure_fairness(broader.state, like=before))
    for mine, theirs in zip(found.fairness.changed, table.changed, strict=True):
        assert (mine.name, mine.added) == (theirs.name, theirs.added)
        assert mine.comb_ratio == pytest.approx(theirs.comb_ratio, rel=1e-12, nan_ok=True)
    assert found.line("ST 10").comb_ratio == pytest.approx(found.fairness.worst, rel=1e-12)


def test_lines_are_sorted_by_what_is_asked(found: HullComparison) -> None:
    """The greatest first; those in which it is nil are left out; another word is refused."""
    lengths = [line.length for line in found.worst(50)]
    assert len(lengths) == 30
    assert lengths == sorted(lengths, reverse=True)
    assert len(found.worst(3)) == 3
    assert found.worst(1, by="comb")[0].name == "ST 10"
    assert found.worst(by="signs") == ()
    with pytest.raises(BadInputError, match="'name'"):
        found.worst(by="name")
    with pytest.raises(BadInputError, match="count"):
        found.worst(-1)
    with pytest.raises(BadInputError, match="'gone'"):
        found.of("gone")


def test_the_text_tells_what_differs(found: HullComparison, other: HullComparison) -> None:
    """Lines that moved farthest, numbers, what went; long lists of points are cut."""
    rows = {row.split("  ")[0]: row.split() for row in str(found).splitlines()}
    assert rows["WL 6.25"][2:4] == ["500.0", "out"]
    volume = ["∇", "m3", "2777.45", "3055.19", "+277.75", "+10.000"]
    assert rows["displacement volume, moulded, with appendages"][-6:] == volume
    assert "lines: 1 same, 30 moved, 0 came, 0 went" in str(found)
    assert "went: ST 10, ST 11" in str(other)
    assert f" and {len(other.points.went) - 10} more" in str(other)


def test_rows_that_print_alike_are_left_out_by_name(parent: ah.Hull, found: HullComparison) -> None:
    """A row stands in the text if its printed digits differ; the others are symbols in a line."""
    text = str(found).splitlines()
    assert not any(row.split()[-2:] == ["+0.0000", "+0.000"] for row in text if row)
    alike, _ = (row for row in text if row.startswith("alike in both: "))
    assert alike.split(": ")[1].split(", ") == ["LCB", "LCB%", "KB", "KM_L", "LCF", "L_WL", "C_B",
                                                "C_M", "C_P", "C_W"]  # fmt: skip
    assert found.hydrostatic("KM_T") is found.hydrostatic("kmt")
    same = str(parent.compare(parent))
    assert "difference" not in same


def test_a_shift_that_prints_as_nothing_is_counted_and_not_listed(parent: ah.Hull) -> None:
    """Lines that moved by less than 0.05 mm are one number."""
    with taken_back(ah.examples.wigley()) as hull:
        with hull.edit("a hair") as edit:
            edit.move("WL 2.5 x ST 7", y=hull.points["WL 2.5 x ST 7"].y + 2e-5)
        found = parent.compare(hull)
        text = str(found)
    moved = len(found.of("moved"))
    assert moved > 0
    assert f"moved by less than 0.05 mm: {moved}" in text
    assert "shift mm" not in text


def test_the_draught_is_as_asked(parent: ah.Hull, broader: ah.Hull) -> None:
    """For both hulls; one at which a hull does not float is refused, with the range."""
    low = parent.compare(broader, draught=3.0)
    assert low.parent.draught == 3.0
    assert (
        low.hydrostatic("volume").before == parent.hydrostatics(draught=3.0, estimate=False).volume
    )
    with pytest.raises(OutOfRangeError, match=r"9\.375"):
        parent.compare(broader, draught=20.0)


@pytest.mark.parametrize(
    ("given", "holds"),
    [
        pytest.param({"variant": "a"}, "a str", id="no variant"),
        pytest.param({"parent": None}, "NoneType", id="no parent"),
        pytest.param({"draught": "deep"}, "deep", id="draught of text"),
        pytest.param({"screw": 3.0}, "screw", id="no screw"),
    ],
)
def test_what_is_no_hull_is_refused(parent: ah.Hull, given: dict[str, Any], holds: str) -> None:
    """In one line that names it."""
    with pytest.raises(BadInputError, match=holds) as caught:
        ah.variation.compare(**{"parent": parent, "variant": parent, **given})
    assert "\n" not in str(caught.value)


def test_the_schema_that_ships_is_that_of_the_code() -> None:
    """If not: ``python -m assoc_hull schema --of comparison -o`` into the package."""
    Draft202012Validator.check_schema(comparison_schema())
    shipped = resources.files("assoc_hull.io").joinpath("comparison.schema.json")
    assert shipped.read_text("utf-8") == dumps_schema(comparison_schema())


def test_json_holds_every_number(found: HullComparison, other: HullComparison) -> None:
    """It has the form of the schema, and what is read are the same numbers to the last bit."""
    check = Draft202012Validator(comparison_schema())
    for each in (found, other):
        document = json.loads(each.to_json())
        assert check.is_valid(document)
        assert [line["name"] for line in document["lines"]] == [line.name for line in each.lines]
        numbers = [
            NumberComparison(**{key: n[key] for key in n if key not in ("difference", "percent")})
            for n in (*document["hydrostatics"], *document["parameters"])
        ]
        assert numbers == [*each.hydrostatics, *each.parameters]
        shift = document["lines"][-1]["shift"] if each is found else document["lines"][0]["shift"]
        line = each.line(document["lines"][-1 if each is found else 0]["name"])
        assert line.shift is not None
        assert (shift["length"], tuple(shift["after"])) == (line.shift.length, line.shift.after)


DAMAGED: dict[str, Callable[[Any], object]] = {
    "another format": lambda d: d.update(format="assoc-hull"),
    "newer schema": lambda d: d.update(schema=2),
    "no variant": lambda d: d.pop("variant"),
    "unknown key": lambda d: d.update(comment=""),
    "fingerprint cut off": lambda d: d["parent"].update(fingerprint="0a"),
    "another word": lambda d: d["lines"][0].update(what="gone"),
    "place of two": lambda d: d["lines"][-1]["shift"].update(after=[1.0, 2.0]),
    "negative length": lambda d: d["lines"][-1]["shift"].update(length=-1.0),
    "neither number nor reason": lambda d: d["parameters"][0].update(before=None),
    "a number and a reason": lambda d: d["hydrostatics"][0].update(reason="it leaks"),
    "count of a sort missing": lambda d: d["points"]["after"].pop("adopted"),
    "feature of no kind": lambda d: d["features"][0].update(kind="bulb"),
}


@pytest.mark.parametrize("change", DAMAGED.values(), ids=DAMAGED.keys())
def test_a_damaged_document_is_invalid(
    found: HullComparison, change: Callable[[Any], object]
) -> None:
    """Each kind of rule at each level is one of the schema."""
    document = json.loads(found.to_json())
    change(document)
    assert not Draft202012Validator(comparison_schema()).is_valid(document)


def test_a_line_that_was_straight_is_told_by_its_comb_and_not_by_a_ratio(parent: ah.Hull) -> None:
    """Raked, the plumb stem of the profile bends: no comb is infinitely many times another."""
    raked = ah.examples.wigley().vary(set={"stem_rake_deg": 10.0})
    text = str(ah.examples.wigley().compare(raked.hull))
    [told] = [line for line in text.splitlines() if line.startswith("  profile:")]
    assert "comb integral 0 > " in told
    assert told.endswith(" 1/m3")
    assert "inf times" not in text
    assert not [note for note in raked.report.notes if "inf" in note]


def test_a_value_in_per_cent_has_no_difference_in_per_cent() -> None:
    """LCB from amidships, .49 and .44 % of Lpp, differs by .05 points, not by 10 %."""
    found = NumberComparison("LCB%", "from amidships", "% L", 4, 0.4919, 0.4429)
    assert found.percent is None
    assert found.difference == pytest.approx(-0.049)
    assert NumberComparison("V", "volume", "m3", 2, 200.0, 210.0).percent == pytest.approx(5.0)
