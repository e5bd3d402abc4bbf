"""The verdict on an import: what makes a hull not sound, what is suspected, and what is refused."""

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, adopt
from assoc_hull.edit.adoption.latent_crossings import make_latent_crossings
from assoc_hull.errors import BadInputError, NotSoundError
from assoc_hull.io.importing import proportions, soundness
from assoc_hull.io.importing.import_hull import import_hull
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.importing.soundness import examine_net
from assoc_hull.io.importing.verdict import Findings, Verdict
from assoc_hull.io.reports import Note
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, HullState, Particulars
from assoc_hull.shipped.series60 import series60_adopted
from assoc_hull.shipped.wigley import wigley_half_breadth

L, B, T, D = 100.0, 10.0, 6.25, 9.0


def wigley_table(change: Callable[[list[list[str]]], None] | None = None, said: str = "") -> str:
    """A table of a Wigley hull with walls above the water, in m; cells may be changed."""
    x, z = np.linspace(0.0, L, 21), np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, T, 7.5, D])
    y = wigley_half_breadth(x[:, None], np.minimum(z, T)[None], L, B, T)
    rows = [["x_m", *(f"wl_{each:g}" for each in z)]]
    rows += [[f"{a:g}", *(f"{b:.4f}" for b in row)] for a, row in zip(x, y, strict=True)]
    if change is not None:
        change(rows)
    return "\n".join([f"# station 0 = AP, unit m{said}", *map(",".join, rows)]) + "\n"


def read(text: str, folder: Path, **options: object) -> tuple[HullState, Verdict]:
    """Read a table whatever it is worth, and give the verdict."""
    path = folder / "ship.csv"
    path.write_text(text)
    given = {"length": L, "draught": T, "accept": True, **options}
    state, report = import_hull(path, ImportOptions(**given))  # type: ignore[arg-type]
    return state, report.verdict


def test_a_sound_table_is_sound(tmp_path: Path) -> None:
    """Nothing is found, and the notes end with assumptions and the verdict before those made."""
    path = tmp_path / "ship.csv"
    path.write_text(wigley_table())
    hull = ah.read(path, length=L, draught=T, strict=True)
    assert hull.adoption is not None
    assert "verdict: sound" in hull.adoption.notes
    assert hull.labels == {}


@pytest.mark.parametrize(
    ("options", "said", "kind", "words"),
    [
        ({"depth": 5.0, "deck": "closed"}, "", "draught", "above the depth 5 m of a decked"),
        ({"breadth": 10.5}, "", "breadth", "given as 10.5 m and the lines are"),
        ({}, ", B = 10.5 m", "breadth", "given as 10.5 m and the lines are"),
    ],
    ids=["draught above a deck", "breadth given", "breadth stated"],
)
def test_what_no_ship_can_have_is_a_fault(
    options: dict[str, object], said: str, kind: str, words: str, tmp_path: Path
) -> None:
    """Each is named with its number, and refused with what to do."""
    found = read(wigley_table(said=said), tmp_path, **options)[1]
    assert any(each.kind == kind and words in each.what for each in found.faults), found
    options.pop("accept", None)
    with pytest.raises(NotSoundError) as refused:
        ah.read(tmp_path / "ship.csv", **{"length": L, "draught": T, **options})  # type: ignore[arg-type]
    assert refused.value.findings == tuple(map(str, found.faults))


@pytest.mark.parametrize(
    ("options", "said", "kind", "words"),
    [
        ({"length": 130.0}, "", "length", "1.300 of the 100 m from end to end"),
        ({"length": 94.0}, "", "length", "0.940 of the waterline's 100 m at the draught"),
        ({"draught": 0.7, "breadth": 10.0}, "", "proportions", "B/T is 14.29"),
        ({}, ", CB = 0.70", "stated", "the file says CB 0.7, and the hull has 0.4"),
        ({}, ", V = 2300 m3", "stated", "the file says V 2300 m3, and the hull has 27"),
        ({}, ", LCB = -2.5 %", "stated", "the file says LCB -2.5 % of Lpp"),
    ],
    ids=["Lpp", "Lpp of the waterline", "B/T", "CB", "volume", "LCB"],
)
def test_what_few_ships_have_is_a_suspicion(
    options: dict[str, object], said: str, kind: str, words: str, tmp_path: Path
) -> None:
    """The hull is taken, the number named; strict refuses it."""
    verdict = read(wigley_table(said=said), tmp_path, **options)[1]
    assert verdict.faults == ()
    assert any(each.kind == kind and words in each.what for each in verdict.suspicions), verdict
    with pytest.raises(NotSoundError, match=r"suspicions, and strict: .*leave out strict"):
        ah.read(tmp_path / "ship.csv", **{"length": L, "draught": T, **options}, strict=True)  # type: ignore[arg-type]


def test_what_a_file_says_and_has_is_no_suspicion(tmp_path: Path) -> None:
    """True figures in comments, with decimal commas too, raise nothing."""
    said = ", L/B = 10, B/T = 1,6, CB 0,444, CM = .667, CP=0.667, CW = 0.667, LCB 0.0 %, V 2770 m3"
    assert read(wigley_table(said=said), tmp_path)[1].word == "sound"


def test_a_slipped_decimal_point_is_a_fault_that_names_the_cell(tmp_path: Path) -> None:
    """15.2 typed for 1.52 makes no ship 30 m broad."""

    def slip(rows: list[list[str]]) -> None:
        rows[4][3] = f"{10.0 * float(rows[4][3]):.3f}"

    verdict = read(wigley_table(slip), tmp_path)[1]
    told = [each for each in verdict.faults if each.kind == "outlier"]
    assert told, verdict
    for each in told:
        assert "station 15" in each.where
        assert each.where.removesuffix("'").endswith("2")


def test_all_faults_are_told_in_one_run(tmp_path: Path) -> None:
    """A wrong breadth and a wrong depth come together, each with its remedy."""
    more = {"breadth": 10.5, "depth": 5.0, "deck": "closed", "accept": False}
    with pytest.raises(NotSoundError) as refused:
        read(wigley_table(), tmp_path, **more)
    kinds = [each.partition(":")[0] for each in refused.value.findings]
    assert kinds == ["draught", "breadth"]
    assert "these 2" in str(refused.value)


def test_an_accepted_hull_keeps_the_verdict(tmp_path: Path) -> None:
    """In the notes of its adoption, and as a checkpoint that is saved with it."""
    path = tmp_path / "ship.csv"
    path.write_text(wigley_table())
    hull = ah.read(path, length=L, draught=T, breadth=10.5, accept=True)
    assert hull.adoption is not None
    assert "verdict: not sound (1 fault)" in hull.adoption.notes
    hull.save(tmp_path / "ship.hull")
    hull.close()
    (label,) = ah.open(tmp_path / "ship.hull").labels
    assert label.startswith("as imported, not sound (1 fault): breadth: ")


def test_accept_and_strict_exclude_one_another() -> None:
    """One takes what the other refuses."""
    with pytest.raises(BadInputError, match="give one of them"):
        ImportOptions(accept=True, strict=True)


# --------------------------------------------------------------------------------------
# Lines and net.


@pytest.fixture(scope="module")
def series60() -> tuple[HullState, AdoptionReport]:
    """Series 60, CB 0.60, with borders of its flats."""
    return series60_adopted(0.60)


def judged(net: tuple[HullState, AdoptionReport], used: dict[str, float]) -> Verdict:
    """Give the verdict on a net some of whose lines are said to use so much of what is allowed."""
    state, report = net
    allowed = state.tolerances.adoption
    lines = tuple(
        attrs.evolve(each, tolerance=allowed, tolerance_used=used.get(each.line, used.get("", 0.5)))
        for each in report.lines
    )
    found = Findings()
    examine_net(state, attrs.evolve(report, lines=lines), found)
    return found.verdict()


def test_a_net_within_its_tolerances_is_sound(series60: tuple[HullState, AdoptionReport]) -> None:
    """Half of what is allowed is no finding, nor is what adoption allows between points."""
    assert judged(series60, {}) == Verdict()
    assert judged(series60, {"": 1.05}) == Verdict()


@pytest.mark.parametrize(
    ("used", "faults", "suspicions"),
    [
        ({"ST 4": 10.5}, ["off its source"], []),
        ({"ST 4": 9.5, "WL 0.5": 1.2}, [], ["off their sources"]),
        ({"": 1.2}, ["off their sources", "border of a flat", "border of a flat"], []),
        ({"flat of side": 1.2}, ["border of a flat"], ["off their sources"]),
        ({"ST 4": float("nan")}, ["off its source"], []),
    ],
    ids=["far off", "off", "most lines", "border", "no number"],
)
def test_lines_off_their_sources(
    used: dict[str, float], faults: list[str], suspicions: list[str],
    series60: tuple[HullState, AdoptionReport],
) -> None:  # fmt: skip
    """Over 10 times the tolerance, or most lines, are faults; less is a suspicion, with place."""
    verdict = judged(series60, used)
    assert [each.kind for each in verdict.faults] == faults
    assert [each.kind for each in verdict.suspicions] == suspicions
    for each in verdict.suspicions:
        assert " mm at (" in each.what
        assert f"of {len(series60[1].lines)} lines" in each.where


def sections(change: Callable[[np.ndarray], None] | None = None) -> str:
    """Digitised sections and two waterlines of a Wigley hull, as CSV."""
    x, z = np.linspace(5.0, 95.0, 13), np.linspace(0.0, D, 19)
    y = wigley_half_breadth(x[:, None], np.minimum(z, T)[None], L, B, T)
    if change is not None:
        change(y)
    rows = [
        f"ST {i},{a:g},{b:.6f},{c:g}"
        for i, a in enumerate(x) for b, c in zip(y[i], z, strict=True)
    ]  # fmt: skip
    return "\n".join(["line,x,y,z", *rows]) + "\n"


@pytest.mark.parametrize(("apart", "count"), [(2e-5, 0), (9e-4, 0), (1.1e-3, 1), (0.05, 1)])
def test_lines_that_touch_do_not_miss_one_another(
    monkeypatch: pytest.MonkeyPatch, apart: float, count: int
) -> None:
    """Within the least limit of a gap, a millimetre of a ship of 100 m, nothing is to be mended."""
    state, report = series60_adopted(0.70)
    lines = state.live("lines").tolist()
    one, other = (
        next(line for line in lines if state.family(line).name == family)
        for family in ("sections", "waterlines")
    )
    place = np.array([[50.0, 5.0, 4.0]])
    places = {
        (state.lines.curves[one][0], other): place,
        (state.lines.curves[other][0], one): place + np.array([0.0, apart, 0.0]),
    }
    monkeypatch.setattr(soundness, "_latent_places", lambda _: places)
    found = Findings()
    examine_net(state, report, found)
    assert sum(each.kind == "gap" for each in found.faults) == count


def test_a_line_through_the_centre_plane_is_a_fault() -> None:
    """A section whose spline swings beyond it is named, with its place and how far it runs."""
    points = np.array([[0.0, 0.0], [0.01, 1.0], [0.01, 2.0], [4.0, 2.5], [5.0, 6.0]])
    lines = [
        LineSource.make("sections", f"ST {i}", np.insert(points, 0, 10.0 * i, axis=1))
        for i in range(2)
    ]
    state, report = adopt(lines, Particulars("a", 10.0, 10.0, 6.0, 3.0), ())
    found = Findings()
    examine_net(state, report, found)
    told = [each for each in found.faults if each.kind == "centre plane"]
    assert [each.where.split(" at ")[0] for each in told] == ["ST 0", "ST 1"]
    for each in told:
        assert each.amount is not None
        assert each.amount > 0.005
        assert f"{1e3 * each.amount:.1f} mm through the centre plane" in each.what


def test_lines_that_pass_one_another_are_a_fault(tmp_path: Path) -> None:
    """A waterline 200 mm outside of the sections it should cross gapes at them."""
    x = np.linspace(5.0, 95.0, 31)
    y = wigley_half_breadth(x, np.full(31, 3.0), L, B, T) + 0.2
    line = "".join(f"WL 3,{a:g},{b:.6f},3\n" for a, b in zip(x, y, strict=True))
    verdict = read(sections() + line, tmp_path)[1]
    told = [each for each in verdict.faults if each.kind == "gap"]
    assert sum(each.where.count(" x WL 3") for each in told) >= 12, verdict
    assert all(each.where.startswith("ST ") and " x WL 3 at (" in each.where for each in told)
    assert read(sections(), tmp_path)[1].faults == ()


def parted(hole: float) -> str:
    """The same with deck edge and a profile whose keel lacks so much (m) amidships."""
    x, z = np.linspace(0.0, L, 41), np.linspace(0.0, D, 19)
    rows = []
    for name, level, water in (("deck edge", D, T), ("WL 3", 3.0, 3.0)):
        half = wigley_half_breadth(x, np.full(len(x), water), L, B, T)
        rows += [f"{name},{a:g},{b:.6f},{level:g},1" for a, b in zip(x, half, strict=True)]
    aft = [*((0.0, c) for c in z[::-1]), *((a, 0.0) for a in x[1:20]), (0.5 * (L - hole), 0.0)]
    rows += [f"profile,{a:g},0,{c:g},1" for a, c in aft]
    rows += [f"profile,{L - a:g},0,{c:g},2" for a, c in aft[::-1]]
    rows += [f"{row},1" for row in sections().splitlines()[1:]]
    return "\n".join(["line,x,y,z,piece", *rows]) + "\n"


def test_a_hole_in_the_profile_is_refused_with_a_join_that_closes_it(tmp_path: Path) -> None:
    """The message names the place; `join=` as told leads to a hull that is sound and closes."""
    path = tmp_path / "holed.csv"
    path.write_text(parted(0.17))
    with pytest.raises(NotSoundError, match=r"hole of 170 mm at \(50, 0, 0\) m") as refused:
        ah.read(path, length=L, draught=T)
    told = re.search(r"join= of ([\d.]+) m", str(refused.value))
    assert told is not None
    hull = ah.read(path, length=L, draught=T, join=float(told[1]), strict=True)
    assert hull.mesh().triangles.face.size
    # So wide that no width is proposed: something is missing that no chord can stand for.
    path.write_text(parted(2.0))
    with pytest.raises(NotSoundError, match=r"open net.*profile at \(51\.000, 0\.000, 0\.000\) m"):
        ah.read(path, length=L, draught=T)


@pytest.mark.parametrize(("short", "made"), [(0.0, 0), (5e-5, 0), (0.04, 1)])
def test_lines_lengthened_to_one_place_of_the_stem_leave_no_gap(short: float, made: int) -> None:
    """Given lines that end short of the stem meet only when both are on it: no gap by their noise.

    Within the tolerance of their ends they need no crossing; farther from these it is made.
    """
    z, y = np.arange(10.0), np.linspace(4.0, 0.0, 9)
    up = z[5:]
    stem, station, level = (
        np.stack([100.0 + 0.5 * (z - 5.0 + short), 0.0 * z, z], axis=1),
        np.stack([0.0 * up + 100.0, 0.1 * (up - 5.0), up], axis=1),
        np.stack([100.0 - 4.0 * y, y, 0.0 * y + 5.0], axis=1),
    )
    lines = [
        LineSource.make(
            "boundary", "profile", stem, plane=((0, 1, 0), 0.0), boundary=BoundaryKind.END
        ),
        LineSource.make("sections", "ST 20", station),
        LineSource.make("waterlines", "WL 5", level),
    ]
    links = [("sections", "waterlines"), ("boundary", "sections"), ("boundary", "waterlines")]
    ship = Particulars("a", 100.0, 10.0, 6.0, 9.0)
    state, report = adopt(lines, ship, [Association(*each) for each in links])
    assert make_latent_crossings(state) == ("WL 5 x ST 20",) * made
    found = Findings()
    examine_net(state, report, found)
    assert found.faults == []
    assert ah.Hull(state).check() == ()
    assert ah.Hull(state).verify() == ()


def test_what_cannot_be_computed_is_a_fault(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An error within a look is told, and the others go on."""

    def fails(*_: object, **__: object) -> None:
        raise ZeroDivisionError("float division by zero")

    monkeypatch.setattr(proportions, "hydrostatics", fails)
    verdict = read(wigley_table(), tmp_path, breadth=10.5)[1]
    assert [each.kind for each in verdict.faults] == ["not computed", "breadth"]
    assert "ZeroDivisionError" in verdict.faults[0].what


def test_a_vertical_stem_at_a_station_is_no_finding(tmp_path: Path) -> None:
    """Series 60 .70 and fuller: section, waterline and stem end in one point of the stem."""
    folder = os.environ.get("ASSOC_HULL_DATA", "")
    path = Path(folder) / "series60" / "s60_cb070_offsets.csv"
    if not path.exists():
        pytest.skip("the data folder is missing")
    heads, *rows = path.read_text().splitlines()[1:]
    for power in (1.0, 1.3, 2.2):  # CB .70 to .81
        fuller = [row.split(",") for row in rows]
        for row in fuller:
            row[1:9] = [f"{1.0 - (1.0 - float(y)) ** power:.4f}" for y in row[1:9]]
        head = "# y/(B/2), z/T; station 0=FP, 20=AP; L/B=7.0, B/T=2.5"
        text = "\n".join([head, *(",".join(row[:9]) for row in [heads.split(","), *fuller])])
        state, verdict = read(text + "\n", tmp_path, length=121.92, draught=None)
        assert verdict.faults == ()
        assert ah.Hull(state).check() == ()
        assert ah.Hull(state).verify() == ()


# --------------------------------------------------------------------------------------
# Files that are none.


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no pipes with names")
@pytest.mark.parametrize(
    "name", ["ship.csv", "ship.stl", "ship.igs", "ship.hull", "ship.hull.json"]
)
def test_a_pipe_is_refused(name: str, tmp_path: Path) -> None:
    """Nothing waits for what will never come."""
    pipe = tmp_path / name
    os.mkfifo(pipe)
    for reader in (ah.read, ah.open, ah.creation.read_classical):
        with pytest.raises(BadInputError, match=r"pipe|regular file"):
            reader(pipe)


# --------------------------------------------------------------------------------------
# Words.


@pytest.mark.parametrize(
    ("faults", "suspicions", "words"),
    [
        (0, 0, "sound"), (0, 2, "sound with suspicions (2)"), (1, 0, "not sound (1 fault)"),
        (2, 1, "not sound (2 faults, 1 suspicion)"),
    ],
)  # fmt: skip
def test_a_verdict_in_words(faults: int, suspicions: int, words: str) -> None:
    """It begins with one of three words, and counts what was found."""
    found = Note("gap", "ST 1", "70 mm")
    assert str(Verdict((found,) * faults, (found,) * suspicions)) == words


def test_findings_that_are_alike_are_one_with_all_places() -> None:
    """Three that differ in places and numbers make one line, of the worst; two stay two."""
    found = Findings()
    for name, over in (("ST 1", 0.1), ("ST 2", 0.3), ("ST 3", 0.2)):
        where = f"{name} at (1.000, {-over}, 2.000) m"
        found.fault("centre plane", where, f"runs {1e3 * over:g} mm through", over)
        found.suspect("doubtful numbers", "the net", f"{name} has {over} m2: check", over)
    for name in ("ST 1", "ST 2"):
        found.fault("fold", name, "folds back on itself (cosine -0.5)")
    verdict = found.verdict()
    assert [str(each) for each in verdict.faults] == [
        "centre plane: ST 2 at (1.000, -0.3, 2.000) m; likewise ST 1, ST 3: runs 300 mm through",
        "fold: ST 1: folds back on itself (cosine -0.5)",
        "fold: ST 2: folds back on itself (cosine -0.5)",
    ]
    assert [each.where for each in verdict.suspicions] == ["the net; likewise ST 1, ST 3"]


@pytest.mark.parametrize("deck", [None, "open", "closed"])
def test_an_open_deck_that_nobody_asked_for_is_an_assumption(
    deck: str | None, tmp_path: Path
) -> None:
    """No table tells of one; what heels beyond the edge of an open one has no levers."""
    path = tmp_path / "table.csv"
    path.write_text(wigley_table())
    state, report = import_hull(path, ImportOptions(length=L, draught=T, deck=deck))
    told = [str(each) for each in report.notes.assumptions if each.kind == "deck"]
    assert [each.split(",")[0] for each in told] == ["deck: the hull: open"] * (deck is None)
    assert state.particulars.deck == (deck or "open")


UPRIGHT = """station,0,0.5,1,2,3,4
0,0,0,.2,1,2.6,3.4
1,.2,1.5,2.6,3.6,4.2,4.5
2,2,3.9,4.4,4.7,4.8,4.8
3,3,4.5,4.75,4.8,4.8,4.8
4,3.1,4.6,4.8,4.8,4.8,4.8
5,3.1,4.6,4.8,4.8,4.8,4.8
6,3,4.5,4.75,4.8,4.8,4.8
7,2,3.9,4.4,4.7,4.8,4.8
8,1,2.6,3.4,4.1,4.5,4.7
9,.2,.9,1.5,2.2,2.9,3.6
10,0,0,.1,.2,.4,1
"""
"""The stem stands upright at the last station up to .5 m, and rakes forward above."""


def test_a_section_begins_where_an_upright_stem_leaves_its_plane(tmp_path: Path) -> None:
    """At the upper end of the run, as the table says, whichever end the stem's passage counts."""
    path = tmp_path / "coaster.csv"
    path.write_text(UPRIGHT)
    wanted = ImportOptions(length=50.0, draught=3.0, station_zero="ap")
    state, report = import_hull(path, wanted)
    assert not report.verdict.faults
    lines = {str(state.lines.name[line]): line for line in state.live("lines").tolist()}
    (curve,) = state.lines.curves[lines["ST 10"]]
    assert state.rows.xyz[state.curves.rows[curve][0]].tolist() == [50.0, 0.0, 0.5]


@pytest.mark.parametrize("numbers", ["usual", "other"])
def test_all_that_numbered_stations_lack_is_told_at_once(numbers: str, tmp_path: Path) -> None:
    """Length, perpendicular and spacings: with what is named the table is read."""
    path = tmp_path / "coaster.csv"
    path.write_text(UPRIGHT if numbers == "usual" else UPRIGHT.replace("\n10,", "\n12,"))
    given: dict[str, Any] = {"length": 50.0, "station_zero": "ap"}
    given |= {} if numbers == "usual" else {"station_spacings": 12}
    with pytest.raises(BadInputError) as told:
        import_hull(path, ImportOptions(draught=3.0))
    assert all(f"{name}=" in str(told.value) for name in given)
    assert ("station_spacings=" in str(told.value)) == (numbers == "other")
    for name in given:
        left = {key: value for key, value in given.items() if key != name}
        with pytest.raises(BadInputError, match=f"{name}="):
            import_hull(path, ImportOptions(draught=3.0, **left))
    read = import_hull(path, ImportOptions(draught=3.0, accept=True, **given))[0]
    assert read.particulars.length == 50.0
