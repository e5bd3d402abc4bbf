"""A keel that rises below broad half-breadths: no section dips below it, and the gap is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.edit.document import Document
from assoc_hull.io.importing.import_hull import ImportReport, import_hull
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.importing.soundness import sampled_places
from assoc_hull.io.offsets.net import lines_of_table
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.model.tables import HullState

L, B, T, RAKE, RISE = 60.0, 11.0, 3.0, 8.0, 3.2
X = np.array([0, 2, 4, 6, 8, 14, 20, 26, 32, 38, 44, 50, 52, 54, 56, 58, 60], np.float64)
Z = np.arange(0.0, 4.1, 0.5)
VOLUME = B * (T * (L - 2.0 * RAKE) + T**2 * RAKE / RISE)


def barge(*, keel: bool, half: float = 0.5 * B) -> str:
    """A box with raked ends, blank below its bottom; with or without a column of the keel."""
    low = RISE * np.clip(np.maximum(RAKE - X, X - (L - RAKE)) / RAKE, 0.0, 1.0)
    rows = ["x_m," + ",".join(f"WL {z:g} m" for z in Z) + (",keel" if keel else "")]
    for x, k in zip(X, low, strict=True):
        cells = ["" if z < k - 1e-9 else f"{half:.3f}" for z in Z]
        rows.append(",".join([f"{x:g}", *cells, *([f"{k:.3f}"] if keel else [])]))
    return "\n".join(rows) + "\n"


def test_no_section_dips_below_its_keel() -> None:
    """A spline from the keel to an upright side swung .8 m below it, and V was 5 % too large."""
    table, report = read_offsets(barge(keel=True), length=L, draught=T)
    assert "open bottom" in report.kinds("suspicions")
    sections = {line.offset: line for line in lines_of_table(table) if line.group == "sections"}
    assert sections[4.0].points[0].tolist() == [4.0, 0.0, 1.6]
    assert sections[4.0].kind[1] == 2


@pytest.mark.parametrize("keel", [True, False])
def test_what_lies_between_keel_and_half_breadths_is_told(keel: bool, tmp_path: Path) -> None:
    """V is off by no more than the suspicion says; without heights of the keel blanks tell it."""
    path = tmp_path / "barge.csv"
    path.write_text(barge(keel=keel))
    state, report = import_hull(path, ImportOptions(length=L, draught=T, origin="ap"))
    (told,) = [each for each in report.verdict.suspicions if each.kind == "open bottom"]
    assert told.amount is not None
    assert "0, 2, 4, 6" in told.where
    volume = hydrostatics(Document(state), on_error="report").volume
    assert abs(VOLUME / volume - 1.0) < told.amount < 0.05


def test_a_sharp_bottom_leaves_nothing_open() -> None:
    """Where the lowest half-breadths run out to the keel, nothing is suspected."""
    rows = ["station,wl_0,wl_1,wl_2,wl_3,keel"]
    for i in range(11):
        k, full = 0.05 * abs(i - 5) ** 2 / 5.0, 4.0 * (1.0 - (i / 5.0 - 1.0) ** 2)
        cells = ["" if z < k else f"{full * (z - k) / 3.0:.4f}" for z in (0.0, 1.0, 2.0, 3.0)]
        rows.append(",".join([str(i), *cells, f"{k:.4f}"]))
    _, report = read_offsets("\n".join(rows), length=L, draught=2.0, station_zero="ap")
    assert "open bottom" not in report.kinds("suspicions")


def test_a_counter_that_reaches_the_deck_alone_is_taken(tmp_path: Path) -> None:
    """A station with one half-breadth, at the deck: its section runs there from the stern."""
    x, z = np.linspace(0.0, 14.0, 15), np.array([-0.7, -0.5, -0.3, -0.1, 0.1, 0.3, 0.6, 0.9, 1.2])
    rows = ["x," + ",".join(f"{each:g}" for each in z)]
    for place in x:
        u = abs(place / 7.0 - 1.0)
        low = -0.75 + 1.05 * u**2 + 0.7 * u**4
        half = 1.9 * (1.0 - min(abs((place - 6.6) / 7.4) ** 2.3, 1.0))
        up = np.clip((z - low) / (1.2 - low), 0.0, 1.0) ** 0.62
        cells = ["" if a < low - 1e-9 else f"{half * b:.3f}" for a, b in zip(z, up, strict=True)]
        rows.append(",".join([f"{place:g}", *cells]))
    path = tmp_path / "yacht.csv"
    path.write_text("\n".join(rows) + "\n")
    state, report = import_hull(path, ImportOptions(draught=0.7, accept=True))
    assert "left open" not in str(report.adoption.notes)
    assert hydrostatics(Document(state), on_error="report").volume == pytest.approx(5.887, rel=0.02)


def test_a_hull_that_is_out_of_the_water_is_told_as_such() -> None:
    """Its sections have no area below the draught, of which a part could be missing."""
    rows = ["x_m,WL 2 m,WL 3 m,WL 4 m,keel", *(f"{x},4,5,5,1.6" for x in range(0, 60, 6))]
    _, report = read_offsets("\n".join(rows), length=54.0, draught=1.0)
    assert "open bottom" not in report.kinds("suspicions")


def fishing_vessel(wide: float, base: str, length: float = 45.0, top: float = 4.6) -> str:
    """A hull of eleven stations; at the base line half-breadths `wide` or less, or `base`.

    `base`: what stands at z = 0 where the bottom has no flat: "0", blank, or no row at all.
    """
    heights = [0.0, 0.4, 1.0, 2.0, 3.2, top]
    rows = ["station,x_m," + ",".join(f"wl_{z:g}" for z in heights)]
    for i in range(11):
        s = abs(i / 5.0 - 1.0)
        flat = max(0.0, wide - 3.0 * s * s)
        full = 4.2 * (1.0 - s**4)
        cells = [f"{flat:.3f}" if flat else base]
        cells += [f"{full * (1.0 - max(0.0, 1.0 - z / (1 + s)) ** 3):.3f}" for z in heights[1:]]
        rows.append(",".join([f"{i}", f"{0.1 * length * i:g}", *cells]))
    if base == "none":
        rows = [",".join(row.split(",")[:2] + row.split(",")[3:]) for row in rows]
    return "# offsets in m, station 0 = AP\n" + "\n".join(rows) + "\n"


def lowest(state: HullState) -> float:
    """Give the lowest place of all lines, m."""
    return float(sampled_places(state)[0][:, 2].min())


@pytest.mark.parametrize(
    ("wide", "base"),
    [(0.25, "0"), (1.0, ""), (2.5, ""), (1.0, "none")],
    ids=["zeros", "narrow and blanks", "wide and blanks", "no row"],
)
def test_nothing_of_a_table_hangs_below_its_base_line(
    wide: float, base: str, tmp_path: Path
) -> None:
    """Sections swung .1 to .5 m under a narrow flat or a blank, a raked stern up to 4.7 m."""
    path = tmp_path / "vessel.csv"
    path.write_text(fishing_vessel(wide, base))
    state, report = import_hull(path, ImportOptions(length=45.0, draught=3.2))
    assert lowest(state) > -1e-3
    assert report.verdict.faults == ()


def test_a_line_that_hangs_below_the_keel_is_a_fault(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first line of the verdict says so, the finding how much, where, and what to give."""
    path = tmp_path / "vessel.csv"
    path.write_text(fishing_vessel(0.25, "0"))
    monkeypatch.setattr("assoc_hull.io.offsets.net.held_up", lambda line, *_: line)
    monkeypatch.setattr("assoc_hull.io.offsets.complete_table.held_up", lambda line, *_: line)
    state, report = import_hull(path, ImportOptions(length=45.0, draught=3.2, accept=True))
    assert str(report.verdict).startswith("not sound")
    worst = max(each.amount or 0.0 for each in report.verdict.faults)
    assert worst == pytest.approx(-lowest(state), abs=2e-3)
    (told, *_) = [each for each in report.verdict.faults if each.kind == "below the keel"]
    assert "give one more waterline close above the keel" in told.what


def test_a_short_hull_has_its_deck_edge_in_its_plane(tmp_path: Path) -> None:
    """Scaled up and down again it lay a last bit beside it, and the import was not sound."""
    path = tmp_path / "vessel.csv"
    path.write_text(fishing_vessel(1.0, "0", 60.0, 5.43))
    _, report = import_hull(path, ImportOptions(length=60.0, draught=3.2, accept=True))
    assert not [each for each in report.verdict.faults if each.kind == "off plane"]


def keeled(*, sheer: bool = False, last: str = "") -> str:
    """A trawler of 45 m with a column of the keel: a sternpost, and a stem raked to the deck."""
    heights = np.array([0.5, 1.0, 2.0, 3.0, 4.0, 5.5])
    rows = ["station,x_m,keel," + ",".join(f"wl_{z:g}" for z in heights) + ",sheer,b_deck" * sheer]
    for i, x in enumerate([0.0, 4.5, 9.0, 13.5, 18.0, 22.5, 27.0, 31.5, 36.0, 40.5, 43.0]):
        keel = max(0.0, 0.5 * (x - 38.0))
        along = np.clip(np.minimum((x + 1.0) / 16.0, (47.0 - x) / 18.0), 0.0, 1.0)
        y = (
            4.6
            * (1.0 - (1.0 - along) ** 2)
            * (1.0 - np.clip(1.0 - (heights - keel) / 3.5, 0, 1) ** 2)
        )
        y = np.where((x == 0.0) & (heights < 2.5), 0.0, y)
        cells = [f"{b:.3f}" if z >= keel else "" for z, b in zip(heights, y, strict=True)]
        edge = [f"{5.6 + 0.0005 * (x - 22.5) ** 2:.3f}", f"{y[-1] + 0.02:.3f}"] * sheer
        rows.append(",".join([f"{i}", f"{x:g}", f"{keel:.3f}", *cells, *edge]))
    return "# offsets in m, station 0 = AP\n" + "\n".join([*rows, last]) + "\n"


def test_a_column_of_the_keel_closes_stem_and_stern(tmp_path: Path) -> None:
    """Up the sternpost and out to where waterlines end: nothing of the net is open."""
    path = tmp_path / "trawler.csv"
    path.write_text(keeled())
    state, report = import_hull(path, ImportOptions(length=45.0, draught=3.6, base=0.0))
    assert report.verdict.faults == ()
    assert not [each for each in report.verdict.suspicions if each.kind == "open net"]
    told = [note for note in report.adoption.notes if "waterlines are drawn on" in note]
    assert ["stern" in told[0], "stem" in told[1]] == [True, True]
    (line,) = [i for i in state.live("lines").tolist() if state.lines.name[i] == "profile"]
    profile = state.spline(state.lines.curves[line][0]).xyz
    post = profile[(profile[:, 0] == 0.0) & (profile[:, 2] <= 2.0)]
    assert sorted(post[:, 2].tolist())[:: len(post) - 1] == [0.0, 2.0]
    assert profile[[0, -1], 2].tolist() == pytest.approx([5.5, 5.5])


def test_an_end_that_stays_open_says_which_row_closes_it(tmp_path: Path) -> None:
    """A sheer tells no ends of waterlines; a station at the deck, as the note says, closes one."""
    path = tmp_path / "trawler.csv"
    last = ""
    for open_ends in (["stern", "stem"], ["stern"]):
        path.write_text(keeled(sheer=True, last=last))
        options = ImportOptions(length=45.0, draught=3.6, base=0.0, accept=True)
        notes = import_hull(path, options)[1].adoption.notes
        told = [note for note in notes if " is open from x = " in note]
        assert [note.split()[1] for note in told] == open_ends
        assert "give one more station" in told[0]
        last = "11,47,5.9,,,,,,,5.9,0"


# --------------------------------------------------------------------------------------
# Flat ends.

BOAT = """# patrol boat, half-breadths and heights in m
station,keel,0.3,0.6,1,1.4,1.9,2.4,3,sheer,half-breadth deck
0,0.95,,,1.109,1.963,2.384,2.661,2.912,3.4,3.05
0.5,0.79,,,1.575,2.112,2.49,2.758,3.009,3.4,3.15
1,0.62,,,1.817,2.239,2.585,2.844,3.094,3.41,3.24
2,0.31,,1.588,2.096,2.426,2.737,2.988,3.239,3.44,3.4
3,0.09,1.325,1.807,2.213,2.514,2.815,3.066,3.324,3.49,3.51
4,0,1.433,1.853,2.238,2.535,2.838,3.094,3.36,3.56,3.58
5,0,1.325,1.748,2.145,2.454,2.773,3.044,3.328,3.65,3.6
6,0,1.109,1.526,1.93,2.254,2.593,2.888,3.2,3.76,3.55
7,0,0.805,1.187,1.58,1.907,2.263,2.579,2.922,3.89,3.38
8,0,0.483,0.784,1.121,1.419,1.757,2.07,2.42,4.04,2.98
9,0.1,0.154,0.345,0.578,0.799,1.064,1.32,1.619,4.21,2.2
9.5,0.52,,0.04,0.226,0.405,0.623,0.839,1.094,4.3,1.64
10,1.9,,,,,0,0.175,0.401,4.4,0.95
"""
"""She ends in a transom at the AP; her stem is raked, and the table stops at the FP."""


def boat(folder: Path, text: str = BOAT, **options: Any) -> tuple[HullState, ImportReport]:
    """Her hull, 36 m long at a draught of 1.9 m."""
    path = folder / "boat.csv"
    path.write_text(text)
    given = {"length": 36.0, "draught": 1.9, "station_zero": "ap", **options}
    return import_hull(path, ImportOptions(**given))


def without_deck(text: str) -> str:
    """Leave the two columns of the deck out."""
    head, *rows = text.splitlines()
    return "\n".join([head, *(",".join(row.split(",")[:-2]) for row in rows)]) + "\n"


@pytest.mark.parametrize("text", [BOAT, without_deck(BOAT)], ids=["sheer", "no sheer"])
def test_lines_end_on_the_edge_of_a_flat_end_and_follow_it(text: str, tmp_path: Path) -> None:
    """The last station becomes it: a waterline that is pulled there takes it along, and back."""
    state, report = boat(tmp_path, text)
    assert any("is the edge of a flat end, 'transom'" in each for each in report.adoption.notes)
    hull = ah.Hull(state)
    assert "ST 0" not in hull.lines
    ends = [f"{name} x transom" for name in ("WL 1", "WL 1.4", "WL 1.9", "WL 2.4")]
    assert all(each in hull.crossings for each in ends)
    with hull.edit("broader transom") as edit:
        edit.pull("WL 1.4 x transom", 0.05, radius=(7.0, 3.0))
    level = hull.lines["WL 1.4"].meet(((1, 0, 0), 0.0))
    upright = hull.lines["transom"].meet(((0, 0, 1), 1.4))
    assert np.abs(level[0] - upright[0]).max() < 1e-9
    assert level[0][1] > 1.963 + 0.02
    assert not hull.verify()


def test_an_immersed_transom_has_the_area_that_its_numbers_give(tmp_path: Path) -> None:
    """It was 0, without a word, and resistance took it for that."""
    state, _ = boat(tmp_path)
    z = [0.95, 1.0, 1.4, 1.9]
    area = 2.0 * np.trapezoid([0.0, 1.109, 1.963, 2.384], z)
    assert hydrostatics(ah.Hull(state)).transom_area == pytest.approx(area, rel=0.03)


@pytest.mark.parametrize("depth", [None, 3.65, 3.2])
def test_the_depth_is_that_of_the_deck_edge_amidships(depth: float | None, tmp_path: Path) -> None:
    """The sheer's, not the highest waterline's; another that is given is kept, and told."""
    state, report = boat(tmp_path, depth=depth)
    assert state.particulars.depth == pytest.approx(depth or 3.65)
    told = [each for each in report.verdict.suspicions if each.where == "depth"]
    assert len(told) == (depth == 3.2)


@pytest.mark.parametrize("sheer", [True, False])
def test_a_row_at_the_head_of_the_stem_closes_it_as_the_note_says(
    sheer: bool, tmp_path: Path
) -> None:
    """With a deck both heights and a half-breadth of 0; then nothing of the net is open."""
    text = BOAT if sheer else without_deck(BOAT)
    row = "10.5,4.4,,,,,,,,4.4,0" if sheer else "10.5,3,,,,,,,"
    state, report = boat(tmp_path, text + row + "\n", deck="closed")
    assert not [each for each in report.adoption.notes if "is open from" in each]
    assert not [each for each in report.verdict.suspicions if each.kind == "open net"]
    assert ah.Hull(state).mesh().report.sound


@pytest.mark.parametrize(
    ("row", "name"), [("0,1.6,,,,,2.2,2.6,2.9", "transom"), ("0,1.6,,,,,0.6,1.4,2.1", "ST 0")]
)
def test_a_stern_that_is_broad_at_the_waterline_is_not_drawn_on(
    row: str, name: str, tmp_path: Path
) -> None:
    """However little of it is under water; a narrow one is."""
    head, _, *rows = without_deck(BOAT).splitlines()[1:]
    state, _ = boat(tmp_path, "\n".join(["# m", head, row, *rows]) + "\n")
    assert name in ah.Hull(state).lines


def scow(*, power: float, stern: float, bow: float) -> str:
    """A hull of 50 m with V sections and a rising keel at both ends; parts of the breadth there."""
    x, z = np.linspace(0.0, 50.0, 11), np.arange(7.0)
    part = np.interp(x, [0.0, 25.0, 50.0], [stern, 1.0, bow])
    low = 1.5 * np.clip(np.abs(x - 25.0) / 10.0 - 1.5, 0.0, 1.0) ** 2
    rows = ["x_m," + ",".join(f"WL {each:g} m" for each in z) + ",keel"]
    for each, b, k in zip(x, 5.0 * part, low, strict=True):
        over = np.clip((z - k) / (6.0 - k), 0.0, None)
        cells = ["" if h < k else f"{y:.4f}" for h, y in zip(z, b * over**power, strict=True)]
        rows.append(",".join([f"{each:g}", *cells, f"{k:.4f}"]))
    return "\n".join(rows) + "\n"


@pytest.mark.parametrize("length", [None, 50.0])
def test_perpendiculars_stand_at_flat_ends_and_not_beyond(
    length: float | None, tmp_path: Path
) -> None:
    """The stem was drawn on by 5 m forward of a flat bow: the middle of a scow was 5 m off."""
    path = tmp_path / "scow.csv"
    path.write_text(scow(power=1.0, stern=0.7, bow=0.7))
    state, report = import_hull(path, ImportOptions(length=length, draught=3.0))
    hull = ah.Hull(state)
    assert {"transom", "bow end"} <= set(hull.lines)
    there = hull.hydrostatics(on_error="report")
    assert (state.particulars.length, there.lwl) == pytest.approx((50.0, 50.0), abs=1e-6)
    assert there.lcb == pytest.approx(25.0, abs=1e-3)
    assert not [each for each in report.verdict.suspicions if "stem meets" in each.what]


@pytest.mark.parametrize("power", [0.5, 1.0])
@pytest.mark.parametrize("stern", [0.2, 0.45, 0.7])
def test_a_transom_and_the_after_perpendicular_are_found_by_one_rule(
    power: float, stern: float, tmp_path: Path
) -> None:
    """The edge was made at the last station, and the AP was put where waterlines went on to."""
    path = tmp_path / "boat.csv"
    path.write_text(scow(power=power, stern=stern, bow=0.0))
    state, _ = import_hull(path, ImportOptions(draught=3.0))
    there = ah.Hull(state).hydrostatics(on_error="report")
    broad = stern == 0.7
    assert ("transom" in ah.Hull(state).lines, there.transom_area > 0.0) == (broad, broad)
    assert state.particulars.length == pytest.approx(there.lwl, abs=1e-6)
    assert (state.particulars.length > 50.1) == (not broad)


def test_a_narrow_stern_that_is_open_under_water_is_told_to_be_no_transom(tmp_path: Path) -> None:
    """It is neither drawn on nor closed; that its area counts nothing was not said."""
    head, _, *rows = BOAT.splitlines()[1:]
    row = "0,0.95,,,0.2,0.35,0.4,0.45,0.5,3.4,0.55"
    state, report = boat(tmp_path, "\n".join(["# m", head, row, *rows]) + "\n")
    assert ah.Hull(state).hydrostatics(on_error="report").transom_area == 0.0
    assert any("count as no transom" in each for each in report.adoption.notes)
