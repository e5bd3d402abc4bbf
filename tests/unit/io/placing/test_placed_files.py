"""Files whose origin is elsewhere come in as the same hull: lines, tables, and what is told."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.importing.import_hull import import_hull
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.placing.options import FrameOptions
from assoc_hull.shipped.wigley import wigley_half_breadth

L, B, T = 100.0, 10.0, 6.25
X = np.linspace(0.0, L, 21)
Z = np.linspace(0.0, 2 * T, 11)


def half_breadth(x: Any, z: Any) -> Any:
    """A Wigley hull with sides straight up from its waterline."""
    return wigley_half_breadth(x, np.minimum(z, T), L, B, T)


def lines(x: float, z: float, form: str = "{:.9g}") -> str:
    """Its sections and waterlines as CSV, with the origin of the file elsewhere."""
    rows = ["line,x,y,z"]

    def add(name: str, points: Any) -> None:
        for a, b, c in points:
            cells = ",".join(form.format(each) for each in (a + x, b, c + z))
            rows.append(f"{name},{cells}")

    for at in X[1:-1].tolist():
        add(f"ST {at + x:g}", [(at, half_breadth(at, c), c) for c in np.linspace(0, 2 * T, 41)])
    for high in Z[1:-1].tolist():
        add(f"WL {high + z:g}", [(a, half_breadth(a, high), high) for a in np.linspace(0, L, 81)])
    add("deck edge", [(a, half_breadth(a, 2 * T), 2 * T) for a in np.linspace(0, L, 81)])
    add("profile", [(0.0, 0.0, 2 * T), (0.0, 0.0, 0.0), (L, 0.0, 0.0), (L, 0.0, 2 * T)])
    return "\n".join(rows) + "\n"


def table(x: float, z: float, unit: float = 1.0) -> str:
    """Its offsets, with x and heights of the keel as columns."""
    head = ",".join(["x", "z_keel", *(f"wl_{each + z:g}" for each in Z.tolist())])
    rows = [
        ",".join(f"{unit * each:.9g}" for each in (a + x, z, *half_breadth(a, Z)))
        for a in X.tolist()
    ]
    return "\n".join([head, *rows]) + "\n"


def test_lines_with_another_origin_are_the_same_lines_moved() -> None:
    """Drawn from midship and the waterline they come to AP and keel, and go by their new places."""
    here = read_lines(lines(0.0, 0.0), frame=FrameOptions(length=L, draught=T))
    there = read_lines(lines(-50.0, -T), frame=FrameOptions(length=L))
    assert here.frame is not None
    assert there.frame is not None
    assert not here.frame.moves
    assert (there.frame.ap, there.frame.base, there.frame.draught) == (-50.0, -T, T)
    for one, other in zip(here.lines, there.lines, strict=True):
        assert one.name == other.name
        assert one.offset == pytest.approx(other.offset)
        for a, b in zip(one.pieces, other.pieces, strict=True):
            np.testing.assert_allclose(a.points, b.points, atol=1e-6)
    assert "names" in there.report.kinds("repairs")
    assert np.allclose(here.low, there.low)
    assert np.allclose(here.high, there.high)


def test_lines_in_place_stay_to_the_bit() -> None:
    """What lies in ship axes has the same bits as if nobody had looked for a frame."""
    plain = read_lines(lines(0.0, 0.0))
    placed = read_lines(lines(0.0, 0.0), frame=FrameOptions(length=L, draught=T))
    for one, other in zip(plain.lines, placed.lines, strict=True):
        for a, b in zip(one.pieces, other.pieces, strict=True):
            assert a.points.tobytes() == b.points.tobytes()


def test_lines_may_have_other_axes() -> None:
    """With the bow at low x: axes= turns them, and a place that is given goes along."""
    text = lines(0.0, 0.0)
    rows = [row.split(",") for row in text.splitlines()[1:]]
    turned = "\n".join(
        ["line,x,y,z", *(f"{n},{-float(x)},{-float(y)},{z}" for n, x, y, z in rows)]
    ).replace("ST ", "ST -")
    slices = read_lines(turned, axes="-x-y+z", frame=FrameOptions(fp=-L, length=L, draught=T))
    assert slices.frame is not None
    assert (slices.frame.ap, slices.frame.fp) == (0.0, L)
    assert float(slices.high[1]) == pytest.approx(B / 2)


@pytest.mark.parametrize("transom", [True, False], ids=["a transom", "a broad end"])
def test_a_stern_that_lies_forward_is_suspected_and_the_remedy_cures_it(transom: bool) -> None:
    """Half of a Wigley hull, which ends broad at x = 0, drawn aft: axes= as told turns it."""
    rows = []
    for x in np.linspace(50.0, 98.0, 9).tolist():
        name = "transom" if transom and x == 50.0 else f"ST {x:g}"
        rows += [f"{name},{-x},{half_breadth(x, z):.6f},{z}" for z in np.linspace(0, 2 * T, 21)]
    text = "line,x,y,z\n" + "\n".join(rows) + "\n"
    said = FrameOptions(draught=T)
    (note,) = [
        each for each in read_lines(text, frame=said).report.suspicions if each.kind == "bow"
    ]
    remedy = note.what.partition("axes='")[2].partition("'")[0]
    turned = read_lines(text, frame=said, axes=remedy)
    assert "bow" not in turned.report.kinds("suspicions")
    right = read_lines(text.replace(",-", ","), frame=said)
    assert "bow" not in right.report.kinds("suspicions")
    assert [line.offset for line in turned.lines] == [line.offset for line in right.lines]


def test_a_named_line_is_the_deck_edge_and_bulwarks_are_cut() -> None:
    """What stands above it goes, is told, and the depth is that of the deck."""
    text = lines(0.0, 0.0).replace("deck edge", "bulwark")
    deck = [
        (a, half_breadth(a, 10.0), 10.0 + 2e-4 * (a - 50.0) ** 2) for a in np.linspace(0, L, 41)
    ]
    rows = "".join(f"main deck,{x:.9g},{y:.9g},{z:.9g}\n" for x, y, z in deck)
    with pytest.raises(
        ah.errors.BadInputError, match=r"no line is called 'weather deck'.*give one of"
    ):
        read_lines(text + rows, deck_edge="weather deck")
    text = "".join(row + "\n" for row in text.splitlines() if not row.startswith("bulwark"))
    slices = read_lines(text + rows, deck_edge="Main deck", frame=FrameOptions(length=L, draught=T))
    assert slices.frame is not None
    assert slices.frame.depth == pytest.approx(10.0, abs=0.01)
    assert "bulwark" in slices.report.kinds("repairs")
    for line in slices.group("sections"):
        assert line.pieces[-1].points[-1, 2] <= 10.5 + 1e-9
        assert line.pieces[-1].ends[1] == "deck edge"


def read_table(folder: Path, text: str, **said: Any) -> Any:
    """Import a table from a file."""
    path = folder / "t.csv"
    path.write_text(text)
    return import_hull(path, ImportOptions(**said))


@pytest.mark.parametrize(
    ("x", "z", "said"),
    [
        (0.0, 0.0, {"draught": T}),
        (12.0, 3.0, {"draught": T}),
        (12.0, 3.0, {"waterline": T + 3.0, "fp": "112 m"}),
        (-50.0, 0.0, {"draught": T}),
        (-50.0, 0.0, {"draught": T, "origin": "midship"}),
    ],
)
def test_a_table_with_another_origin_is_the_same_hull(
    tmp_path: Path, x: float, z: float, said: dict[str, Any]
) -> None:
    """Its stations and heights come to AP and keel by Lpp alone, or as it is said."""
    state, report = read_table(tmp_path, table(x, z), length=L, **said)
    assert report.frame.ap == pytest.approx(x, abs=0.5)
    assert report.table.x[0] == pytest.approx(0.0, abs=0.5)
    assert report.table.z[0] == pytest.approx(0.0, abs=1e-9)
    ship = state.particulars
    assert (ship.length, ship.draught) == (L, pytest.approx(T))
    assert ship.breadth == pytest.approx(B)
    hull = ah.Hull(state)
    assert hull.half_breadth(50.0, T) == pytest.approx(B / 2, abs=2e-3)


def test_a_table_of_a_model_is_that_of_the_ship(tmp_path: Path) -> None:
    """At scale 25, its particulars given at full scale and its waterline in the file."""
    small = 1.0 / 25.0
    x, z = X * small, Z * small
    head = ",".join(["x", *(f"wl_{each:g}" for each in z.tolist())])
    rows = [
        ",".join(f"{each:.9g}" for each in (a, *(small * half_breadth(a / small, Z))))
        for a in x.tolist()
    ]
    state, report = read_table(
        tmp_path, "\n".join([head, *rows]) + "\n", scale=25.0, length=L, unit="m",
        waterline=T * small,
    )  # fmt: skip
    assert report.frame.draught == pytest.approx(T)
    assert state.particulars.length == L
    assert ah.Hull(state).half_breadth(50.0, T) == pytest.approx(B / 2, abs=2e-3)


def test_what_was_found_is_told_in_python_as_on_the_command_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each value that was not given, the suspicion of the AP, and LCB as a place."""
    path = tmp_path / "lines.csv"
    path.write_text(lines(-50.0, -T))
    hull = ah.read(path)
    assert hull.adoption is not None
    notes = "\n".join(hull.adoption.notes)
    for kind in ("base line", "draught", "forward perpendicular", "aft perpendicular", "breadth"):
        assert f"assumed: {kind}: " in notes
    assert "suspicion: aft perpendicular: " in notes
    assert "LCB at the draught of 6.25 m lies 5" in notes
    assert "aft of the place where the stem meets the waterline" in notes
    ship = hull.particulars
    assert (ship.length, ship.draught, ship.depth) == pytest.approx((L, T, 2 * T))
    again = ah.read(path, length=L, waterline="0 m", origin="midship")
    assert again.adoption is not None
    assert "suspicion: aft perpendicular" not in "\n".join(again.adoption.notes)
    assert main(["import", str(path), "-o", str(tmp_path / "o.hull"), "--length", "100",
                 "--waterline", "0m", "--origin", "midship"]) == 0  # fmt: skip
    out = capsys.readouterr().out
    assert "base line: the lines: at z = -6.25 m" in out
    assert main(["import", str(path), "-o", str(tmp_path / "p.hull"), "--draught", "60"]) != 0
    assert "over the top of the hull" in capsys.readouterr().err


def test_options_that_a_form_does_not_take_are_refused(tmp_path: Path) -> None:
    """The deck edge of a table, frames of lines: said, not ignored."""
    path = tmp_path / "lines.csv"
    path.write_text(lines(0.0, 0.0))
    wrong: dict[str, Any] = {"station_spacings": 20, "frame_spacing": 0.7}
    for name, value in wrong.items():
        with pytest.raises(ah.errors.BadInputError, match=f"{name} cannot be given"):
            ah.read(path, **dict([(name, value)]))
    path.write_text(table(0.0, 0.0))
    with pytest.raises(ah.errors.BadInputError, match="deck_edge cannot be given"):
        ah.read(path, deck_edge="main deck", length=L)


def test_stations_may_be_frames_or_any_number_of_spacings(tmp_path: Path) -> None:
    """Frame 0 at the AP and 2.5 m apart, or 40 spacings: the same stations."""
    rows = [",".join(f"{each:.9g}" for each in (i * 2, *half_breadth(a, Z)))
            for i, a in enumerate(X.tolist())]  # fmt: skip
    head = ",".join(["station", *(f"wl_{each:g}" for each in Z.tolist())])
    text = "\n".join([head, *rows]) + "\n"
    for said in ({"frame_spacing": 2.5}, {"station_spacings": 40}):
        _, report = read_table(
            tmp_path, text, length=L, draught=T, unit="m", station_zero="ap", **said
        )
        np.testing.assert_allclose(report.table.x, X)
    with pytest.raises(ah.errors.BadInputError, match="give one"):
        read_table(tmp_path, text, length=L, frame_spacing=2.5, station_spacings=40)
